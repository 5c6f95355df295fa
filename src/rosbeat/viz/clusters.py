"""Clusters in a layered graph: boxes that one frame encloses, and nothing else does.

A cluster takes one stretch across the flow in all columns from its first to its last, and what
does not belong to it stands before or after that stretch. So a frame is a rectangle. All clusters
and all boxes without one have a common order across the flow, which every column keeps.
"""

from __future__ import annotations

import itertools
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import inf

import numpy as np
import numpy.typing as npt

from rosbeat.viz.layers import Layering, Link

Block = tuple[str, ...]
#: The second of two variables is at least this far behind the first.
Rule = tuple[str, str, float]
Extent = tuple[float, float]

#: Between a frame and what stands outside of it.
OUTSIDE = 18.0

#: From how many blocks on an order is taken as it comes, since trying others takes too long.
_MOST_BLOCKS = 40
_PASSES = 3
_SWEEPS, _ROUNDS = 12, 100
#: A place is found when nothing is pushed further than this, in CSS pixels.
_CLOSE = 0.01
#: How much further the ends of a frame give way than a box does.
_YIELDING = 10.0


@dataclass(frozen=True)
class Rim:
    """Room between a frame and what is inside; each value is along and across the flow.

    Attributes:
        before: At the frame's beginning.
        after: At its end.
        least: The frame's least extent.
    """

    before: Extent = (10.0, 10.0)
    after: Extent = (10.0, 10.0)
    least: Extent = (0.0, 0.0)


@dataclass(frozen=True)
class Clustering(Layering):
    """Columns in which every cluster can have a frame.

    Attributes:
        blocks: All names in order across the flow, those of a cluster in one block.
        clusters: The blocks that have a frame, with the stand-ins of arrows inside.
        rim: Room between frames and what is inside.
    """

    blocks: tuple[Block, ...] = ()
    clusters: tuple[Block, ...] = ()
    rim: Rim = Rim()


def enclosed(
    groups: Sequence[Collection[str]], links: Sequence[Link], others: Collection[str]
) -> list[set[str]]:
    """Add to each group what only its members use, such as a topic between two of them.

    Args:
        groups: Nodes that belong together.
        links: The arrows of the graph.
        others: Everything but the nodes.
    """
    found = [set(group) for group in groups]
    part = {name: {name} for name in others}
    for one, other in links:
        # A note and the topic beside it go the same way.
        if one in part and other in part and part[one] is not part[other]:
            merged = part[one] | part[other]
            part.update(dict.fromkeys(merged, merged))
    for names in part.values():
        ends = {end for link in links if names & set(link) for end in link} - names
        for group in found:
            if len(ends) > 1 and ends <= group:
                group |= names
    return found


def clustered(plan: Layering, groups: Sequence[Collection[str]]) -> Clustering:
    """Reorder columns so that each group can have a frame.

    Args:
        plan: Columns and order.
        groups: Names that get a frame; no name is in two groups.
    """
    place = {name: (rank + 0.5) / len(one) for one in plan.layers for rank, name in enumerate(one)}
    members = [set(group) for group in groups]
    for chain in plan.chains.values():
        for group in members:
            if {chain[0], chain[-1]} <= group:
                group.update(chain)
    framed: list[Block] = [
        tuple(sorted(group, key=lambda name: (place[name], name))) for group in members
    ]
    loose: list[Block] = [(name,) for name in place if not any(name in group for group in members)]
    blocks = sorted(
        framed + loose, key=lambda block: sum(map(place.__getitem__, block)) / len(block)
    )
    blocks = _improved(plan, blocks)
    rank = {name: k for k, name in enumerate(itertools.chain.from_iterable(blocks))}
    layers = [sorted(layer, key=rank.__getitem__) for layer in plan.layers]
    clusters = tuple(block for block in blocks if set(block) in members)
    return Clustering(layers, plan.chains, plan.back, tuple(blocks), clusters)


def across(
    plan: Clustering, breadths: Mapping[str, float], space: float
) -> tuple[dict[str, float], list[Extent]]:
    """Find places across the flow, each as near to the middle of its neighbours as others let it.

    Args:
        plan: Columns, order and clusters.
        breadths: Breadth of every name.
        space: Between two boxes of a column.

    Returns:
        The middle of every name; begin and end of every cluster. The least begin is 0.
    """
    order, rules = _variables(plan), list(_rules(plan, breadths, space))
    at = _pushed(dict.fromkeys(order, 0.0), order, rules)
    sides = plan.neighbours()
    for sweep in range(_SWEEPS):
        # On from column to column, looking back; then back again, looking on.
        wishes, back = dict(at), sweep % 2
        for name in itertools.chain.from_iterable(plan.layers[:: -1 if back else 1]):
            near = [wishes[one] for one in sides[back][name]]
            wishes[name] = sum(near) / len(near) if near else wishes[name]
        for number, block in enumerate(plan.clusters):
            ends = _tight(block, wishes, breadths, plan.rim, (-inf, inf))
            wishes[_begin(number)], wishes[_end(number)] = ends
        at = _pushed(_projected(wishes, rules), order, rules)
    found = [
        _tight(block, at, breadths, plan.rim, (at[_begin(number)], at[_end(number)]))
        for number, block in enumerate(plan.clusters)
    ]
    top = min([*(at[name] - breadths[name] / 2 for name in breadths), *(one for one, _ in found)])
    places = {name: at[name] - top for name in breadths}
    return places, [(begin - top, end - top) for begin, end in found]


# The order of the blocks.


def _improved(plan: Layering, blocks: list[Block]) -> list[Block]:
    """Move blocks, and names within a block, while that undoes crossings or shortens arrows."""
    measure = _Measure(plan, blocks)
    best, cost = blocks, measure(blocks)
    for _ in range(_PASSES if len(blocks) <= _MOST_BLOCKS else 0):
        start = cost
        for block in blocks:
            for trial in _moves(best, set(block)):
                if (found := measure(trial)) < cost:
                    best, cost = trial, found
        if cost == start:
            break
    return best


def _moves(blocks: list[Block], names: set[str]) -> Iterator[list[Block]]:
    """The orders in which one block stands elsewhere, or two of its names have changed places."""
    at = next(rank for rank, block in enumerate(blocks) if set(block) == names)
    block, rest = blocks[at], blocks[:at] + blocks[at + 1 :]
    for rank in range(len(blocks)):
        yield [*rest[:rank], block, *rest[rank:]]
    for k in range(len(block) - 1):
        swapped = (*block[:k], block[k + 1], block[k], *block[k + 2 :])
        yield [*blocks[:at], swapped, *blocks[at + 1 :]]


class _Measure:
    """Counts crossings, of arrows with arrows and with frames, and adds up how far arrows go."""

    def __init__(self, plan: Layering, blocks: Sequence[Block]) -> None:
        self._ids = {name: k for k, name in enumerate(itertools.chain.from_iterable(blocks))}
        column = {name: k for k, layer in enumerate(plan.layers) for name in layer}
        pairs = [pair for chain in plan.chains.values() for pair in itertools.pairwise(chain)]
        self._starts = np.array([self._ids[one] for one, _ in pairs], dtype=np.intp)
        self._ends = np.array([self._ids[other] for _, other in pairs], dtype=np.intp)
        columns = np.array([column[one] for one, _ in pairs], dtype=np.intp)
        self._together = columns[:, None] == columns[None, :]
        self._passing: list[tuple[int, npt.NDArray[np.bool_]]] = []
        for block in blocks:
            if len(block) > 1:
                taken = [column[name] for name in block]
                apart = [
                    not set(pair) & set(block) and min(taken) - 1 <= column[pair[0]] <= max(taken)
                    for pair in pairs
                ]
                self._passing.append((self._ids[block[0]], np.array(apart, dtype=bool)))

    def __call__(self, blocks: Sequence[Block]) -> tuple[int, int]:
        rank: npt.NDArray[np.intp] = np.empty(len(self._ids), dtype=np.intp)
        order = [self._ids[name] for block in blocks for name in block]
        rank[order] = np.arange(len(order))
        start, end = rank[self._starts], rank[self._ends]
        crossed = (start[:, None] < start) & (end[:, None] > end) & self._together
        through = sum(
            int((((start < rank[one]) != (end < rank[one])) & apart).sum())
            for one, apart in self._passing
        )
        return int(crossed.sum()) + through, int(np.abs(start - end).sum())


# Places across the flow.


def _begin(number: int) -> str:
    return f"begin of cluster {number}"


def _end(number: int) -> str:
    return f"end of cluster {number}"


def _variables(plan: Clustering) -> list[str]:
    """All names and the ends of all clusters, in an order that every rule runs along."""
    found: list[str] = []
    for block in plan.blocks:
        if block in plan.clusters:
            number = plan.clusters.index(block)
            found += [_begin(number), *block, _end(number)]
        else:
            found += block
    return found


def _rules(plan: Clustering, breadths: Mapping[str, float], space: float) -> Iterator[Rule]:
    for layer in plan.layers:
        for one, other in itertools.pairwise(layer):
            yield one, other, (breadths[one] + breadths[other]) / 2 + space
    for number, block in enumerate(plan.clusters):
        begin, end = _begin(number), _end(number)
        yield begin, end, plan.rim.least[1]
        for name in block:
            yield begin, name, breadths[name] / 2 + plan.rim.before[1]
            yield name, end, breadths[name] / 2 + plan.rim.after[1]
        yield from _rules_outside(plan, number, breadths)


def _rules_outside(plan: Clustering, number: int, breadths: Mapping[str, float]) -> Iterator[Rule]:
    """Keep everything else in the columns of a cluster out of its frame."""
    block, layers = plan.clusters[number], plan.layers
    rank = {name: k for k, one in enumerate(plan.blocks) for name in one}
    home = {name: k for k, one in enumerate(plan.clusters) for name in one}
    taken = [k for k, layer in enumerate(layers) if set(layer) & set(block)]
    for name in itertools.chain.from_iterable(layers[taken[0] : taken[-1] + 1]):
        if name in block:
            continue
        framed, half = name in home, 0.0 if name in home else breadths[name] / 2
        if rank[name] < rank[block[0]]:
            yield _end(home[name]) if framed else name, _begin(number), half + OUTSIDE
        else:
            yield _end(number), _begin(home[name]) if framed else name, half + OUTSIDE


def _pushed(
    at: Mapping[str, float], order: Sequence[str], rules: Sequence[Rule]
) -> dict[str, float]:
    """Move everything on until every rule holds."""
    behind: dict[str, list[tuple[str, float]]] = {name: [] for name in order}
    for one, other, distance in rules:
        behind[other].append((one, distance))
    found: dict[str, float] = {}
    for name in order:
        found[name] = max([at[name], *(found[one] + gap for one, gap in behind[name])])
    return found


def _projected(wishes: Mapping[str, float], rules: Sequence[Rule]) -> dict[str, float]:
    """The places nearest to the wishes (least squares) at which nearly every rule holds.

    This is Hildreth's method ("A quadratic programming procedure", Naval Research Logistics
    Quarterly 4(1), 1957): each rule in turn pushes its two variables apart, or lets go of them as
    far as it has pushed before.
    """
    at = dict(wishes)
    yielding = {name: _YIELDING for k in range(len(rules)) for name in (_begin(k), _end(k))}
    pairs = [(*rule, yielding.get(rule[0], 1.0), yielding.get(rule[1], 1.0)) for rule in rules]
    forces = [0.0] * len(pairs)
    for _ in range(_ROUNDS):
        furthest = 0.0
        for k, (one, other, distance, here, there) in enumerate(pairs):
            push = max(-forces[k], (distance - at[other] + at[one]) / (here + there))
            at[one] -= here * push
            at[other] += there * push
            forces[k] += push
            furthest = max(furthest, abs(push))
        if furthest < _CLOSE:
            break
    return at


def _tight(
    block: Block, at: Mapping[str, float], breadths: Mapping[str, float], rim: Rim, room: Extent
) -> Extent:
    """Begin and end of a frame close around what is inside, at least as long as its label."""
    begin = min(at[name] - breadths[name] / 2 for name in block) - rim.before[1]
    end = max(at[name] + breadths[name] / 2 for name in block) + rim.after[1]
    missing = max(0.0, rim.least[1] - (end - begin))
    begin = max(room[0], min(begin - missing / 2, room[1] - rim.least[1]))
    return begin, max(end, begin + rim.least[1])
