"""The stamp in `.venv`: this exact environment is complete, and ROS was heard in it."""

from __future__ import annotations

import hashlib
import json
import os
import sys
from dataclasses import asdict, dataclass
from pathlib import Path

from course_tool import underlay
from course_tool.layout import LEVELS, Layout

_REVISION = "2"
"""To be raised when this tool lays out an environment in another way."""


@dataclass(frozen=True)
class Stamp:
    """What was made, and from what."""

    level: str
    fingerprint: str


def fingerprint(layout: Layout, level: str) -> str:
    """Return a hash of everything that a level's environment depends on.

    The place is part of it: a moved environment still names its old one in its scripts.
    """
    digest = hashlib.sha256()
    version = "{}.{}".format(*sys.version_info[:2])
    for text in (_REVISION, level, version, str(layout.venv)):
        digest.update(text.encode("utf-8", "surrogateescape") + b"\0")
    for path in _sources(layout, level):
        digest.update(_content(path) + b"\0")
    return digest.hexdigest()


def _sources(layout: Layout, level: str) -> list[Path]:
    projects = [folder / "pyproject.toml" for folder in layout.own_packages]
    return [layout.lock(level), layout.lock("build"), *projects, *underlay.templates()]


def read(layout: Layout) -> Stamp | None:
    """Return the stamp, or None when there is none that can be read."""
    try:
        data = json.loads(layout.stamp.read_text(encoding="utf-8"))
        stamp = Stamp(level=data["level"], fingerprint=data["fingerprint"])
    except (OSError, ValueError, KeyError, TypeError):
        return None
    return stamp if stamp.level in LEVELS else None


def write(layout: Layout, level: str) -> None:
    """Say that the environment is complete."""
    put(layout, Stamp(level, fingerprint(layout, level)))


def put(layout: Layout, stamp: Stamp) -> None:
    """Write a stamp, whole or not at all."""
    unfinished = layout.stamp.with_suffix(".new")
    unfinished.write_text(json.dumps(asdict(stamp)) + "\n", encoding="utf-8")
    unfinished.replace(layout.stamp)


def remove(layout: Layout) -> None:
    """Say that the environment is being worked on."""
    layout.stamp.unlink(missing_ok=True)


def at_least(layout: Layout, level: str) -> str:
    """Return the higher of a level and the one that is there: nobody loses tools."""
    stamp = read(layout)
    return level if stamp is None else max(level, stamp.level, key=LEVELS.index)


def satisfied(layout: Layout, level: str) -> bool:
    """Tell whether the environment is complete, fresh and good for a level."""
    stamp = read(layout)
    if stamp is None or not os.access(layout.python, os.X_OK):
        return False
    enough = LEVELS.index(stamp.level) >= LEVELS.index(level)
    return enough and stamp.fingerprint == fingerprint(layout, stamp.level)


def _content(path: Path) -> bytes:
    return path.read_bytes() if path.exists() else b""
