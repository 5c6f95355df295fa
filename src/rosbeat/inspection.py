"""Gather the facts about a topic that `rosbeat.diagnosis` needs to explain it."""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

from rosbeat.diagnosis.topic_snapshot import (
    BLOCKED,
    ENDED,
    NOT_ADDED,
    PAUSED,
    RUNNING,
    SILENT,
    SPIN,
    Beat,
    Condition,
    OtherDomain,
    Scene,
    Unreturned,
    rate_of,
)
from rosbeat.domains import PRIVATE_IDS, SESSION_DOMAINS
from rosbeat.records import NANOSECONDS, Endpoint, GraphSnapshot, is_hidden
from rosbeat.ros.differences import tasks_for
from rosbeat.ros.graph import (
    GraphObserver,
    domains_in_use,
    is_of_course,
    outside_endpoints,
    poll,
)
from rosbeat.ros.listening import Heard, listen, look_into
from rosbeat.ros.processes import Entry, NodeState, is_free
from rosbeat.ros.qos_events import limit_ns
from rosbeat.ros.session_core import SessionCore
from rosbeat.ros.waits import Call

#: A live callback that runs for so many seconds of wall time blocks the others.
_BLOCKING_SECONDS = 1.0
#: A rate is that of so many messages, the newest.
_NEWEST = 100
#: Whether messages arrive lately is told by so many messages, the newest.
_LATELY = 20


def inspect_topic(core: SessionCore, topic: str, seconds: float) -> Scene:
    """Return all that is known around a topic.

    In a domain with other processes, a hidden node listens to them, for so many seconds of wall
    time at most, and asks their nodes whether they run.
    """
    blocked = _blocked(core)
    observer = core.graph_observer
    if observer is not None:
        observer.wait_until_stable()
    graph = core.graph()
    heard, calls = Heard(), _calls(core, topic)
    if observer is not None:
        graph = _with_commands(graph, observer, topic)
        heard = listen(core, observer, topic, graph, seconds)
    outside = _outside_beats(heard)
    with core.recorder.lock:
        messages = core.recorder.times(topic)
    states = core.nodes.states()
    other_domains, private_sessions = _elsewhere(core, topic, graph)
    return Scene(
        graph,
        core.now(),
        (
            *_publishers(core, topic, messages),
            *_subscriptions(core, topic, messages, calls, len(heard.stamps_ns)),
            *outside,
        ),
        (*blocked, *(_condition(core, state) for state in states), *_outside_conditions(heard)),
        0.0 if outside else rate_of(heard.stamps_ns),
        frozenset(state.name for state in states),
        virtual=core.live is None,
        waiting=core.virtual.has_work,
        domain_id=-1 if observer is None else core.domain_id or 0,
        other_domains=other_domains,
        private_sessions=private_sessions,
    )


# What is asked of the engine beside the public fields of nodes and entities: which code has begun
# and has not returned. rclpy's own callback groups know it of each callback in an exclusive group;
# processes know it of those that wait.


def _waiting_calls(state: NodeState) -> list[Call]:
    """Return the code of a node's process that waits, except in a `spin`, the oldest first."""
    calls = [call for call in state.process.calls if call.wait is not None and not call.idle]
    return sorted(calls, key=lambda call: call.began_ns)


def _waiting_coroutines(core: SessionCore, entry: Entry) -> list[Any]:
    """Return the tasks of an `async def` callback that have begun and not ended."""
    process = entry.state.process
    executors = {process.executor, process.global_executor, entry.state.node.executor} - {None}
    if core.live is not None:
        executors.add(core.live)
    return [task for executor in executors for task in tasks_for(executor, entry.entity)]


def _group_holder(core: SessionCore, entry: Entry) -> Entry | None:
    """Return whose callback occupies the callback group of an entity, if one does."""
    if is_free(entry):
        return None
    active = getattr(entry.entity.callback_group, "_active_entity", None)
    entries = (one for state in core.nodes.states() for one in state.entries)
    return next((one for one in entries if one.entity is active), None)


def _awaited_future(task: Any) -> Any:  # noqa: ANN401 - rclpy is untyped
    """Return the future that a task of rclpy awaits, if it is one."""
    inner, deeper = None, task._handler
    while deeper is not None:
        inner = deeper
        deeper = getattr(inner, "cr_await", None) or getattr(inner, "gi_yieldfrom", None)
    frame = getattr(inner, "gi_frame", None) or getattr(inner, "cr_frame", None)
    return frame.f_locals.get("self") if frame is not None else None


def _unreturned(call: Call) -> Unreturned:
    wait = call.wait
    assert wait is not None
    return Unreturned(
        call.node,
        call.name,
        call.began_ns,
        wait.reason,
        wait.until_ns,
        again=wait.began_ns > call.began_ns,
        is_main=call.entry is None and call.process.program is not None,
        in_vain="which was reported as a deadlock" if wait.reported else "",
    )


def _unreturned_entry(core: SessionCore, entry: Entry) -> Unreturned:
    """Describe a callback that occupies its group, or has not returned."""
    state = entry.state
    for call in _waiting_calls(state):
        if call.entry is entry:
            return _unreturned(call)
    since = core.recorder.last_run(entry.label_number)
    made = Unreturned(state.name, entry.label.name, since)
    for task in _waiting_coroutines(core, entry):
        future = _awaited_future(task)
        client = _asked_client(state, future)
        if client is None:
            done = getattr(future, "done", None)
            is_pending = callable(done) and not done()
            return replace(made, waits_for="a future that is not done" if is_pending else "")
        group = entry.entity.callback_group
        is_own = client.entity.callback_group is group and not is_free(client)
        return replace(
            made,
            waits_for=f"a response from {client.name}",
            in_vain="whose client is in the callback group that it occupies" if is_own else "",
        )
    return made


def _asked_client(state: NodeState, future: object) -> Entry | None:
    """Return the client of a node's process that a future is the answer of."""
    entries = (one for neighbor in state.process.states for one in neighbor.entries)
    clients = [one for one in entries if one.kind == "client"]
    # A client has no public name for its pending requests.
    return next((one for one in clients if future in one.entity._pending_requests.values()), None)


def _holder(core: SessionCore, entry: Entry) -> Unreturned | None:
    """Return what keeps an entity's callback from running now: a thread or a group is occupied."""
    holding = _group_holder(core, entry)
    if holding is not None:
        return _unreturned_entry(core, holding)
    calls = _waiting_calls(entry.state)
    if calls and not entry.state.process.has_thread():
        return _unreturned(calls[0])
    return None if entry.state.spinning else _other_spin(entry.state)


def _other_spin(state: NodeState) -> Unreturned | None:
    """Return the `main` of a program that spins other nodes than this one."""
    for call in state.process.calls if state.process.program is not None else ():
        if call.idle and call.entry is None and call.wait is not None:
            began, until = call.began_ns, call.wait.until_ns
            return Unreturned(state.name, call.name, began, SPIN, until, is_main=True)
    return None


def _node_holder(core: SessionCore, state: NodeState) -> Unreturned | None:
    """Return what keeps every callback of a node from running now."""
    entries = [one for one in state.entries if one.kind in ("timer", "subscription", "service")]
    held = [_holder(core, one) for one in entries]
    if held:
        return held[0] if all(held) else None
    calls = _waiting_calls(state)
    return _unreturned(calls[0]) if calls and not state.process.has_thread() else None


def _running(core: SessionCore, entry: Entry) -> int:
    """Return how many runs of an entity's callback have begun and not returned."""
    calls = sum(call.entry is entry for call in _waiting_calls(entry.state))
    tasks = len(_waiting_coroutines(core, entry))
    # In live mode, a callback may just be running.
    is_at_rest = core.live is None or core.live.task is None
    return max(calls + tasks, int(is_at_rest and _group_holder(core, entry) is entry))


# The nodes of the session.


def _blocked(core: SessionCore) -> list[Condition]:
    """Return the node that holds up the one thread in which all live callbacks run, if any."""
    live = core.live
    if live is None or live.task is None:
        return []
    work, state = live.task, core.nodes.state_of(live.current)
    callback = core.recorder.newest_callback()
    if poll(lambda: live.task is not work, time.monotonic() + _BLOCKING_SECONDS):
        return []
    if state is None or callback is None:
        return []
    return [Condition(state.name, BLOCKED, callback=callback.name)]


def _condition(core: SessionCore, state: NodeState) -> Condition:
    if state.ended:
        return _ended(core, state)
    # A program may spin its node again and again, and do something else in between.
    if state.spinning or (state.process.program is not None and not state.paused):
        return Condition(state.name, RUNNING)
    return Condition(state.name, PAUSED if state.paused else NOT_ADDED)


def _ended(core: SessionCore, state: NodeState) -> Condition:
    ending = state.ending
    if ending is None:
        return Condition(state.name, ENDED)
    faults = [one for one in core.recorder.faults if one.node == ending.node]
    return Condition(
        state.name,
        ENDED,
        faults[-1] if faults else None,
        ending.callback,
        ending.kind,
        "" if ending.node == state.name else ending.node,
    )


#: Messages of a topic: number among all of the session, who published, when in nanoseconds.
_Messages = list[tuple[int, str, int]]


def _publishers(core: SessionCore, topic: str, messages: _Messages) -> Iterator[Beat]:
    for state in core.nodes.states():
        counts = [tap.count for tap in state.taps if tap.topic == topic]
        if counts:
            number = sum(counts)
            # Of a node of this name that was replaced there may be more.
            times = [at for _, node, at in messages if node == state.name]
            times = times[-min(number, _NEWEST) :] if number else []
            last, watched = times[-1] if times else -1, core.now() - state.born_ns
            held = None if state.ended else _node_holder(core, state)
            yield Beat(state.name, "publisher", number, last, rate_of(times), watched, held=held)


def _calls(core: SessionCore, topic: str) -> Counter[NodeState]:
    """Return how often the callbacks on a topic have run so far, of each node."""
    calls = Counter[NodeState]()
    for state in core.nodes.states():
        mine = (one for one in state.entries if (one.kind, one.name) == ("subscription", topic))
        calls[state] = sum(one.calls for one in mine)
    return calls


def _subscriptions(
    core: SessionCore, topic: str, messages: _Messages, before: Counter[NodeState], arrived: int
) -> Iterator[Beat]:
    """Return what subscriptions have done.

    Args:
        core: The state of the session.
        topic: Full name of the topic.
        messages: Its messages.
        before: How often callbacks had run before it was listened to other processes.
        arrived: How many messages came from there meanwhile.
    """
    for state in core.nodes.states():
        entries = [one for one in state.entries if (one.kind, one.name) == ("subscription", topic)]
        if entries:
            deliveries = [_delivery(core, entry, messages) for entry in entries]
            worst = max(deliveries, key=lambda one: (one.behind, one.newest - one.arrived))
            missed = sum(number < entries[0].born for number, _, _ in messages)
            calls = sum(one.calls for one in entries)
            is_deaf = core.live is not None and calls == before[state]
            yield Beat(
                state.name,
                "subscription",
                calls,
                max(core.recorder.last_run(one.label_number) for one in entries),
                watched_ns=core.now() - state.born_ns,
                missed=missed,
                since=max(one.since for one in deliveries),
                running=sum(_running(core, one) for one in entries),
                behind=worst.behind,
                behind_ns=worst.behind_ns,
                newest=worst.newest,
                arrived=worst.arrived,
                at_once=worst.at_once,
                unheard=arrived if is_deaf else 0,
                waited_ns=_waited(core, state, worst.begin_ns),
                held=worst.held,
            )


@dataclass(frozen=True)
class _Delivery:
    """Hold what became of a subscription's messages; see `Beat` for most of the fields."""

    since: int = 0
    behind: int = 0
    behind_ns: int = 0
    newest: int = 0
    arrived: int = 0
    at_once: int = 0
    begin_ns: int = 0
    held: Unreturned | None = None


def _delivery(core: SessionCore, entry: Entry, messages: _Messages) -> _Delivery:
    now, label = core.now(), entry.label_number
    taps = [(state.name, tap) for state in core.nodes.states() for tap in state.taps
            if tap.topic == entry.name and tap.fits(entry.entity)]  # fmt: skip
    connected = {name for name, _ in taps}
    sent = [at for number, name, at in messages if number >= entry.born and name in connected]
    held = None if entry.state.ended else _holder(core, entry)
    if held is None and entry.calls and entry.calls == _running(core, entry):
        held = _unreturned_entry(core, entry)
    # What is sent at this very moment, between two steps of the session, may be on its way.
    past = [at for at in sent if at < now]
    last = core.recorder.last_run(label)
    late = [at for at in past if at > last]
    newest = [at for at in past if at >= past[-_LATELY:][0]]  # with all of that moment
    if limit_ns(entry.entity.qos_profile.lifespan) or any(tap.lifespan_ns for _, tap in taps):
        newest = []  # they may have expired
    begin = newest[0] if newest else 0
    return _Delivery(
        len(sent),
        len(late),
        now - late[0] if late else 0,
        len(newest),
        core.recorder.runs(label, begin, now) if newest else 0,
        max(Counter(newest).values(), default=0),
        begin,
        held,
    )


def _waited(core: SessionCore, state: NodeState, since_ns: int) -> int:
    """Return for how long code of a node's process has waited since a time, in nanoseconds."""
    names = {one.name for one in state.process.states}
    waits = [one for one in core.virtual.all_waits() if one.node in names]
    return sum(max(0, one.until_ns - max(one.time_ns, since_ns)) for one in waits)


# The nodes of other processes.


def _with_commands(graph: GraphSnapshot, observer: GraphObserver, topic: str) -> GraphSnapshot:
    """Add the hidden nodes on a topic, such as that of `ros2 topic pub`; other graphs omit them."""
    ends = [
        end
        for end in outside_endpoints(observer, topic)
        if is_hidden(end.node) and not is_of_course(end.node)
    ]
    names = dict.fromkeys(end.node for end in ends)
    return replace(graph, nodes=(*graph.nodes, *names), endpoints=(*graph.endpoints, *ends))


def _outside_beats(heard: Heard) -> tuple[Beat, ...]:
    """Return what each publisher outside has done; of several it cannot be told whose is whose."""
    if heard.span is None or (heard.stamps_ns and len(heard.publishers) > 1):
        return ()
    beat = partial(
        Beat,
        kind="publisher",
        count=len(heard.stamps_ns),
        rate_hz=rate_of(heard.stamps_ns),
        watched_ns=round(heard.span * NANOSECONDS),
    )
    return tuple(beat(name) for name in heard.publishers)


def _outside_conditions(heard: Heard) -> Iterator[Condition]:
    for name in heard.asked:
        yield Condition(name, SILENT if name in heard.silent else RUNNING)


# Who uses the topic in another ROS domain of this machine.


#: To look into one takes a part of a second.
_MOST_DOMAINS = 10


def _elsewhere(
    core: SessionCore, topic: str, graph: GraphSnapshot
) -> tuple[tuple[OtherDomain, ...], bool]:
    """Look into other domains, if a side is missing here and other processes matter at all.

    Domains of checks and builds are left alone: no node shall appear there. Private sessions cannot
    be looked into.

    Returns:
        The other domains, and whether other processes have private sessions.
    """
    publishers: Sequence[Endpoint] = graph.on(topic, "publisher")
    heard = graph.on(topic, "subscription") or any(end.matched > 0 for end in publishers)
    is_alone = core.graph_observer is None and core.live is None
    if is_alone or (publishers and heard):
        return (), False
    used = domains_in_use()
    apart = {core.domain_id, *PRIVATE_IDS, *SESSION_DOMAINS}
    shared = [number for number in used if number not in apart]
    found = tuple(
        OtherDomain(number, *look_into(number, topic)) for number in shared[:_MOST_DOMAINS]
    )
    return found, any(number in SESSION_DOMAINS for number in used)
