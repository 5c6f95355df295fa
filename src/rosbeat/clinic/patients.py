"""Run a patient: a real system with one or two faults, and its owner's description."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import redirect_stderr
from functools import cached_property
from io import StringIO
from typing import TYPE_CHECKING

from rosbeat.clinic.cases import Ill
from rosbeat.clinic.charts import Chart, chart
from rosbeat.clinic.plans import Plan, Wiring
from rosbeat.diagnosis.silence import NODE
from rosbeat.records import Observation

if TYPE_CHECKING:
    from rosbeat.page_session import Session


class Patient:
    """Represent one system of the ward, which displays itself at the end of a cell.

    Args:
        number: Number of the patient in the ward.
        ill: The system, its faults and its owner's complaint.
        seed: Seed of the patient's session.
    """

    def __init__(self, number: int, ill: Ill, seed: int) -> None:
        self.number = number
        self._ill = ill
        self._seed = seed

    @property
    def complaint(self) -> str:
        """Return what the owner says, which never names the cause."""
        return self._ill.complaint

    @property
    def orders(self) -> str:
        """Return the owner's specification of the system, in words."""
        return "\n".join(_orders(self._ill.plan))

    @cached_property
    def ros(self) -> Session:
        """Return the session of the system, which has run for a minute and can run on.

        The session opens on first access, and closes with the patient or with `ros.close()`.
        """
        return _running(self._ill.plan, self._seed)

    def __repr__(self) -> str:
        head, rest = "  Ordered: ", " " * len("  Ordered: ")
        orders = [(rest if at else head) + row for at, row in enumerate(_orders(self._ill.plan))]
        return "\n".join(
            [f"Patient {self.number}: {self._ill.plan.place}", f'  "{self.complaint}"', *orders]
        )


def examined(ill: Ill, seed: int, number: int = 0) -> Chart:
    """Run a system for as long as a patient has run, and write down what the instruments show.

    Args:
        ill: The system.
        seed: Seed of its session.
        number: Number of the patient.
    """
    with _running(ill.plan, seed) as ros:
        seen = ros.observation()
        return chart(seen, ill.plan.orders, _unspun(ros, seen), number, ill.truths)


def _unspun(ros: Session, seen: Observation) -> set[str]:
    """Nodes whose callbacks nobody runs, as `explain` marks them."""
    ended = {fault.node for fault in seen.faults}
    explained = [ros.explain(topic) for topic in seen.graph.topics()]
    return {
        mark.subject
        for one in explained
        if any(diagnosis.mistake == "not-spun" for diagnosis in one.diagnoses)
        for mark in one.marks
        if mark.kind == NODE and mark.subject not in ended
    }


def _running(plan: Plan, seed: int) -> Session:
    # Here, so that judges can read charts where ROS is not installed.
    from rosbeat.page_session import Session

    ros = Session(seed=seed)
    # A session says at once which node has ended, and that is for the doctor to find out.
    with redirect_stderr(StringIO()):
        _run(ros, plan)
    return ros


def _run(ros: Session, plan: Plan) -> None:
    from rosbeat.clinic.nodes import maker

    for part in sorted(plan.parts, key=lambda one: one.joins):
        ros.run(part.joins - ros.time, quiet=True)
        make = maker(part, plan.orders)
        if part.handed_over:
            ros.add(make, namespace=part.namespace or None, remappings=part.remappings)
        else:
            make()  # into the session's context, and nobody runs its callbacks
    ros.run(plan.seconds - ros.time, quiet=True)


def _orders(plan: Plan) -> list[str]:
    orders = plan.orders
    burst = f"{orders.burst} readings at once" if orders.burst > 1 else "a reading"
    return [
        *(_route(topic, orders.wiring) for topic in dict.fromkeys(w.topic for w in orders.wiring)),
        f"{burst} every {orders.period:g} s, {orders.least:g} to {orders.most:g} degrees Celsius,",
        "each one half a degree above or below the last one, or equal to it",
        f"Low below {orders.low:g}, High above {orders.high:g}, and Normal otherwise",
    ]


def _route(topic: str, wiring: Sequence[Wiring]) -> str:
    """Who publishes on a topic, and who listens."""
    here = [one for one in wiring if one.topic == topic]
    speakers = ", ".join(
        _short(one.node) + (" (once, soon after its start)" if one.once else "")
        for one in here
        if one.kind == "publisher"
    )
    listeners = ", ".join(_short(one.node) for one in here if one.kind == "subscription")
    return f"{speakers} -> {topic} -> {listeners or '(no node)'}"


def _short(node: str) -> str:
    return node.rpartition("/")[2]
