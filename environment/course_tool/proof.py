"""Proves that ROS works in `.venv`: a real message, in a process of its own, with a deadline."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from course_tool import running
from course_tool.layout import Layout
from course_tool.messages import Problem

_DEADLINE = 60.0
_WRONG_MIDDLEWARE = 102


def ask_ros(layout: Layout, environ: Mapping[str, str]) -> dict[str, Any]:
    """Return what ROS says of itself in `.venv`.

    Raises:
        Problem: If it cannot be asked, or no message arrives.
    """
    script = Path(__file__).with_name("ros_check.py")
    result = running.quiet([layout.python, script], environ, timeout=_DEADLINE)
    facts = _facts(result.text) if result.ok else None
    if facts is None:
        raise silent(result)
    if facts["milliseconds"] is None:
        raise unheard()
    return facts


def silent(result: running.Result) -> Problem:
    """Return the problem of a ROS that does not start."""
    cure = "Remove the folder .venv and run the same command again."
    if result.code == _WRONG_MIDDLEWARE:
        cure = "Unset RMW_IMPLEMENTATION: this ROS brings rmw_fastrtps_cpp."
    return Problem(
        "ROS 2 is installed in .venv, but a first node does not start.",
        "No page of the course would run, so it is not opened.",
        cure + "\nIf it stays like this, send the lines below to the course's issue tracker.",
        "\n".join(result.text.strip().splitlines()[-12:]),
    )


def unheard() -> Problem:
    """Return the problem of a subscriber that hears nothing."""
    return Problem(
        "A first node publishes, and a subscriber in the same process hears nothing.",
        "ROS 2 starts here, but its messages do not travel.",
        "Look whether ROS_DOMAIN_ID, ROS_AUTOMATIC_DISCOVERY_RANGE or\n"
        "FASTRTPS_DEFAULT_PROFILES_FILE is set to something unusual, and whether the\n"
        "loopback interface is up:  ip link show lo",
    )


def _facts(text: str) -> dict[str, Any] | None:
    try:
        facts = json.loads(text.strip().splitlines()[-1])
    except (ValueError, IndexError):
        return None
    return facts if isinstance(facts, dict) else None
