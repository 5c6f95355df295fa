"""What was published on a topic, and why there is nothing to judge."""

from __future__ import annotations

from collections.abc import Collection

from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.diagnosis.wires import Wire, why_not_published
from rosbeat.records import Observation, Sample

_SILENT = Diagnosis(
    "new-to-me",
    "Nothing was published on {topic}.",
    "Follow the data: what calls the callback, and does the callback call publish?",
)


def on(observation: Observation, wire: Wire) -> list[Sample]:
    """All messages on a topic, of whatever type, in order."""
    return [sample for sample in observation.samples if sample.topic == wire.topic]


def missing(
    observation: Observation,
    wire: Wire,
    besides: Collection[str] = (),
    otherwise: Diagnosis = _SILENT,
) -> Diagnosis | None:
    """Say why there is too little to judge on a topic.

    Args:
        observation: What the node did.
        wire: Where it should have published, and what.
        besides: Full names of other topics on which it is to publish as well.
        otherwise: What is said of a silence that nothing explains; `{topic}` stands for the name.

    Returns:
        The mistake; None if messages of the right type were published there.
    """
    heard = on(observation, wire)
    if heard and heard[0].type_name != wire.type_name:
        return Diagnosis(
            "type-mismatch",
            f"The messages on {wire.topic} are of type {heard[0].type_name}.",
            f"Both sides of a topic have to agree on the type: here it is {wire.type_name}.",
        )
    if heard:
        return None
    evidence = otherwise.evidence.format(topic=wire.topic)
    unexplained = Diagnosis(otherwise.mistake, evidence, otherwise.hint)
    return why_not_published(observation, wire, besides) or unexplained
