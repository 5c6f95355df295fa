"""Lay out a directed graph: columns, order, coordinates, and arrows around boxes.

Columns and order follow Sugiyama, Tagawa and Toda ("Methods for Visual Understanding of
Hierarchical System Structures", IEEE Transactions on Systems, Man, and Cybernetics 11(2), 1981):
longest path for the columns, stand-ins where an arrow passes through a column, mean position of the
neighbours for the order.

Lengths are CSS pixels along the direction of flow and across it, so that the same code lays a graph
out from left to right and from top to bottom. Nothing is random: one graph always looks the same.
"""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

Link = tuple[str, str]
Layers = list[list[str]]
Point = tuple[float, float]

#: Between two columns, at least and at most.
GAP_LEAST, GAP_MOST = 28.0, 120.0
#: Between two boxes of a column, and for an arrow that passes through a column.
SPACE, THREAD = 22.0, 6.0
#: Between two arrows that run back beside the graph.
LANE = 18.0

_ORDER_SWEEPS, _PLACE_SWEEPS = 8, 12


@dataclass(frozen=True)
class Layering:
    """Hold where everything goes, without sizes.

    Attributes:
        layers: Column by column the names in it, from first to last; stand-ins among them.
        chains: For every forward link the names it passes: source, stand-ins, target.
        back: The links that run against the columns because the graph has a cycle.
    """

    layers: Layers
    chains: dict[Link, tuple[str, ...]]
    back: tuple[Link, ...]

    def neighbours(self) -> tuple[dict[str, list[str]], dict[str, list[str]]]:
        """Return for every name those right before it and right after it on the chains."""
        before: dict[str, list[str]] = {name: [] for layer in self.layers for name in layer}
        after: dict[str, list[str]] = {name: [] for name in before}
        for chain in self.chains.values():
            for one, other in itertools.pairwise(chain):
                after[one].append(other)
                before[other].append(one)
        return before, after


@dataclass(frozen=True)
class Box:
    """Hold the size and the middle of a box; `along` and `across` the flow."""

    along: float
    across: float
    length: float
    breadth: float


@dataclass(frozen=True)
class Placement:
    """Hold a finished layout.

    Attributes:
        boxes: Where each box is.
        routes: For every forward link its points; at each the arrow runs along the flow.
        returns: For every back link the corners of its way around.
        length: Extent along the flow, from 0.
        breadth: Extent across the flow, from 0.
    """

    boxes: dict[str, Box]
    routes: dict[Link, tuple[Point, ...]]
    returns: dict[Link, tuple[Point, ...]]
    length: float
    breadth: float


# Columns, and the order in each.


def layering(starts: Mapping[str, int], links: Sequence[Link]) -> Layering:
    """Choose columns and order.

    Args:
        starts: For every name the first column it may stand in, in order of creation.
        links: Pairs of names, from source to target.
    """
    back = back_links(list(starts), links)
    forward = [link for link in links if link not in back]
    columns = _columns(starts, forward)
    layers: Layers = [[] for _ in range(max(columns.values(), default=-1) + 1)]
    for name, column in columns.items():
        layers[column].append(name)
    chains = {link: _chain(link, columns, layers) for link in forward}
    return _untangled(Layering(layers, chains, tuple(back)))


def back_links(names: Sequence[str], links: Sequence[Link]) -> list[Link]:
    """Return the links that close a cycle when the graph is walked from its sources, in order."""
    targets = {name: [end for start, end in links if start == name] for name in names}
    reached = {end for _, end in links}
    done: set[str] = set()
    path: list[str] = []
    back: list[Link] = []

    def visit(name: str) -> None:
        path.append(name)
        back.extend((name, end) for end in targets[name] if end in path)
        for end in targets[name]:
            if end not in done and end not in path:
                visit(end)
        done.add(path.pop())

    for root in sorted(names, key=lambda name: name in reached):
        if root not in done:
            visit(root)
    return back


def _columns(starts: Mapping[str, int], links: Sequence[Link]) -> dict[str, int]:
    columns = dict(starts)
    for _ in starts:
        for start, end in links:
            columns[end] = max(columns[end], columns[start] + 1)
    ends = {end for _, end in links}
    for name in columns:
        # What has nothing before it stands right beside what comes after it.
        after = [columns[end] for start, end in links if start == name]
        if after and name not in ends:
            columns[name] = min(after) - 1
    without_gaps = {column: rank for rank, column in enumerate(sorted(set(columns.values())))}
    return {name: without_gaps[column] for name, column in columns.items()}


def _chain(link: Link, columns: dict[str, int], layers: Layers) -> tuple[str, ...]:
    """Return the link's way through the columns; put a stand-in into each column it passes."""
    between = range(columns[link[0]] + 1, columns[link[1]])
    stand_ins = [f"via {column} {link[0]} > {link[1]}" for column in between]
    for column, name in zip(between, stand_ins, strict=True):
        layers[column].append(name)
    return (link[0], *stand_ins, link[1])


def _untangled(plan: Layering) -> Layering:
    """Return the plan with the columns reordered so that few arrows cross."""
    before, after = plan.neighbours()
    tried = [plan.layers]
    for sweep in range(_ORDER_SWEEPS):
        layers = [list(layer) for layer in tried[-1]]
        order, sides = (1, before) if sweep % 2 == 0 else (-1, after)
        for layer in layers[::order]:
            _sort(layer, layers, sides)
        tried.append(layers)
    return replace(plan, layers=min(tried, key=lambda layers: _crossings(layers, after)))


def _sort(layer: list[str], layers: Layers, sides: dict[str, list[str]]) -> None:
    """Order a column by the mean place of its neighbours; who has none keeps its place."""
    place = {name: rank / max(1, len(one) - 1) for one in layers for rank, name in enumerate(one)}
    layer.sort(key=lambda name: _mean([place[one] for one in sides[name]], place[name]))


def _mean(values: Sequence[float], otherwise: float) -> float:
    return sum(values) / len(values) if values else otherwise


def _crossings(layers: Layers, after: dict[str, list[str]]) -> int:
    place = {name: rank for layer in layers for rank, name in enumerate(layer)}
    total = 0
    for layer in layers:
        ends = [place[end] for name in layer for end in sorted(after[name], key=place.__getitem__)]
        total += sum(one > other for one, other in itertools.combinations(ends, 2))
    return total


# Coordinates.


def needed(plan: Layering, sizes: Mapping[str, Point]) -> float:
    """Return the least extent along the flow for boxes of these sizes (length, breadth)."""
    lengths = _lengths(plan, sizes)
    return sum(lengths) + GAP_LEAST * (len(lengths) - 1 + _rims(plan))


def place(plan: Layering, sizes: Mapping[str, Point], room: float) -> Placement:
    """Give every box its place.

    Args:
        plan: Columns and order.
        sizes: Length along and breadth across the flow, for every box.
        room: Extent along the flow that may be used.
    """
    lengths, rims = _lengths(plan, sizes), _rims(plan)
    gaps = max(1, len(lengths) - 1 + rims)
    gap = min(GAP_MOST, max(GAP_LEAST, (room - sum(lengths)) / gaps))
    across = _across(plan, sizes)
    boxes: dict[str, Box] = {}
    at = gap * rims / 2
    for layer, length in zip(plan.layers, lengths, strict=True):
        for name in layer:
            own = sizes.get(name, (length, 0.0))
            boxes[name] = Box(at + length / 2, across[name], *own)
        at += length + gap
    breadth = max((box.across + box.breadth / 2 for box in boxes.values()), default=0.0)
    returns = _returns(plan, boxes, lengths, gap, breadth)
    routes = {link: _route(chain, boxes) for link, chain in plan.chains.items()}
    shown = {name: box for name, box in boxes.items() if name in sizes}
    total = at - gap + gap * rims / 2
    return Placement(shown, routes, returns, total, breadth + LANE * len(returns))


def _lengths(plan: Layering, sizes: Mapping[str, Point]) -> list[float]:
    return [max(sizes.get(name, (0.0, 0.0))[0] for name in layer) for layer in plan.layers]


def _rims(plan: Layering) -> int:
    """Return 1 if arrows run back, which need room before the first and after the last column."""
    return 1 if plan.back else 0


def _route(chain: Sequence[str], boxes: Mapping[str, Box]) -> tuple[Point, ...]:
    first, *between, last = (boxes[name] for name in chain)
    points = [(first.along + first.length / 2, first.across)]
    for box in between:
        points.append((box.along - box.length / 2, box.across))
        points.append((box.along + box.length / 2, box.across))
    return (*points, (last.along - last.length / 2, last.across))


def _returns(
    plan: Layering, boxes: Mapping[str, Box], lengths: Sequence[float], gap: float, breadth: float
) -> dict[Link, tuple[Point, ...]]:
    """Return ways around the graph: out of the source's column, back beside all boxes, in again."""
    half = {name: lengths[rank] / 2 for rank, layer in enumerate(plan.layers) for name in layer}
    ways: dict[Link, tuple[Point, ...]] = {}
    for number, (source, target) in enumerate(plan.back, 1):
        start, end, lane = boxes[source], boxes[target], breadth + LANE * number
        # Each lane turns at its own place in the gap, so that no two run on top of each other.
        inset = gap * (0.5 - 0.2 * number / len(plan.back))
        out = start.along + half[source] + inset
        back = end.along - half[target] - inset
        ways[source, target] = (
            (start.along + start.length / 2, start.across),
            (out, start.across),
            (out, lane),
            (back, lane),
            (back, end.across),
            (end.along - end.length / 2, end.across),
        )
    return ways


# Places across the flow, each as near to the middle of its neighbours as the others let it.


def _across(plan: Layering, sizes: Mapping[str, Point]) -> dict[str, float]:
    """Return the middle of every name; the least begin is 0."""
    breadths = {name: sizes.get(name, (0, THREAD))[1] for layer in plan.layers for name in layer}
    columns = [
        (layer, [(breadths[a] + breadths[b]) / 2 + SPACE for a, b in itertools.pairwise(layer)])
        for layer in plan.layers
    ]
    at: dict[str, float] = {}
    for layer, gaps in columns:
        at.update(zip(layer, apart([0.0] * len(layer), gaps), strict=True))
    sides = plan.neighbours()
    for sweep in range(_PLACE_SWEEPS):
        # On from column to column, looking back; then back again, looking on.
        back = sweep % 2
        for layer, gaps in columns[:: -1 if back else 1]:
            wishes = [_mean([at[one] for one in sides[back][name]], at[name]) for name in layer]
            at.update(zip(layer, apart(wishes, gaps), strict=True))
    top = min((at[name] - breadths[name] / 2 for name in at), default=0.0)
    return {name: place - top for name, place in at.items()}


def apart(wishes: Sequence[float], gaps: Sequence[float]) -> list[float]:
    """Return places near the wishes, in the same order.

    Pushing everything on until it is far enough apart is one solution, and pushing everything back
    is another. Half way between the two the distances are kept as well.

    Args:
        wishes: Where each thing would best be.
        gaps: Least distances: from the first to the second, from the second to the third, ...
    """
    on, back = list(wishes[:1]), list(wishes[-1:])
    for wish, gap in zip(wishes[1:], gaps, strict=True):
        on.append(max(wish, on[-1] + gap))
    for wish, gap in zip(wishes[-2::-1], gaps[::-1], strict=True):
        back.append(min(wish, back[-1] - gap))
    return [(one + other) / 2 for one, other in zip(on, back[::-1], strict=True)]
