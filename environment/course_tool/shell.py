"""`course shell`: a bash with the course's ROS, as after sourcing a ROS of the system."""

from __future__ import annotations

import os
import shlex
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NoReturn

from course_tool import prepare, surroundings
from course_tool.layout import Layout

_START_FILE = Path(__file__).with_name("shellrc.bash")


def shell(layout: Layout, arguments: Sequence[str]) -> NoReturn:
    """Become a bash with the environment active; arguments are bash's own (`-c "command"`)."""
    environ = surroundings.with_ros(prepare.ready(layout, "course"), layout)
    command = ["bash", *arguments] if arguments else interactive()
    os.execvpe("bash", command, for_shells(environ, layout))


def interactive() -> list[str]:
    """Return the command of a bash to type in; its environment comes from `for_shells`."""
    return ["bash", "--rcfile", str(_START_FILE)]


def for_shells(environ: Mapping[str, str], layout: Layout) -> dict[str, str]:
    """Return an environment in which the start file of our shells finds this tool."""
    return {**environ, "ROSBEAT_COURSE": str(layout.environment / "course")}


def variables(layout: Layout) -> str:
    """Return the shell lines that put this process's environment right.

    The user's own start file may source another ROS or put another Python first, so the shell asks
    for this after it.
    """
    clean = surroundings.cleaned(os.environ, layout).environ
    wanted = surroundings.with_ros(surroundings.inside(clean, layout), layout)
    return "\n".join(difference(os.environ, wanted))


def difference(now: Mapping[str, str], wanted: Mapping[str, str]) -> list[str]:
    """Return the shell lines that turn one environment into another."""
    gone = [f"unset {name}" for name in sorted(now) if name not in wanted]
    changed = [
        f"export {name}={shlex.quote(value)}"
        for name, value in sorted(wanted.items())
        if now.get(name) != value
    ]
    return gone + changed
