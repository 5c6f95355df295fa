"""Say why nothing arrives on a topic, from what was seen to an explanation. Pure functions."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from difflib import SequenceMatcher
from textwrap import fill

from rosbeat.diagnosis.exceptions import first_sentence, line_of
from rosbeat.diagnosis.mistakes import UNKNOWN, Diagnosis, in_html
from rosbeat.diagnosis.qos import incompatible, rule, words
from rosbeat.diagnosis.topic_snapshot import (
    BLOCKED,
    ENDED,
    NOT_ADDED,
    PAUSED,
    RUNNING,
    SILENT,
    Beat,
    Condition,
    OtherDomain,
    Scene,
    StaleBuild,
)
from rosbeat.records import NANOSECONDS, Endpoint, GraphSnapshot, QoS, is_hidden

# Which topic was probably meant.

#: How like two names have to be, from 0 to 1. At 0.8 `temprature` and `temperatures` are like
#: `temperature`, and `humidity`, `status` or `temp` are not.
_LIKE = 0.8


def nearest(name: str, others: Iterable[str]) -> str:
    """Return the name that is most like `name`, or an empty text if none is like it.

    Capitals do not count. Two names that end alike are alike too, whatever stands before: a
    namespace is easily forgotten.

    Args:
        name: A full name, such as `/temperature`.
        others: Full names; `name` itself does not count.
    """
    rated = [(_likeness(name, other), other) for other in sorted(set(others) - {name})]
    best = max(rated, default=(0.0, ""), key=lambda pair: pair[0])
    return best[1] if best[0] >= _LIKE else ""


def difference(one: str, other: str) -> str:
    """Say in what two names that are alike differ, as the end of a sentence."""
    if one.lower() == other.lower():
        return "they differ in capital letters"
    if _tail(one) == _tail(other):
        return "they differ before the last slash"
    if one.strip("/_").replace("_", "") == other.strip("/_").replace("_", ""):
        return "they differ in underscores"
    return f"they differ in {_letters(one, other)}"


def _likeness(one: str, other: str) -> float:
    low, other_low = one.lower().strip("/"), other.lower().strip("/")
    alike = SequenceMatcher(None, low, other_low, autojunk=False).ratio()
    return max(alike, 0.9 if _tail(low) == _tail(other_low) else 0.0)


def _tail(name: str) -> str:
    return name.rpartition("/")[2]


def _letters(one: str, other: str) -> str:
    """Return how many letters differ: each that is missing, too much or another one counts."""
    steps = SequenceMatcher(None, one, other, autojunk=False).get_opcodes()
    apart = [(one[a:b], other[c:d]) for kind, a, b, c, d in steps if kind != "equal"]
    number = sum(max(len(here), len(there)) for here, there in apart)
    # A digit, an underscore and a slash are no letters.
    noun = "letter" if all((here + there).isalpha() for here, there in apart) else "character"
    return f"one {noun}" if number == 1 else f"{number} {noun}s"


# What an explanation is put together from: a finding, marks in the graph, and words.

#: Kinds of marks.
LINK, NODE, TWINS, NEAR, TOPIC = "link", "node", "twins", "near", "topic"


@dataclass(frozen=True)
class Mark:
    """Mark a place in the graph where a cause is.

    Attributes:
        kind: `link`, between a node and a topic, where nothing passes; `node`, which does not run;
            `twins`, several nodes of one name; `near`, two topics whose names are almost the same;
            `topic`, which nobody uses.
        subject: Full name of the node; of the first topic, of a near miss.
        other: Full name of the topic; of the second topic, of a near miss; empty for a node.
        words: What is the matter there, a few words, in lines.
        side: Of a link: `publisher` or `subscription`, what the node is on that topic.
    """

    kind: str
    subject: str
    other: str = ""
    words: tuple[str, ...] = ()
    side: str = ""


@dataclass(frozen=True)
class Finding:
    """Hold one cause.

    Attributes:
        mistake: The mistake's id.
        headline: What is the matter, one sentence without its end.
        evidence: What shows it.
        hint: What to try.
        marks: Where in the graph.
    """

    mistake: str
    headline: str
    evidence: str
    hint: str
    marks: Sequence[Mark] = ()

    @property
    def diagnosis(self) -> Diagnosis:
        """Return the mistake with what is said of it."""
        return Diagnosis(self.mistake, self.evidence, self.hint)


def link(end: Endpoint, *words: str) -> Mark:
    """Mark the link between an endpoint's node and its topic."""
    return Mark(LINK, end.node, end.name, words, end.kind)


def listing(names: Iterable[str], last: str = "and") -> str:
    """Return names as a sentence has them, each once: `a`, `a and b`, `a, b and c`."""
    items = list(dict.fromkeys(names))
    if len(items) < 2:
        return "".join(items)
    return f"{', '.join(items[:-1])} {last} {items[-1]}"


def _near_miss(one: str, other: str) -> Mark:
    return Mark(NEAR, one, other, ("almost the", "same name"))


def nodes_of(ends: Iterable[Endpoint]) -> str:
    """Return the nodes of some endpoints, as a sentence has them."""
    return listing(end.node for end in ends)


def count(number: int, noun: str) -> str:
    """Return a number with its noun: `1 message`, `no messages`."""
    return f"{number or 'no'} {noun}{'' if number == 1 else 's'}"


def verb(ends: Iterable[Endpoint], one: str, many: str) -> str:
    """Return the form of a verb that fits the number of nodes."""
    return one if len({end.node for end in ends}) == 1 else many


def short_type(name: str) -> str:
    """Return a type as the page's code calls it: `Float32`."""
    return name.rsplit("/", 1)[-1]


def rate_words(rate_hz: float) -> str:
    """Return a rate as a person says it: `1 message a second`, `a message every 2 s`."""
    if rate_hz < 0.95:
        return f"a message every {_two_digits(1 / rate_hz)} s"
    rate = _two_digits(rate_hz)
    return f"{rate} message{'' if rate == '1' else 's'} a second"


def comes(rate_hz: float, one: str, many: str) -> str:
    """Return a rate with its verb: `1 message a second comes`, `4 messages a second come`."""
    words = rate_words(rate_hz)
    return f"{words} {many if ' messages ' in words else one}"


def qos_words(qos: QoS) -> str:
    """Return what matters of a quality of service."""
    said = [qos.reliability, qos.durability, *([f"depth {qos.depth}"] if qos.depth else [])]
    for name, limit in (("deadline", qos.deadline_ns), ("lifespan", qos.lifespan_ns)):
        said += [f"{name} {limit / NANOSECONDS:g} s"] if limit else []
    return ", ".join(said)


def seconds(value: float) -> str:
    """Return a time in seconds: `3 s`, `0.25 s`."""
    return f"{value:.3g} s" if value < 100 else f"{value:.0f} s"


def _at(time_ns: int) -> str:
    return f"{time_ns / NANOSECONDS:.6g} s"


def _two_digits(value: float) -> str:
    # A clock that is measured is never exact: 0.9987 a second is one a second.
    return f"{float(f'{value:.2g}'):g}"


# Why two sides of a topic are not connected: one is missing, or they do not fit.

_OTHER = {"publisher": "subscription", "subscription": "publisher"}
_DOES = {
    "publisher": ("publishes on", "publish on"),
    "subscription": ("subscribes to", "subscribe to"),
}


@dataclass(frozen=True)
class Sides:
    """Hold the two sides of a topic.

    Attributes:
        topic: Its full name.
        publishers: Who publishes.
        subscriptions: Who subscribes.
    """

    topic: str
    publishers: tuple[Endpoint, ...]
    subscriptions: tuple[Endpoint, ...]

    @property
    def missing(self) -> str:
        """Return the side that nobody is on, `both`, or empty."""
        if not self.publishers:
            return "publisher" if self.subscriptions else "both"
        # A publisher that is matched is heard by somebody who is not shown, as `ros2 topic echo`.
        heard = self.subscriptions or any(end.matched > 0 for end in self.publishers)
        return "" if heard else "subscription"


def sides_of(topic: str, graph: GraphSnapshot) -> Sides:
    """Return the two sides of a topic."""
    return Sides(topic, graph.on(topic, "publisher"), graph.on(topic, "subscription"))


def links(sides: Sides, scene: Scene) -> Iterator[Finding]:
    """Find everything that keeps the sides of a topic apart."""
    yield from _types(sides)
    yield from _qualities(sides)
    yield from _unconnected(sides)
    if sides.missing:
        yield _misspelled(sides, scene.graph) or _nobody(sides, scene)


# They do not fit.


def _types(sides: Sides) -> Iterator[Finding]:
    """Find subscriptions that hear nobody, and publishers that nobody hears beside one that is."""
    sent = {one.type_name for one in sides.publishers}
    asked = {one.type_name for one in sides.subscriptions}
    for end in sides.subscriptions:
        if sent and end.type_name not in sent:
            yield _type_clash(sides.topic, sides.publishers, (end,), end)
    for end in sides.publishers if sent & asked else ():
        if end.type_name not in asked:
            yield _type_clash(sides.topic, (end,), sides.subscriptions, end)


def _type_clash(
    topic: str, publishers: Sequence[Endpoint], listeners: Sequence[Endpoint], marked: Endpoint
) -> Finding:
    sent, asked = _two_types(publishers[0].type_name, listeners[0].type_name)
    return Finding(
        "type-mismatch",
        f"{topic} has two message types",
        f"{nodes_of(publishers)} {verb(publishers, 'publishes', 'publish')} {sent}, and "
        f"{nodes_of(listeners)} {verb(listeners, *_DOES['subscription'])} {asked}. ROS connects "
        "them only if both use the same type.",
        "Decide on one type, and use it in both `create_publisher` and `create_subscription`.",
        [link(marked, f"sends {sent}", f"expects {asked}")],
    )


def _two_types(one: str, other: str) -> tuple[str, str]:
    if short_type(one) == short_type(other):
        return one, other
    return short_type(one), short_type(other)


def _qualities(sides: Sides) -> Iterator[Finding]:
    for end in sides.subscriptions:
        clashing = [one for one in _same_type(end, sides.publishers) if _clash(one, end)]
        for one in clashing:
            all_do = len(clashing) == len(sides.publishers)
            yield _quality(one, end, end if all_do else one)


def _same_type(end: Endpoint, others: Iterable[Endpoint]) -> list[Endpoint]:
    return [one for one in others if one.type_name == end.type_name]


def _clash(publisher: Endpoint, subscription: Endpoint) -> tuple[str, ...]:
    return incompatible(publisher.qos, subscription.qos)


def _quality(publisher: Endpoint, subscription: Endpoint, marked: Endpoint) -> Finding:
    policies = _clash(publisher, subscription)
    offers = listing(words(publisher.qos, one) for one in policies)
    asks = listing(words(subscription.qos, one) for one in policies)
    rules = "; ".join(f"{one}: {rule(one)}" for one in policies)
    return Finding(
        "qos-mismatch",
        f"{listing(policies)} of {publisher.node} and {subscription.node} are incompatible"
        if len(policies) > 1
        else f"the {policies[0]} of {publisher.node} and {subscription.node} is incompatible",
        f"{publisher.node} offers {offers}, but {subscription.node} requests {asks}. The rule "
        f"for {rules}.",
        "A publisher has to offer at least what the subscription requests. Give both sides the "
        "same QoS.",
        [link(marked, f"offers {offers}", f"requests {asks}")],
    )


def _unconnected(sides: Sides) -> Iterator[Finding]:
    for end in sides.subscriptions:
        fitting = [one for one in _same_type(end, sides.publishers) if not _clash(one, end)]
        if not fitting or end.matched != 0:
            continue
        yield Finding(
            UNKNOWN,
            f"{nodes_of(fitting)} and {end.node} are not connected",
            f"{fitting[0].node} offers {qos_words(fitting[0].qos)}, {end.node} requests "
            f"{qos_words(end.qos)}, and both use the same type. They are compatible, but the "
            "middleware has not connected them.",
            "If the nodes have only just started, ask again in a moment. If not, compare the "
            "deadline, the lifespan and the liveliness in the QoS of both sides.",
            [link(end, "not connected")],
        )


# One side is missing.


def _misspelled(sides: Sides, graph: GraphSnapshot) -> Finding | None:
    if sides.missing == "both":
        return None
    wanted = sides.missing
    here = sides.publishers or sides.subscriptions
    name = nearest(sides.topic, _one_sided(wanted, graph))
    if not name:
        return None
    there = graph.on(name, wanted)
    pair = (sides.topic, name) if wanted == "subscription" else (name, sides.topic)
    how = difference(sides.topic, name)
    return Finding(
        "topic-misspelled",
        f"{pair[0]} and {pair[1]} are two different topics",
        f"{nodes_of(here)} {verb(here, *_DOES[_OTHER[wanted]])} {sides.topic}, and "
        f"{nodes_of(there)} {verb(there, *_DOES[wanted])} {name}; {how}. To ROS, these are two "
        "different topics.",
        "Compare the two names letter by letter, and use the same one on both sides.",
        [_near_miss(*pair)],
    )


def _one_sided(kind: str, graph: GraphSnapshot) -> Iterator[str]:
    """Return topics with somebody on this side and nobody on the other."""
    for name in visible_topics(graph):
        if sides_of(name, graph).missing == _OTHER[kind]:
            yield name


def visible_topics(graph: GraphSnapshot) -> list[str]:
    """Return the topics that a learner has made, sorted."""
    return [name for name in graph.topics() if not is_hidden(name)]


def _nobody(sides: Sides, scene: Scene) -> Finding:
    if sides.missing == "both":
        return _unknown(sides.topic, scene)
    if sides.missing == "publisher":
        return _no_publisher(sides, scene)
    return Finding(
        "no-subscription",
        f"no node subscribes to {sides.topic}",
        f"{nodes_of(sides.publishers)} {verb(sides.publishers, 'publishes', 'publish')} there, "
        "but no node subscribes, so the messages reach no node.",
        f"Start the node that subscribes{_how_to_start(scene)}, and compare the topic name in "
        "its `create_subscription`.",
    )


def _no_publisher(sides: Sides, scene: Scene) -> Finding:
    listeners = sides.subscriptions
    published = listing(_with_publishers(scene.graph))
    start = f"tart the node that publishes{_how_to_start(scene)}, and compare the topic name in"
    # Others listen to the near one, so it may well be another topic: a question, and no verdict.
    near = nearest(sides.topic, _with_publishers(scene.graph))
    asked = (
        f"Did you mean {near}, which has a publisher? "
        f"{difference(sides.topic, near).capitalize()}. If not, s"
        if near
        else "S"
    )
    return Finding(
        "no-publisher",
        f"no node publishes on {sides.topic}",
        f"{nodes_of(listeners)} {verb(listeners, 'subscribes', 'subscribe')} to it, but no node "
        f"publishes. Topics with a publisher: {published or 'none'}.",
        f"{asked}{start} its `create_publisher`.",
        [_near_miss(near, sides.topic)] if near else [],
    )


def _with_publishers(graph: GraphSnapshot) -> list[str]:
    return [name for name in visible_topics(graph) if graph.on(name, "publisher")]


def _unknown(topic: str, scene: Scene) -> Finding:
    names = visible_topics(scene.graph)
    near = nearest(topic, names)
    hint = (
        f"Did you mean {near}? Ask about that topic."
        if near
        else f"Start a node that uses it{_how_to_start(scene)}, or ask about a topic that exists."
    )
    return Finding(
        "topic-unknown",
        f"no node uses {topic}",
        f"No node publishes on it, and no node subscribes to it. Topics in use: "
        f"{listing(names) or 'none'}.",
        hint,
        [
            Mark(TOPIC, topic, words=("no node uses", "this name")),
            *([_near_miss(near, topic)] if near else []),
        ],
    )


def _how_to_start(scene: Scene) -> str:
    if scene.domain_id < 0:
        return ", with `ros.add(...)`"
    if scene.own:
        return ", with `ros.add(...)` or in a terminal"
    return " in a terminal, with `ros2 run`"


# Why a node that is on a topic does not do its part.

#: Who has been quiet for so many of its own intervals has stopped.
_INTERVALS = 5
#: So many messages may be on their way while a session is live.
_ON_THE_WAY = 2


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
    for end in sides.publishers:
        yield from _publisher(end, scene)
    for end in sides.subscriptions:
        yield from _subscription(end, scene)


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
_CONDITIONS = {
    ENDED: _Cause("node-ended", "{node} has ended",
        "{node} called rclpy.shutdown(), which ended the node.",
        "Take that call out of the callback, and add the node again.",
        ("has ended",)),
    BLOCKED: _Cause("callback-blocks", "a callback of {node} does not return",
        "{callback} has started but not returned. Until it returns, no other callback of {node} "
        "runs{others}.",
        "A callback does its work once and returns: no endless loop, no `time.sleep`, no waiting "
        "for a response. Use a timer for anything that happens repeatedly.",
        ("callback does", "not return")),
    PAUSED: _Cause("not-spun", _NOT_RUN,
        "{node} is paused: messages wait in its queues, and its timers do not fire.",
        'Resume the node with `ros.resume("{name}")`.',
        ("paused",)),
    NOT_ADDED: _Cause("not-spun", _NOT_RUN,
        "{node} was created, but never added to the session: it is in the graph, but none of its "
        "callbacks is ever called.",
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
    cause, node, fault = _CONDITIONS[condition.state], condition.node, condition.fault
    if condition.state == ENDED and fault:
        evidence = (
            f"At {fault.time:.6g} s {fault.callback} raised {fault.kind}: "
            f"{first_sentence(fault.text)}.{line_of(fault)} An uncaught exception in a callback "
            "ends its node."
        )
        hint = "Correct that line, then run the cell that adds the node again."
    else:
        alone = node in scene.own and not scene.virtual
        others = ", and neither does any other node of the session" if alone else ""
        evidence = cause.evidence.format(node=node, callback=condition.callback, others=others)
        hint = cause.hint.format(name=node.lstrip("/"))
    mark = Mark(NODE, node, words=cause.words)
    return Finding(cause.mistake, cause.headline.format(node=node), evidence, hint, [mark])


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
            [Mark(TWINS, node, words=(f"{known[node]} of this name",))],
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
        f"Virtual time is at {_at(scene.now_ns)}, and advances only during `ros.run`. No timer "
        "has fired since then, and no callback has run.",
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
    why, hint = _timers(end.node, scene) if end.node in scene.own else ("", _LONGER)
    return Finding(
        "never-published",
        f"{end.node} has not published anything",
        f"{end.node} has a publisher on {end.name}, but published no message in "
        f"{seconds(watched)}.{why}",
        hint,
        [link(end, "no message", "so far")],
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
        f"The node published {count(number, 'message')}, the last one at {_at(last_ns)}, and "
        f"nothing in the {seconds(quiet)} since.",
        "Check what changed after that message: perhaps a condition in the callback is no longer "
        "true, or the timer was cancelled.",
        [link(end, "silent since", _at(last_ns))],
    )


def _subscription(end: Endpoint, scene: Scene) -> Iterator[Finding]:
    beat = scene.beat(end)
    if beat.count != 0 or end.matched == 0 or not _runs(end, scene):
        return
    if beat.since > (0 if scene.virtual else _ON_THE_WAY):
        yield Finding(
            UNKNOWN,
            "the cause is unknown",
            f"{count(beat.since, 'message')} were published while {end.node} was subscribed and "
            "connected, but its callback has not run.",
            "Check the callback that you passed to `create_subscription`, and its callback group.",
            [link(end, "nothing", "arrives")],
        )
    elif beat.missed:
        yield _too_early(end, beat.missed)


def _too_early(end: Endpoint, missed: int) -> Finding:
    said = "The only message was" if missed == 1 else f"All {missed} messages were"
    return Finding(
        "first-messages-lost",
        f"the messages were published before {end.node} subscribed",
        f"{said} published before {end.node} subscribed, and none since. By default, a topic "
        "keeps no messages for late-joining subscriptions.",
        "Publish once the subscription is there (`get_subscription_count()`), or publish "
        "repeatedly with a timer, or give both sides the durability TRANSIENT_LOCAL.",
        [link(end, "came", "too late")],
    )


# Causes outside of the graph: another ROS domain, and a build that is older than its source.


def elsewhere(sides: Sides, scene: Scene) -> Iterator[Finding]:
    """Find what is missing here in other domains."""
    for domain in scene.other_domains:
        publishers = domain.publishers if not sides.publishers else ()
        subscriptions = domain.subscriptions if not sides.subscriptions else ()
        if sides.missing and (publishers or subscriptions):
            yield _other_domain(sides.topic, scene.domain_id, domain, publishers, subscriptions)


def _other_domain(
    topic: str,
    here: int,
    domain: OtherDomain,
    publishers: tuple[str, ...],
    subscriptions: tuple[str, ...],
) -> Finding:
    said = [
        f"{listing(names)} {does} {topic}"
        for names, does in ((publishers, "publishes on"), (subscriptions, "subscribes to"))
        if names
    ]
    own = f"; this is domain {here}" if here >= 0 else ""
    return Finding(
        "other-domain",
        f"the missing side is in ROS domain {domain.domain_id}",
        f"In ROS domain {domain.domain_id}, {listing(said)}{own}. Nodes in different domains "
        "never discover each other.",
        "Compare `echo $ROS_DOMAIN_ID` in both terminals. Both terminals need the same number, "
        "set before the nodes start; a page joins a domain with `Session(domain_id=...)`.",
    )


def stale(scene: Scene) -> Iterator[Finding]:
    """Find programs that were edited and not built again."""
    for build in scene.stale_builds:
        yield _not_rebuilt(build) if build.built else _not_built(build)


def _not_rebuilt(build: StaleBuild) -> Finding:
    return Finding(
        "not-rebuilt",
        f"{build.executable} was edited after the last build",
        f"{build.module} names this topic, but differs from the copy that `ros2 run "
        f"{build.package} {build.executable}` starts.",
        "Run `colcon build` in the workspace, then stop the node and start it again.",
    )


def _not_built(build: StaleBuild) -> Finding:
    return Finding(
        "not-built",
        f"{build.package} is not built yet",
        f"{build.module} names this topic, but the package {build.package} was never built, so "
        "its nodes cannot run.",
        "In the workspace, run `colcon build`, then `source install/setup.bash`, then `ros2 run "
        f"{build.package} {build.executable}`.",
    )


# What was seen on a topic, sentence by sentence.


def report(sides: Sides, scene: Scene) -> tuple[str, ...]:
    """Say who is on a topic and what each has done."""
    return tuple(filter(None, _sentences(sides, scene)))


def _sentences(sides: Sides, scene: Scene) -> Iterator[str]:
    for end in sides.publishers:
        beat = scene.beat(end)
        yield f"{end.node} publishes {_what(end)}{_published_by(beat)}."
    for end in sides.subscriptions:
        beat = scene.beat(end)
        yield f"{end.node} subscribes to {_what(end)}{_heard(beat)}."
    if scene.arriving_hz:
        yield f"In total, {comes(scene.arriving_hz, 'arrives', 'arrive')} from other processes."
    if sides.missing and scene.private_sessions:
        yield (
            "Pages on this machine have private sessions open. Only a session that is opened with "
            "`Session(domain_id=...)` can be heard in other processes."
        )


def _what(end: Endpoint) -> str:
    return f"{short_type(end.type_name)} ({qos_words(end.qos)})"


def _published_by(beat: Beat) -> str:
    if beat.count < 0:
        return ""
    if beat.count == 0:
        return f": no messages in {seconds(beat.seconds)}"
    rate = f", {rate_words(beat.rate_hz)}" if beat.rate_hz else ""
    last = f", the last at {_at(beat.last_ns)}" if beat.last_ns >= 0 else ""
    return f": {count(beat.count, 'message')}{rate}{last}"


def _heard(beat: Beat) -> str:
    if beat.count < 0:
        return ""
    missed = f"; {count(beat.missed, 'message')} had been published before" if beat.missed else ""
    last = f", the last at {_at(beat.last_ns)}" if beat.count and beat.last_ns >= 0 else ""
    ran = f"ran {count(beat.count, 'time')}" if beat.count else "has not run"
    return f": its callback {ran}{last}{missed}"


def arrival(sides: Sides, scene: Scene, rate_hz: float) -> str:
    """Say what arrives and where, if all is well."""
    listeners = nodes_of(sides.subscriptions) or "a subscription that is not shown here"
    if rate_hz:
        return f"{comes(rate_hz, 'arrives', 'arrive')} at {listeners}"
    number = sum(scene.beat(end).count for end in sides.publishers if scene.beat(end).count > 0)
    return f"{count(number, 'message')} arrived at {listing([listeners])} so far"


# The explanation.

#: The verdict if nothing is wrong.
WELL = "all-is-well"

#: The likelier a cause explains the others, the earlier it is named.
_ORDER = (
    *("node-ended", "callback-blocks", "not-spun", "type-mismatch", "qos-mismatch"),
    *("topic-misspelled", "other-domain", "not-rebuilt", "not-built", "topic-unknown"),
    *("no-publisher", "never-published", "gone-quiet", "first-messages-lost", "run-twice"),
    *("no-subscription", UNKNOWN),
)
_WIDTH = 100
_GOOD, _BAD = "#00785a", "#b34700"


@dataclass(frozen=True, repr=False)
class Explanation:
    """Say why nothing arrives on a topic, or that all is well, at the end of a cell.

    Attributes:
        topic: Full name of the topic.
        verdict: `all-is-well`, or the id of the likeliest mistake; `new-to-me` if none is known.
        diagnoses: Every cause that was found, the likeliest first.
        headlines: Each cause in a few words, in the same order.
        rate_hz: Messages a second on the topic; 0 if nothing comes, or too little to tell.
        sentences: What was seen, sentence by sentence.
        graph: The graph.
        marks: The places in the graph where something is the matter.
    """

    topic: str
    verdict: str
    diagnoses: tuple[Diagnosis, ...] = ()
    headlines: tuple[str, ...] = ()
    rate_hz: float = 0.0
    sentences: tuple[str, ...] = ()
    graph: GraphSnapshot = field(default_factory=GraphSnapshot)
    marks: tuple[Mark, ...] = ()

    @property
    def is_well(self) -> bool:
        """Return whether nothing is wrong."""
        return self.verdict == WELL

    @property
    def title(self) -> str:
        """Return what is the matter, one sentence."""
        headline = self.headlines[0]
        said = headline if self.topic in headline else f"{self.topic}: {headline}"
        return f"{said[:1].upper()}{said[1:]}."

    def __str__(self) -> str:
        rows = [f"{self._sign} {self.title}"]
        for number, one in enumerate(self.diagnoses):
            if number:
                rows.append(f"{self._sign} Also: {self.headlines[number]}.")
            rows += [_row("Seen:", one.evidence), _row("Hint:", one.hint)]
        rows += [_row("-", sentence) for sentence in self.sentences]
        return "\n".join(rows)

    __repr__ = __str__

    def _repr_html_(self) -> str:
        # No background and no text colour of its own: both are the reader's theme.
        colour = _GOOD if self.is_well else _BAD
        style = f"border-left:4px solid {colour};padding:0.3em 0.8em;margin:0.3em 0"
        causes = "".join(map(self._html_of, range(len(self.diagnoses))))
        seen = "".join(f"<li>{in_html(one)}</li>" for one in self.sentences)
        head = f"<strong>{self._sign} {in_html(self.title)}</strong>"
        return f'<div style="{style}">{head}{causes}<ul style="margin:0.3em 0">{seen}</ul></div>'

    @property
    def _sign(self) -> str:
        return "\N{CHECK MARK}" if self.is_well else "\N{BALLOT X}"

    def _html_of(self, number: int) -> str:
        one = self.diagnoses[number]
        also = f"<strong>Also: {in_html(self.headlines[number])}.</strong> " if number else ""
        return f"<div>{also}{in_html(one.evidence)}<br><em>Hint:</em> {in_html(one.hint)}</div>"


def explain(topic: str, scene: Scene) -> Explanation:
    """Say why nothing arrives on a topic, or that all is well.

    Args:
        topic: Its full name, such as `/temperature`.
        scene: What was seen.

    Returns:
        The explanation; the same for the same scene, every time.
    """
    sides = sides_of(topic, scene.graph)
    found = _ordered(_findings(sides, scene))
    sentences = report(sides, scene)
    rate = _rate(sides, scene)
    if not found:
        good = (f"all is well on {topic}: {arrival(sides, scene, rate)}",)
        remarks = tuple(f"Note: {one.headline}." for one in stale(scene))
        return Explanation(topic, WELL, (), good, rate, (*sentences, *remarks), scene.graph)
    return Explanation(
        topic,
        found[0].mistake,
        tuple(one.diagnosis for one in found),
        tuple(one.headline for one in found),
        rate,
        sentences,
        scene.graph,
        tuple(dict.fromkeys(mark for one in found for mark in one.marks)),
    )


def _findings(sides: Sides, scene: Scene) -> list[Finding]:
    found = [*links(sides, scene), *nodes(sides, scene)]
    found += elsewhere(sides, scene)
    if not found and not _anything_came(sides, scene):
        found.append(_new(sides, scene))
    return [*found, *stale(scene)] if found else []


def _anything_came(sides: Sides, scene: Scene) -> bool:
    return any(scene.beat(end).count > 0 for end in sides.publishers) or scene.arriving_hz > 0


def _new(sides: Sides, scene: Scene) -> Finding:
    return Finding(
        UNKNOWN,
        "the cause is unknown",
        "Both sides exist and are compatible, but it could not be observed whether messages "
        "arrive.",
        f"Listen in a terminal with `ros2 topic echo {sides.topic}`. If the command does not "
        "find the message type, run `source install/setup.bash` in the workspace first.",
        [link(end, "nothing seen") for end in sides.publishers],
    )


def _ordered(found: list[Finding]) -> list[Finding]:
    rank = {name: number for number, name in enumerate(_ORDER)}
    return sorted(found, key=lambda one: rank.get(one.mistake, len(rank)))


def _rate(sides: Sides, scene: Scene) -> float:
    rates = {end.node: scene.beat(end).rate_hz for end in sides.publishers}
    return scene.arriving_hz + sum(rates.values())


def _row(mark: str, text: str) -> str:
    begin = f"  {mark} "
    rest = " " * len(begin)
    return fill(
        text,
        _WIDTH,
        initial_indent=begin,
        subsequent_indent=rest,
        break_long_words=False,
        break_on_hyphens=False,
    )
