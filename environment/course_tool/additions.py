"""`course add` and `course remove`: what few courses need, on top of `.venv`."""

from __future__ import annotations

import os
from collections.abc import Sequence

from course_tool import messages, prepare, running
from course_tool.layout import Layout
from course_tool.problems import Problem, say

_NEXT = """\

Now packages of messages can be built, in the terminals of the course:

  cd "$ROS2_WORKSPACE/src"
  ros2 pkg create --build-type ament_cmake --license Apache-2.0 my_interfaces

environment/README.md goes on from there. rosie_interfaces is a first such package:
  ros2 interface package rosie_interfaces
"""


def add(layout: Layout, arguments: Sequence[str]) -> int:
    """Add what builds packages of messages to `.venv`, and say before how much that is.

    Raises:
        Problem: If the machine lacks what no wheel brings, or an installer stops.
    """
    _require_name("add", arguments)
    environ = prepare.ready(layout, "course")
    locks = messages.needed(layout, environ["PATH"])
    if prepare.additions(layout) == locks:
        say("What builds messages is here already. To take it out again:")
        say("  ./environment/course remove messages")
        return 0
    messages.require_headers()
    disk, fetched = messages.size(locks)
    room = f"What builds messages takes {_megabytes(disk)}, and the installer's cache some more."
    prepare.check_space(layout.root, disk * 1.5, room)
    say(f"Adding what builds messages to {layout.venv.name}: {_megabytes(disk)} of disk, of which")
    say(f"{_megabytes(fetched)} are fetched. {_of_the_machine(locks)}")
    with prepare.exclusive(layout.environment):
        messages.install(layout, locks, running.cleaned(os.environ, layout).environ)
        prepare.write_stamp(layout, prepare.stamped_level(layout) or "course", locks)
    say(_NEXT)
    return 0


def remove(layout: Layout, arguments: Sequence[str]) -> int:
    """Take out of `.venv` what `add` has brought.

    Raises:
        Problem: If an installer stops.
    """
    _require_name("remove", arguments)
    environ = prepare.ready(layout, "course")
    if not prepare.additions(layout):
        say("What builds messages is not here, so nothing was removed.")
        return 0
    level = prepare.stamped_level(layout) or "course"
    with prepare.exclusive(layout.environment):
        # First what says that it is there: an interruption leaves no more than a few files behind.
        prepare.write_stamp(layout, level, [])
        others = [path.stem for path in layout.environment.glob("*.lock")]
        kept = [name for name in others if name not in messages.LOCKS]
        messages.uninstall(layout, kept, environ)
    say("Removed. Packages of messages that you have built stay in your workspace, and work.")
    return 0


def _require_name(command: str, arguments: Sequence[str]) -> None:
    if list(arguments) != ["messages"]:
        typed = " ".join(arguments)
        raise Problem(
            f"There is no addition '{typed}'." if typed else "The name of an addition is missing.",
            "The only one so far is `messages`: what builds packages of messages of your own.",
            f"Type:  ./environment/course {command} messages",
        )


def _megabytes(size: int) -> str:
    return f"{size / 10**6:.0f} MB"


def _of_the_machine(locks: Sequence[str]) -> str:
    lacks = [name for name in ("CMake", "compiler") if name.lower() in locks]
    if not lacks:
        return "CMake and the compiler are those of this machine."
    return f"This machine has no {' and no '.join(lacks)}, so wheels bring that, too."
