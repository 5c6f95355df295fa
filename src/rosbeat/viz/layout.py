"""Lay out a directed graph: columns, order, coordinates, frames, and arrows around boxes.

Columns and order follow Sugiyama, Tagawa and Toda ("Methods for Visual Understanding of
Hierarchical System Structures", IEEE Transactions on Systems, Man, and Cybernetics 11(2), 1981):
longest path for the columns, stand-ins where an arrow passes through a column, mean position of the
neighbours for the order.

A cluster is a group of names with one frame around them, and nothing else in it. It takes one
stretch across the flow in all columns from its first to its last; what does not belong to it stands
before or after that stretch. All names have a common order across the flow, a cluster in one block.

Lengths are CSS pixels along the direction of flow and across it, so that the same code lays a graph
out from left to right and from top to bottom. Nothing is random: one graph always looks the same.
"""

from __future__ import annotations

import itertools
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from math import inf

Link = tuple[str, str]
Layers = list[list[str]]
Point = tuple[float, float]
Block = tuple[str, ...]
Extent = tuple[float, float]
#: The second of two variables is at least this far behind the first.
Rule = tuple[str, str, float]

#: Between two columns, at least and at most.
GAP_LEAST, GAP_MOST = 28.0, 120.0
#: Between two boxes of a column, and for an arrow that passes through a column.
SPACE, THREAD = 22.0, 6.0
#: Between two arrows that run back beside the graph.
LANE = 18.0
#: Between a frame and what stands outside of it.
OUTSIDE = 18.0

_ORDER_SWEEPS, _PLACE_SWEEPS = 8, 12


@dataclass(frozen=True)
class Rim:
    """Hold the room between a frame and what is inside; each value is along and across the flow.

    Attributes:
        before: At the frame's beginning.
        after: At its end.
        least: The frame's least extent.
    """

    before: Extent = (10.0, 10.0)
    after: Extent = (10.0, 10.0)
    least: Extent = (0.0, 0.0)


@dataclass(frozen=True)
class Layering:
    """Hold where everything goes, without sizes.

    Attributes:
        layers: Column by column the names in it, from first to last; stand-ins among them.
        chains: For every forward link the names it passes: source, stand-ins, target.
        back: The links that run against the columns because the graph has a cycle.
        blocks: If there are clusters, all names in order across the flow, a cluster in one block.
        clusters: The blocks that have a frame, with the stand-ins of arrows inside.
        rim: Room between frames and what is inside.
    """

    layers: Layers
    chains: dict[Link, tuple[str, ...]]
    back: tuple[Link, ...]
    blocks: tuple[Block, ...] = ()
    clusters: tuple[Block, ...] = ()
    rim: Rim = Rim()

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
        frames: For every cluster a box that encloses it and nothing else.
    """

    boxes: dict[str, Box]
    routes: dict[Link, tuple[Point, ...]]
    returns: dict[Link, tuple[Point, ...]]
    length: float
    breadth: float
    frames: tuple[Box, ...] = ()


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


# Clusters: what belongs to each, and one order for all columns.


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


def clustered(plan: Layering, groups: Sequence[Collection[str]]) -> Layering:
    """Reorder columns so that each group can have a frame; no name may be in two groups."""
    place = {name: (rank + 0.5) / len(one) for one in plan.layers for rank, name in enumerate(one)}
    members = [set(group) for group in groups]
    for chain in plan.chains.values():
        for group in members:
            if {chain[0], chain[-1]} <= group:
                group.update(chain)
    framed = [tuple(sorted(group, key=lambda name: (place[name], name))) for group in members]
    loose = [(name,) for name in place if not any(name in group for group in members)]
    blocks = sorted([*framed, *loose], key=lambda block: _mean([place[one] for one in block], 0.0))
    rank = {name: k for k, name in enumerate(itertools.chain.from_iterable(blocks))}
    layers = [sorted(layer, key=rank.__getitem__) for layer in plan.layers]
    clusters = tuple(block for block in blocks if set(block) in members)
    return replace(plan, layers=layers, blocks=tuple(blocks), clusters=clusters)


# Coordinates.


def needed(plan: Layering, sizes: Mapping[str, Point]) -> float:
    """Return the least extent along the flow for boxes of these sizes (length, breadth)."""
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
    lengths, rims, (before, after) = _lengths(plan, sizes), _rims(plan), _ends(plan)
    gaps = max(1, len(lengths) - 1 + rims)
    gap = min(GAP_MOST, max(GAP_LEAST, (room - before - after - sum(lengths)) / gaps))
    across, stretches = _across(plan, sizes)
    boxes: dict[str, Box] = {}
    at = before + gap * rims / 2
    for layer, length in zip(plan.layers, lengths, strict=True):
        for name in layer:
            own = sizes.get(name, (length, 0.0))
            boxes[name] = Box(at + length / 2, across[name], *own)
        at += length + gap
    ends = [box.across + box.breadth / 2 for box in boxes.values()]
    breadth = max([0.0, *ends, *(end for _, end in stretches)])
    returns = _returns(plan, boxes, lengths, gap, breadth)
    routes = {link: _route(chain, boxes) for link, chain in plan.chains.items()}
    shown = {name: box for name, box in boxes.items() if name in sizes}
    total = at - gap + gap * rims / 2 + after
    blocks = zip(plan.clusters, stretches, strict=True)
    frames = [_frame(plan, [boxes[one] for one in block], extent) for block, extent in blocks]
    breadth += LANE * len(returns)
    return Placement(shown, routes, returns, total, breadth, tuple(frames))


def _lengths(plan: Layering, sizes: Mapping[str, Point]) -> list[float]:
    lengths = [max(sizes.get(name, (0.0, 0.0))[0] for name in layer) for layer in plan.layers]
    # Columns with a frame are wide enough for it; one over several columns always is.
    least = plan.rim.least[0] - sum(_ends(plan))
    framed = set(itertools.chain.from_iterable(plan.clusters))
    return [
        max(length, least) if framed & set(layer) else length
        for layer, length in zip(plan.layers, lengths, strict=True)
    ]


def _ends(plan: Layering) -> Extent:
    """Return the room for frames before the first column and after the last."""
    return (plan.rim.before[0], plan.rim.after[0]) if plan.clusters else (0.0, 0.0)


def _rims(plan: Layering) -> int:
    """Return 1 if arrows run back, which need room before the first and after the last column."""
    return 1 if plan.back else 0


def _frame(plan: Layering, boxes: Sequence[Box], stretch: Extent) -> Box:
    begin = min(box.along - box.length / 2 for box in boxes) - plan.rim.before[0]
    end = max(box.along + box.length / 2 for box in boxes) + plan.rim.after[0]
    length = max(end - begin, plan.rim.least[0])
    return Box((begin + end) / 2, sum(stretch) / 2, length, stretch[1] - stretch[0])


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


def _across(
    plan: Layering, sizes: Mapping[str, Point]
) -> tuple[dict[str, float], Sequence[Extent]]:
    """Return the middle of every name, and begin and end of every cluster; the least begin is 0."""
    breadths = {name: sizes.get(name, (0, THREAD))[1] for layer in plan.layers for name in layer}
    at = _placed(plan, breadths)
    stretches = [
        _tight(block, at, breadths, plan.rim, (at[_begin(number)], at[_end(number)]))
        for number, block in enumerate(plan.clusters)
    ]
    begins = [at[name] - breadths[name] / 2 for name in breadths]
    top = min([*begins, *(begin for begin, _ in stretches)], default=0.0)
    places = {name: at[name] - top for name in breadths}
    return places, [(begin - top, end - top) for begin, end in stretches]


def _begin(number: int) -> str:
    return f"begin of cluster {number}"


def _end(number: int) -> str:
    return f"end of cluster {number}"


def _placed(plan: Layering, breadths: Mapping[str, float]) -> dict[str, float]:
    """Find places for names and for the ends of frames, all columns at once."""
    rules = list(_rules(plan, breadths))
    order: list[str] = []  # every rule runs along it
    for block in plan.blocks or [(name,) for layer in plan.layers for name in layer]:
        number = plan.clusters.index(block) if block in plan.clusters else None
        order += block if number is None else (_begin(number), *block, _end(number))
    at = apart(dict.fromkeys(order, 0.0), order, rules)
    sides = plan.neighbours()
    for sweep in range(_PLACE_SWEEPS):
        # On from column to column, looking back; then back again, looking on.
        back = sweep % 2
        layers = plan.layers[:: -1 if back else 1]
        # A frame reaches over columns, so with frames all columns give way together.
        for names in [list(itertools.chain(*layers))] if plan.clusters else layers:
            wishes = dict(at)
            for name in names:
                wishes[name] = _mean([wishes[one] for one in sides[back][name]], at[name])
            for number, block in enumerate(plan.clusters):
                ends = _tight(block, wishes, breadths, plan.rim, (-inf, inf))
                wishes[_begin(number)], wishes[_end(number)] = ends
            at = apart(wishes, order, rules)
    return at


def _rules(plan: Layering, breadths: Mapping[str, float]) -> Iterator[Rule]:
    for layer in plan.layers:
        for one, other in itertools.pairwise(layer):
            yield one, other, (breadths[one] + breadths[other]) / 2 + SPACE
    for number, block in enumerate(plan.clusters):
        begin, end = _begin(number), _end(number)
        yield begin, end, plan.rim.least[1]
        for name in block:
            yield begin, name, breadths[name] / 2 + plan.rim.before[1]
            yield name, end, breadths[name] / 2 + plan.rim.after[1]
        yield from _rules_outside(plan, number, breadths)


def _rules_outside(plan: Layering, number: int, breadths: Mapping[str, float]) -> Iterator[Rule]:
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


def apart(
    wishes: Mapping[str, float], order: Sequence[str], rules: Sequence[Rule]
) -> dict[str, float]:
    """Return places near the wishes at which every rule holds.

    Pushing everything on until the rules hold is one solution, and pushing everything back is
    another. Rules are linear, so they hold half way between the two as well.

    Args:
        wishes: Wished place of every variable.
        order: The variables, in an order that every rule runs along.
        rules: What is at least how far behind what.
    """
    before: dict[str, list[tuple[str, float]]] = {name: [] for name in order}
    behind: dict[str, list[tuple[str, float]]] = {name: [] for name in order}
    for one, other, distance in rules:
        before[other].append((one, distance))
        behind[one].append((other, distance))
    on: dict[str, float] = {}
    for name in order:
        on[name] = max([wishes[name], *(on[one] + gap for one, gap in before[name])])
    back: dict[str, float] = {}
    for name in reversed(order):
        back[name] = min([wishes[name], *(back[one] - gap for one, gap in behind[name])])
    return {name: (on[name] + back[name]) / 2 for name in order}


def _tight(
    block: Block, at: Mapping[str, float], breadths: Mapping[str, float], rim: Rim, room: Extent
) -> Extent:
    """Return the ends of a frame close around what is inside, at least as long as its label."""
    begin = min(at[name] - breadths[name] / 2 for name in block) - rim.before[1]
    end = max(at[name] + breadths[name] / 2 for name in block) + rim.after[1]
    missing = max(0.0, rim.least[1] - (end - begin))
    begin = max(room[0], min(begin - missing / 2, room[1] - rim.least[1]))
    return begin, max(end, begin + rim.least[1])
