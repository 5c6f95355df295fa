"""Observe the ROS graph with a hidden node, and wait until discovery has settled."""

from __future__ import annotations

import math
import os
import signal
import time
from argparse import ArgumentParser, Namespace
from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, suppress
from functools import partial
from importlib.resources import files
from pathlib import Path
from typing import Any, NoReturn

from ros2_command.errors import ENDED_BY, NO_NOTES, CommandError, note
from ros2_command.names import full_name, is_hidden
from ros2_command.untyped import Untyped

PROFILE_VARIABLE = "FASTRTPS_DEFAULT_PROFILES_FILE"
UNKNOWN = "_NODE_NAME_UNKNOWN_"
#: The graph is believed if it was the same this many times in a row. Not a time: on a busy machine
#: time passes in which no news could have come in ...
SAME_LOOKS, SAME_NAMES = 4, 2
#: ... and every process of this machine is in it. Those of other machines announce themselves
#: each 0.1 s, and cannot be counted, so they are given two chances.
OTHER_MACHINES = 0.25
#: A process without the discovery profile announces itself each 3 s. If there is no news for
#: longer, whoever is missing has stopped. While there is news, a busy machine is waited for.
NO_NEWS = 4.0
AT_MOST = 20.0
#: Endpoints whose numbers are missing may be late, or were destroyed; this is how late they may be.
GAPS_FOR = 2.0
#: Whoever waits for longer than this is told for what.
SILENT_FOR = 2.0
_LOOK_EVERY = 0.02


def add_graph_arguments(parser: ArgumentParser, daemon: bool = True) -> None:
    """Add the options of verbs that ask the graph.

    Args:
        parser: The verb's parser.
        daemon: Whether the original's verb can use its daemon.
    """
    parser.add_argument(
        "--spin-time", type=float, default=None,
        help="Spin time in seconds to wait for discovery (default: until the graph has settled)",
    )  # fmt: skip
    parser.add_argument(
        "-s", "--use-sim-time", action="store_true", help="Enable ROS simulation time"
    )
    if daemon:
        parser.add_argument(
            "--no-daemon", action="store_true",
            help="Do not spawn nor use an already running daemon (here: there is none)",
        )  # fmt: skip


class Graph:
    """Look at the graph as a hidden node sees it.

    Attributes:
        node: The rclpy node.
        context: Its context.
        node_name: The node's name, still known after `close`.
    """

    def __init__(self, node: Untyped, context: Untyped, args: Namespace | None = None) -> None:
        from rclpy.executors import SingleThreadedExecutor

        self.node, self.context = node, context
        self.node_name = str(node.get_name())
        self._spin_time: float | None = getattr(args, "spin_time", None)
        self._sim_time = bool(getattr(args, "use_sim_time", False))
        self._born = time.monotonic()
        self._executor = SingleThreadedExecutor(context=context)
        self._executor.add_node(node)

    def close(self) -> None:
        """Take the node out of the graph."""
        self._executor.shutdown()
        self.node.destroy_node()
        self.context.try_shutdown()

    @property
    def age(self) -> float:
        """Return the seconds since the node appeared."""
        return time.monotonic() - self._born

    def spin_until(self, done: Callable[[], bool], seconds: float | None = None) -> bool:
        """Let callbacks run until a condition holds.

        Args:
            done: The condition.
            seconds: When to give up; never if None.

        Returns:
            Whether the condition holds.
        """
        end = None if seconds is None else time.monotonic() + seconds
        while not done():
            left = _LOOK_EVERY if end is None else min(_LOOK_EVERY, end - time.monotonic())
            if left <= 0:
                return False
            self._executor.spin_once(timeout_sec=left)
        return True

    def spin_for(self, seconds: float) -> None:
        """Let callbacks run for some time."""
        self.spin_until(lambda: False, seconds)

    def clock(self) -> Callable[[], float]:
        """Return what tells the time in seconds: simulated time with `-s`, else a steady clock."""
        if not self._sim_time:
            return time.monotonic
        clock = self.node.get_clock()
        return lambda: float(clock.now().nanoseconds) / 1e9

    def ticks(self, period: float) -> Iterator[None]:
        """Let callbacks run, and yield at once and then each period of the clock.

        Ticks that were missed are left out, as timers of ROS do, also when simulated time jumps
        ahead with the first message on `/clock`; where it jumps back they start anew.
        """
        clock = self.clock()
        due = clock()
        while True:
            yield
            due += period * max(1, math.ceil((clock() - due) / period))
            if self._sim_time:
                self.spin_until(partial(_is_outside, clock, due - period, due))
                due = min(due, clock())
            else:
                self.spin_for(due - clock())

    def settle(self, enough: Callable[[], bool] = lambda: False, names_only: bool = False) -> Graph:
        """Wait until the graph can be believed, and return this object.

        That is when every process of this machine is seen, the names of its nodes are known, and
        nothing has changed for a moment.

        Args:
            enough: Ends the wait early, as soon as it is true.
            names_only: Whether only the names of nodes are wanted, not what belongs to them. A
                process tells all its names at once.
        """
        if self._spin_time is not None:
            time.sleep(max(0.0, self._spin_time - self.age))
            return self
        at_least = 0.0 if only_this_machine() else OTHER_MACHINES
        last, since, same, told = None, self._born, 0, False
        while self.age < AT_MOST and time.monotonic() - since < NO_NEWS and not enough():
            now = self._look()
            if now != last:
                last, since, same = now, time.monotonic(), 0
            same += 1
            enough_looks = (
                same >= (SAME_NAMES if names_only else SAME_LOOKS) and self.age >= at_least
            )
            if enough_looks and self._is_complete() and (names_only or self._has_no_gaps(since)):
                break
            if not told and self.age > SILENT_FOR and not os.environ.get(NO_NOTES):
                told = True
                note(self._what_is_awaited())
            time.sleep(_LOOK_EVERY)
        return self

    def _what_is_awaited(self) -> str:
        seen, there = len(self._processes()[0]), count_participants(domain_id())
        missing = f"{there - seen} of {there} ROS processes on this machine have not answered yet"
        return (
            "Waiting for a complete answer: "
            f"{missing if seen < there else 'new nodes are still being discovered'}."
        )

    def _look(self) -> object:
        topics = self.topics()
        counts = [
            (self.node.count_publishers(name), self.node.count_subscribers(name))
            for name, _ in topics
        ]
        return sorted(self.node.get_node_names_and_namespaces()), topics, self.services(), counts

    def _is_complete(self) -> bool:
        """Return whether every ROS process is seen and has told the names of its nodes.

        A process tells of its publishers and of its subscriptions in two separate streams, each
        in order of creation, and creates one of each for this topic first.
        """
        seen, heard = self._processes()
        if seen != heard or len(seen) < count_participants(domain_id()):
            return False
        named = set()
        for name, _ in self.topics():
            for one in self.publishers(name) + self.subscriptions(name):
                if one.node_name == UNKNOWN:
                    return False
                named.add(_process(one))
        return seen <= named

    def _processes(self) -> tuple[set[bytes], set[bytes]]:
        """Return the processes whose publisher of discovery is seen, and whose subscription."""
        topic = ("ros_discovery_info", True)
        return (
            {_process(one) for one in self.node.get_publishers_info_by_topic(*topic)},
            {_process(one) for one in self.node.get_subscriptions_info_by_topic(*topic)},
        )

    def _has_no_gaps(self, since: float) -> bool:
        """Return whether no endpoint is missing, or was missing for too long to come."""
        return time.monotonic() - since >= GAPS_FOR or not has_gaps(
            bytes(one.endpoint_gid)
            for name, _ in self.node.get_topic_names_and_types(no_demangle=True)
            for ask in (
                self.node.get_publishers_info_by_topic,
                self.node.get_subscriptions_info_by_topic,
            )
            for one in ask(name, True)
        )

    def topics(self) -> list[tuple[str, list[str]]]:
        """Return every topic with its types, sorted."""
        return sorted(self.node.get_topic_names_and_types())

    def services(self) -> list[tuple[str, list[str]]]:
        """Return every service with its types, sorted."""
        return sorted(self.node.get_service_names_and_types())

    def nodes(self, hidden: bool = False) -> list[str]:
        """Return the full name of every node but this one, sorted."""
        own = full_name(self.node.get_name(), self.node.get_namespace())
        known = self.node.get_node_names_and_namespaces()
        # A node is hidden by its own name, and not by that of its namespace.
        names = [full_name(*one) for one in known if hidden or not is_hidden(one[0])]
        return sorted(name for name in names if name != own)

    def publishers(self, topic: str) -> list[Any]:
        """Return every publisher on a topic."""
        return list(self.node.get_publishers_info_by_topic(topic))

    def subscriptions(self, topic: str) -> list[Any]:
        """Return every subscription to a topic."""
        return list(self.node.get_subscriptions_info_by_topic(topic))

    def others(self, endpoints: list[Any]) -> list[Any]:
        """Return those endpoints that are not this node's."""
        return [one for one in endpoints if one.node_name != self.node.get_name()]


def _is_outside(clock: Callable[[], float], begin: float, end: float) -> bool:
    return not begin <= clock() < end


def _process(endpoint: Untyped) -> bytes:
    """Return the part of an endpoint's address that all endpoints of a process have in common."""
    return bytes(endpoint.endpoint_gid[PROCESS])


@contextmanager
def open_graph(args: Namespace | None = None, name: str | None = None) -> Iterator[Graph]:
    """Appear in the graph as a hidden node, and leave it at the end.

    Args:
        args: The verb's arguments; `--spin-time` and `--use-sim-time` are read from them.
        name: The node's name, `_ros2cli_<pid>` by default.

    Raises:
        CommandError: If ROS cannot be started.
    """
    _check_domain()
    for number in (signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, _leave)
    # A shell without job control starts what stands before `&` with Ctrl+C ignored.
    signal.signal(signal.SIGINT, _interrupt)
    _choose_profile()
    # The middleware wants to know where its log files are, also where nobody has said it.
    os.environ.setdefault("HOME", os.path.expanduser("~"))
    graph = _start(args, name or f"_ros2cli_{os.getpid()}")
    try:
        yield graph
    finally:
        with suppress(KeyboardInterrupt):
            graph.close()


def _leave(number: int, frame: object) -> NoReturn:
    """Take the node out of the graph first; else others would see it for as long as it is due."""
    ENDED_BY.append(number)
    raise SystemExit(128 + number)


def _interrupt(number: int, frame: object) -> NoReturn:
    ENDED_BY.append(number)
    raise KeyboardInterrupt


def _start(args: Namespace | None, name: str) -> Graph:
    import rclpy
    from rclpy.parameter import Parameter
    from rclpy.signals import SignalHandlerOptions

    sim_time = Parameter("use_sim_time", value=bool(getattr(args, "use_sim_time", False)))
    context = rclpy.Context()
    try:
        # Python's own handling of Ctrl+C is what this command wants, and its words are not ROS's.
        rclpy.init(args=[], context=context, signal_handler_options=SignalHandlerOptions.NO)
        node = rclpy.create_node(
            name, context=context, start_parameter_services=False,
            parameter_overrides=[sim_time],
        )  # fmt: skip
    except RuntimeError as error:  # rclpy's RCLError is one
        raise CommandError(f"ROS could not be started: {error}") from None
    return Graph(node, context, args)


def _check_domain() -> None:
    text = os.environ.get("ROS_DOMAIN_ID", "")
    if text and not (text.isascii() and text.isdecimal() and int(text) <= 232):
        raise CommandError(
            f"ROS_DOMAIN_ID is {text!r}, which is not a domain id.",
            "ROS_DOMAIN_ID determines which processes discover each other; it is a number from 0 "
            "to 101 (up to 232 on some systems).",
            "Set a valid id (export ROS_DOMAIN_ID=0), or remove the variable (unset "
            "ROS_DOMAIN_ID).",
        )


def _choose_profile() -> None:
    """Use the quick discovery profile, unless the user has one."""
    if "FASTDDS_DEFAULT_PROFILES_FILE" not in os.environ:
        quick = str(files("ros2_command") / "data" / "fastdds.xml")
        os.environ.setdefault(PROFILE_VARIABLE, quick)


# What must exist, but has not been discovered yet.
#
# Fast DDS numbers the endpoints of a process 1, 2, 3 and so on, publishers and subscriptions in one
# sequence, and announces the two kinds in two separate streams. When one stream lags behind, as it
# does when the machine is busy, numbers are missing in between. Destroyed endpoints leave such gaps
# forever, so a gap is a reason to wait for a short time only.

#: Bytes of an endpoint's address (GID): that of its process, then its number, then its kind.
PROCESS = slice(0, 12)
_NUMBER = slice(12, 15)
_TABLES = ("/proc/net/udp", "/proc/net/udp6")


def has_gaps(addresses: Iterable[bytes]) -> bool:
    """Return whether some process lacks an endpoint with a number below a known one.

    Args:
        addresses: The GIDs of all known endpoints.
    """
    numbers: defaultdict[bytes, set[int]] = defaultdict(set)
    for address in addresses:
        numbers[address[PROCESS]].add(int.from_bytes(address[_NUMBER], "big"))
    return any(len(known) < max(known) for known in numbers.values())


def domain_id() -> int:
    """Return the domain of this process."""
    return int(os.environ.get("ROS_DOMAIN_ID") or 0)


def only_this_machine() -> bool:
    """Return whether processes of other machines are out of reach anyway."""
    return os.environ.get("ROS_AUTOMATIC_DISCOVERY_RANGE", "").upper() in ("LOCALHOST", "OFF")


def count_participants(domain: int, tables: str | None = None) -> int:
    """Count the ROS processes on this machine, before any of them has answered.

    Each participant of DDS listens on two UDP ports that follow from the domain and from its number
    on the machine: 7400 + 250 * domain + 10 + 2 * number, and the next one (RTPS specification,
    section 9.6.1). One of them alone, or each with another user, is a socket of another program.

    Args:
        domain: The domain's id.
        tables: The text of the system's tables of UDP sockets, read from the system by default.

    Returns:
        The number, or 0 where that cannot be known.
    """
    text = _read_tables() if tables is None else tables
    fields = [line.split() for line in text.splitlines()]
    ports = {  # each with the number of the user
        (int(row[1].rpartition(":")[2], 16), row[7])
        for row in fields
        if len(row) > 7 and row[0][0].isdigit()
    }
    first = 7400 + 250 * domain + 10
    numbers = range(first, first + 240, 2)
    return sum(port in numbers and (port + 1, user) in ports for port, user in ports)


def _read_tables() -> str:
    text = ""
    for name in _TABLES:
        with suppress(OSError):
            text += Path(name).read_text(encoding="ascii")
    return text
