"""What a terminal displays, the same on every machine, while pages are built or tested.

A learner sees the real thing. Where the steady home is set (`rosbeat.workspace.place`), a line
loses what is different next time: folders of the machine, process numbers, timings.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Callable
from pathlib import Path

from rosbeat.workspace.place import course_root, steady_home

Polish = Callable[[str], str]

#: What a steady run calls its home and its user.
HOME, USER = "/home/you", "you"
_COURSE = f"{HOME}/rosbeat"
#: The Python of Ubuntu 24.04, which ROS 2 Jazzy is made for.
_PYTHON = "python3.12"
_PATTERNS = [
    (r"\[(?:\d+min )?\d+(?:\.\d+)?s\]", "[0.00s]"),  # colcon
    (r"(?<=in )\d+\.\d\ds\b", "0.00s"),  # pytest
    (r"\bpython3\.\d+(?=/|$)", _PYTHON),
    (r"^(\[\d+\]) \d+$", r"\1 1234"),  # a job in the background
    (r"(\[(?:INFO|WARN|ERROR|DEBUG|FATAL)\]) \[\d+\.\d+\]", r"\1"),
]


def polisher() -> Polish:
    """Return what makes a line the same every time; for a learner, what leaves it as it is."""
    steady = steady_home()
    if steady is None:
        return str
    swaps = [(re.compile(pattern), text) for pattern, text in [*_folders(steady), *_PATTERNS]]

    def polish(line: str) -> str:
        for pattern, text in swaps:
            line = pattern.sub(text, line)
        return line

    return polish


def _folders(steady: Path) -> list[tuple[str, str]]:
    """Return what stands for each folder of this machine, the deepest first."""
    places = {str(steady): HOME, str(Path(sys.prefix)): f"{_COURSE}/.venv"}
    root = course_root()
    if root is not None:
        places.setdefault(str(root), _COURSE)
    deepest = sorted(places, key=len, reverse=True)
    return [
        (rf"{re.escape(place)}(?![\w-]|\.\w)", places[place]) for place in deepest if place != "/"
    ]
