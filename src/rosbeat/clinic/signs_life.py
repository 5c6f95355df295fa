"""Find faults in the activity of nodes: whether they run, whether and how often they publish."""

from __future__ import annotations

from collections.abc import Iterator

from rosbeat.clinic.charts import Chart, Member, Talk
from rosbeat.diagnosis.silence import count, listing, seconds

#: Silent for more than so many times its usual gap, a publisher has stopped.
_GAPS = 3.0
_NO_NODE = "this diagnosis is about a node, but {} is a topic"


def _member(chart: Chart, node: str) -> Member | None:
    return next((one for one in chart.members if one.node == node), None)


def _has_ended(chart: Chart, node: str) -> bool:
    return any(fault.node == node for fault in chart.faults)


def _runs(chart: Chart, node: str) -> bool:
    member = _member(chart, node)
    return member is not None and member.spun and not _has_ended(chart, node)


# Whether a node runs.


def _ended(chart: Chart) -> Iterator[tuple[str, ...]]:
    for fault in chart.faults:
        yield (fault.node,)


def _unspun(chart: Chart) -> Iterator[tuple[str, ...]]:
    for member in chart.members:
        if not member.spun:
            yield (member.node,)


def _blocked(chart: Chart) -> Iterator[tuple[str, ...]]:
    """Never: a callback that does not return would have held up the whole session."""
    yield from ()


def _against_ended(chart: Chart, place: str) -> str:
    member = _member(chart, place)
    if member is None:
        return _NO_NODE.format(place)
    return f"no callback of {place} raised an exception in {seconds(chart.seconds)}"


def _against_unspun(chart: Chart, place: str) -> str:
    member = _member(chart, place)
    if member is None:
        return _NO_NODE.format(place)
    if member.callbacks:
        return f"callbacks of {place} ran {count(member.callbacks, 'time')}"
    return f"{place} is spun, but no message or timer has triggered a callback"


def _against_blocked(chart: Chart, place: str) -> str:
    member = _member(chart, place)
    if member is None:
        return _NO_NODE.format(place)
    if not member.callbacks:
        return f"no callback of {place} has started, so none can block the node"
    return f"{count(member.callbacks, 'callback')} of {place} ran, and each of them returned"


# Whether it speaks.


def _silent(chart: Chart) -> Iterator[tuple[str, ...]]:
    for talk in chart.talks:
        if not talk.count and _runs(chart, talk.node) and _is_driven(chart, talk.node):
            yield talk.node, talk.topic


def _is_driven(chart: Chart, node: str) -> bool:
    member = _member(chart, node)
    return member is not None and member.callbacks > 0


def _quiet(chart: Chart) -> Iterator[tuple[str, ...]]:
    for talk in chart.talks:
        end = _reason_until(chart, talk)
        if talk.gap and _runs(chart, talk.node) and end - talk.last > _GAPS * talk.gap:
            yield talk.node, talk.topic


def _reason_until(chart: Chart, talk: Talk) -> float:
    """Until when a node had a reason to speak: a timer always, a message when it came."""
    heard = chart.hears(talk.node)
    return max(one.last for one in heard) if heard else chart.seconds


def _against_silence(chart: Chart, place: str) -> str:
    talks = [one for one in chart.talks if place in (one.node, one.topic)]
    if not talks:
        return f"the orders require no publisher at {place}"
    return listing(_spoke(chart, talk) for talk in talks)


def _spoke(chart: Chart, talk: Talk) -> str:
    if talk.count == 1 and _is_once(chart, talk):
        said = f"{talk.node} has published its message on {talk.topic} at {talk.last:g} s"
        return f"{said}, and the orders require only one"
    if talk.count:
        said = f"{talk.node} has published {count(talk.count, 'message')} on {talk.topic}"
        return f"{said}, the last at {talk.last:g} s{_while(chart, talk)}"
    if not _is_driven(chart, talk.node):
        return f"no callback of {talk.node} that could call publish has run"
    return f"{talk.node} has never published on {talk.topic}"


def _is_once(chart: Chart, talk: Talk) -> bool:
    """Whether one message is all that was ordered."""
    mine = (talk.node, talk.topic, True)
    return any((one.node, one.topic, one.once) == mine for one in chart.orders.wiring)


def _while(chart: Chart, talk: Talk) -> str:
    heard = chart.hears(talk.node)
    if not heard:
        return " and then ended" if _has_ended(chart, talk.node) else ""
    return f", and received its last message at {max(one.last for one in heard):g} s"


# How many, and how often.


def _twins(chart: Chart) -> Iterator[tuple[str, ...]]:
    yield from ((node,) for node in set(chart.nodes) if chart.nodes.count(node) > 1)


def _against_twins(chart: Chart, place: str) -> str:
    number = len(chart.nodes)
    return f"the {number} nodes of this patient have {number} different names"


def _two_sources(chart: Chart) -> Iterator[tuple[str, ...]]:
    ordered = {(one.node, one.topic) for one in chart.orders.wiring if one.kind == "publisher"}
    topics = {topic for _, topic in ordered}
    for talk in chart.talks:
        if (talk.node, talk.topic) not in ordered and talk.topic in topics:
            yield talk.topic, talk.node


def _against_two_sources(chart: Chart, place: str) -> str:
    talks = [one for one in chart.talks if place in (one.node, one.topic)]
    if not talks:
        return f"there is no publisher at {place}"
    return listing(
        f"the orders require {one.node} to publish on {one.topic}"
        if len(_speakers(chart, one.topic)) > 1
        else f"only {one.node} publishes on {one.topic}"
        for one in talks
    )


def _speakers(chart: Chart, topic: str) -> list[str]:
    return [one.node for one in chart.talks if one.topic == topic]


def _off_rate(chart: Chart) -> Iterator[tuple[str, ...]]:
    for talk in chart.talks:
        if talk.topic == chart.orders.topic and talk.gap not in (0.0, chart.orders.period):
            yield talk.node, talk.topic


def _against_rate(chart: Chart, place: str) -> str:
    talks = [one for one in chart.talks if place in (one.node, one.topic) and one.gap]
    if not talks:
        return f"{place} publishes no messages, so it has no rate to check"
    return listing(_paced(chart, talk) for talk in talks)


def _paced(chart: Chart, talk: Talk) -> str:
    if chart.hears(talk.node):
        return f"{talk.node} publishes when it receives a message, not with a timer"
    if talk.topic != chart.orders.topic:
        return f"the orders give no rate for {talk.topic}"
    return f"{talk.node} publishes every {talk.gap:g} s, as ordered"


SIGNS = {
    "not-spun": (_unspun, _against_unspun),
    "callback-blocks": (_blocked, _against_blocked),
    "node-ended": (_ended, _against_ended),
    "never-published": (_silent, _against_silence),
    "gone-quiet": (_quiet, _against_silence),
    "run-twice": (_twins, _against_twins),
    "two-sources": (_two_sources, _against_two_sources),
    "wrong-rate": (_off_rate, _against_rate),
}
