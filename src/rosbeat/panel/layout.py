"""Where the nodes and topics of the panel's graph are: the layout of the pictures, as numbers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import Any

from rosbeat.viz import theme
from rosbeat.viz.graphs import Label, node_label, topic_label
from rosbeat.viz.layout import Box, Layering, Placement, Point, layering, needed, place
from rosbeat.viz.wiring import Wiring, describe, node_key, topic_key

#: Types of message that a slider can publish, and whose numbers a fault can change.
NUMERIC_TYPES = frozenset({"std_msgs/msg/Float32", "std_msgs/msg/Float64"})
#: Widest line of a name in CSS pixels, tried in this order.
_LIMITS = (200.0, 150.0, 115.0, 95.0)
_ROOM = theme.WIDTH - 2 * theme.MARGIN


def layout(shown: Wiring) -> dict[str, Any]:
    """Place a graph.

    Args:
        shown: The graph.

    Returns:
        `width` and `height` in CSS pixels; `boxes` with key, kind, name, lines of text, how many
        of them, from the top, are the name (`rows`), and place; `edges` with the keys of their
        ends, what is wrong there, and the path as SVG writes it; `words` that say the same.
    """
    plan, labels = _plan(shown), _labels(shown, _LIMITS[0])
    for limit in _LIMITS:
        labels = _labels(shown, limit)
        if needed(plan, _sizes(labels)) <= _ROOM:
            break
    placed = place(plan, _sizes(labels), _ROOM)
    names = {node_key(name): name for name in shown.nodes}
    names.update((topic_key(name), name) for name in shown.topics)
    boxes = [_box(key, names[key], labels[key], box) for key, box in placed.boxes.items()]
    return {
        "width": round(max(placed.length, 1) + 2 * theme.MARGIN, 1),
        "height": round(max(placed.breadth, 1) + 2 * theme.MARGIN, 1),
        "boxes": boxes,
        "edges": _edges(shown, placed),
        "numeric": [name for name, types in shown.topics.items() if NUMERIC_TYPES & set(types)],
        "words": describe(shown),
    }


def _plan(shown: Wiring) -> Layering:
    starts = {node_key(name): 0 for name in shown.nodes}
    starts.update((topic_key(name), 1) for name in shown.topics)
    return layering(starts, [(edge.source, edge.target) for edge in shown.edges])


def _labels(shown: Wiring, limit: float) -> dict[str, Label]:
    labels = {node_key(name): node_label(name, limit, theme.TEXT, False) for name in shown.nodes}
    for name, types in shown.topics.items():
        look = (limit, theme.TEXT, False)
        labels[topic_key(name)] = topic_label(name, types, shown.faults(name), *look)
    return labels


def _sizes(labels: Mapping[str, Label]) -> dict[str, Point]:
    return {key: label.size for key, label in labels.items()}


def _box(key: str, name: str, label: Label, box: Box) -> dict[str, Any]:
    return {
        "key": key,
        "kind": "node" if label.is_node else "topic",
        "name": name,
        "lines": [line.words for line in label.lines],
        "rows": sum(line.colour == theme.INK for line in label.lines),
        "broken": label.broken,
        "x": round(box.along + theme.MARGIN, 1),
        "y": round(box.across + theme.MARGIN, 1),
        "w": round(box.length, 1),
        "h": round(box.breadth, 1),
    }


def _edges(shown: Wiring, placed: Placement) -> list[dict[str, str]]:
    found = []
    for edge in shown.edges:
        link = (edge.source, edge.target)
        around = link not in placed.routes
        points = placed.returns[link] if around else placed.routes[link]
        path = _straight(points) if around else _smooth(points)
        found.append({"from": edge.source, "to": edge.target, "fault": edge.fault, "path": path})
    return found


def _smooth(points: Sequence[Point]) -> str:
    parts = [f"M{_at(points[0])}"]
    for (x0, y0), (x1, y1) in pairwise(points):
        middle = (x0 + x1) / 2
        parts.append(f"C{_at((middle, y0))} {_at((middle, y1))} {_at((x1, y1))}")
    return "".join(parts)


def _straight(points: Sequence[Point]) -> str:
    return "M" + "L".join(map(_at, points))


def _at(point: Point) -> str:
    return f"{point[0] + theme.MARGIN:.1f},{point[1] + theme.MARGIN:.1f}"
