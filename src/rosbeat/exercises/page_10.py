"""Page 10, find the fault: diagnoses of a ward's patients, compared with their charts.

The scenario only calls the learner's function, so no patient's fault is known where it runs. The
judge examines the patients, where none of a learner's code runs; `rosbeat.clinic` is imported in
its functions only, and says what contradicts a diagnosis (`clinic/diagnoses.py`). What is left to
judge here is the form of a diagnosis, and that may be anything.
"""

from __future__ import annotations

from collections.abc import Sequence
from difflib import get_close_matches
from functools import lru_cache, partial
from typing import TYPE_CHECKING, Any, NamedTuple

from rosbeat.diagnosis.findings import listing
from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.exercises.exercise import BLANK, Exercise, Verdict, not_attempted, passed
from rosbeat.exercises.model import before_reading
from rosbeat.exercises.scenarios import Answer, Report, Value, report

if TYPE_CHECKING:
    from rosbeat.clinic.charts import Chart

#: The ward of the page; a dict of diagnoses may name another one.
WARD = 7
_KEY = "ward"

# The dict of diagnoses: from a patient's number to a pair, or to a list of pairs.


class Claim(NamedTuple):
    """Hold one diagnosis: the id of a fault, and the node or topic where it is said to be."""

    mistake: str
    place: str


def _claims(entry: Value) -> list[Claim] | None:
    """Return the diagnoses of one patient without blanks; None if they cannot be read."""
    if not isinstance(entry, list):
        return None
    pairs = [entry] if [*map(type, entry)] == [str, str] else entry
    if not all(isinstance(pair, list) and [*map(type, pair)] == [str, str] for pair in pairs):
        return None
    claims = [Claim(mistake.strip(), place.strip()) for mistake, place in pairs]
    return [one for one in claims if one.mistake and BLANK not in (one.mistake, one.place)]


def _is_begun(entry: Value) -> bool:
    """Return whether anything is written for a patient, if only a place, or a diagnosis."""
    if isinstance(entry, list):
        return any(map(_is_begun, entry))
    return isinstance(entry, str) and entry.strip() not in ("", BLANK)


def _unreadable(value: Value, patients: Sequence[int]) -> Diagnosis | None:
    """Say why a result holds no diagnoses; None if it can be read."""
    evidence = _misfit(value, patients)
    if not evidence:
        return None
    form = '`1: ("callback-blocks", "/a_node")`'
    hint = f"Return a dict: the patient's number, then diagnosis and place, as in {form}."
    return Diagnosis("no-diagnoses", evidence, hint)


def _misfit(value: Value, patients: Sequence[int]) -> str:
    if not isinstance(value, dict):
        return f"The function returned a {type(value).__name__} instead of a dict."
    ward = value.get(_KEY, WARD)
    if type(ward) is not int or not 0 <= ward < 2**32:
        return f"There is no ward {ward!r}: its number is a whole one, from 0 up."
    for key, entry in value.items():
        if key != _KEY and key not in map(str, patients):
            asked = f"patients {patients[0]} to {patients[-1]}"
            return f"The dict has the key {key}, and this exercise is about {asked}."
        if key != _KEY and _claims(entry) is None:
            return f"The value for patient {key} is not a pair of two texts, or a list of pairs."
    return ""


# A diagnosis and a chart.


@lru_cache(maxsize=64)
def _chart(seed: int, number: int) -> Chart:
    """Examine a patient once: it is the same each time."""
    from rosbeat.clinic.patients import Ward

    return Ward(seed).chart(number)


def weigh(chart: Chart, claims: Sequence[Claim]) -> Diagnosis | None:
    """Return what is wrong with the diagnoses of one patient, never what is right; or None.

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
    wrong = (_nameless(chart, one) or _refuted(chart, one) for one in claims)
    return next(filter(None, wrong), None) or _half(chart, claims)


def _place(chart: Chart, name: str) -> str:
    """Return a place's full name; its slash may be left out, and so may a node's namespace."""
    full = "/" + name.lstrip("/")
    if full in (*chart.nodes, *chart.topics):
        return full
    found = [node for node in chart.nodes if node.endswith(full)]
    return found[0] if len(found) == 1 else ""


def _nameless(chart: Chart, claim: Claim) -> Diagnosis | None:
    """Say if there is no such diagnosis, or no such place."""
    from rosbeat.clinic.diagnoses import KNOWN

    if claim.mistake not in KNOWN and claim.place in KNOWN:
        evidence = f"{claim.mistake!r} comes first, and {claim.place!r} second."
        return Diagnosis("arguments-swapped", evidence, "First the diagnosis, then the place.")
    if claim.mistake not in KNOWN:
        evidence = f"the clinic knows no diagnosis {claim.mistake!r}."
        hint = "`clinic.names()` lists all possible diagnoses: copy one, letter by letter."
        return Diagnosis("no-such-diagnosis", evidence, hint)
    if _place(chart, claim.place):
        return None
    near = get_close_matches(claim.place, [*chart.nodes, *chart.topics], 1)
    hint = f"Did you mean {near[0]}?" if near else "The graph shows its nodes and topics."
    return Diagnosis("no-such-place", f"it has no node or topic {claim.place!r}.", hint)


def _refuted(chart: Chart, claim: Claim) -> Diagnosis | None:
    """Say what contradicts a diagnosis."""
    from rosbeat.clinic.diagnoses import contradiction

    place = _place(chart, claim.place)
    places = [one.places for one in chart.truths if one.mistake == claim.mistake]
    if any(place in there for there in places):
        return None
    yet = contradiction(chart, claim.mistake, place)
    evidence = f"you say {claim.mistake} at {place}; yet {yet}."
    if places:
        hint = "There is such a fault, but not there. Follow the messages: how far do they get?"
        return Diagnosis("other-place", evidence, hint)
    hint = "Which instrument would show this fault? Use it, and compare with the order."
    return Diagnosis("contradicted", evidence, hint)


def _half(chart: Chart, claims: Sequence[Claim]) -> Diagnosis | None:
    known = {claim.mistake for claim in claims}
    if len(known) >= len(chart.truths):
        return None
    return Diagnosis(
        "half-a-diagnosis",
        f"{listing(sorted(known))} is right, and it is not the only fault.",
        "Imagine that this fault is fixed. Would the owner be satisfied? Examine the rest of the "
        "system with the same instruments.",
        len(known) / len(chart.truths),
    )


# All patients of an exercise.


def _judge(patients: Sequence[int], seen: Report) -> Verdict:
    early = before_reading(seen, "diagnoses")
    if early:
        return early
    value = seen.value
    unreadable = _unreadable(value, patients)
    if unreadable:
        return unreadable
    claims = {number: _claims(value.get(str(number), [])) or [] for number in patients}
    if not any(map(_is_begun, (value.get(str(number)) for number in patients))):
        return not_attempted("No patient has a diagnosis yet.")
    ward = value.get(_KEY, WARD)
    weighed = {number: weigh(_chart(ward, number), claims[number]) for number in patients}
    right = [str(number) for number, found in weighed.items() if not found]
    wrong = {number: found for number, found in weighed.items() if found}
    head = f"Patient{'s' * (len(right) > 1)} {listing(right)}"
    if not wrong:
        return passed(f"{head} are diagnosed.")
    # Nobody has to have seen all patients before the first one is judged.
    told = [(n, found) for n, found in wrong.items() if claims[n]] or [*wrong.items()][:1]
    evidence = [f"Patient {number}: {found.evidence}" for number, found in told]
    if right:
        evidence.insert(0, f"{head} {'are' if len(right) > 1 else 'is'} right.")
    share = (len(right) + sum(found.share for found in wrong.values())) / len(patients)
    return Diagnosis(told[0][1].mistake, " ".join(evidence), told[0][1].hint, share)


def _report(answer: Answer) -> Report:
    """Call the function; the diagnoses of one patient may be a set, as their order is free."""

    def in_lists() -> Value:
        value = answer()
        if not isinstance(value, dict):
            return value
        return {
            number: sorted(entry) if isinstance(entry, set | frozenset) else entry
            for number, entry in value.items()
        }

    return report(in_lists)


EXERCISES: tuple[Exercise[Any], ...] = (
    Exercise("10a", _report, partial(_judge, range(1, 5)), "four patients, and something is silent",
        2, (
        "The owner says what is fine. Whatever those nodes need is fine, too: rule it out.",
        "`ros.graph()` first: is every name as it was ordered, letter by letter? Then "
        "`ros.explain(...)` of the topic on which the silence begins, seen from the sensor.",
        "In ward 7: for patient 1, compare the graph with the order. For patient 2, find out "
        "when each node started and when the message was published, with `ros.logs()` and "
        "`ros.messages(...)`.",
        "In ward 7: for patients 3 and 4, ask `ros.explain` about the topic of the readings, "
        "and read only its first line.",
    ), tells_hints=True),
    Exercise("10b", _report, partial(_judge, range(5, 9)), "four patients, and nothing is silent",
        3, (
        "All is well, says `ros.explain`: messages arrive. So look at what they say, how many "
        "they are, and who sent them.",
        "`viz.values` beside the order: limits, steps, rate. `ros.graph()` beside the order: "
        "who is on which topic?",
        "In ward 7: for patient 5, read one message of the sensor. On which scale would that "
        "be a mild day? For patient 6, check which topic each node subscribes to.",
        "In ward 7: for patient 7, count the nodes. For patient 8, draw the readings with the "
        "ordered limits as a band. How far outside the band do they get?",
    ), tells_hints=True),
    Exercise("10c", _report, partial(_judge, range(9, 12)), "three patients with two faults each",
        4, (
        "Find one fault, imagine that it's fixed, and begin again at the sensor.",
        "The two faults are at different places. Go through the nodes one by one: is it "
        "published, is it matched, is it taken, is the value right?",
        "In ward 7: for patient 9, count the messages that each subscriber has received, and "
        "look at the values. For patient 10, look at both topics. For patient 11, look at the "
        "rate, and at which nodes are still running.",
    ), tells_hints=True),
)  # fmt: skip
