"""What the doctor looks at in ROS, as a plain Python of `.venv` sees it."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any

from course_tool import proof, surroundings
from course_tool.findings import Finding, note, ok, problem
from course_tool.layout import Layout
from course_tool.messages import Problem

LAB = "./environment/course lab"
_PROFILES = ("FASTRTPS_DEFAULT_PROFILES_FILE", "FASTDDS_DEFAULT_PROFILES_FILE")
_OUR_PROFILE = os.path.join("ros2_command", "data", "fastdds.xml")


def findings(layout: Layout, clean: surroundings.Surroundings) -> list[Finding]:
    """Ask ROS itself, once, and judge its answers."""
    environ = surroundings.inside(clean.environ, layout)
    try:
        facts = proof.ask_ros(layout, environ)
    except Problem as trouble:
        cure = trouble.cure.replace("\n", f"\n{'':30}")
        return [problem("ROS", _with_last_line(trouble), cure)]
    return judge(facts, clean.environ, str(layout.venv)) + middleware_asked_for(clean)


def judge(facts: Mapping[str, Any], environ: Mapping[str, str], venv: str) -> list[Finding]:
    """Judge what ROS said.

    Args:
        facts: What `ros_check` printed.
        environ: What the person set, before the course's defaults.
        venv: Where ROS should come from.
    """
    seen: Mapping[str, str] = facts["environ"]
    return [
        origin(facts["rclpy"], facts["rclpy_file"], venv),
        ok("message heard", f"after {facts['milliseconds']:.0f} ms"),
        ok("middleware", facts["rmw"]),
        domain(seen.get("ROS_DOMAIN_ID"), environ.get("ROS_DOMAIN_ID")),
        reach(seen.get("ROS_AUTOMATIC_DISCOVERY_RANGE")),
        profile(seen, environ),
        field_checks(facts["field_checks"], environ.get("ROS_PYTHON_CHECK_FIELDS")),
    ]


def origin(version: str, file: str, venv: str) -> Finding:
    """Look whether `import rclpy` finds the course's."""
    if file.startswith(venv):
        return ok("rclpy", f"{version}, from .venv")
    return problem("rclpy", f"comes from {file}", "unset PYTHONPATH in this terminal")


def domain(seen: str | None, set_by_user: str | None) -> Finding:
    """Say which domain nodes meet in, and who chose it."""
    if seen is None:
        return problem("domain id", "is not set: nodes meet everybody's in 0", _hook_cure())
    if set_by_user:
        return ok("domain id", f"{seen}, from ROS_DOMAIN_ID in your environment")
    return ok("domain id", f"{seen}, the course's choice for you and this checkout")


def reach(discovery_range: str | None) -> Finding:
    """Say how far nodes look for each other."""
    name = discovery_range or "SUBNET"
    if name == "LOCALHOST":
        return ok("discovery range", "LOCALHOST: nodes meet on this machine only")
    return note("discovery range", f"{name}, from your environment; the pages expect LOCALHOST")


def profile(seen: Mapping[str, str], environ: Mapping[str, str]) -> Finding:
    """Look whether two processes find each other quickly, and by whose settings."""
    name = next((name for name in _PROFILES if seen.get(name)), None)
    if name is None:
        return note("discovery profile", "none: two programs may need 3 s to find each other")
    if not os.path.exists(seen[name]):
        return problem("discovery profile", f"{name} names {seen[name]}: no file", f"unset {name}")
    if environ.get(name) and not seen[name].endswith(_OUR_PROFILE):
        return note("discovery profile", f"{seen[name]}, from {name} in your environment")
    return ok("discovery profile", "the course's: two programs find each other at once")


def field_checks(works: bool, set_by_user: str | None) -> Finding:
    """Look whether messages check the types of their fields."""
    if works:
        return ok("field checks", "on: a message refuses a value of the wrong type")
    if set_by_user is not None:
        return note("field checks", "off, by ROS_PYTHON_CHECK_FIELDS in your environment")
    return problem("field checks", "off", _hook_cure())


def middleware_asked_for(clean: surroundings.Surroundings) -> list[Finding]:
    """Say when the environment asks for a middleware that is not here."""
    return [note("middleware", text) for text in clean.notes if text.startswith("RMW_")]


def _hook_cure() -> str:
    return f"remove .venv/rosbeat-stamp.json; {LAB}  then repairs .venv"


def _with_last_line(trouble: Problem) -> str:
    lines = trouble.details.strip().splitlines()
    return trouble.happened + (f" ({lines[-1]})" if lines else "")
