"""Hold what is known about a topic on which nothing arrives: plain data.

A session or a terminal fills a `Scene` with what it can see; `silence.explain` reads nothing
else. What a field cannot know keeps its default, and nothing is concluded from it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from rosbeat.records import NANOSECONDS, Endpoint, Fault, GraphSnapshot

#: How a node does, as `Condition.state` says it.
RUNNING, PAUSED, NOT_ADDED, ENDED = "running", "paused", "not added", "ended"
BLOCKED, SILENT = "blocked", "no answer"
#: Why a node has ended, as `Condition.cause` says it.
RAISED, SHUT_DOWN, INTERRUPTED = "raised", "shut down", "interrupted"


#: What a `main` that spins waits for, as `Unreturned.waits_for` says it.
SPIN = "spin"


@dataclass(frozen=True)
class Unreturned:
    """Describe code of a node that has begun and has not returned.

    Attributes:
        node: Full name of its node.
        callback: The callback, or the function `main` of a program.
        since_ns: When it began, in nanoseconds since the session began; -1 if unknown.
        waits_for: What it waits for: `sleep`, or `a response from /add`; `SPIN` for a `main` that
            spins other nodes only; empty if unknown.
        until_ns: When that wait ends by itself; None if no time ends it, or none is known.
        again: Whether it has waited before.
        is_main: Whether it is the `main` of a program, which does not spin the node.
        in_vain: Why that wait cannot end, as the end of a sentence; empty if it may.
    """

    node: str
    callback: str
    since_ns: int = -1
    waits_for: str = ""
    until_ns: int | None = None
    again: bool = False
    is_main: bool = False
    in_vain: str = ""


@dataclass(frozen=True)
class Beat:
    """Hold what one endpoint on the topic has done.

    Attributes:
        node: Full name of its node.
        kind: `publisher` or `subscription`.
        count: Messages published, or callbacks run; -1 if unknown.
        last_ns: When the last one was, in nanoseconds since the session began; -1 if never.
        rate_hz: Messages a second; 0 if unknown.
        watched_ns: For how long it was watched, in nanoseconds.
        missed: Of a subscription: messages that were published before it was there.
        since: Of a subscription: messages that were published since by publishers that it is
            connected to.
        running: Of a subscription: how many runs of its callback have not returned.
        behind: Of a subscription: messages that came after its callback had last begun.
        behind_ns: For how long the first of these has waited, in nanoseconds.
        newest: Of a subscription: how many of its newest messages were looked at.
        arrived: How often its callback has begun since the first of these.
        at_once: How many of these came at one moment, at most.
        unheard: Of a subscription in live mode: messages that arrived from other processes while
            its callback did not run.
        waited_ns: For how long callbacks of its process have waited meanwhile, in nanoseconds.
        held: What keeps its callback from running now; of a publisher, what keeps every callback
            of its node that could publish from running.
    """

    node: str
    kind: str
    count: int = -1
    last_ns: int = -1
    rate_hz: float = 0.0
    watched_ns: int = 0
    missed: int = 0
    since: int = 0
    running: int = 0
    behind: int = 0
    behind_ns: int = 0
    newest: int = 0
    arrived: int = 0
    at_once: int = 0
    unheard: int = 0
    waited_ns: int = 0
    held: Unreturned | None = None

    @property
    def seconds(self) -> float:
        """Return for how long it was watched, in seconds."""
        return self.watched_ns / NANOSECONDS


@dataclass(frozen=True)
class Condition:
    """Hold how a node does.

    Attributes:
        node: Full name of the node.
        state: `RUNNING`; `PAUSED`; `NOT_ADDED`, so that nobody runs its callbacks; `ENDED`;
            `BLOCKED` by a callback that does not return; `SILENT`, if it is in another process and
            does not answer.
        fault: The exception that ended it, if one did.
        callback: The callback that does not return, or that ended it.
        cause: Why it has ended: `RAISED`, `SHUT_DOWN` or `INTERRUPTED`; empty if unknown.
        culprit: The node of the same process whose callback ended it, if it was not its own.
    """

    node: str
    state: str = RUNNING
    fault: Fault | None = None
    callback: str = ""
    cause: str = ""
    culprit: str = ""


@dataclass(frozen=True)
class OtherDomain:
    """Describe another ROS domain of this machine that has participants.

    Attributes:
        domain_id: Its id.
        publishers: Full names of the nodes that publish on the topic there.
        subscriptions: Full names of the nodes that subscribe to the topic there.
    """

    domain_id: int
    publishers: tuple[str, ...] = ()
    subscriptions: tuple[str, ...] = ()


@dataclass(frozen=True)
class StaleBuild:
    """Describe a program of the workspace that uses the topic and was edited since the last build.

    Attributes:
        package: Name of the package.
        executable: Name of the executable, as for `ros2 run`.
        module: The edited file, relative to the package.
        built: Whether the package was ever built.
    """

    package: str
    executable: str
    module: str
    built: bool = True


@dataclass(frozen=True)
class Scene:
    """Hold what was seen around a topic.

    Attributes:
        graph: The graph.
        now_ns: When it was seen, in nanoseconds since the session began.
        beats: What the endpoints on the topic do, each one's as far as it is known.
        conditions: How the nodes on the topic do, as far as it is known.
        arriving_hz: Messages a second that came from other processes; 0 if none, or unknown.
        own: The nodes of the page's own session; all others are in other processes.
        virtual: Whether time is virtual, and so stands still between two runs.
        waiting: Whether callbacks wait for the next run.
        domain_id: The ROS domain, or -1 for a private session.
        other_domains: Other domains in which somebody takes part.
        private_sessions: Whether other processes of this machine have private sessions open.
        stale_builds: What was edited and not built again.
    """

    graph: GraphSnapshot = field(default_factory=GraphSnapshot)
    now_ns: int = 0
    beats: tuple[Beat, ...] = ()
    conditions: tuple[Condition, ...] = ()
    arriving_hz: float = 0.0
    own: frozenset[str] = frozenset()
    virtual: bool = False
    waiting: bool = False
    domain_id: int = -1
    other_domains: tuple[OtherDomain, ...] = ()
    private_sessions: bool = False
    stale_builds: tuple[StaleBuild, ...] = ()

    def beat(self, end: Endpoint) -> Beat:
        """Return what an endpoint has done; a record that knows nothing if there is none."""
        for beat in self.beats:
            if (beat.node, beat.kind) == (end.node, end.kind):
                return beat
        return Beat(end.node, end.kind)

    def condition(self, node: str) -> Condition:
        """Return how a node does; running if nothing else is known."""
        return next((one for one in self.conditions if one.node == node), Condition(node))


def rate_of(times_ns: Sequence[int]) -> float:
    """Return messages a second, from their ascending times in nanoseconds; 0 if unknown."""
    if len(times_ns) < 2 or times_ns[-1] <= times_ns[0]:
        return 0.0
    return (len(times_ns) - 1) * NANOSECONDS / (times_ns[-1] - times_ns[0])
