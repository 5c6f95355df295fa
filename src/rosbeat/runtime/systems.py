"""Running a whole system of a learner's: several nodes, as a launch file would start them.

What `scenario.observe` does for one node: nothing is printed or raised, there is a deadline, and
whatever goes wrong is a fault in the observation. A node that cannot be made, or raises, ends
alone; the others go on, as processes do.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from inspect import isclass
from typing import Any

from rclpy.node import Node

from rosbeat.errors import NoSystemError, RosbeatError
from rosbeat.records import Observation
from rosbeat.runtime.launch import Launch, Maker, checked
from rosbeat.runtime.scenario import DEADLINE
from rosbeat.runtime.scene import Scene, _let_be
from rosbeat.runtime.steps import Step
from rosbeat.runtime.unharmed import unharmed

#: A system of more nodes is taken for a slip.
MOST_NODES = 30
_OPTIONS = ("name", "namespace", "remappings", "parameters")


def observe_system(
    answer: Any,  # noqa: ANN401 - whatever a learner hands over
    seconds: float,
    *,
    others: Iterable[Callable[[], Node]] = (),
    parameters: Mapping[str, Any] | None = None,
    steps: Iterable[Step] = (),
    seed: int = 0,
    deadline: float = DEADLINE,
) -> Observation:
    """Run the nodes of an answer among others in virtual time.

    Args:
        answer: What should be a function that returns a list, or the list. Its members are node
            classes, functions that return a node, or pairs of one of these and a dict with
            `name`, `namespace`, `remappings` and `parameters`.
        seconds: Virtual seconds to run.
        others: Nodes to run beside them, added first.
        parameters: Values with which each of the answer's nodes is started, besides its own.
        steps: What is done meanwhile.
        seed: Seed of the random numbers that nodes draw.
        deadline: Seconds of wall time after which it is broken off.

    Returns:
        What happened. An answer that is no list of nodes is a fault of the kind `NoSystemError`.

    Raises:
        KeyboardInterrupt: If Interrupt was pressed.
        DomainsExhaustedError: If no private domain id is left on this machine.
    """
    scene = _SystemScene(seed, seconds, steps)
    try:
        with unharmed() as count:
            scene.play(Maker(answer, Launch(parameters=parameters or {})), others, deadline)
        with unharmed():
            return scene.observation(count.characters)
    finally:
        with unharmed():
            scene.close()


class _SystemScene(Scene):
    """Runs the nodes of a system."""

    def _add(self, answer: Maker) -> None:
        self._making = True
        # Each is a process of its own: none makes room for another of its name.
        self._world.node_begins = _let_be  # type: ignore[method-assign]
        try:
            for member in members(answer.make):
                self._add_one(member, answer.start)
        finally:
            del self._world.node_begins
        self._making = False

    def _add_one(self, member: Maker, given: Launch) -> None:
        try:
            if isinstance(member.make, Node):
                self._session.add(member.make)
                return
            both = {**member.start.parameters, **given.parameters}
            self._session.add(member.make, **replace(member.start, parameters=both).options())
        except RosbeatError as error:
            self._faults.append(self._refused(error))


def members(answer: Any) -> list[Maker]:  # noqa: ANN401
    """The nodes of a system, and how each is started.

    Args:
        answer: A list, or a function that returns one.

    Raises:
        NoSystemError: If it is neither.
        SessionError: If a node cannot be started as the list says.
    """
    found = answer() if callable(answer) and not _is_node(answer) else answer
    if found is None:
        raise _no_system(
            "The function gave nothing back.", "It needs a `return`, and behind it the list."
        )
    if isinstance(found, str | Mapping | Node) or _is_node(found):
        raise _no_system(f"What came is {_kind(found)}.", "A system is a list of nodes.")
    try:
        listed = list(found)
    except TypeError:
        raise _no_system(f"What came is {_kind(found)}.", "A system is a list.") from None
    if not 0 < len(listed) <= MOST_NODES:
        raise _no_system(f"The list holds {len(listed)} nodes.", "Each node of yours stands once.")
    return [_member(one) for one in listed]


def _member(one: Any) -> Maker:  # noqa: ANN401
    if isinstance(one, Maker):
        return one
    if not isinstance(one, tuple | list):
        return Maker(one)
    may = f"The dict may hold {', '.join(_OPTIONS)}, as `ros.add` takes them."
    if len(one) != 2 or not isinstance(one[1], Mapping):
        raise _no_system("A pair in the list is not of a class and a dict.", may)
    strange = [option for option in one[1] if option not in _OPTIONS]
    if strange:
        known = f"known are {', '.join(_OPTIONS)}"
        raise _no_system(f"A node cannot be started with {strange[0]!r}; {known}.", may)
    return Maker(one[0], checked(*(one[1].get(option) for option in _OPTIONS)))


def _is_node(found: object) -> bool:
    return isinstance(found, Node) or (isclass(found) and issubclass(found, Node))


def _kind(found: object) -> str:
    if isclass(found):
        return "one class, and no list"
    return "one node, and no list" if _is_node(found) else f"of type {type(found).__name__}"


def _no_system(what: str, means: str) -> NoSystemError:
    return NoSystemError(what, means, "Return a list of classes: `return [SomeNode, OtherNode]`.")
