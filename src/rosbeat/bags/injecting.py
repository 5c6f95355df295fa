"""Inject faults into a recording: define a fault, and apply it to the messages of a topic."""

from __future__ import annotations

from collections import defaultdict, deque
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

from rosbeat.bags import refusals
from rosbeat.bags.sources import Observer, full_name, observed
from rosbeat.errors import called_as
from rosbeat.records import Observation, Sample

#: What a fault does to the messages of one topic. Messages that are not there were lost; those in
#: between may come at other times.
Change = Callable[[Sequence[Sample]], Sequence[Sample]]


@dataclass(frozen=True, repr=False)
class InjectedFault:
    """Represent a fault of a sensor or of its connection, as a function from messages to messages.

    The function is pure: the same messages always give the same result.

    Attributes:
        words: Short description, such as `stuck from 20 s on`.
        topic: Full name of the only affected topic; empty for all topics.
        change: The function that is applied to the messages of one topic.
    """

    words: str
    topic: str
    change: Change

    def __repr__(self) -> str:
        return f"{self.topic}: {self.words}" if self.topic else self.words

    def __call__(self, samples: Sequence[Sample]) -> tuple[Sample, ...]:
        """Inject the fault into messages, topic by topic, and keep them in order of time."""
        known = dict.fromkeys(one.topic for one in samples)
        if self.topic and samples and self.topic not in known:
            raise refusals.unknown_topic(self.topic, known)
        groups = {topic: [one for one in samples if one.topic == topic] for topic in known}
        made = {topic: self._changed(topic, group) for topic, group in groups.items()}
        return _in_order(samples, made)

    def _changed(self, topic: str, group: Sequence[Sample]) -> Sequence[Sample]:
        return self.change(group) if self.topic in ("", topic) else group


def fault(words: str, topic: str | None, change: Change) -> InjectedFault:
    """Make a fault.

    Args:
        words: What goes wrong.
        topic: The topic that it concerns, or None for all.
        change: What it does to the messages of one topic.
    """
    return InjectedFault(words, full_name(topic) if topic is not None else "", change)


@called_as("bags.inject(bag, bags.stuck(at=20))")
def inject(
    source: Observation | Observer | Iterable[Sample], *faults: Change
) -> tuple[Sample, ...]:
    """Break a recording on purpose: the messages with some faults, one after the other.

    Args:
        source: A bag, a session, what it observed, or messages.
        faults: Faults, such as `stuck(at=20)`, or any function from messages to messages.

    Returns:
        New messages; those in `source` stay as they are.

    Raises:
        BagError: If a fault cannot be injected into these messages.
    """
    if isinstance(source, (list, tuple)):
        samples: tuple[Sample, ...] = tuple(source)
    else:
        samples = observed(source).samples  # type: ignore[arg-type]  # `observed` refuses others
    for one in faults:
        if not callable(one):
            raise refusals.no_fault(one)
        samples = tuple(one(samples))
    return samples


def _in_order(samples: Sequence[Sample], groups: dict[str, Sequence[Sample]]) -> tuple[Sample, ...]:
    """Messages of several topics by time; at equal times in the order in which they came before."""
    places: dict[tuple[str, int], deque[int]] = defaultdict(deque)
    for number, one in enumerate(samples):
        places[one.topic, one.time_ns].append(number)
    keyed = []
    for one in (one for group in groups.values() for one in group):
        before = places[one.topic, one.time_ns]
        keyed.append((one.time_ns, before.popleft() if before else len(samples), one))
    return tuple(one for *_, one in sorted(keyed, key=lambda key: key[:2]))
