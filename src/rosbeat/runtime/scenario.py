"""Running a learner's node and writing down what it did.

A scenario says nothing about right or wrong. Whatever goes wrong in the learner's code becomes a
fault in the observation; nothing is printed and nothing is raised, and it takes no longer than its
deadline. Afterwards the kernel is as it was.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

from rclpy.node import Node

from rosbeat.records import Observation
from rosbeat.runtime.feeding import feeder as feeder
from rosbeat.runtime.feeding import message_class as message_class
from rosbeat.runtime.launch import Launch as Launch
from rosbeat.runtime.launch import Maker as Maker
from rosbeat.runtime.scene import Scene
from rosbeat.runtime.steps import Step
from rosbeat.runtime.unharmed import unharmed

#: Seconds of wall time that an observation may take.
DEADLINE = 5.0


def observe(
    answer: Any,  # noqa: ANN401 - whatever a learner hands over
    seconds: float,
    *,
    others: Iterable[Callable[[], Node] | Maker] = (),
    start: Launch | None = None,
    seed: int = 0,
    steps: Iterable[Step] = (),
    deadline: float = DEADLINE,
) -> Observation:
    """Run an answer among other nodes in virtual time.

    Args:
        answer: What should be a node class, or a function that returns a node. Of a node the class
            is taken.
        seconds: Virtual seconds to run.
        others: Nodes to run beside it. They are added first, so that what clashes with them is
            raised by the answer's own line. A `Maker` also says how a node is started.
        start: How the answer is started: under which name, with which topics and parameters.
        seed: Seed of the random numbers that nodes draw.
        steps: What is done while it runs; each that was done is a callback of the kind `step`.
        deadline: Seconds of wall time after which it is broken off.

    Returns:
        What happened. An answer that cannot be made into a node, an endless chain, and a deadline
        that passed are faults.

    Raises:
        KeyboardInterrupt: If Interrupt was pressed.
        DomainsExhaustedError: If no private domain id is left on this machine.
    """
    scene = Scene(seed, seconds, steps)
    try:
        with unharmed() as count:
            scene.play(Maker(answer, start or Launch()), others, deadline)
        # What the learner's code has changed is put back before anything else is done.
        with unharmed():
            return scene.observation(count.characters)
    finally:
        with unharmed():
            scene.close()
