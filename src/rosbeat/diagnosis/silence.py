"""Say why nothing arrives on a topic, from what was seen to an explanation. Pure functions."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from textwrap import fill

from rosbeat.diagnosis.findings import (
    TOPIC,
    Finding,
    Mark,
    Sides,
    at_time,
    clash,
    comes,
    count,
    difference,
    link,
    listing,
    near_miss,
    nearest,
    nodes_of,
    qos_words,
    rate_words,
    same_type,
    seconds,
    short_type,
    sides_of,
    verb,
)
from rosbeat.diagnosis.mistakes import UNKNOWN, Diagnosis, in_html
from rosbeat.diagnosis.qos import rule, words
from rosbeat.diagnosis.silent_nodes import drops, nodes
from rosbeat.diagnosis.topic_snapshot import Beat, OtherDomain, Scene, StaleBuild
from rosbeat.records import Endpoint, GraphSnapshot, is_hidden

# Why two sides of a topic are not connected: one is missing, or they do not fit.

_OTHER = {"publisher": "subscription", "subscription": "publisher"}
_DOES = {
    "publisher": ("publishes on", "publish on"),
    "subscription": ("subscribes to", "subscribe to"),
}


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
        (link(marked, f"sends {sent}", f"expects {asked}"),),
    )


def _two_types(one: str, other: str) -> tuple[str, str]:
    if short_type(one) == short_type(other):
        return one, other
    return short_type(one), short_type(other)


def _qualities(sides: Sides) -> Iterator[Finding]:
    for end in sides.subscriptions:
        clashing = [one for one in same_type(end, sides.publishers) if clash(one, end)]
        for one in clashing:
            all_do = len(clashing) == len(sides.publishers)
            yield _quality(one, end, end if all_do else one)


def _quality(publisher: Endpoint, subscription: Endpoint, marked: Endpoint) -> Finding:
    policies = clash(publisher, subscription)
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
        (link(marked, f"offers {offers}", f"requests {asks}"),),
    )


def _unconnected(sides: Sides) -> Iterator[Finding]:
    for end in sides.subscriptions:
        fitting = [one for one in same_type(end, sides.publishers) if not clash(one, end)]
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
            (link(end, "not connected"),),
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
        (near_miss(*pair),),
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
        (near_miss(near, sides.topic),) if near else (),
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
        (
            Mark(TOPIC, topic, words=("no node uses", "this name")),
            *((near_miss(near, topic),) if near else ()),
        ),
    )


def _how_to_start(scene: Scene) -> str:
    if scene.domain_id < 0:
        return ", with `ros.add(...)`"
    if scene.own:
        return ", with `ros.add(...)` or in a terminal"
    return " in a terminal, with `ros2 run`"


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
    last = f", the last at {at_time(beat.last_ns)}" if beat.last_ns >= 0 else ""
    return f": {count(beat.count, 'message')}{rate}{last}"


def _heard(beat: Beat) -> str:
    if beat.count < 0:
        return ""
    missed = f"; {count(beat.missed, 'message')} had been published before" if beat.missed else ""
    last = f", the last at {at_time(beat.last_ns)}" if beat.count and beat.last_ns >= 0 else ""
    ran = f"ran {count(beat.count, 'time')}" if beat.count else "has not run"
    return f": its callback {ran}{last}{missed}"


def arrival(sides: Sides, scene: Scene, rate_hz: float) -> str:
    """Say what arrives and where, if all is well.

    Of a listener in another process nobody here knows what its callbacks do.
    """
    own = [end for end in sides.subscriptions if end.node in scene.own]
    for beat in map(scene.beat, own):
        if drops(beat):
            return f"of the {beat.newest} newest messages, {beat.arrived} arrived at {beat.node}"
    listeners = nodes_of(own or sides.subscriptions) or "a subscription that is not shown here"
    if rate_hz:
        does = ("arrives at", "arrive at") if own else ("is sent to", "are sent to")
        return f"{comes(rate_hz, *does)} {listeners}"
    number = sum(scene.beat(end).count for end in sides.publishers if scene.beat(end).count > 0)
    was = "was" if number == 1 else "were"
    return (
        f"{count(number, 'message')} {'arrived at' if own else f'{was} sent to'} {listeners} so far"
    )


# The explanation.

#: The verdict if nothing is wrong.
WELL = "all-is-well"

#: The likelier a cause explains the others, the earlier it is named.
_ORDER = (
    *("node-ended", "callback-blocks", "not-spun", "type-mismatch", "qos-mismatch"),
    *("topic-misspelled", "other-domain", "not-rebuilt", "not-built", "topic-unknown"),
    *("no-publisher", "never-published", "gone-quiet", "first-messages-lost", "run-twice"),
    *("no-subscription", "slow-callback", UNKNOWN),
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
        tuple(link(end, "nothing seen") for end in sides.publishers),
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
