"""From what a caller gives to what a picture needs, with an error that helps when it cannot be."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Protocol, runtime_checkable

from rosbeat.errors import PictureError
from rosbeat.records import INFRASTRUCTURE_TOPICS, GraphSnapshot, Observation, Sample
from rosbeat.viz.words import listing, nearest


@runtime_checkable
class Observer(Protocol):
    """Anything that can say what it has observed so far, such as a session."""

    def observation(self) -> Observation:
        """What was observed so far."""
        ...


#: Whatever `timeline` can draw from.
Observed = Observation | Observer
#: Whatever `values` can take its messages from.
Samples = Observed | Sequence[Sample]


def snapshot(source: Observed | GraphSnapshot) -> GraphSnapshot:
    """The graph in an observation, or the graph itself.

    Raises:
        PictureError: If `source` is neither.
    """
    if isinstance(source, GraphSnapshot):
        return source
    if isinstance(source, Observation | Observer):
        return observed(source).graph
    raise _wrong_kind(source, "an Observation or a GraphSnapshot")


def observed(source: Observed) -> Observation:
    """The observation itself, or the one of a session as far as it has run.

    Raises:
        PictureError: If it is neither.
    """
    if isinstance(source, Observation):
        return source
    if isinstance(source, Observer) and not isinstance(source, type):
        return source.observation()
    raise _wrong_kind(source, "an Observation")


def samples(source: Samples) -> tuple[Sample, ...]:
    """The messages in an observation or a sequence.

    Raises:
        PictureError: If `source` is neither, or holds anything but `Sample` records.
    """
    if isinstance(source, Observation | Observer):
        return observed(source).samples
    if isinstance(source, Iterable) and not isinstance(source, (str, bytes)):
        items = tuple(source)
        if all(isinstance(item, Sample) for item in items):
            return items
    raise _wrong_kind(source, "an Observation or a sequence of Sample records")


def topic_names(wanted: str | Iterable[str] | None, known: Sequence[str]) -> tuple[str, ...]:
    """Full names of the topics wanted; a missing leading slash is forgiven.

    Args:
        wanted: One name, several, or None for all but the infrastructure topics.
        known: The names that the source has.

    Raises:
        PictureError: If a name is not among the known ones.
    """
    if wanted is None:
        return tuple(name for name in known if name not in INFRASTRUCTURE_TOPICS)
    names = [wanted] if isinstance(wanted, str) else list(wanted)
    return tuple(dict.fromkeys(known_name(name, known, "topic") for name in names))


def known_name(name: str, known: Sequence[str], kind: str) -> str:
    """The full name for `name`, with or without its leading slash.

    Raises:
        PictureError: If it is not among `known`; it suggests the nearest one.
    """
    for candidate in (name, f"/{name}"):
        if candidate in known:
            return candidate
    guess = nearest(name, known)
    raise PictureError(
        f"There is no {kind} {name!r} in what was recorded.",
        f"Recorded: {listing(known)}." if known else f"No {kind} was recorded at all.",
        f"Did you mean {guess!r}?" if guess else "Check the name, or run the session longer.",
    )


def _wrong_kind(source: object, wanted: str) -> PictureError:
    return PictureError(
        f"A picture cannot be drawn from {type(source).__name__!r}.",
        f"It is drawn from recorded data: {wanted}.",
        "Give it the session, or what the session observed: `ros.observation()`.",
    )
