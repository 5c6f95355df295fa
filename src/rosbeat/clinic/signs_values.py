"""Find faults in published values: numbers beyond their limits, and statuses that do not match."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from rosbeat.clinic.charts import Chart, Talk
from rosbeat.clinic.plans import OVER, STEP
from rosbeat.diagnosis.silence import listing

#: A room that nothing holds does not go so far over its limits; another unit goes farther.
_FAR = 2 * OVER
#: Two spans are the same if they differ by less.
_ALIKE = 0.01
#: So many messages that are all alike are no accident.
_MANY = 10


def _readings(chart: Chart) -> Iterator[Talk]:
    """Who publishes readings, and has published some."""
    return (one for one in chart.talks if one.topic == chart.orders.topic and one.values)


def _over(chart: Chart, talk: Talk) -> float:
    """How far its readings go beyond the limits that were ordered, at most."""
    return max(chart.orders.least - talk.values[0], talk.values[-1] - chart.orders.most)


def _unit(chart: Chart) -> Iterator[tuple[str, ...]]:
    for talk in _readings(chart):
        if _over(chart, talk) > _FAR:
            yield talk.node, talk.topic


def _unclamped(chart: Chart) -> Iterator[tuple[str, ...]]:
    for talk in _readings(chart):
        if STEP < _over(chart, talk) <= _FAR:
            yield talk.node, talk.topic


def _too_early(chart: Chart) -> Iterator[tuple[str, ...]]:
    for talk in _readings(chart):
        if 0 < _over(chart, talk) <= STEP:
            yield talk.node, talk.topic


def _stuck(chart: Chart) -> Iterator[tuple[str, ...]]:
    for talk in _readings(chart):
        if len(talk.values) == 1 and talk.count >= _MANY:
            yield talk.node, talk.topic


def _boundary(chart: Chart) -> Iterator[tuple[str, ...]]:
    orders = chart.orders
    wrong = {f"{orders.high:.1f} High", f"{orders.low:.1f} Low"}
    for talk in chart.talks:
        if wrong.intersection(talk.texts):
            yield talk.node, talk.topic


def _against_values(chart: Chart, place: str, yet: Callable[[Chart, Talk], str]) -> str:
    """The numbers beside the order; `yet` adds what the order alone does not say."""
    orders = chart.orders
    said = [
        f"{one.node} published numbers from {one.values[0]:.5g} to {one.values[-1]:.5g} on "
        f"{one.topic}, while the orders say {orders.least:g} to {orders.most:g}{yet(chart, one)}"
        for one in _readings(chart)
        if place in (one.node, one.topic)
    ]
    return listing(said) or "no reading in degrees comes from that place"


def _against_unit(chart: Chart, place: str) -> str:
    return _against_values(chart, place, _near)


def _against_stuck(chart: Chart, place: str) -> str:
    return _against_values(chart, place, lambda _, talk: "")


def _against_unclamped(chart: Chart, place: str) -> str:
    return _against_values(chart, place, _held)


def _against_early(chart: Chart, place: str) -> str:
    return _against_values(chart, place, _by_steps)


def _near(chart: Chart, talk: Talk) -> str:
    over = _over(chart, talk)
    if not 0 < over <= _FAR:
        return ""
    return f"; they are at most {over:g} outside, but in another unit all of them would be"


def _held(chart: Chart, talk: Talk) -> str:
    over = _over(chart, talk)
    if 0 < over <= STEP:
        return f"; they are at most {over:g} outside, but unclamped readings would go farther"
    return _afar(chart, talk)


def _by_steps(chart: Chart, talk: Talk) -> str:
    over = _over(chart, talk)
    if STEP < over <= _FAR:
        return f"; they are {over:g} outside, but a clamp before the step allows one step at most"
    return _afar(chart, talk)


def _afar(chart: Chart, talk: Talk) -> str:
    """Readings far beyond the limits are none that went over them a little."""
    if _over(chart, talk) <= _FAR:
        return ""
    span, asked = talk.values[-1] - talk.values[0], chart.orders.most - chart.orders.least
    # Kelvin moves all readings alike, to the precision of a Float32; Fahrenheit spreads them, too.
    if abs(span - asked) < _ALIKE:
        return f"; they span {asked:g} degrees, as ordered"
    return (
        f"; they are more than {_FAR:g} degrees outside, as no Celsius reading of this room can be"
    )


def _against_boundary(chart: Chart, place: str) -> str:
    limits = [f"{limit:.1f}" for limit in (chart.orders.low, chart.orders.high)]
    said = [
        f"{talk.node} says {text!r}, but a reading at a limit is Normal"
        for talk in chart.talks
        if place in (talk.node, talk.topic)
        for text in talk.texts
        if text.split()[0] in limits
    ]
    return listing(said) or "no node there has judged a reading that is exactly at a limit"


SIGNS = {
    "wrong-unit": (_unit, _against_unit),
    "never-changes": (_stuck, _against_stuck),
    "no-clamp": (_unclamped, _against_unclamped),
    "clamped-too-early": (_too_early, _against_early),
    "boundary": (_boundary, _against_boundary),
}
