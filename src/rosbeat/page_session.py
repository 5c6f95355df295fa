"""The session of a page: one of `rosbeat.ros` that knows mistakes, explains, and opens a panel."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rosbeat.diagnosis.exceptions import first_sentence, meaning_of
from rosbeat.diagnosis.silence import Explanation
from rosbeat.diagnosis.silence import explain as explain_scene
from rosbeat.errors import called_as
from rosbeat.inspection import inspect_topic
from rosbeat.page_cells import cell_to_run, link_below
from rosbeat.records import Fault
from rosbeat.ros import session
from rosbeat.ros.clock import START
from rosbeat.ros.context import show_briefly
from rosbeat.ros.errors import Advice, Console, duration_ns
from rosbeat.ros.session_core import full_topic

if TYPE_CHECKING:
    from rosbeat.panel.panel import Panel


class PageConsole(Console):
    """Print what happens in a session of a page, and recognize the mistakes of beginners."""

    add_again = "run the cell that adds the node again."
    create_again = "run the cell again."

    def explain(self, fault: Fault) -> Advice | None:
        """Return which known mistake an exception comes from; None if it is none of them.

        After a restart of the kernel, a name is missing because its cell has not run.
        """
        cell = cell_to_run(f"{fault.kind}: {fault.text}")
        if cell is not None:
            link_below(cell)
            text = first_sentence(fault.text)
            means = "No cell that has run since the kernel started defines that name."
            return Advice(text, means, f"Run the cell above {cell}.")
        known = meaning_of(fault)
        if known is None:
            return None
        return Advice(first_sentence(fault.text), known.evidence, known.hint)


class Session(session.Session):
    """Run ROS nodes inside a page, in virtual time or live, and record what they do.

    ::

        with Session(seed=7) as ros:
            sensor = ros.add(TemperatureSensor)
            ros.run(seconds=60)
            ros.messages("temperature")
            ros.explain("temperature")

    The nodes are real `rclpy` nodes on the real middleware, in a ROS context of their own. In
    virtual time (`run`) the clock jumps from one timer to the next, so a minute takes milliseconds
    and every run gives the same result. Live (`start`, `wait`, `stop`) the same nodes run against
    the wall clock; in a domain that was joined with `domain_id`, other processes can talk to them.

    A session closes at the end of its `with` block, on `close()`, when it is garbage-collected, or
    when the kernel ends, and releases all its resources. A node that is created without a context
    belongs to the session that was opened last.

    Args:
        seed: Seed of the random numbers that the nodes draw with Python's `random` or NumPy's
            global generator. The same seed gives the same run.
        domain_id: The ROS domain to join, 0 to 214; the session then also discovers the nodes of
            other processes in that domain. By default a session is private: no other session or
            terminal can reach it.

        start_time: What the nodes' clocks show when the session begins, in seconds since 1970. On a
            robot no clock begins at zero. What a session prints counts from its own start.

    Raises:
        SessionError: If an argument is not an integer in its range.
    """

    _console_class = PageConsole

    @called_as("Session(seed=7)")
    def __init__(
        self, *, seed: int = 0, domain_id: int | None = None, start_time: int = START
    ) -> None:
        super().__init__(seed=seed, domain_id=domain_id, start_time=start_time)
        # A cell that is run again makes its node again, in the place of the old one.
        self._core.replaces_nodes = True
        # A second type for a topic is a slip there, and is named at once.
        self._core.has_separate_types = False

    @called_as('ros.explain("temperature")')
    def explain(self, topic: str, *, seconds: float = 3.0) -> Explanation:
        """Say why nothing arrives on a topic, or that all is well, with the rate.

        It goes by what the session has recorded, which takes no time. In a domain that was joined
        with `domain_id`, it also listens to the other processes and asks their nodes whether they
        run.

        Args:
            topic: The topic's name; `temperature` and `/temperature` are the same. Nobody need use
                it.
            seconds: How long to listen to other processes at most, in seconds of wall time.

        Returns:
            The explanation; at the end of a cell it shows itself, and `viz.graph` draws it.

        Raises:
            DurationError: If `seconds` is not a number from 0 up.
            SessionError: If `topic` cannot be the name of a topic, or `explain` is called from a
                callback.
            ClosedSessionError: If the session has ended.
        """
        self._check_call("explain")
        name = full_topic("explain", topic)
        span = duration_ns(seconds, "explain(seconds=...)") / 1e9
        try:
            return explain_scene(name, inspect_topic(self._core, name, span))
        except KeyboardInterrupt as interrupt:
            show_briefly(interrupt, "you stopped the looking; the session goes on.")
            raise

    @called_as("ros.panel()")
    def panel(self) -> Panel:
        """Open the instrument panel: what the live nodes do, and controls to disturb them.

        An open panel makes room for the new one; the last one ends with the session. Where no
        browser can show it, it is a still picture of the graph.

        Raises:
            SessionError: If `panel` is called from a callback.
            ClosedSessionError: If the session has ended.
        """
        self._check_call("panel")
        # The widgets take a while to load, and few pages need them.
        from rosbeat.panel.panel import Panel
        from rosbeat.panel.session_adapter import SessionInstruments

        core = self._core
        if core.panel is not None:
            core.panel.close()
        # The panel must not hold this session, which ends when nothing else refers to it.
        core.panel = made = Panel(SessionInstruments(core))
        return made
