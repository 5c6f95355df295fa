"""Where the nodes and topics of the panel's graph are: the layout of the pictures, as numbers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise
from typing import Any

from rosbeat.viz import theme
from rosbeat.viz.graphs import Arrangement, Marked, arrange
from rosbeat.viz.layout import Point
from rosbeat.viz.wiring import Wiring, describe, node_key, topic_key

#: Types of message that a slider can publish, and whose numbers a fault can change.
NUMERIC_TYPES = frozenset({"std_msgs/msg/Float32", "std_msgs/msg/Float64"})


def layout(shown: Wiring) -> dict[str, Any]:
    """Place a graph.

    Args:
        shown: The graph.

    Returns:
        `width` and `height` in CSS pixels; `boxes` with key, kind, name, lines of text, how many
        of them, from the top, are the name (`rows`), and place; `edges` with the keys of their
        ends, what is wrong there, and the path as SVG writes it; `words` that say the same.
    """
    shown = replace(shown, offers=())
    arranged = arrange(Marked(shown, shown))
    width, height = arranged.size
    names = {node_key(name): name for name in shown.nodes}
    names.update((topic_key(name), name) for name in shown.topics)
    return {
        "width": round(max(width, 1) + 2 * theme.MARGIN, 1),
        "height": round(max(height, 1) + 2 * theme.MARGIN, 1),
        "boxes": [_box(arranged, key, names[key]) for key in arranged.placement.boxes],
        "edges": _edges(shown, arranged),
        "numeric": [name for name, types in shown.topics.items() if NUMERIC_TYPES & set(types)],
        "words": describe(shown),
    }


def _box(arranged: Arrangement, key: str, name: str) -> dict[str, Any]:
    label, box = arranged.labels[key], arranged.placement.boxes[key]
    x, y = arranged.at((box.along, box.across))
    width, height = arranged.at((box.length, box.breadth))
    return {
        "key": key,
        "kind": "node" if label.is_node else "topic",
        "name": name,
        "lines": [line.words for line in label.lines],
        "rows": sum(line.colour == theme.INK for line in label.lines),
        "broken": label.broken,
        "x": round(x + theme.MARGIN, 1),
        "y": round(y + theme.MARGIN, 1),
        "w": round(width, 1),
        "h": round(height, 1),
    }


def _edges(shown: Wiring, arranged: Arrangement) -> list[dict[str, str]]:
    found, placed = [], arranged.placement
    for edge in shown.edges:
        link = (edge.source, edge.target)
        around = link not in placed.routes
        points = placed.returns[link] if around else placed.routes[link]
        path = _straight if around else _smooth
        words = {"from": edge.source, "to": edge.target, "fault": edge.fault}
        found.append({**words, "path": path(points, arranged)})
    return found


def _smooth(points: Sequence[Point], arranged: Arrangement) -> str:
    """Return a line that runs along the flow at each of its points."""
    parts = [f"M{_at(points[0], arranged)}"]
    for (begin, first), (end, last) in pairwise(points):
        middle = (begin + end) / 2
        corners = ((middle, first), (middle, last), (end, last))
        parts.append("C" + " ".join(_at(one, arranged) for one in corners))
    return "".join(parts)


def _straight(points: Sequence[Point], arranged: Arrangement) -> str:
    return "M" + "L".join(_at(point, arranged) for point in points)


def _at(point: Point, arranged: Arrangement) -> str:
    x, y = arranged.at(point)
    return f"{x + theme.MARGIN:.1f},{y + theme.MARGIN:.1f}"
