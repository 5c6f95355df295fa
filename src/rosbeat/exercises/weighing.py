"""Diagnoses held against the chart of a patient: what speaks against them, never what is right."""

from __future__ import annotations

from collections.abc import Sequence
from difflib import get_close_matches

from rosbeat.clinic import signs
from rosbeat.clinic.charts import Chart
from rosbeat.clinic.names import KNOWN
from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.diagnosis.silence import listing
from rosbeat.exercises.claims import Claim

_INSTRUMENTS = (
    "Say which instrument would show it if it were so, use that one, and compare what it shows "
    "with the order."
)


def weighed(chart: Chart, claims: Sequence[Claim]) -> Diagnosis | None:
    """Say what is wrong with the diagnoses of one patient; None if all are right.

    Args:
        chart: The patient.
        claims: The diagnoses that were given, in any order.
    """
    if not claims:
        return Diagnosis(
            "no-diagnosis-yet",
            "no diagnosis yet.",
            "Begin with its owner's words. Then go along the order, from the sensor on: is it "
            "published, matched, taken, and is the value right?",
        )
    for claim in claims:
        wrong = _unreadable(chart, claim) or _refuted(chart, claim)
        if wrong:
            return wrong
    return _number(chart, claims)


def _unreadable(chart: Chart, claim: Claim) -> Diagnosis | None:
    if claim.mistake not in KNOWN:
        return _unknown(chart, claim)
    if _place(chart, claim.place):
        return None
    near = get_close_matches(claim.place, [*chart.nodes, *chart.topics], 1)
    hint = f"Is {near[0]} meant?" if near else "Its nodes and topics stand in the graph."
    return Diagnosis("no-such-place", f"it has no node or topic {claim.place!r}.", hint)


def _unknown(chart: Chart, claim: Claim) -> Diagnosis:
    if claim.place in KNOWN:
        return Diagnosis(
            "arguments-swapped",
            f"{claim.mistake!r} stands first, and {claim.place!r} second.",
            "First the diagnosis, then the place.",
        )
    hint = "`clinic.names()` lists all that may be given: copy one, letter by letter."
    return Diagnosis("no-such-diagnosis", f"the clinic knows no diagnosis {claim.mistake!r}.", hint)


def _place(chart: Chart, name: str) -> str:
    """The full name of a place; its slash may be left out, and so may the namespace of a node."""
    full = "/" + name.lstrip("/")
    if full in (*chart.nodes, *chart.topics):
        return full
    found = [node for node in chart.nodes if node.endswith(full)]
    return found[0] if len(found) == 1 else ""


def _is_true(chart: Chart, claim: Claim) -> bool:
    place = _place(chart, claim.place)
    return any(one.mistake == claim.mistake and place in one.places for one in chart.truths)


def _refuted(chart: Chart, claim: Claim) -> Diagnosis | None:
    if _is_true(chart, claim):
        return None
    place = _place(chart, claim.place)
    yet = signs.against(chart, claim.mistake, place)
    evidence = f"you say {claim.mistake} at {place}; yet {yet}."
    if any(one.mistake == claim.mistake for one in chart.truths):
        hint = "Such a fault is there. Follow the messages: where do they still come, where not?"
        return Diagnosis("other-place", evidence, hint)
    return Diagnosis("contradicted", evidence, _INSTRUMENTS)


def _number(chart: Chart, claims: Sequence[Claim]) -> Diagnosis | None:
    named = {claim.mistake for claim in claims}
    if len(named) < len(chart.truths):
        said = listing(sorted(named))
        return Diagnosis(
            "half-a-diagnosis",
            f"{said} is right, and would you send it home like that?",
            "Imagine that this fault is mended. Would the owner be content? Look at the rest of "
            "the system with the same instruments.",
        )
    return None
