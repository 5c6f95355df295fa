"""Draw a ward of patients from a seed, and run each patient: a broken system of real nodes."""

from __future__ import annotations

from contextlib import redirect_stderr
from functools import cached_property, partial
from io import StringIO
from random import Random
from typing import TYPE_CHECKING

from rosbeat.clinic.charts import Chart, chart_of
from rosbeat.clinic.faults import CASES, HEARD, PAIR, SILENT, BrokenSystem
from rosbeat.clinic.systems import PLACES, Specification, System
from rosbeat.errors import ExerciseError, called_as

if TYPE_CHECKING:
    from rosbeat.page_session import Session

#: How long a system has run when it is first examined, in seconds.
SECONDS = 60.0
#: How many patients of each level there are, in this order.
_LEVELS = ((SILENT, 4), (HEARD, 4), (PAIR, 3))


class Ward:
    """Draw a ward of patients, which are broken systems; the same seed always draws the same ward.

    Patients 1 to 4 have one fault, and something is silent. Patients 5 to 8 have one fault, and
    nothing is silent. Patients 9 to 11 have two faults.

    Args:
        seed: Seed for the faults of each patient, and for all names and numbers.

    Raises:
        ExerciseError: If the seed is not an integer from 0 to 2**32 - 1.
    """

    @called_as("clinic.Ward(seed=7)")
    def __init__(self, seed: int = 7) -> None:
        if type(seed) is not int or not 0 <= seed < 2**32:
            raise ExerciseError(
                f"There is no ward {seed!r}.",
                "A ward's number, its seed, is a whole number of 0 or more.",
                "For example, write clinic.Ward(seed=7).",
            )
        self.seed = seed

    def __len__(self) -> int:
        return sum(count for _, count in _LEVELS)

    def __repr__(self) -> str:
        places = [f"  {number}: {one.system.place}" for number, one in enumerate(self._broken, 1)]
        return "\n".join([f"Ward {self.seed}, {len(self)} patients", *places])

    @called_as("ward.patient(1)")
    def patient(self, number: int) -> Patient:
        """Return one patient, with a new session.

        Args:
            number: Number of the patient, from 1.

        Raises:
            ExerciseError: If there is no such patient.
        """
        return Patient(number, self._at(number), self.seed)

    @called_as("ward.chart(1)")
    def chart(self, number: int) -> Chart:
        """Return the chart of one patient, including the correct diagnoses.

        Args:
            number: Number of the patient, from 1.

        Raises:
            ExerciseError: If there is no such patient.
        """
        one = self._at(number)
        with _running(one.system, self.seed) as ros:
            return chart_of(ros.observation(), one)

    def _at(self, number: int) -> BrokenSystem:
        if type(number) is not int or not 1 <= number <= len(self):
            raise ExerciseError(
                f"There is no patient {number!r}.",
                f"The patients of this ward are numbered from 1 to {len(self)}.",
                "For example, write ward.patient(1).",
            )
        return self._broken[number - 1]

    @cached_property
    def _broken(self) -> list[BrokenSystem]:
        rng = Random(self.seed)
        places = rng.sample(PLACES, len(self))
        cases = [
            case
            for level, count in _LEVELS
            for case in rng.sample([one for one in CASES if one.level == level], count)
        ]
        return [case.draw(rng, place) for case, place in zip(cases, places, strict=True)]


class Patient:
    """Represent one system of the ward, which displays itself at the end of a cell.

    Args:
        number: Number of the patient in the ward.
        broken: The system, its faults and its owner's complaint.
        seed: Seed of the patient's session.
    """

    def __init__(self, number: int, broken: BrokenSystem, seed: int) -> None:
        self.number = number
        self._broken = broken
        self._seed = seed

    @property
    def complaint(self) -> str:
        """Return what the owner says, which never names the cause."""
        return self._broken.complaint

    @property
    def orders(self) -> str:
        """Return the owner's specification of the system, in words."""
        spec = self._broken.system.spec
        topics = dict.fromkeys(one.topic for one in spec.wiring)
        burst = f"{spec.burst} readings at once" if spec.burst > 1 else "a reading"
        return "\n".join([
            *(_route(topic, spec) for topic in topics),
            f"{burst} every {spec.period:g} s, {spec.least:g} to {spec.most:g} degrees Celsius,",
            "each one half a degree above or below the last one, or equal to it",
            f"Low below {spec.low:g}, High above {spec.high:g}, and Normal otherwise",
        ])  # fmt: skip

    @cached_property
    def ros(self) -> Session:
        """Return the session of the system, which has run for a minute and can run on.

        The session opens on first access, and closes with the patient or with `ros.close()`.
        """
        return _running(self._broken.system, self._seed)

    def __repr__(self) -> str:
        head = "  Ordered: "
        orders = self.orders.replace("\n", "\n" + " " * len(head))
        place = self._broken.system.place
        return f'Patient {self.number}: {place}\n  "{self.complaint}"\n{head}{orders}'


def _route(topic: str, spec: Specification) -> str:
    """Who publishes on a topic, and who listens."""
    names: dict[str, list[str]] = {"publisher": [], "subscription": []}
    for one in spec.wiring:
        if one.topic == topic:
            once = " (once, soon after its start)" if one.once else ""
            names[one.kind].append(one.node.rpartition("/")[2] + once)
    publishers, subscribers = map(", ".join, names.values())
    return f"{publishers} -> {topic} -> {subscribers or '(no node)'}"


def _running(system: System, seed: int) -> Session:
    # Here, so that judges can read charts where ROS is not installed.
    from rosbeat.clinic.nodes import NODE_CLASSES
    from rosbeat.page_session import Session

    ros = Session(seed=seed)
    # A session says at once which node has ended, and that is for the doctor to find out.
    with redirect_stderr(StringIO()):
        for node in sorted(system.nodes, key=lambda one: one.starts_at):
            ros.run(node.starts_at - ros.time, quiet=True)
            make = partial(NODE_CLASSES[node.role], node, system.spec)
            if node.spun:
                ros.add(make, namespace=node.namespace or None, remappings=node.remappings)
            else:
                make()  # into the session's context, and nobody runs its callbacks
        ros.run(SECONDS - ros.time, quiet=True)
    return ros
