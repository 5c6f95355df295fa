"""Put an explanation together: a finding, marks in the graph, and words. Pure functions."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from difflib import SequenceMatcher

from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.diagnosis.qos import incompatible
from rosbeat.records import NANOSECONDS, Endpoint, GraphSnapshot, QoS

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
    marks: tuple[Mark, ...] = ()

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


def near_miss(one: str, other: str) -> Mark:
    """Mark two topics whose names are almost the same."""
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


def at_time(time_ns: int) -> str:
    """Return a time of the session in seconds: `3.5 s`."""
    return f"{time_ns / NANOSECONDS:.6g} s"


def _two_digits(value: float) -> str:
    # A clock that is measured is never exact: 0.9987 a second is one a second.
    return f"{float(f'{value:.2g}'):g}"


# The two sides of a topic.


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


def same_type(end: Endpoint, others: Iterable[Endpoint]) -> list[Endpoint]:
    """Return those of some endpoints that have the type of this one."""
    return [one for one in others if one.type_name == end.type_name]


def clash(publisher: Endpoint, subscription: Endpoint) -> tuple[str, ...]:
    """Return the QoS policies in which two endpoints are incompatible."""
    return incompatible(publisher.qos, subscription.qos)
