"""The command `rosbeat explain`: why nothing arrives on a topic of a terminal's ROS domain."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from dataclasses import replace
from typing import Any

from rosbeat.diagnosis.silence import Explanation, explain
from rosbeat.diagnosis.topic_snapshot import StaleBuild
from rosbeat.errors import CommandError, SessionError
from rosbeat.inspection import inspect_topic
from rosbeat.ros.errors import duration_ns
from rosbeat.ros.session_core import SessionCore, full_topic

#: The last domain id that there is (RTPS specification, section 9.6.1).
_LAST_DOMAIN = 232


def explain_domain(
    topic: str,
    domain_id: int | None,
    seconds: float,
    stale_builds: Callable[[str], tuple[StaleBuild, ...]],
) -> Explanation:
    """Say why nothing arrives on a topic in a domain, as a node that joins it for a while.

    A terminal shows one line on the standard error stream first.

    Args:
        topic: The topic's name, with or without its slash.
        domain_id: The domain; None for the terminal's own.
        seconds: How long to listen at most, in seconds of wall time.
        stale_builds: Says of a topic which programs that name it were edited and not built again.

    Raises:
        CommandError: If one of them cannot be used.
    """
    try:
        name, span = full_topic("explain", topic), duration_ns(seconds, "--seconds") / 1e9
    except SessionError as error:
        raise CommandError(error.what, error.means, error.to_try) from None
    domain = _checked_domain(domain_id)
    if sys.stderr.isatty():
        print(f"Looking at {name} in ROS domain {domain} ...", file=sys.stderr)
    core = SessionCore(0, domain)
    try:
        scene = inspect_topic(core, name, span)
    finally:
        core.close()
    return explain(name, replace(scene, stale_builds=stale_builds(name)))


def _checked_domain(given: int | None) -> int:
    asked: Any = given if given is not None else os.environ.get("ROS_DOMAIN_ID") or "0"
    number = int(asked) if str(asked).isdecimal() and str(asked).isascii() else -1
    if 0 <= number <= _LAST_DOMAIN:
        return number
    source = "--domain-id" if given is not None else "ROS_DOMAIN_ID"
    raise CommandError(
        f"{source} is {asked!r}, which is no domain id.",
        f"It says which processes see each other, and is a whole number from 0 to {_LAST_DOMAIN}.",
        "Look at the number of the node's terminal: `echo $ROS_DOMAIN_ID`.",
    )
