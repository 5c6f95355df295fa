"""Why a node that is on a topic does not do its part."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from rosbeat.diagnosis.explanation_links import Sides
from rosbeat.diagnosis.explanation_parts import (
    NODE,
    TWINS,
    Finding,
    Mark,
    count,
    finding,
    link,
    seconds,
)
from rosbeat.diagnosis.mistakes import UNKNOWN
from rosbeat.diagnosis.situation import (
    BLOCKED,
    ENDED,
    NOT_ADDED,
    PAUSED,
    RUNNING,
    SILENT,
    Condition,
    Scene,
)
from rosbeat.records import NANOSECONDS, Endpoint

#: Who has been quiet for so many of its own intervals has stopped.
_INTERVALS = 5
#: So many messages may be on their way while a session is live.
_ON_THE_WAY = 2


def nodes(sides: Sides, scene: Scene) -> Iterator[Finding]:
    """Find every node that does not do its part."""
    ends = (*sides.publishers, *sides.subscriptions)
    for condition in _conditions(ends, scene):
        found = _of(condition, scene)
        if found:
            yield found
    yield from _twins(ends, scene)
    held_up = any(one.state == BLOCKED and one.node in scene.own for one in scene.conditions)
    if held_up and not scene.virtual:
        return  # nobody else can do anything either
    if _stands_still(sides, scene):
        yield _no_time(sides, scene)
        return
    for end in sides.publishers:
        yield from _publisher(end, scene)
    for end in sides.subscriptions:
        yield from _subscription(end, scene)


def _conditions(ends: tuple[Endpoint, ...], scene: Scene) -> list[Condition]:
    """Those of the nodes on the topic, and of whoever holds up all others."""
    here = {end.node for end in ends}
    speaks = {end.node for end in ends if end.kind == "publisher" and _is_heard(end, scene)}
    return [
        one
        for one in scene.conditions
        if (one.state == BLOCKED and not scene.virtual)
        or (one.node in here and not (one.state == SILENT and one.node in speaks))
    ]


def _is_heard(end: Endpoint, scene: Scene) -> bool:
    # A program may well publish in a loop of its own and never spin.
    return scene.beat(end).count > 0


def _of(condition: Condition, scene: Scene) -> Finding | None:
    say = {
        ENDED: _ended,
        BLOCKED: _blocked,
        PAUSED: _paused,
        NOT_ADDED: _not_added,
        SILENT: _no_answer,
    }.get(condition.state)
    return say(condition, scene) if say else None


def _ended(condition: Condition, _: Scene) -> Finding:
    fault, node = condition.fault, condition.node
    evidence = f"{node} called rclpy.shutdown(), which ends it."
    hint = "Take that call out of the callback, and add the node again."
    if fault:
        where = f" Line {fault.line}: `{fault.code}`." if fault.line else ""
        evidence = (
            f"At {fault.time:.6g} s {fault.callback} raised {fault.kind}: {_first_line(fault.text)}"
            f".{where} An exception that leaves a callback ends its node."
        )
        hint = "Mend that line, then run the cell that adds the node again."
    mark = Mark(NODE, node, words=("has ended",))
    return finding("node-ended", f"{node} has ended", evidence, hint, [mark])


def _first_line(text: str) -> str:
    return text.split(", at ")[0].split("\n")[0].rstrip(".")


def _blocked(condition: Condition, scene: Scene) -> Finding:
    node = condition.node
    alone = node in scene.own and not scene.virtual
    others = ", and no other node of the session runs meanwhile" if alone else ""
    return finding(
        "callback-blocks",
        f"a callback of {node} does not return",
        f"{condition.callback} has begun and not ended. Until it does, no other callback of {node} "
        f"runs{others}.",
        "A callback does one thing and returns: no endless loop, no `time.sleep`, no waiting for "
        "an answer. What comes again and again is a timer's work.",
        [Mark(NODE, node, words=("callback does", "not return"))],
    )


def _paused(condition: Condition, _: Scene) -> Finding:
    node = condition.node
    return finding(
        "not-spun",
        f"nobody runs the callbacks of {node}",
        f"{node} is paused: its messages wait in its queues, and its timers do not fire.",
        f'Let it go on with `ros.resume("{node.lstrip("/")}")`.',
        [Mark(NODE, node, words=("paused",))],
    )


def _not_added(condition: Condition, _: Scene) -> Finding:
    node = condition.node
    return finding(
        "not-spun",
        f"nobody runs the callbacks of {node}",
        f"{node} was made, and never handed to the session: it is in the graph, and none of its "
        "callbacks is ever called.",
        "Hand it over with `ros.add(...)`. In a program, `rclpy.spin(node)` does that.",
        [Mark(NODE, node, words=("not spun",))],
    )


def _no_answer(condition: Condition, _: Scene) -> Finding:
    node = condition.node
    return finding(
        "not-spun",
        f"{node} does not answer",
        f"{node} is in the graph, and did not answer a question that every running node answers. "
        "Its process runs none of its callbacks: it does not spin, or one callback does not "
        "return.",
        "Look for `rclpy.spin(node)` in its `main`, then for an endless loop or `time.sleep` in a "
        "callback.",
        [Mark(NODE, node, words=("does not", "answer"))],
    )


def _twins(ends: tuple[Endpoint, ...], scene: Scene) -> Iterator[Finding]:
    known = Counter(scene.graph.nodes)
    here = Counter((end.node, end.kind) for end in ends)
    for (node, kind), number in here.items():
        # Two endpoints of one name may also belong to one node.
        if number < 2 or known[node] < 2:
            continue
        speak = kind == "publisher"
        effect = "each publishes, so more arrives than you expect" if speak else "each hears all"
        yield finding(
            "run-twice",
            f"{known[node]} nodes are called {node}",
            f"The graph has {known[node]} nodes of that name; {effect}.",
            "End the one that you no longer need: a terminal that still runs it (Ctrl+C), or "
            "another page. If you want both, give one another name.",
            [Mark(TWINS, node, words=(f"{known[node]} of this name",))],
        )


# What the hearts say.


def _stands_still(sides: Sides, scene: Scene) -> bool:
    """Whether nothing came because nobody has let time pass since."""
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
    return finding(
        "not-spun",
        "no time has passed since the nodes were added",
        f"Virtual time stands at {scene.now_ns / NANOSECONDS:.6g} s, and moves only while "
        "`ros.run` is at work. No timer has fired since, and no callback has run.",
        "Let the nodes run: `ros.run(seconds=10)`.",
        [link(end, "nothing yet") for end in sides.publishers],
    )


def _publisher(end: Endpoint, scene: Scene) -> Iterator[Finding]:
    if not _runs(end, scene):
        return
    beat = scene.beat(end)
    if beat.count == 0:
        yield _never(end, scene)
    elif beat.rate_hz and end.node in scene.own:
        quiet = (scene.now_ns - beat.last_ns) / NANOSECONDS
        if quiet * beat.rate_hz > _INTERVALS:
            yield _gone_quiet(end, beat.count, beat.last_ns, quiet)


def _never(end: Endpoint, scene: Scene) -> Finding:
    watched = scene.beat(end).seconds
    why, hint = _timers(end.node, watched, scene) if end.node in scene.own else ("", _LONGER)
    return finding(
        "never-published",
        f"{end.node} has not published anything",
        f"{end.node} has a publisher on {end.name}, and in {seconds(watched)} no message "
        f"came from it.{why}",
        hint,
        [link(end, "no message", "so far")],
    )


_LOOK = (
    "Look whether `publish` is called on this publisher, and by what: usually the callback of a "
    "timer."
)
_LONGER = (
    "If it publishes only now and then, listen longer: `--seconds 30` in a terminal, `seconds=30` "
    f"on a page. {_LOOK}"
)


def _timers(node: str, watched: float, scene: Scene) -> tuple[str, str]:
    timers = [one for one in scene.graph.timers if one.node == node]
    if not timers:
        return " It has no timer that could call `publish`.", _LOOK
    fired = [one for one in timers if one.calls]
    if fired:
        names = ", ".join(f"{one.callback} ran {count(one.calls, 'time')}" for one in fired)
        return f" Its timer works: {names}.", (
            "Look whether that callback comes as far as `publish`, and on which publisher it calls "
            "it."
        )
    first = min(timers, key=lambda one: one.period_ns)
    period = first.period_ns / NANOSECONDS
    said = f" Its timer has a period of {seconds(period)} and has not fired."
    if period > watched:
        return said, f"Wait longer than {seconds(period)}, or choose a shorter period."
    return said, "Look whether something cancels the timer."


def _gone_quiet(end: Endpoint, number: int, last_ns: int, quiet: float) -> Finding:
    return finding(
        "gone-quiet",
        f"{end.node} has stopped publishing",
        f"It published {count(number, 'message')}, the last at {last_ns / NANOSECONDS:.6g} s, and "
        f"nothing in the {seconds(quiet)} since.",
        "Look at what its callback does after that message: a condition that is no longer true, or "
        "a timer that was cancelled.",
        [link(end, "silent since", f"{last_ns / NANOSECONDS:.6g} s")],
    )


def _subscription(end: Endpoint, scene: Scene) -> Iterator[Finding]:
    beat = scene.beat(end)
    if beat.count != 0 or end.matched == 0 or not _runs(end, scene):
        return
    if beat.since > (0 if scene.virtual else _ON_THE_WAY):
        yield finding(
            UNKNOWN,
            "this is new to me",
            f"{count(beat.since, 'message')} were published while {end.node} was subscribed and "
            "connected, and its callback has not run.",
            "Look at the callback that you gave to `create_subscription`, and at its callback "
            "group.",
            [link(end, "nothing", "arrives")],
        )
    elif beat.missed:
        yield _too_early(end, beat.missed)


def _too_early(end: Endpoint, missed: int) -> Finding:
    said = "The only message was" if missed == 1 else f"All {missed} messages were"
    return finding(
        "first-messages-lost",
        f"what was published came before {end.node} listened",
        f"{said} published before {end.node} subscribed, and none since. A topic keeps nothing for "
        "those who come later.",
        "Begin to publish when the other side is there (`get_subscription_count()`), or again and "
        "again with a timer; or give both sides the durability TRANSIENT_LOCAL.",
        [link(end, "came", "too late")],
    )
