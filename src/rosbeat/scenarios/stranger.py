"""A system that the learner did not write, put into a session."""

from __future__ import annotations

from typing import Any

from rosbeat.ros import test_nodes

__all__ = ["greenhouse"]


def greenhouse(session: Any) -> None:  # noqa: ANN401 - a Session, which is not imported here
    """Put the five nodes of the greenhouse into a session.

    Args:
        session: The session.
    """
    test_nodes.add_greenhouse(session)
