"""What the doctor looks at in a terminal: the underlay, its commands, and the workspace."""

from __future__ import annotations

import os
import shlex
from collections.abc import Mapping
from pathlib import Path

from course_tool import running, surroundings
from course_tool.findings import Finding, note, ok, problem
from course_tool.layout import Layout

WORKSPACE = "ROS2_and_RL_Tutorials"
SETTING = "ROSBEAT_WORKSPACE_IN"
_AGAIN = "remove .venv/rosbeat-stamp.json; ./environment/course lab  then repairs .venv"
_COMMANDS = {"ros2": "pkg prefix rclpy", "colcon": "version-check --help", "rosbeat": "--help"}


def findings(layout: Layout, clean: surroundings.Surroundings) -> list[Finding]:
    """Try the underlay and each command in it, as a terminal of the course has them."""
    environ = surroundings.inside(clean.environ, layout)
    commands = [command(layout, name, environ) for name in _COMMANDS]
    return [place(layout), underlay(layout, clean), *commands]


def place(layout: Layout) -> Finding:
    """Look whether what colcon builds can be started by its own name in this place.

    The first line of a program cannot name an interpreter with a space in its path. `ros2 run`
    reads that line itself.
    """
    if len(str(layout.venv).split()) == 1:
        return ok("place", str(layout.root))
    return note(
        "place",
        f"'{layout.root}' has a space: start what colcon builds with ros2 run, not by its path",
    )


def underlay(layout: Layout, clean: surroundings.Surroundings) -> Finding:
    """Look whether `source .venv/setup.bash` activates ROS in a bash that knows nothing of it."""
    setup = layout.venv / "setup.bash"
    if not setup.exists():
        return problem("underlay", "setup.bash is not in .venv", _AGAIN)
    line = f'. {shlex.quote(str(setup))} && printf "%s" "$AMENT_PREFIX_PATH"'
    answer = running.quiet(["bash", "-c", line], clean.environ, timeout=30)
    if answer.ok and str(layout.venv) in answer.text.split(os.pathsep):
        return ok("underlay", f"source {setup}  activates ROS in any bash")
    return problem("underlay", f"{setup} does not work ({_last_line(answer)})", _AGAIN)


def command(layout: Layout, name: str, environ: Mapping[str, str]) -> Finding:
    """Look whether a command of the environment starts."""
    program = layout.venv / "bin" / name
    answer = running.quiet([program, *_COMMANDS[name].split()], environ, timeout=60)
    if answer.ok:
        return ok(name, "starts")
    return problem(name, f"does not start ({_last_line(answer)})", _AGAIN)


def workspace(layout: Layout, environ: Mapping[str, str]) -> Finding:
    """Say where the workspace of the tutorial lies, and whether it can lie there."""
    chosen = environ.get(SETTING, "")
    parent = Path(chosen).expanduser().absolute() if chosen else layout.root
    because = f", by {SETTING}" if chosen else ""
    if not parent.is_dir():
        return problem("workspace", f"{SETTING} names {parent}: no folder", f"mkdir -p {parent}")
    if not os.access(parent, os.W_OK):
        return problem("workspace", f"{parent} cannot be written to", f"set {SETTING} elsewhere")
    there = "" if (parent / WORKSPACE).is_dir() else " (page 01 makes it)"
    return ok("workspace", f"{parent / WORKSPACE}{there}{because}")


def _last_line(answer: running.Result) -> str:
    return (answer.text.strip().splitlines() or [f"exit code {answer.code}"])[-1]
