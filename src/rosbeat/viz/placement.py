"""Coordinates for a layered graph: boxes that do not overlap, arrows that avoid them.

Everything is in CSS pixels along the direction of flow and across it, so that the same code lays
a graph out from left to right and from top to bottom.
"""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from rosbeat.viz import clusters
from rosbeat.viz.clusters import Clustering, Extent
from rosbeat.viz.layers import Layering, Link

Point = tuple[float, float]

#: Between two columns, at least and at most.
GAP_LEAST, GAP_MOST = 46.0, 120.0
#: Between two boxes of a column, and for an arrow that passes through a column.
SPACE, THREAD = 22.0, 6.0
#: Between two arrows that run back beside the graph.
LANE = 18.0

_SWEEPS = 12


@dataclass(frozen=True)
class Box:
    """The size and the middle of a box; `along` and `across` the flow."""

    along: float
    across: float
    length: float
    breadth: float


@dataclass(frozen=True)
class Placement:
    """A finished layout.

    Attributes:
        boxes: Where each box is.
        routes: For every forward link its points; at each the arrow runs along the flow.
        returns: For every back link the corners of its way around.
        length: Extent along the flow, from 0.
        breadth: Extent across the flow, from 0.
        frames: For every cluster a box that encloses it and nothing else.
    """

    boxes: dict[str, Box]
    routes: dict[Link, tuple[Point, ...]]
    returns: dict[Link, tuple[Point, ...]]
    length: float
    breadth: float
    frames: tuple[Box, ...] = ()


def needed(plan: Layering, sizes: Mapping[str, Point]) -> float:
    """The least extent along the flow for boxes of these sizes (length, breadth)."""
    lengths = _lengths(plan, sizes)
    gaps = GAP_LEAST * (len(lengths) - 1) + _rims(plan) * GAP_LEAST
    return sum(lengths) + gaps + sum(_ends(plan))


def place(plan: Layering, sizes: Mapping[str, Point], room: float) -> Placement:
    """Give every box its place.

    Args:
        plan: Columns and order.
        sizes: Length along and breadth across the flow, for every box.
        room: Extent along the flow that may be used.
    """
    lengths = _lengths(plan, sizes)
    rims = _rims(plan)
    gaps = max(1, len(lengths) - 1 + rims)
    before, after = _ends(plan)
    gap = min(GAP_MOST, max(GAP_LEAST, (room - before - after - sum(lengths)) / gaps))
    across, stretches = _across(plan, sizes)
    boxes: dict[str, Box] = {}
    at = before + gap * rims / 2
    for layer, length in zip(plan.layers, lengths, strict=True):
        for name in layer:
            own = sizes.get(name, (length, 0.0))
            boxes[name] = Box(at + length / 2, across[name], *own)
        at += length + gap
    breadth = max((box.across + box.breadth / 2 for box in boxes.values()), default=0.0)
    breadth = max([breadth, *(end for _, end in stretches)])
    returns = _returns(plan, boxes, lengths, gap, breadth)
    routes = {link: _route(chain, boxes) for link, chain in plan.chains.items()}
    shown = {name: box for name, box in boxes.items() if name in sizes}
    total = at - gap + gap * rims / 2 + after
    frames = _frames(plan, boxes, stretches)
    return Placement(shown, routes, returns, total, breadth + LANE * len(returns), frames)


def spread(wishes: Sequence[float], distances: Sequence[float]) -> list[float]:
    """Places nearest to the wishes (least squares) that keep order and distances.

    With the distances subtracted it is isotonic regression, solved by pooling adjacent violators
    (Ayer et al., "An Empirical Distribution Function for Sampling with Incomplete Information",
    Annals of Mathematical Statistics 26(4), 1955).

    Args:
        wishes: Wished places, one for each item, in the order that is kept.
        distances: Least distance from each item to the next, one fewer than items.
    """
    offsets = [sum(distances[:rank]) for rank in range(len(wishes))]
    pools: list[tuple[float, int]] = []
    for wish, offset in zip(wishes, offsets, strict=True):
        mean, size = wish - offset, 1
        while pools and pools[-1][0] > mean:
            other, others = pools.pop()
            mean, size = (mean * size + other * others) / (size + others), size + others
        pools.append((mean, size))
    means = [mean for mean, size in pools for _ in range(size)]
    return [mean + offset for mean, offset in zip(means, offsets, strict=True)]


def _lengths(plan: Layering, sizes: Mapping[str, Point]) -> list[float]:
    lengths = [max(sizes.get(name, (0.0, 0.0))[0] for name in layer) for layer in plan.layers]
    if isinstance(plan, Clustering):
        # Columns with a frame are wide enough for it; one over several columns always is.
        least = plan.rim.least[0] - sum(_ends(plan))
        for rank, layer in enumerate(plan.layers):
            if any(name in block for block in plan.clusters for name in layer):
                lengths[rank] = max(lengths[rank], least)
    return lengths


def _ends(plan: Layering) -> Extent:
    """Room for frames before the first column and after the last."""
    if isinstance(plan, Clustering):
        return plan.rim.before[0], plan.rim.after[0]
    return 0.0, 0.0


def _frames(
    plan: Layering, boxes: Mapping[str, Box], stretches: Sequence[Extent]
) -> tuple[Box, ...]:
    if not isinstance(plan, Clustering):
        return ()
    return tuple(
        _frame(plan, [boxes[name] for name in block], stretch)
        for block, stretch in zip(plan.clusters, stretches, strict=True)
    )


def _frame(plan: Clustering, boxes: Sequence[Box], stretch: Extent) -> Box:
    begin = min(box.along - box.length / 2 for box in boxes) - plan.rim.before[0]
    end = max(box.along + box.length / 2 for box in boxes) + plan.rim.after[0]
    length = max(end - begin, plan.rim.least[0])
    return Box((begin + end) / 2, sum(stretch) / 2, length, stretch[1] - stretch[0])


def _rims(plan: Layering) -> int:
    """Arrows that run back need room before the first and after the last column."""
    return 1 if plan.back else 0


def _across(
    plan: Layering, sizes: Mapping[str, Point]
) -> tuple[dict[str, float], Sequence[Extent]]:
    """Places across the flow, each as near to the middle of its neighbours as the others let it."""
    breadth = {name: sizes.get(name, (0, THREAD))[1] for layer in plan.layers for name in layer}
    if isinstance(plan, Clustering):
        return clusters.across(plan, breadth, SPACE)
    return _across_freely(plan, breadth), ()


def _across_freely(plan: Layering, breadth: Mapping[str, float]) -> dict[str, float]:
    before, after = plan.neighbours()
    gaps = [
        [(breadth[a] + breadth[b]) / 2 + SPACE for a, b in itertools.pairwise(layer)]
        for layer in plan.layers
    ]
    at: dict[str, float] = {}
    for layer, distances in zip(plan.layers, gaps, strict=True):
        at.update(zip(layer, spread([0.0] * len(layer), distances), strict=True))
    for sweep in range(_SWEEPS):
        sides = (before, after)[sweep % 2]
        for layer, distances in list(zip(plan.layers, gaps, strict=True))[:: 1 - 2 * (sweep % 2)]:
            wishes = [_mean([at[one] for one in sides[name]], at[name]) for name in layer]
            at.update(zip(layer, spread(wishes, distances), strict=True))
    top = min((at[name] - breadth[name] / 2 for name in at), default=0.0)
    return {name: value - top for name, value in at.items()}


def _mean(values: Sequence[float], otherwise: float) -> float:
    return sum(values) / len(values) if values else otherwise


def _route(chain: Sequence[str], boxes: Mapping[str, Box]) -> tuple[Point, ...]:
    first, *between, last = (boxes[name] for name in chain)
    points = [(first.along + first.length / 2, first.across)]
    for box in between:
        points += [
            (box.along - box.length / 2, box.across),
            (box.along + box.length / 2, box.across),
        ]
    return (*points, (last.along - last.length / 2, last.across))


def _returns(
    plan: Layering, boxes: Mapping[str, Box], lengths: Sequence[float], gap: float, breadth: float
) -> dict[Link, tuple[Point, ...]]:
    """Ways around the graph: out of the source's column, back beside all boxes, in again."""
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
