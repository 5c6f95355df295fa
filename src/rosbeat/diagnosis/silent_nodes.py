"""Say why a node that is on a topic does not do its part: it has ended, is held up, or is late."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from rosbeat.diagnosis.exceptions import first_sentence, line_of
from rosbeat.diagnosis.findings import (
    NODE,
    TWINS,
    Finding,
    Mark,
    Sides,
    at_time,
    clash,
    count,
    link,
    nodes_of,
    seconds,
    verb,
)
from rosbeat.diagnosis.mistakes import UNKNOWN
from rosbeat.diagnosis.topic_snapshot import (
    BLOCKED,
    ENDED,
    INTERRUPTED,
    NOT_ADDED,
    PAUSED,
    RAISED,
    RUNNING,
    SHUT_DOWN,
    SILENT,
    SPIN,
    Beat,
    Condition,
    Scene,
    Unreturned,
)
from rosbeat.records import NANOSECONDS, Endpoint

#: Who has been quiet for so many of its own intervals has stopped.
_INTERVALS = 5
#: So many messages may be on their way while a session is live.
_ON_THE_WAY = 2
#: A callback is late if so many messages wait for it, or one for so many nanoseconds.
_LATE_MESSAGES, _LATE_NS = 3, NANOSECONDS


def nodes(sides: Sides, scene: Scene) -> Iterator[Finding]:
    """Find every node that does not do its part."""
    ends = (*sides.publishers, *sides.subscriptions)
    for condition in _conditions(ends, scene):
        if condition.state in _CONDITIONS:
            yield _of(condition, scene)
    yield from _twins(ends, scene)
    held_up = any(one.state == BLOCKED and one.node in scene.own for one in scene.conditions)
    if held_up and not scene.virtual:
        return  # nobody else can do anything either
    if _stands_still(sides, scene):
        yield _no_time(sides, scene)
        return
    found = [_publisher(end, scene) for end in sides.publishers]
    found += [_subscription(end, sides, scene) for end in sides.subscriptions]
    # Of a node that is on both sides, the same callback may hold up both.
    yield from dict.fromkeys(one for one in found if one is not None)


def _conditions(ends: tuple[Endpoint, ...], scene: Scene) -> list[Condition]:
    """Return those of the nodes on the topic, and of whoever holds up all others."""
    here = {end.node for end in ends}
    # A program may well publish in a loop of its own and never spin.
    speaks = {end.node for end in ends if end.kind == "publisher" and scene.beat(end).count > 0}
    return [
        one
        for one in scene.conditions
        if (one.state == BLOCKED and not scene.virtual)
        or (one.node in here and not (one.state == SILENT and one.node in speaks))
    ]


@dataclass(frozen=True)
class _Cause:
    """Say what is wrong with a node that does not run; `{node}` is its full name."""

    mistake: str
    headline: str
    evidence: str
    hint: str
    words: tuple[str, ...]


_NOT_RUN = "{node} is not spun"
_RETURNS = (
    "A callback does its work once and returns: no endless loop, no `time.sleep`, no waiting for a "
    "response. Use a timer for anything that happens repeatedly."
)
_WORDS = ("callback has", "not returned")
_CONDITIONS = {
    ENDED: _Cause("node-ended", "{node} has ended",
        "The process of {node} has ended; how is not known.",
        "Add the node again with `ros.add(...)`.",
        ("has ended",)),
    BLOCKED: _Cause("callback-blocks", "a callback of {node} has not returned",
        "{callback} has started but not returned. Until it returns, no other callback of {node} "
        "runs{others}.",
        _RETURNS,
        _WORDS),
    PAUSED: _Cause("not-spun", _NOT_RUN,
        "{node} is paused: messages wait in its queues, and its timers do not fire.",
        'Resume the node with `ros.resume("{name}")`.',
        ("paused",)),
    NOT_ADDED: _Cause("not-spun", _NOT_RUN,
        "{node} was created, but never added to the session: it is in the graph, but nothing runs "
        "its callbacks now.",
        "Add the node with `ros.add(...)`. In a program, call `rclpy.spin(node)`.",
        ("not spun",)),
    SILENT: _Cause("not-spun", "{node} does not answer",
        "{node} is in the graph, but did not respond to a service that every spinning node "
        "offers. Its callbacks do not run: either the node is not spun, or one of its callbacks "
        "does not return.",
        "Look for `rclpy.spin(node)` in the node's `main`, then for an endless loop or "
        "`time.sleep` in a callback.",
        ("does not", "answer")),
}  # fmt: skip


def _of(condition: Condition, scene: Scene) -> Finding:
    cause, node = _CONDITIONS[condition.state], condition.node
    alone = node in scene.own and not scene.virtual
    others = ", and neither does any other node of the session" if alone else ""
    evidence = cause.evidence.format(node=node, callback=condition.callback, others=others)
    hint = cause.hint.format(name=node.lstrip("/"))
    if condition.state == ENDED:
        evidence, hint = _ending(condition) or (evidence, hint)
    mark = Mark(NODE, node, words=cause.words)
    return Finding(cause.mistake, cause.headline.format(node=node), evidence, hint, (mark,))


def _ending(condition: Condition) -> tuple[str, str] | None:
    """Return why a node has ended, and what to try, if it is known."""
    node, fault = condition.node, condition.fault
    culprit = condition.culprit or node
    callback = fault.callback if fault and condition.cause in (RAISED, "") else condition.callback
    callback += f" of {culprit}" if condition.culprit else ""
    shared = f" {node} ran in the same process, which ended with it." if condition.culprit else ""
    again = "the cell that adds the nodes" if condition.culprit else "the cell that adds the node"
    if fault and condition.cause in (RAISED, ""):
        ends = "An uncaught exception in a callback ends its "
        ends += "process." if condition.culprit else "node."
        return (
            f"At {fault.time:.6g} s {callback} raised {fault.kind}: {first_sentence(fault.text)}."
            f"{line_of(fault)} {ends}{shared}",
            f"Correct that line, then run {again} again.",
        )
    if condition.cause == SHUT_DOWN:
        if not condition.culprit:
            return (
                f"{node} called rclpy.shutdown() in {callback}, which ended the node.",
                "Take that call out of the callback, and add the node again.",
            )
        return (
            f"{callback} called rclpy.shutdown(), which ends its process.{shared}",
            f"Take that call out of the callback, then run {again} again.",
        )
    if condition.cause == INTERRUPTED:
        return (
            f"{callback} was interrupted before it had returned, which ended the node.{shared}",
            f"{_RETURNS} Then run {again} again.",
        )
    return None


# A callback that has begun and has not returned, and what waits for it.


def _blocked(held: Unreturned, node: str, effect: str) -> Finding:
    """Say what keeps a node's callbacks from running, and what has come of it."""
    began = f" began at {at_time(held.since_ns)} and" if held.since_ns >= 0 else ""
    if held.is_main:
        since = at_time(held.since_ns)
        does = f"waited since {since}{_waits_for(held)}. Meanwhile it spins no node"
        if held.waits_for == SPIN:
            does = f"spun since {since}, but not this node"
        return Finding(
            "not-spun",
            f"{node} is not spun",
            f"The main function of its program has {does}. {effect}",
            "Callbacks run only while `main` is in `rclpy.spin` or another function that spins. "
            "Spin the node, and do what is repeated in a timer.",
            (Mark(NODE, node, words=("not spun",)),),
        )
    return Finding(
        "callback-blocks",
        f"a callback of {held.node} has not returned",
        f"{held.callback} of {held.node}{began} has not returned{_waits_for(held)}. {effect}",
        _IN_VAIN if held.in_vain else _RETURNS,
        (Mark(NODE, node, words=_WORDS),),
    )


_IN_VAIN = (
    "Give the client, or what the callback waits for, a callback group of its own, and do not wait "
    "in a callback without need: `call_async` with a done callback does not hold it up."
)


def _waits_for(held: Unreturned) -> str:
    if not held.waits_for:
        return ""
    if held.waits_for == "sleep":
        until = f" until {at_time(held.until_ns)}" if held.until_ns is not None else ""
        return f"; it sleeps{until}{', and not for the first time' if held.again else ''}"
    until = f", until {at_time(held.until_ns)} at most" if held.until_ns is not None else ""
    vain = f", {held.in_vain}" if held.in_vain else ""
    return f"; it waits for {held.waits_for}{until}{vain}"


def _twins(ends: tuple[Endpoint, ...], scene: Scene) -> Iterator[Finding]:
    known = Counter(scene.graph.nodes)
    here = Counter((end.node, end.kind) for end in ends)
    for (node, kind), number in here.items():
        # Two endpoints of one name may also belong to one node.
        if number < 2 or known[node] < 2:
            continue
        speak = kind == "publisher"
        effect = (
            "each of them publishes, so more messages arrive than you expect"
            if speak
            else "each of them receives every message"
        )
        yield Finding(
            "run-twice",
            f"{known[node]} nodes are called {node}",
            f"The graph has {known[node]} nodes with that name; {effect}.",
            "End the node that you no longer need: it may still run in a terminal (press Ctrl+C "
            "there) or on another page. If you want both nodes, give one of them another name.",
            (Mark(TWINS, node, words=(f"{known[node]} of this name",)),),
        )


# What publishers and subscriptions did.


def _stands_still(sides: Sides, scene: Scene) -> bool:
    """Return whether nothing came because nobody has let time pass since."""
    if not scene.virtual or not sides.publishers:
        return False
    new = (
        end.node in scene.own
        and not scene.beat(end).count
        and not scene.beat(end).watched_ns
        and _runs(end, scene)
        for end in sides.publishers
    )
    return all(new) or (scene.waiting and any(_waits(end, scene) for end in sides.subscriptions))


def _waits(end: Endpoint, scene: Scene) -> bool:
    beat = scene.beat(end)
    return beat.count == 0 and beat.since > 0 and _runs(end, scene)


def _runs(end: Endpoint, scene: Scene) -> bool:
    return scene.condition(end.node).state == RUNNING


def _no_time(sides: Sides, scene: Scene) -> Finding:
    return Finding(
        "not-spun",
        "no time has passed since the nodes were added",
        f"Virtual time is at {at_time(scene.now_ns)}, and advances only during `ros.run`. No timer "
        "has fired since then, and no callback has run.",
        "Let the nodes run: `ros.run(seconds=10)`.",
        tuple(link(end, "nothing yet") for end in sides.publishers),
    )


def _publisher(end: Endpoint, scene: Scene) -> Finding | None:
    if not _runs(end, scene):
        return None
    beat = scene.beat(end)
    if beat.count == 0:
        return _held_back(end, scene) or _never(end, scene)
    if end.node not in scene.own:
        return None
    quiet = (scene.now_ns - beat.last_ns) / NANOSECONDS
    if beat.rate_hz and quiet * beat.rate_hz > _INTERVALS:
        return _held_back(end, scene) or _gone_quiet(end, beat.count, beat.last_ns, quiet)
    # After a single message, nobody knows its rate; but its timers have periods.
    periods = [one.period_ns for one in scene.graph.timers if one.node == end.node]
    if periods and quiet * NANOSECONDS > _INTERVALS * min(periods):
        return _held_back(end, scene)
    return None


def _held_back(end: Endpoint, scene: Scene) -> Finding | None:
    """Find a callback that keeps a publisher's node from publishing."""
    beat = scene.beat(end)
    if beat.held is None or beat.held.since_ns < 0:
        return None
    last = f"no message since {at_time(beat.last_ns)}" if beat.count else "no message yet"
    effect = f"No other callback of {end.node} runs until then: it has published {last}."
    return _blocked(beat.held, end.node, effect)


def _never(end: Endpoint, scene: Scene) -> Finding:
    watched = scene.beat(end).seconds
    why, hint = _timers(end.node, scene) if end.node in scene.own else ("", _LONGER)
    return Finding(
        "never-published",
        f"{end.node} has not published anything",
        f"{end.node} has a publisher on {end.name}, but published no message in "
        f"{seconds(watched)}.{why}",
        hint,
        (link(end, "no message", "so far"),),
    )


_LOOK = "Check which code calls `publish` on this publisher: usually it is a timer's callback."
_LONGER = (
    "If the node publishes only occasionally, listen longer: `--seconds 30` in a terminal, "
    f"`seconds=30` on a page. {_LOOK}"
)


def _timers(node: str, scene: Scene) -> tuple[str, str]:
    timers = [one for one in scene.graph.timers if one.node == node]
    if not timers:
        return " The node has no timer that could call `publish`.", _LOOK
    fired = [one for one in timers if one.calls]
    if fired:
        names = ", ".join(f"{one.callback} ran {count(one.calls, 'time')}" for one in fired)
        return f" The node's timer works: {names}.", (
            "Check whether that callback reaches its call of `publish`, and on which publisher."
        )
    period = seconds(min(one.period_ns for one in timers) / NANOSECONDS)
    return (
        f" The node's timer has a period of {period} and has not fired.",
        f"Let more time pass than {period}, and check whether something cancels the timer.",
    )


def _gone_quiet(end: Endpoint, number: int, last_ns: int, quiet: float) -> Finding:
    return Finding(
        "gone-quiet",
        f"{end.node} has stopped publishing",
        f"The node published {count(number, 'message')}, the last one at {at_time(last_ns)}, and "
        f"nothing in the {seconds(quiet)} since.",
        "Check what changed after that message: perhaps a condition in the callback is no longer "
        "true, or the timer was cancelled.",
        (link(end, "silent since", at_time(last_ns)),),
    )


def _subscription(end: Endpoint, sides: Sides, scene: Scene) -> Finding | None:
    if end.matched == 0 or not _runs(end, scene):
        return None
    beat = scene.beat(end)
    on_the_way = 0 if scene.virtual else _ON_THE_WAY
    behind = _behind(end, beat, sides, scene)
    if beat.held is not None and _is_held_up(beat, behind):
        return _blocked(beat.held, end.node, _waiting(end, beat, behind))
    if drops(beat):
        return _slow(end, beat) if _is_slow(beat) else None
    if scene.virtual and _comes_only_live(end, beat, sides, scene):
        return _only_live(end, sides.publishers)
    if beat.count == 0 and beat.since <= on_the_way and not behind:
        return _too_early(end, beat.missed) if beat.missed else None
    if beat.count == 0 or (behind and (beat.unheard or beat.behind_ns >= _LATE_NS)):
        return _unexplained(end, max(behind, 0 if beat.count else beat.since))
    return None


def _behind(end: Endpoint, beat: Beat, sides: Sides, scene: Scene) -> int:
    """Return how many messages have come since a callback last ran, beyond those on their way."""
    outside = [one for one in sides.publishers if one.node not in scene.own]
    unheard = 0 if any(clash(one, end) for one in outside) else beat.unheard
    behind = max(beat.behind, unheard)
    return behind if behind > (0 if scene.virtual else _ON_THE_WAY) else 0


def _is_held_up(beat: Beat, behind: int) -> bool:
    """Return whether a callback that has not returned keeps messages from a subscription."""
    if 0 < beat.count <= beat.running:
        return True  # none of its runs has returned
    is_late = behind >= _LATE_MESSAGES or (behind > 0 and beat.behind_ns >= _LATE_NS)
    ends = beat.held is not None and beat.held.until_ns is not None
    if not (is_late and ends and beat.arrived):
        return is_late
    # A callback that is slow all the time leaves out as many messages before each of its runs.
    usual = (beat.newest - behind) / beat.arrived
    return behind > 2 * usual + 1


def drops(beat: Beat) -> bool:
    """Return whether a part of the newest messages has not reached the callback."""
    lost = beat.newest - beat.arrived
    return lost >= _LATE_MESSAGES and lost * 10 >= beat.newest and beat.arrived > 0


def _is_slow(beat: Beat) -> bool:
    """Return whether they are not just lost because many came at once."""
    return beat.waited_ns > 0 or beat.running > 0 or beat.at_once < 2


def _slow(end: Endpoint, beat: Beat) -> Finding:
    queue = f", which holds {end.qos.depth}" if end.qos.depth else ""
    waited = (
        f" Meanwhile, callbacks of its process waited {seconds(beat.waited_ns / NANOSECONDS)}."
        if beat.waited_ns
        else ""
    )
    return Finding(
        "slow-callback",
        f"{end.node} does not keep up with the messages",
        f"Of the {beat.newest} newest messages, {beat.arrived} have reached the callback of "
        f"{end.node}. The others were dropped from its queue{queue}, or wait there.{waited}",
        "A callback has to return before the next message comes, and a node that is paused takes "
        "none. Move what takes long to another node; a deeper queue only helps against bursts.",
        (link(end, "does not", "keep up"),),
    )


def _waiting(end: Endpoint, beat: Beat, behind: int) -> str:
    if not behind:
        return f"None of the calls of {end.node}'s callback has returned."
    number = count(behind, "message")
    came = "has come" if behind == 1 else "have come"
    last = f"since its callback last ran, at {at_time(beat.last_ns)}" if beat.count else "for it"
    return f"{end.node} hears nothing until then: {number} {came} {last}."


def _comes_only_live(end: Endpoint, beat: Beat, sides: Sides, scene: Scene) -> bool:
    """Return whether messages come from other processes only, and time has passed without one."""
    outside = all(one.node not in scene.own for one in sides.publishers)
    arrives = scene.arriving_hz or any(scene.beat(one).count > 0 for one in sides.publishers)
    is_quiet = beat.count == 0 or beat.last_ns < scene.now_ns
    return bool(end.node in scene.own and sides.publishers and outside and arrives and is_quiet)


def _unexplained(end: Endpoint, number: int) -> Finding:
    return Finding(
        UNKNOWN,
        "the cause is unknown",
        f"{count(number, 'message')} were published while {end.node} was subscribed and "
        "connected, but its callback has not run since.",
        "Check the callback that you passed to `create_subscription`, and its callback group.",
        (link(end, "nothing", "arrives"),),
    )


def _only_live(end: Endpoint, publishers: Sequence[Endpoint]) -> Finding:
    return Finding(
        "not-spun",
        f"no callback of {end.node} has run since messages came",
        f"{nodes_of(publishers)} {verb(publishers, 'publishes', 'publish')} in another process, in "
        "real time. In virtual time, callbacks run only during `ros.run`, which is over before "
        "such a message comes.",
        "Run the nodes live: `ros.start()`, then `ros.wait(seconds)`.",
        (link(end, "nothing yet"),),
    )


def _too_early(end: Endpoint, missed: int) -> Finding:
    said = "The only message was" if missed == 1 else f"All {missed} messages were"
    return Finding(
        "first-messages-lost",
        f"the messages were published before {end.node} subscribed",
        f"{said} published before {end.node} subscribed, and none since. By default, a topic "
        "keeps no messages for late-joining subscriptions.",
        "Publish once the subscription is there (`get_subscription_count()`), or publish "
        "repeatedly with a timer, or give both sides the durability TRANSIENT_LOCAL.",
        (link(end, "came", "too late"),),
    )
