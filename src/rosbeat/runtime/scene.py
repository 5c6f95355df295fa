"""One run of a learner's node among others, in a session of its own."""

from __future__ import annotations

import gc
from collections.abc import Callable, Iterable
from contextlib import AbstractContextManager, suppress
from itertools import islice

from rclpy.node import Node

from rosbeat.errors import NodeClassError, NodeConstructionError, RosbeatError
from rosbeat.records import NANOSECONDS, CallbackRecord, Fault, GraphSnapshot, Observation
from rosbeat.runtime.dozing import resting
from rosbeat.runtime.durations import duration_ns
from rosbeat.runtime.entities import NodeState
from rosbeat.runtime.faults import fault_of
from rosbeat.runtime.guard import Deadline, DeadlinePassed, apart, within
from rosbeat.runtime.launch import Maker
from rosbeat.runtime.naps import virtual_sleep
from rosbeat.runtime.session import Session
from rosbeat.runtime.staging import Stage
from rosbeat.runtime.steps import Step

#: Records of one kind that an observation holds at most; and one that was broken off: a callback
#: that publishes or logs without end fills no memory with them, and takes no time.
MOST_RECORDS, MOST_OF_BROKEN_OFF = 100_000, 2_000
#: What may run beside an answer.
Others = Iterable[Callable[[], Node] | Maker]
#: Seconds of wall time in which a graph is read and nodes are destroyed, at most.
_TO_TIDY = 1.0


class _Over(BaseException):
    """Raised in a callback that sleeps when the run is over: it would go on after that."""


class Scene:
    """Runs an answer, and remembers what went wrong.

    Args:
        seed: Seed of the random numbers that nodes draw.
        seconds: Virtual seconds to run.
        steps: What is done meanwhile.
    """

    def __init__(self, seed: int, seconds: float, steps: Iterable[Step]) -> None:
        self.subject = ""
        self._seed, self._end = seed, duration_ns(seconds)
        self._session = session = Session(seed=seed)
        self._world = session._world
        self._stage = Stage(session, steps)
        self._faults: list[Fault] = []
        self._making = False
        self._slept, self._asleep = 0.0, ""
        # When a callback began to sleep, by its node and by how many the node has run.
        self._busy_since: dict[tuple[int, int], int] = {}
        self._limit: Deadline | None = None
        # What was running when the time was up, and how many faults there had been by then.
        self._stuck: tuple[str, str] = ("", "run")
        self._known = 0

    # Running.

    def play(self, answer: Maker, others: Others, deadline: float) -> None:
        """Run everything, at most `deadline` seconds of wall time; whatever is raised is a fault.

        Raises:
            KeyboardInterrupt: If Interrupt was pressed.
        """
        # What has to be put back stands outside of the deadline, which hits what it finds.
        sleep, limit = self._sleeping(answer.make), within(deadline, self._note_stuck, self._wake)
        with sleep, self._world.running(), limit as self._limit:
            apart(lambda: self._try_to_play(answer, others))

    def _sleeping(self, answer: object) -> AbstractContextManager[None]:
        return virtual_sleep(self._nap, self._world.clock, [answer])

    def _try_to_play(self, answer: Maker, others: Others) -> None:
        try:
            self._perform(answer, others)
        except DeadlinePassed:
            raise
        except _Over:
            return
        except BaseException as error:  # a learner may raise anything
            self._faults.append(self._refused(error))

    def _perform(self, answer: Maker, others: Others) -> None:
        self._stage.prepare()
        for other in others:
            made = other if isinstance(other, Maker) else Maker(other)
            self._session.add(made.make, **made.start.options())
        self._add(answer)
        self._world.console.begin(quiet=True)
        self._stage.advance(self._end, self._world.virtual.run_until)

    def _add(self, answer: Maker) -> None:
        make = type(answer.make) if isinstance(answer.make, Node) else answer.make
        self._making = True
        # A node of the same name would make room: here it is another process, and stays.
        self._world.node_begins = _let_be  # type: ignore[method-assign]
        try:
            made = self._session.add(make, **answer.start.options())
            self.subject = self._stage.subject = self._world.name_of(made) or ""
        finally:
            del self._world.node_begins
        self._making = False

    def _wake(self) -> None:
        """Wake executors that wait in C, where no exception reaches them."""
        for state in self._world.states():
            executor = getattr(state.node, "executor", None)
            if executor is not None and executor is not self._world.virtual:
                executor.wake()

    # Sleeping.

    def _nap(self, seconds: float) -> None:
        if self._making or self._world.virtual.current is None:
            # Nobody waits for a node that is being made: the run begins when it is there.
            self._slept += seconds
            if self._slept * NANOSECONDS > self._end:
                self._expire()
            return
        self._doze(self._world.virtual.current, round(seconds * NANOSECONDS))

    def _doze(self, state: NodeState, span: int) -> None:
        virtual = self._world.virtual
        until = virtual.now + span
        self._busy_since.setdefault((state.number, calls_of(state)), virtual.now)
        with resting(self._world, state):
            self._stage.advance(min(until, self._end), virtual.run_nested)
        if until > self._end:
            self._end_of_sleep(self._busy_since[state.number, calls_of(state)], until)

    def _end_of_sleep(self, since: int, until: int) -> None:
        """The run is over, and a callback sleeps on; that is a fault only if it sleeps for long."""
        if since <= self._end / 2 or until >= 2 * self._end:
            self._expire()
        raise _Over

    def _expire(self) -> None:
        self._asleep = f"still asleep after {self._end / NANOSECONDS:g} s"
        if self._limit is not None:
            self._limit.expire()

    # What went wrong.

    def _note_stuck(self) -> None:
        calling = self._world.virtual.calling
        if self._making:
            self._stuck = ("", "__init__")
        elif calling is not None:
            self._stuck = (calling.node, calling.name)
        # Not `len`: this is called in the midst of code that may have put something in its place.
        self._known = self._world.recorder.faults.__len__()

    def _refused(self, error: BaseException) -> Fault:
        now, cause = self._world.now(), error.__cause__
        if isinstance(error, NodeConstructionError) and cause is not None:
            return fault_of(cause, now, "", "__init__")
        if isinstance(error, RosbeatError):
            call = "add" if isinstance(error, NodeClassError) else "run"
            return Fault(now, "", call, type(error).__name__, error.what, 0, "")
        self._note_stuck()
        return fault_of(error, now, *self._stuck)

    def _all_faults(self) -> tuple[Fault, ...]:
        found = [*self._world.recorder.faults, *self._faults]
        if self._limit is None or not self._limit.passed:
            return tuple(found)
        node, callback = self._stuck
        text = self._asleep or f"still running after {self._limit.seconds:g} s"
        stuck = Fault(self._world.now(), node, callback, "DeadlinePassed", text, *self._limit.place)
        # What was raised afterwards was raised by the shot.
        return (*found[: self._known], stuck)

    # The result.

    def observation(self, printed: int) -> Observation:
        """What was seen.

        Args:
            printed: How many characters the learner's code printed.
        """
        recorder = self._world.recorder
        most = MOST_OF_BROKEN_OFF if self._limit and self._limit.passed else MOST_RECORDS
        callbacks = [*islice(recorder.callbacks(), most), *self._stage.records]
        graph = self._graph()
        return Observation(
            self._world.now(),
            self._seed,
            tuple(islice(recorder.samples(), most)),
            tuple(recorder.logs[:most]),
            tuple(sorted(callbacks, key=_time_of)),
            self._all_faults(),
            graph,
            self.subject,
            printed,
            self._stage.replies,
        )

    def _graph(self) -> GraphSnapshot:
        graph = GraphSnapshot()
        with within(_TO_TIDY), suppress(Exception):  # a node may have properties of its own
            graph = self._world.graph()
        return graph

    def close(self) -> None:
        """End the session, whatever the nodes do against it."""
        kinds = [type(node) for node in self._session.nodes]
        with within(_TO_TIDY, nudge=self._wake):
            apart(self._destroy_nodes)
        self._session.close()
        del self._session, self._world, self._stage
        if any(hasattr(kind, "__del__") for kind in kinds):
            with within(_TO_TIDY):
                apart(gc.collect)  # here, where it has a deadline, and not at any later time

    def _destroy_nodes(self) -> None:
        self._world.hurry()
        for node in reversed(self._session.nodes):
            with suppress(Exception):
                Node.destroy_node(node)  # and not what its class makes of that


def calls_of(state: NodeState) -> int:
    """How many callbacks a node has run; while one sleeps, none is added."""
    return sum(entry.calls for entry in state.entries)


def _let_be(name: str, namespace: str) -> None:
    """Make no room for a new node."""


def _time_of(record: CallbackRecord) -> int:
    return record.time_ns
