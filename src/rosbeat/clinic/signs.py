"""Find the faults that a chart shows, and the evidence against a diagnosis, with pure functions.

Each kind of fault has a sign: a function that finds its places in a chart, and one that gives the
evidence against it at any other place.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

from rosbeat.clinic import signs_life, signs_links, signs_values
from rosbeat.clinic.charts import Chart
from rosbeat.clinic.plans import Truth

#: Finds faults of one kind: the places of each.
Find = Callable[[Chart], Iterator[tuple[str, ...]]]
#: Says what speaks against a diagnosis at a place.
Against = Callable[[Chart, str], str]

_SIGNS: dict[str, tuple[Find, Against]] = {
    **signs_links.SIGNS,
    **signs_life.SIGNS,
    **signs_values.SIGNS,
}


def found(chart: Chart) -> tuple[Truth, ...]:
    """Return every fault that shows in a chart."""
    return tuple(
        Truth(name, places) for name, (find, _) in _SIGNS.items() for places in find(chart)
    )


def against(chart: Chart, mistake: str, place: str) -> str:
    """Return the evidence against a diagnosis, as the end of a sentence.

    Args:
        chart: The patient.
        mistake: Id of the mistake, one that the clinic knows.
        place: Full name of a node or topic of the patient.
    """
    return _SIGNS[mistake][1](chart, place)
