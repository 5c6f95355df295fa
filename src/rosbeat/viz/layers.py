"""Columns for the boxes of a directed graph, and their order inside each column.

This is the method of Sugiyama, Tagawa and Toda ("Methods for Visual Understanding of Hierarchical
System Structures", IEEE Transactions on Systems, Man, and Cybernetics 11(2), 1981): longest path
for the columns, stand-ins where an arrow passes through a column, mean position of the neighbours
for the order. Nothing is random, so one graph always looks the same.
"""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

Link = tuple[str, str]
Layers = list[list[str]]

_SWEEPS = 8


@dataclass(frozen=True)
class Layering:
    """Where everything goes, without sizes.

    Attributes:
        layers: Column by column the names in it, from first to last; stand-ins among them.
        chains: For every forward link the names it passes: source, stand-ins, target.
        back: The links that run against the columns because the graph has a cycle.
    """

    layers: Layers
    chains: dict[Link, tuple[str, ...]]
    back: tuple[Link, ...]

    def neighbours(self) -> tuple[dict[str, list[str]], dict[str, list[str]]]:
        """For every name those right before it and right after it on the chains."""
        before: dict[str, list[str]] = {name: [] for layer in self.layers for name in layer}
        after: dict[str, list[str]] = {name: [] for name in before}
        for chain in self.chains.values():
            for one, other in itertools.pairwise(chain):
                after[one].append(other)
                before[other].append(one)
        return before, after


def layering(starts: Mapping[str, int], links: Sequence[Link]) -> Layering:
    """Choose columns and order.

    Args:
        starts: For every name the first column it may stand in, in order of creation.
        links: Pairs of names, from source to target.
    """
    back = back_links(list(starts), links)
    forward = [link for link in links if link not in back]
    columns = _without_gaps(_columns(starts, forward))
    layers: Layers = [[] for _ in range(max(columns.values(), default=-1) + 1)]
    for name, column in columns.items():
        layers[column].append(name)
    chains = {link: _chain(link, columns, layers) for link in forward}
    return _untangled(Layering(layers, chains, tuple(back)))


def back_links(names: Sequence[str], links: Sequence[Link]) -> list[Link]:
    """The links that close a cycle when the graph is walked from its sources, in order."""
    targets = {name: [end for start, end in links if start == name] for name in names}
    reached = {end for _, end in links}
    done: set[str] = set()
    back: list[Link] = []
    for root in sorted(names, key=lambda name: name in reached):
        _walk(root, targets, done, back)
    return back


def _walk(root: str, targets: dict[str, list[str]], done: set[str], back: list[Link]) -> None:
    path: list[str] = []
    todo = [(root, False)]
    while todo:
        name, leaving = todo.pop()
        if leaving:
            done.add(path.pop())
        elif name not in done and name not in path:
            path.append(name)
            back += [(name, end) for end in targets[name] if end in path]
            todo.append((name, True))
            todo += [(end, False) for end in reversed(targets[name]) if end not in path]


def _columns(starts: Mapping[str, int], links: Sequence[Link]) -> dict[str, int]:
    columns = dict(starts)
    for _ in starts:
        moved = [
            (end, columns[start] + 1) for start, end in links if columns[end] <= columns[start]
        ]
        if not moved:
            break
        for end, column in moved:
            columns[end] = max(columns[end], column)
    ends = {end for _, end in links}
    for name in columns:
        # What has nothing before it stands right beside what comes after it.
        after = [columns[end] for start, end in links if start == name]
        if after and name not in ends:
            columns[name] = min(after) - 1
    return columns


def _without_gaps(columns: dict[str, int]) -> dict[str, int]:
    used = {column: rank for rank, column in enumerate(sorted(set(columns.values())))}
    return {name: used[column] for name, column in columns.items()}


def _chain(link: Link, columns: dict[str, int], layers: Layers) -> tuple[str, ...]:
    """The link's way through the columns; puts a stand-in into each column it passes."""
    between = range(columns[link[0]] + 1, columns[link[1]])
    stand_ins = [f"via {column} {link[0]} > {link[1]}" for column in between]
    for column, name in zip(between, stand_ins, strict=True):
        layers[column].append(name)
    return (link[0], *stand_ins, link[1])


def _untangled(given: Layering) -> Layering:
    """The given layering with the columns reordered so that few arrows cross."""
    before, after = given.neighbours()
    layers = [list(layer) for layer in given.layers]
    best, fewest = layers, _crossings(layers, after)
    for sweep in range(_SWEEPS):
        layers = [list(layer) for layer in layers]
        order, sides = (1, before) if sweep % 2 == 0 else (-1, after)
        for layer in layers[::order]:
            _sort(layer, layers, sides)
        crossings = _crossings(layers, after)
        if crossings < fewest:
            best, fewest = layers, crossings
    return Layering(best, given.chains, given.back)


def _sort(layer: list[str], layers: Layers, sides: dict[str, list[str]]) -> None:
    """Order a column by the mean place of its neighbours; who has none keeps its place."""
    place = {name: rank / max(1, len(one) - 1) for one in layers for rank, name in enumerate(one)}
    means = {
        name: sum(map(place.__getitem__, sides[name])) / len(sides[name])
        if sides[name]
        else place[name]
        for name in layer
    }
    layer.sort(key=means.__getitem__)


def _crossings(layers: Layers, after: dict[str, list[str]]) -> int:
    place = {name: rank for layer in layers for rank, name in enumerate(layer)}
    total = 0
    for layer in layers:
        ends = [place[end] for name in layer for end in sorted(after[name], key=place.__getitem__)]
        total += sum(one > other for k, one in enumerate(ends) for other in ends[k + 1 :])
    return total
