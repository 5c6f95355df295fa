"""Draw which rooms of rosbeat import which: `python docs/draw_architecture.py`.

The arrows come from the sources: every `import` that is carried out when a program runs, except
those that other arrows imply. They give each room its row, with `errors`, which imports nothing,
at the bottom. Only the columns and the purposes are written here. `tests/test_architecture.py`
compares the picture in `docs/images` with what this program draws now.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from xml.sax.saxutils import escape

ROOT = Path(__file__).resolve().parents[1]
PACKAGE = ROOT / "src" / "rosbeat"
PICTURE = ROOT / "docs" / "images" / "architecture.svg"

#: Column and purpose of each room.
ROOMS = {
    "cli": (0.3, "the command rosbeat"),
    "grading": (1.5, "submissions → marks"),
    "page_runs": (1.5, "a page in a sandbox, judged"),
    "exercises": (1.5, "scenario, judge and hints"),
    "clinic": (1.5, "broken systems to diagnose"),
    "page_session": (1.5, "the Session of a page"),
    "panel": (1.5, "a live session, with controls"),
    "bags": (0.6, "recordings and faults"),
    "ros": (0.9, "real nodes in virtual time"),
    "viz": (2.0, "records → pictures and words"),
    "workspace": (3.2, "terminals, files, packages"),
    "authoring": (-0.5, "lesson → two notebooks"),
    "diagnosis": (2.0, "evidence → named mistake"),
    "environment": (0.35, "settings and ROS domains"),
    "records": (2.0, "what was observed, as data"),
    "errors": (1.2, "every error, in one tree"),
}
#: Modules beside the rooms, and the room that each of them is drawn as.
PART_OF = {
    "records_json": "records",
    "comparisons": "records",
    "check_command": "cli",
    "course_commands": "cli",
    "explain_command": "cli",
    "__main__": "cli",
    "domains": "environment",
    "local_server": "grading",
    "jupyter_lease": "environment",
    "page_names": "environment",
    "inspection": "page_session",
    "page_errors": "page_session",
    "page_cells": "page_session",
    "testing": "ros",
    "pytest_plugin": "ros",
}
#: The package's own `__init__` hands out names of other rooms, and `scenarios` keeps an old one.
LEFT_OUT = {"rosbeat", "scenarios"}

COLUMN, ROW, WIDTH, HEIGHT, MARGIN = 205.0, 74.0, 182.0, 46.0, 12.0

STYLE = """
  text { font-family: system-ui, sans-serif; text-anchor: middle; fill: #1b1f24 }
  .name { font-size: 15px; font-weight: 600 }
  .purpose { font-size: 12px }
  rect { fill: #eef3f8; stroke: #33658a; stroke-width: 1.5 }
  path { stroke: #57606a; stroke-width: 1.3; fill: none; marker-end: url(#tip) }
  #tip path { fill: #57606a; stroke: none; marker-end: none }
  @media (prefers-color-scheme: dark) {
    text { fill: #e6edf3 }
    rect { fill: #1c2733; stroke: #79b8e0 }
    path { stroke: #9aa4af }
    #tip path { fill: #9aa4af }
  }
"""

Arrow = tuple[str, str]


@dataclass(frozen=True)
class Box:
    """Hold where a room is drawn: the middle of its box, in pixels."""

    x: float
    y: float


def arrows(package: Path = PACKAGE) -> set[Arrow]:
    """Return which room imports which, as pairs, without those that a longer way implies."""
    found: set[Arrow] = set()
    for path in sorted(package.rglob("*.py")):
        room = _room(path.relative_to(package.parent).with_suffix("").parts)
        for name in _imported(ast.parse(path.read_text(encoding="utf-8"))):
            other = _room(tuple(name.split(".")))
            if room != other and {room, other}.isdisjoint(LEFT_OUT):
                found.add((room, other))
    return {(a, b) for a, b in found if not _reaches(found - {(a, b)}, a, b)}


def _room(parts: tuple[str, ...]) -> str:
    """Return the room of a module; what `from rosbeat import ...` gives may be no module."""
    part = parts[1] if len(parts) > 1 else "__init__"
    there = (PACKAGE / part).is_dir() or (PACKAGE / f"{part}.py").is_file()
    return PART_OF.get(part, part) if there and part != "__init__" else "rosbeat"


def _imported(tree: ast.AST) -> Iterator[str]:
    """Yield what is imported of rosbeat, by dotted name; imports for types alone do not count."""
    for node in ast.iter_child_nodes(tree):
        if isinstance(node, ast.If) and "TYPE_CHECKING" in ast.dump(node.test):
            continue
        names: list[str] = []
        if isinstance(node, ast.ImportFrom):
            whole = node.module == "rosbeat" and not node.level
            names = [f"rosbeat.{one.name}" for one in node.names] if whole else [node.module or ""]
        elif isinstance(node, ast.Import):
            names = [one.name for one in node.names]
        yield from (name for name in names if name.startswith("rosbeat."))
        yield from _imported(node)


def _reaches(pairs: set[Arrow], start: str, end: str) -> bool:
    """Return whether a way leads from one room to another."""
    seen, left = set(), [start]
    while left:
        here = left.pop()
        seen.add(here)
        left += [b for a, b in pairs if a == here and b not in seen]
    return end in seen


def _heights(pairs: set[Arrow]) -> dict[str, int]:
    """Return each room's row, counted from the bottom: one above the highest that it imports."""
    below = {room: [b for a, b in pairs if a == room] for room in ROOMS}
    rows: dict[str, int] = {}
    while len(rows) < len(below):
        ready = {r for r, rooms in below.items() if r not in rows and rows.keys() >= set(rooms)}
        if not ready:
            raise ValueError(f"Rooms import each other around a circle: {below.keys() - rows}")
        rows |= {room: 1 + max((rows[b] for b in below[room]), default=-1) for room in ready}
    return rows


def picture(pairs: set[Arrow]) -> str:
    """Return the picture as SVG, with the arrows in words as its description.

    Raises:
        KeyError: If there is a room that `ROOMS` does not have.
    """
    rows = _heights(pairs)
    left = min(column for column, _ in ROOMS.values())
    right = max(column for column, _ in ROOMS.values())
    top = max(rows.values())
    boxes = {
        room: Box(
            MARGIN + WIDTH / 2 + (column - left) * COLUMN,
            MARGIN + HEIGHT / 2 + (top - rows[room]) * ROW,
        )
        for room, (column, _) in ROOMS.items()
    }
    width = (right - left) * COLUMN + WIDTH + 2 * MARGIN
    height = top * ROW + HEIGHT + 2 * MARGIN
    words = "; ".join(f"{a} imports {b}" for a, b in sorted(pairs))
    return "\n".join(
        [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:.0f} {height:.0f}" '
            'role="img" aria-labelledby="title words">',
            '<title id="title">Which rooms of rosbeat import which</title>',
            f'<desc id="words">{words}.</desc>',
            f"<style>{STYLE}</style>",
            '<defs><marker id="tip" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="8" '
            'markerHeight="8" orient="auto"><path d="M0,0 L8,4 L0,8 z"/></marker></defs>',
            *_lines(pairs, boxes),
            *(_box(room, boxes[room]) for room in ROOMS),
            "</svg>\n",
        ]
    )


def _lines(pairs: set[Arrow], boxes: dict[str, Box]) -> Iterator[str]:
    """Yield the arrows: down from row to row, and around the rooms between where there are some."""
    for room, other in sorted(pairs):
        start, end = boxes[room], boxes[other]
        top = end.y - HEIGHT / 2 - 1
        if end.y - start.y > 1.5 * ROW:
            side = WIDTH / 2 if end.x > start.x else -WIDTH / 2
            yield f'<path d="M{start.x + side:.1f},{start.y:.1f} H{end.x:.1f} V{top:.1f}"/>'
        else:
            x1 = _port(start, end, [boxes[b] for a, b in pairs if a == room])
            x2 = _port(end, start, [boxes[a] for a, b in pairs if b == other])
            yield f'<path d="M{x1:.1f},{start.y + HEIGHT / 2:.1f} L{x2:.1f},{top:.1f}"/>'


def _port(here: Box, there: Box, others: list[Box]) -> float:
    """Return where an arrow meets a box: arrows are spread along its side, from left to right."""
    near = [box for box in others if abs(box.y - here.y) < 1.5 * ROW]
    order = sorted(near, key=lambda box: box.x)
    return here.x + WIDTH * 0.8 * ((order.index(there) + 1) / (len(order) + 1) - 0.5)


def _box(room: str, box: Box) -> str:
    return (
        f'<rect x="{box.x - WIDTH / 2:.1f}" y="{box.y - HEIGHT / 2:.1f}" width="{WIDTH:.0f}" '
        f'height="{HEIGHT:.0f}" rx="6"/>'
        f'<text class="name" x="{box.x:.1f}" y="{box.y - 4:.1f}">{room}</text>'
        f'<text class="purpose" x="{box.x:.1f}" y="{box.y + 14:.1f}">'
        f"{escape(ROOMS[room][1])}</text>"
    )


if __name__ == "__main__":
    PICTURE.write_text(picture(arrows()), encoding="utf-8")
    print(f"Drawn: {PICTURE.relative_to(ROOT)}")
