"""Programs of the workspace that were edited and not built again."""

from __future__ import annotations

import ast
import os
from collections.abc import Iterator
from pathlib import Path

from rosbeat.diagnosis.situation import StaleBuild
from rosbeat.workspace.packages import Package, find_packages, read_package
from rosbeat.workspace.parsing import parse
from rosbeat.workspace.place import VARIABLE, workspace


def stale_builds(topic: str, root: Path | None = None) -> tuple[StaleBuild, ...]:
    """Return the programs that name a topic and differ from what `ros2 run` would start.

    Args:
        topic: The topic's full name.
        root: The workspace, by default the one that the terminal knows, or else the learner's.
    """
    place = root or Path(os.environ.get(VARIABLE) or workspace())
    folders = find_packages(place) if place.is_dir() else []
    return tuple(one for folder in folders for one in _of(read_package(folder, place), topic))


def _of(package: Package, topic: str) -> Iterator[StaleBuild]:
    for entry in package.setup.entry_points:
        module = entry.module.replace(".", "/") + ".py"
        installed = package.installed
        if installed and module not in installed.changed:
            continue
        if topic.strip("/") in _texts(package.folder / module):
            yield StaleBuild(package.name, entry.executable, module, installed is not None)


def _texts(path: Path) -> set[str]:
    """Every text in a file of Python, as a topic is called without its first slash."""
    try:
        tree = parse(path.read_bytes())
    except (OSError, SyntaxError, ValueError):
        return set()
    found = (node.value for node in ast.walk(tree) if isinstance(node, ast.Constant))
    return {text.strip("/") for text in found if isinstance(text, str)}
