"""What the panel asks of a session: eyes and hands, as plain data."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from rosbeat.records import Fault, GraphSnapshot, LogRecord, Sample

#: Types of message that a slider can publish, and whose numbers a fault can change.
NUMERIC_TYPES = frozenset({"std_msgs/msg/Float32", "std_msgs/msg/Float64"})
#: What a fault does to the messages of a topic.
FAULTS = ("none", "dropout", "nan", "offset")


@dataclass(frozen=True)
class Arrival:
    """What came from one node on one topic since the last look.

    Attributes:
        count: How many messages.
        newest: The last of them.
    """

    count: int
    newest: Sample


@dataclass(frozen=True)
class News:
    """What happened in a session since the last look.

    Attributes:
        arrivals: One for each topic and publishing node that was heard.
        logs: The log lines.
        faults: The exceptions that ended nodes.
    """

    arrivals: tuple[Arrival, ...] = ()
    logs: tuple[LogRecord, ...] = ()
    faults: tuple[Fault, ...] = ()


class Instruments(Protocol):
    """A session as the panel sees it. Every method may be called from any thread.

    Names of nodes and topics are full names. A method of the second half changes something; it
    raises `RosbeatError` if it cannot.
    """

    def now_ns(self) -> int:
        """Nanoseconds since the session began."""
        ...

    def is_live(self) -> bool:
        """Whether the nodes run against the wall clock."""
        ...

    def news(self) -> News:
        """What happened since this was last asked."""
        ...

    def graph(self) -> GraphSnapshot:
        """The nodes and topics."""
        ...

    def conditions(self) -> dict[str, str]:
        """For every node: `running`, `paused`, `stopped`, `ended` or `not added`."""
        ...

    def pause(self, node: str) -> None:
        """Run none of a node's callbacks."""
        ...

    def resume(self, node: str) -> None:
        """Run a paused node's callbacks again."""
        ...

    def stop(self, node: str) -> None:
        """Destroy a node, and remember how it was made."""
        ...

    def start(self, node: str) -> None:
        """Make a stopped or ended node again."""
        ...

    def publish(self, topic: str, value: float) -> None:
        """Publish one number."""
        ...

    def repeat(self, topic: str, value: float | None) -> None:
        """Publish a number every second from now on; None ends that."""
        ...

    def disturb(self, topic: str, kind: str, amount: float) -> None:
        """Let what nodes publish on a topic be wrong, in one of the ways of `FAULTS`."""
        ...

    def load(self, milliseconds: float) -> None:
        """Let a callback run for so long, once a second; 0 ends that."""
        ...

    def release(self) -> None:
        """Take away everything that the panel has added."""
        ...
