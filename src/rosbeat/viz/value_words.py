"""The values of topics in words: how many, from where to where, in which band."""

from __future__ import annotations

from collections.abc import Sequence

from rosbeat.viz.bands import Band, tally
from rosbeat.viz.fields import Series
from rosbeat.viz.words import count, listing, number, rounded, sentence_case


def describe(lines: Sequence[Series], bands: Sequence[Band], name: str, unit: str) -> str:
    """The picture in whole sentences."""
    head = f"{sentence_case(name)} over virtual time" + (f", in {unit}." if unit else ".")
    return " ".join([head, *(_line(line, bands, unit) for line in lines)])


def _line(line: Series, bands: Sequence[Band], unit: str) -> str:
    total = len(line.values)
    first, last = number(line.times[0]), number(line.times[-1])
    span = f"at {first} s" if first == last else f"from {first} s to {last} s"
    said = [f"{count(total, 'value')} on {line.topic} from {line.node}, {span}."]
    tail = f" {unit}" if unit else ""
    if line.finite:
        said.append(_range(line.finite, tail))
    lost = total - len(line.finite)
    if lost:
        verb = "is" if lost == 1 else "are"
        said.append(f"{count(lost, 'value')} {verb} infinite or not a number and left out.")
    if bands:
        said.append(_shares(bands, line.finite, unit))
    return " ".join(said)


def _range(finite: Sequence[float], tail: str) -> str:
    low, high = rounded(min(finite)), rounded(max(finite))
    if low == high:
        return f"All of them are {low}{tail}." if len(finite) > 1 else f"It is {low}{tail}."
    ends = f"first {rounded(finite[0])}, last {rounded(finite[-1])}{tail}"
    return f"They lie between {low} and {high}{tail}: {ends}."


def _shares(bands: Sequence[Band], finite: Sequence[float], unit: str) -> str:
    totals = tally(bands, finite)
    shares = [f"{totals[band.name] or 'none'} {band.name} ({band.words(unit)})" for band in bands]
    outside = len(finite) - sum(totals.values())
    shares += [f"{outside} in no band"] if outside else []
    return f"Of these, {listing(shares)}."
