"""What an explanation is put together from: a finding, marks in the graph, and words."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.records import NANOSECONDS, Endpoint, QoS

#: Kinds of marks.
LINK, NODE, TWINS, NEAR, TOPIC = "link", "node", "twins", "near", "topic"


@dataclass(frozen=True)
class Mark:
    """A place in the graph where a cause is.

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
    """One cause.

    Attributes:
        diagnosis: The mistake, with evidence and hint.
        headline: What is the matter, one sentence without its end.
        marks: Where in the graph.
    """

    diagnosis: Diagnosis
    headline: str
    marks: tuple[Mark, ...] = ()


def finding(
    mistake: str, headline: str, evidence: str, hint: str, marks: Iterable[Mark] = ()
) -> Finding:
    """Put a finding together."""
    return Finding(Diagnosis(mistake, evidence, hint), headline, tuple(marks))


def link(end: Endpoint, *words: str) -> Mark:
    """Mark the link between an endpoint's node and its topic."""
    return Mark(LINK, end.node, end.name, words, end.kind)


def listing(names: Iterable[str], last: str = "and") -> str:
    """Names as a sentence has them, each once: `a`, `a and b`, `a, b and c`."""
    items = list(dict.fromkeys(names))
    if len(items) < 2:
        return "".join(items)
    return f"{', '.join(items[:-1])} {last} {items[-1]}"


def nodes_of(ends: Iterable[Endpoint]) -> str:
    """The nodes of some endpoints, as a sentence has them."""
    return listing(end.node for end in ends)


def count(number: int, noun: str) -> str:
    """A number with its noun: `1 message`, `no messages`."""
    return f"{number or 'no'} {noun}{'' if number == 1 else 's'}"


def verb(ends: Iterable[Endpoint], one: str, many: str) -> str:
    """The form of a verb that fits the number of nodes."""
    return one if len({end.node for end in ends}) == 1 else many


def short_type(name: str) -> str:
    """A type as the page's code calls it: `Float32`."""
    return name.rsplit("/", 1)[-1]


def rate_words(rate_hz: float) -> str:
    """A rate as a person says it: `1 message a second`, `a message every 2 s`."""
    if rate_hz < 0.95:
        return f"a message every {_two_digits(1 / rate_hz)} s"
    rate = _two_digits(rate_hz)
    return f"{rate} message{'' if rate == '1' else 's'} a second"


def comes(rate_hz: float, one: str, many: str) -> str:
    """A rate with its verb: `1 message a second comes`, `4 messages a second come`."""
    words = rate_words(rate_hz)
    return f"{words} {many if ' messages ' in words else one}"


def qos_words(qos: QoS) -> str:
    """What matters of a quality of service."""
    said = [qos.reliability, qos.durability, *([f"depth {qos.depth}"] if qos.depth else [])]
    for name, limit in (("deadline", qos.deadline_ns), ("lifespan", qos.lifespan_ns)):
        said += [f"{name} {limit / NANOSECONDS:g} s"] if limit else []
    return ", ".join(said)


def seconds(value: float) -> str:
    """A time in seconds: `3 s`, `0.25 s`."""
    return f"{value:.3g} s" if value < 100 else f"{value:.0f} s"


def _two_digits(value: float) -> str:
    # A clock that is measured is never exact: 0.9987 a second is one a second.
    return f"{float(f'{value:.2g}'):g}"
