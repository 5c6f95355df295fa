"""List the diagnoses that the clinic accepts, and say what contradicts each of them in a chart."""

from __future__ import annotations

from collections.abc import Callable

from rosbeat.clinic.charts import Chart, Published, Received
from rosbeat.clinic.systems import OVERSHOOT, STEP
from rosbeat.diagnosis.findings import count, listing, seconds
from rosbeat.diagnosis.mistakes import MISTAKES
from rosbeat.diagnosis.qos import incompatible
from rosbeat.errors import called_as
from rosbeat.records import Endpoint

#: Says what speaks against a diagnosis at a place: a full name of a node or topic.
_Contradiction = Callable[[Chart, str], str]
_PARTNER = {"publisher": "subscription", "subscription": "publisher"}
#: Readings that are not clamped do not go so far over the limits; another unit goes farther.
_FAR = 2 * OVERSHOOT
#: Two spans are the same if they differ by less: Float32 is not exact.
_SAME = 0.01


@called_as("clinic.names()")
def names() -> dict[str, str]:
    """Return the meaning of every diagnosis by its id, including diagnoses that never occur."""
    return {name: MISTAKES[name].title for name in KNOWN}


def contradiction(chart: Chart, name: str, place: str) -> str:
    """Return the evidence against a diagnosis, as the end of a sentence.

    Args:
        chart: The patient.
        name: Id of the mistake, one of `KNOWN`.
        place: Full name of a node or topic of the patient.
    """
    return _CONTRADICTIONS[name](chart, place)


# Names of topics.


def _name(evidence: str) -> _Contradiction:
    """What speaks against a wrong name; `evidence` does it where the name is wrong otherwise."""

    def contradict(chart: Chart, place: str) -> str:
        end = next((one for one in _misplaced(chart) if place in (one.node, one.name)), None)
        if end is None:
            used = sorted({one.name for one in chart.at(place)})
            return f"the names used there are spelled as ordered: {listing(used)}"
        if _partners(chart, end):
            return f"{end.name} has both a publisher and a subscription"
        return evidence.format(topic=end.name, node=end.node)

    return contradict


def _misplaced(chart: Chart) -> list[Endpoint]:
    """Endpoints on another topic than was ordered."""
    found = []
    for order in chart.spec.wiring:
        mine = [one for one in chart.endpoints if (one.node, one.kind) == (order.node, order.kind)]
        if all(one.name != order.topic for one in mine):
            found += mine[:1]
    return found


def _partners(chart: Chart, end: Endpoint) -> list[Endpoint]:
    return [one for one in chart.at(end.name) if one.kind == _PARTNER[end.kind]]


# Connections.


def _qos(chart: Chart, place: str) -> str:
    return listing(_matched(chart, end) for end in chart.at(place))


def _matched(chart: Chart, end: Endpoint) -> str:
    partners = _partners(chart, end)
    if not partners:
        return f"{end.name} has no endpoint that {end.node} could be incompatible with"
    fitting = sum(_fits(end, one) for one in partners)
    noun = _PARTNER[end.kind] + ("" if len(partners) == 1 else "s")
    return f"{end.node} is matched with {fitting} of {len(partners)} {noun} on {end.name}"


def _fits(one: Endpoint, other: Endpoint) -> bool:
    publisher, subscription = (one, other) if one.kind == "publisher" else (other, one)
    return not incompatible(publisher.qos, subscription.qos)


def _types(chart: Chart, place: str) -> str:
    types = {f"{end.name} has {end.type_name.rpartition('/')[2]}" for end in chart.at(place)}
    return f"all endpoints there use the same type: {listing(sorted(types))}"


def _depth(chart: Chart, place: str) -> str:
    burst = chart.spec.burst
    at_once = "one message arrives" if burst == 1 else f"{burst} messages arrive"
    said = [
        f"the queue of {end.node} on {end.name} holds {end.qos.depth}, and {at_once} at once"
        for end in chart.at(place)
        if end.kind == "subscription"
    ]
    return listing(said) or "it has no subscription, so it has no queue for incoming messages"


def _lost(chart: Chart, place: str) -> str:
    said = [_since_start(one) for one in chart.received_at(place)]
    return listing(said) or "it has no subscription that could have missed a message"


def _since_start(one: Received) -> str:
    if not one.before:
        return f"no message was published on {one.topic} before {one.node} subscribed"
    return f"{one.sent} messages reached the queue of {one.node} after it subscribed to {one.topic}"


# Whether a node runs.


def _node(describe: Callable[[Chart, str, int], str]) -> _Contradiction:
    """What speaks against a fault of a node, given how many of its callbacks ran."""

    def contradict(chart: Chart, place: str) -> str:
        if place not in chart.callbacks:
            return f"this diagnosis is about a node, but {place} is a topic"
        return describe(chart, place, chart.callbacks[place])

    return contradict


def _not_ended(chart: Chart, node: str, ran: int) -> str:
    return f"no callback of {node} raised an exception in {seconds(chart.seconds)}"


def _spun(chart: Chart, node: str, ran: int) -> str:
    if ran:
        return f"callbacks of {node} ran {count(ran, 'time')}"
    return f"{node} is spun, but no message or timer has triggered a callback"


def _not_blocked(chart: Chart, node: str, ran: int) -> str:
    if ran:
        return f"{count(ran, 'callback')} of {node} ran, and each of them returned"
    return f"no callback of {node} has started, so none can block the node"


# Whether, how often and by whom something is published.


def _silence(chart: Chart, place: str) -> str:
    said = [_spoke(chart, one) for one in chart.published_at(place)]
    return listing(said) or f"the orders require no publisher at {place}"


def _spoke(chart: Chart, one: Published) -> str:
    ordered = {(wiring.node, wiring.topic): wiring for wiring in chart.spec.wiring}
    wiring = ordered.get((one.node, one.topic))
    if one.count == 1 and wiring and wiring.once:
        said = f"{one.node} has published its message on {one.topic} at {one.last:g} s"
        return f"{said}, and the orders require only one"
    if one.count:
        said = f"{one.node} has published {count(one.count, 'message')} on {one.topic}"
        return f"{said}, the last at {one.last:g} s{_until(chart, one.node)}"
    if not chart.callbacks[one.node]:
        return f"no callback of {one.node} that could call publish has run"
    return f"{one.node} has never published on {one.topic}"


def _until(chart: Chart, node: str) -> str:
    received = chart.received_at(node)
    if received:
        return f", and received its last message at {max(one.last for one in received):g} s"
    return " and then ended" if node in chart.ended else ""


def _twice(chart: Chart, place: str) -> str:
    number = len(chart.nodes)
    return f"the {number} nodes of this patient have {number} different names"


def _sources(chart: Chart, place: str) -> str:
    said = [
        f"the orders require {one.node} to publish on {one.topic}"
        if len(chart.published_at(one.topic)) > 1
        else f"only {one.node} publishes on {one.topic}"
        for one in chart.published_at(place)
    ]
    return listing(said) or f"there is no publisher at {place}"


def _rate(chart: Chart, place: str) -> str:
    said = [_paced(chart, one) for one in chart.published_at(place) if one.period]
    return listing(said) or f"{place} publishes no messages, so it has no rate to check"


def _paced(chart: Chart, one: Published) -> str:
    if chart.received_at(one.node):
        return f"{one.node} publishes when it receives a message, not with a timer"
    if one.topic != chart.spec.topic:
        return f"the orders give no rate for {one.topic}"
    return f"{one.node} publishes every {one.period:g} s, as ordered"


# Published values.


def _values(least_over: float = 0, most_over: float = 0, note: str = "") -> _Contradiction:
    """The readings beside the order, with a note if that alone does not speak against the fault.

    The note is for readings that go over the limits by more than `least_over`, and by `most_over`
    at most.
    """

    def contradict(chart: Chart, place: str) -> str:
        spec, said = chart.spec, []
        for one in chart.published_at(place):
            if one.topic == spec.topic and one.values:
                least, most = float(one.values[0]), float(one.values[-1])
                over = max(spec.least - least, most - spec.most)
                text = (
                    f"{one.node} published numbers from {least:.5g} to {most:.5g} on {one.topic}, "
                    f"while the orders say {spec.least:g} to {spec.most:g}"
                )
                if least_over < over <= most_over:
                    text += "; " + note.format(over=over)
                elif note and over > _FAR:
                    text += "; " + _far_outside(spec.most - spec.least, most - least)
                said.append(text)
        return listing(said) or "no reading in degrees comes from that place"

    return contradict


def _far_outside(ordered: float, span: float) -> str:
    """Readings far beyond the limits are none that went over them a little."""
    # Kelvin moves all readings alike; Fahrenheit spreads them, too.
    if abs(span - ordered) < _SAME:
        return f"they span {ordered:g} degrees, as ordered"
    return f"they are more than {_FAR:g} degrees outside, as no Celsius reading of this room can be"


def _boundary(chart: Chart, place: str) -> str:
    limits = [f"{limit:.1f}" for limit in (chart.spec.low, chart.spec.high)]
    said = [
        f"{one.node} says {value!r}, but a reading at a limit is Normal"
        for one in chart.published_at(place)
        for value in one.values
        if isinstance(value, str) and value.split()[0] in limits
    ]
    return listing(said) or "no node there has judged a reading that is exactly at a limit"


#: By the id of the mistake; more than ever occur.
_CONTRADICTIONS: dict[str, _Contradiction] = {
    "topic-misspelled": _name("the last part of {topic} is spelled as ordered"),
    "wrong-namespace": _name("{topic} is in the namespace that the orders require"),
    "wrong-topic": _name("only {node} uses {topic}, so it is not another topic of this system"),
    "qos-mismatch": _qos,
    "type-mismatch": _types,
    "depth-too-small": _depth,
    "first-messages-lost": _lost,
    "not-spun": _node(_spun),
    "callback-blocks": _node(_not_blocked),
    "node-ended": _node(_not_ended),
    "never-published": _silence,
    "gone-quiet": _silence,
    "run-twice": _twice,
    "two-sources": _sources,
    "wrong-rate": _rate,
    "wrong-unit": _values(
        *(0, _FAR),
        "they are at most {over:g} outside, but in another unit all of them would be",
    ),
    "never-changes": _values(),
    "no-clamp": _values(
        *(0, STEP),
        "they are at most {over:g} outside, but unclamped readings would go farther",
    ),
    "clamped-too-early": _values(
        *(STEP, _FAR),
        "they are {over:g} outside, but a clamp before the step allows one step at most",
    ),
    "boundary": _boundary,
}
KNOWN = tuple(_CONTRADICTIONS)
