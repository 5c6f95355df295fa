"""A module of a node's own, which imports `sleep` by itself."""

from __future__ import annotations

from time import sleep


def sleep_in_a_helper(seconds: float) -> None:
    """Sleep, by a name that only this module has."""
    sleep(seconds)
