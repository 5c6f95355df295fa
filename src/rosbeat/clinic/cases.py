"""List the cases of the clinic: single faults and pairs of faults, with the owner's description."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from random import Random

from rosbeat.clinic import faults, faults_heard
from rosbeat.clinic.faults import Fault
from rosbeat.clinic.houses import house, with_humidity, with_teacher
from rosbeat.clinic.plans import DIARY, DISPLAY, GUARD, SENSOR, Plan, Truth

House = Callable[[Random, str], Plan]

#: Levels: something is silent; nothing is silent and something is wrong; two faults.
SILENT, HEARD, PAIR = "silent", "heard", "pair"


@dataclass(frozen=True)
class Case:
    """Describe a kind of patient.

    Attributes:
        name: Name in tests.
        level: `SILENT`, `HEARD` or `PAIR`.
        faults: The faults in order, each with the roles of the nodes that it may affect.
        complaint: Returns what the owner says, without the cause, for the role of the first fault.
        house: Draws the healthy system.
    """

    name: str
    level: str
    faults: tuple[tuple[Fault, tuple[str, ...]], ...]
    complaint: Callable[[str], str]
    house: House = house

    def drawn(self, rng: Random, place: str) -> Ill:
        """Draw a patient of this kind."""
        plan, truths, first = self.house(rng, place), [], ""
        for fault, roles in self.faults:
            role = rng.choice(roles)
            first = first or role
            plan, truth = fault(plan, role, rng)
            truths.append(truth)
        names = {part.role: part.name for part in reversed(plan.parts)}
        return Ill(self.name, plan, tuple(truths), self.complaint(first).format(**names))


@dataclass(frozen=True)
class Ill:
    """Describe a system with one or two faults.

    Attributes:
        case: Name of its case.
        plan: The system.
        truths: The correct diagnoses.
        complaint: What its owner says.
    """

    case: str
    plan: Plan
    truths: tuple[Truth, ...]
    complaint: str


def _bursts(rng: Random, place: str) -> Plan:
    return house(rng, place, burst=5)


def _humid(rng: Random, place: str) -> Plan:
    return with_humidity(house(rng, place))


def _taught(rng: Random, place: str) -> Plan:
    return with_teacher(house(rng, place))


_DARK = {
    SENSOR: "{display} stays dark, and {diary} is empty.",
    GUARD: "{display} stays dark. {diary} is fine.",
    DISPLAY: "{display} stays dark. {diary} is fine.",
    DIARY: "{diary} is empty. {display} is fine.",
}
_FADED = {
    SENSOR: "At first, everything worked. Then {display} stopped changing, and {diary} got no new "
    "entries.",
    GUARD: "At first, everything worked. Then {display} stopped changing. {diary} is fine.",
    DIARY: "At first, everything worked. Then {diary} got no new entries. {display} is fine.",
}


def _said(text: str) -> Callable[[str], str]:
    return lambda _: text


_ANYWHERE = (SENSOR, GUARD, DISPLAY, DIARY)

_SILENT = (
    ("misspelled", faults.misspelled, (SENSOR, DISPLAY, DIARY), _DARK.__getitem__, house),
    ("namespaced", faults.namespaced, (DISPLAY, DIARY), _DARK.__getitem__, house),
    ("unfit", faults.unfit, _ANYWHERE, _DARK.__getitem__, house),
    ("ended", faults.ended, (SENSOR, GUARD, DIARY), _FADED.__getitem__, house),
    ("mute", faults.mute, (SENSOR, GUARD), _DARK.__getitem__, house),
    ("unspun", faults.unspun, _ANYWHERE, _DARK.__getitem__, house),
    ("quiet", faults.quiet, (SENSOR, GUARD), _FADED.__getitem__, house),
    ("late", faults.late, (DISPLAY,), _said(
        "The plate should show the rule, but it stays empty. Everything else is fine."), _taught),
)  # fmt: skip
_HEARD = (
    ("two sources", faults_heard.two_sources, (SENSOR,), _said(
        "The readings jump up and down, as if they came from two rooms."), house),
    ("wrong unit", faults_heard.wrong_unit, (SENSOR,), _said(
        "{display} says High, day and night. It doesn't feel that warm at all."), house),
    ("short queue", faults_heard.short_queue, (GUARD, DIARY), {
        GUARD: "{display} shows fewer readings than {diary} has.",
        DIARY: "There are gaps in {diary}. {display} has shown more readings than that.",
    }.__getitem__, _bursts),
    ("other topic", faults_heard.other_topic, (GUARD, DIARY), {
        GUARD: "{display} says High all the time. The readings of {diary} are fine.",
        DIARY: "The readings in {diary} don't match what {display} shows at all.",
    }.__getitem__, _humid),
    ("unclamped", faults_heard.unclamped, (SENSOR,), _said(
        "{diary} contains readings that {sensor} should never send."), house),
    ("clamped first", faults_heard.clamped_first, (SENSOR,), _said(
        "{diary} contains a few readings that {sensor} should never send."), house),
    ("other rate", faults_heard.other_rate, (SENSOR,), _said(
        "Something is odd: {diary} doesn't have as many entries as I expected."), house),
    ("at the limit", faults_heard.at_the_limit, (GUARD,), _said(
        "Now and then, {display} is wrong. Most of the time, it's right."), house),
    ("stuck", faults_heard.stuck, (SENSOR,), _said(
        "{display} always says Normal. I don't believe it."), house),
)  # fmt: skip
_PAIRS: tuple[tuple[str, Fault, str, Fault, str, str, House], ...] = (
    ("misspelled, unfit", faults.misspelled, DIARY, faults.unfit, DISPLAY,
     "{display} stays dark, and {diary} is empty.", house),
    ("unfit, unspun", faults.unfit, GUARD, faults.unspun, DISPLAY,
     "{display} stays dark. I changed {guard} a little, but {display} is still dark.", house),
    ("ended, namespaced", faults.ended, GUARD, faults.namespaced, DISPLAY,
     "{display} never showed anything, not even in the first seconds.", house),
    ("mute, misspelled", faults.mute, GUARD, faults.misspelled, DISPLAY,
     "{display} stays dark. {diary} is fine.", house),
    ("other topic, unclamped", faults_heard.other_topic, GUARD, faults_heard.unclamped, SENSOR,
     "{display} says High all the time, and {diary} contains strange readings.", _humid),
    ("two sources, stuck", faults_heard.two_sources, SENSOR, faults_heard.stuck, SENSOR,
     "I don't trust the readings: some look fine, and the others are all the same.", house),
    ("short queue, wrong unit", faults_heard.short_queue, DIARY, faults_heard.wrong_unit, SENSOR,
     "{diary} has gaps, and its readings are hard to believe.", _bursts),
    ("at the limit, namespaced", faults_heard.at_the_limit, GUARD, faults.namespaced, DISPLAY,
     "{display} stays dark. Before we moved it, it was wrong now and then.", house),
    ("other rate, ended", faults_heard.other_rate, SENSOR, faults.ended, DIARY,
     "{diary} gets no new entries. And its entries looked odd before that.", house),
)  # fmt: skip

CASES: tuple[Case, ...] = (
    *(Case(name, SILENT, ((make, roles),), says, home)
      for name, make, roles, says, home in _SILENT),
    *(Case(name, HEARD, ((make, roles),), says, home)
      for name, make, roles, says, home in _HEARD),
    *(Case(name, PAIR, ((one, (here,)), (other, (there,))), _said(text), home)
      for name, one, here, other, there, text, home in _PAIRS),
)  # fmt: skip
