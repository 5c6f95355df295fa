"""A monitor that can be started anywhere: names, limits and unit come from outside.

Pure functions from what three nodes of one class did, in three places, to an outcome.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.diagnosis.wires import Wire, why_not_heard, why_not_published
from rosbeat.exercises.exercise import failed_by, passed
from rosbeat.exercises.page_09_scenarios import FLOAT
from rosbeat.records import INFRASTRUCTURE_TOPICS, Observation, Outcome, Sample

STRING = "std_msgs/msg/String"
#: The default values of the parameters `low`, `high` and `unit`.
LOW, HIGH, UNIT = 20.0, 26.0, "C"

_WORDS = ("High", "Low", "Normal")
_NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?")
#: One decimal, and 32 bits.
_ROUNDING = 0.06


@dataclass(frozen=True)
class Place:
    """Where the monitor is started, and what it hears there.

    Attributes:
        node: Full name of the node; empty for the one that is started without arguments.
        listens: Full name of the topic on which its readings come.
        speaks: Full name of the topic on which it has to publish.
        low: Its lower limit.
        high: Its upper limit.
        unit: Its unit.
        readings: What it hears, one a second, the first at 1 s.
    """

    node: str
    listens: str
    speaks: str
    low: float
    high: float
    unit: str
    readings: tuple[float, ...]


@dataclass(frozen=True)
class _Said:
    """What a node said of a reading."""

    reading: float
    text: str

    @property
    def word(self) -> str:
        found = [word for word in _WORDS if re.search(rf"(?i)\b{word}\b", self.text)]
        return found[0] if len(found) == 1 else ""

    @property
    def has_number(self) -> bool:
        found = [float(number) for number in _NUMBER.findall(self.text)]
        return any(abs(number - self.reading) < _ROUNDING for number in found)

    def names(self, unit: str) -> bool:
        before, after = (r"(?<![A-Za-z])", r"(?![A-Za-z])") if unit.isalpha() else ("", "")
        return re.search(before + re.escape(unit) + after, self.text) is not None


def judge_reusable(exercise: str, observation: Observation, places: Sequence[Place]) -> Outcome:
    """Judge a monitor that was started in several places at once.

    Args:
        exercise: The exercise's id.
        observation: What all of them did; its subject was started without arguments.
        places: Where they were started, that one first.
    """
    home, *elsewhere = places
    wrong = _plain(observation, home)
    for place in elsewhere:
        wrong = wrong or _names(observation, place)
    wrong = wrong or _counted(observation, places) or _sayings(observation, home, elsewhere)
    if wrong:
        return failed_by(exercise, wrong)
    units = ", ".join(place.unit for place in places)
    return passed(
        exercise,
        f"One class in {len(places)} places at once, with other topics, limits and units "
        f"({units}): {sum(len(place.readings) for place in places)} readings, no wrong word.",
    )


# Whether it works at all, and under which names.


def _plain(observation: Observation, home: Place) -> Diagnosis | None:
    """What is missing of the node that was started without arguments."""
    heard = Wire(home.listens, FLOAT)
    if not any(
        (one.node, one.source) == (observation.subject, heard.topic)
        for one in observation.callbacks
    ):
        return why_not_heard(observation, heard) or Diagnosis(
            "no-subscription",
            f"Readings were published on {heard.topic}, and the node got none.",
            "What listens to them, and under which name?",
        )
    wire = Wire(home.speaks, STRING)
    said = [one for one in _all(observation, home) if one.topic == wire.topic]
    if not said:
        return why_not_published(observation, wire) or Diagnosis(
            "never-published",
            f"Readings arrived, and nothing was published on {wire.topic}.",
            "Does the callback come to the line that publishes?",
        )
    if said[0].type_name != STRING:
        return Diagnosis(
            "type-mismatch",
            f"The messages on {wire.topic} are of type {said[0].type_name}.",
            "The status is a text: both sides of a topic must agree on its type.",
        )
    return None


def _names(observation: Observation, place: Place) -> Diagnosis | None:
    wanted = (
        ("subscription", "listens to", place.listens),
        ("publisher", "speaks on", place.speaks),
    )
    for kind, does, topic in wanted:
        names = [
            end.name
            for end in observation.graph.endpoints
            if (end.node, end.kind) == (place.node, kind) and end.name not in INFRASTRUCTURE_TOPICS
        ]
        if topic in names:
            continue
        space = place.node.rpartition("/")[0]
        moved = all(name.startswith(f"{space}/") for name in names)
        return Diagnosis(
            "wrong-topic" if moved else "absolute-name",
            f"Started in the namespace {space}, the node {does} {_listed(names)}, and not "
            f"{'to' if kind == 'subscription' else 'on'} {topic}.",
            "Which name stands in the code? It has to be the one that is asked for, whole."
            if moved
            else "A namespace moves a name only if nothing in the code nails it to the top.",
        )
    return None


def _listed(names: Sequence[str]) -> str:
    return " and ".join(names) or "nothing"


# What it said.


def _all(observation: Observation, place: Place) -> list[Sample]:
    node = place.node or observation.subject
    return [one for one in observation.samples if one.node == node]


def _said(observation: Observation, place: Place) -> list[_Said]:
    texts = {one.time: str(one.value) for one in _all(observation, place)}
    return [_Said(value, texts.get(float(at), "")) for at, value in enumerate(place.readings, 1)]


def _counted(observation: Observation, places: Sequence[Place]) -> Diagnosis | None:
    for place in places:
        times = [one.time for one in _all(observation, place) if one.topic == place.speaks]
        if times != [float(at) for at in range(1, len(place.readings) + 1)]:
            return Diagnosis(
                "wrong-rate",
                f"{len(place.readings)} readings came on {place.listens}, one a second, and "
                f"{len(times)} texts were published on {place.speaks}.",
                "One text for each reading, when it comes: also if nothing has changed.",
            )
    return None


def _sayings(observation: Observation, home: Place, elsewhere: Sequence[Place]) -> Diagnosis | None:
    here = _said(observation, home)
    there = [(place, _said(observation, place)) for place in elsewhere]
    wrong = _words(here, home)
    if wrong and not any(_words(said, place) for place, said in there[:1]):
        return Diagnosis("other-default", wrong.evidence + " Where it was told its limits, it kept "
            "them.", f"Without a word from outside, the limits are {home.low:g} and {home.high:g}: "
            "the values that the parameters are declared with.")  # fmt: skip
    wrong = wrong or _form(here, home)
    for place, said in there:
        wrong = wrong or _fixed(said, place) or _words(said, place) or _unit_fixed(said, place)
        wrong = wrong or _form(said, place)
    return wrong


def _word(value: float, low: float, high: float) -> str:
    return "High" if value > high else "Low" if value < low else "Normal"


def _words(said: Sequence[_Said], place: Place) -> Diagnosis | None:
    for one in said:
        wanted = _word(one.reading, place.low, place.high)
        if one.word == wanted:
            continue
        evidence = (
            f"With the limits {place.low:g} and {place.high:g}, it said {one.text!r} of a reading "
            f"of {one.reading:g}."
        )
        if not one.word:
            hint = "One of the three words stands in each text: High, Low or Normal."
            return Diagnosis("wrong-word", evidence, hint)
        if one.reading in (place.low, place.high):
            hint = "Above and below leave the limit itself out: exactly there all is Normal."
            return Diagnosis("boundary", evidence, hint)
        return Diagnosis("wrong-state", evidence, "Which of your conditions is true for it?")
    return None


def _fixed(said: Sequence[_Said], place: Place) -> Diagnosis | None:
    """Limits that stayed what they are by default."""
    words = [one.word for one in said]
    tries = {
        "low and high": (LOW, HIGH),
        "low": (LOW, place.high),
        "high": (place.low, HIGH),
    }
    given = [_word(one.reading, place.low, place.high) for one in said]
    for names, limits in tries.items():
        found = [_word(one.reading, *limits) for one in said]
        if words == found != given:
            return Diagnosis(
                "limits-fixed",
                f"Started with low {place.low:g} and high {place.high:g}, it went by "
                f"{limits[0]:g} and {limits[1]:g}: the parameter {names} changed nothing.",
                "A value from outside reaches a node only through a parameter that it declares, by "
                "exactly that name, and reads.",
            )
    return None


def _unit_fixed(said: Sequence[_Said], place: Place) -> Diagnosis | None:
    if all(one.names(place.unit) for one in said) or not said[0].names(UNIT):
        return None
    return Diagnosis(
        "unit-fixed",
        f"Started with the unit {place.unit!r}, it said {said[0].text!r}.",
        "The unit is a parameter like the limits, and the text has to use what it holds.",
    )


def _form(said: Sequence[_Said], place: Place) -> Diagnosis | None:
    for one in said:
        if not one.names(place.unit):
            hint = f"Each text ends with the unit, here {place.unit}."
            return Diagnosis("wrong-unit", f"Of {one.reading:g} it said {one.text!r}.", hint)
        if not one.has_number:
            hint = "The reading itself belongs into the text, with one decimal."
            return Diagnosis("wrong-values", f"Of {one.reading:g} it said {one.text!r}.", hint)
    return None
