"""What a system said at its outputs, as the judges of the requirements read it."""

from __future__ import annotations

from bisect import bisect_right
from dataclasses import dataclass

from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.diagnosis.silence import difference, nearest
from rosbeat.records import Observation, Sample

#: The agreed outputs and their types.
OUTPUTS = {
    "/vent": "std_msgs/msg/Bool",
    "/pump": "std_msgs/msg/Bool",
    "/alarm": "std_msgs/msg/String",
    "/report": "std_msgs/msg/Float32",
}
INPUTS = ("/temperature", "/humidity")
#: Slack for comparisons of times, in seconds.
EPS = 1e-6


@dataclass(frozen=True)
class Switch:
    """What a topic of True and False said: off until the first True.

    Attributes:
        commands: When which command was published, in order.
    """

    commands: tuple[tuple[float, bool], ...]

    def at(self, time: float) -> bool:
        """How it stands at a time, what is published then included."""
        place = bisect_right([when for when, _ in self.commands], time + EPS)
        return self.commands[place - 1][1] if place else False

    def spans(self, end: float) -> list[tuple[float, float]]:
        """From when to when it was on; a span that is open lasts until `end`."""
        found: list[tuple[float, float]] = []
        since: float | None = None
        for when, is_on in (*self.commands, (end, False)):
            if is_on and since is None:
                since = when
            elif not is_on and since is not None:
                found.append((since, when))
                since = None
        return [(begin, until) for begin, until in found if until > begin]


def said(seen: Observation, topic: str) -> list[Sample]:
    """What was published on a topic, in order."""
    return [sample for sample in seen.samples if sample.topic == topic]


def switch(seen: Observation, topic: str) -> Switch:
    """The commands on a topic."""
    return Switch(tuple((one.time, bool(one.value)) for one in said(seen, topic)))


def silent(seen: Observation, topic: str) -> Diagnosis | None:
    """Why nothing that can be read was published on an output; None if something was."""
    wanted = OUTPUTS[topic]
    ends = seen.graph.on(topic, "publisher")
    wrong = next((end for end in ends if end.type_name != wanted), None)
    if wrong:
        return Diagnosis(
            "type-mismatch",
            f"{wrong.node} publishes {wrong.type_name} on {topic}; agreed is {wanted}.",
            "One topic carries one type, and all sides have to name the same one.",
        )
    if said(seen, topic):
        return None
    if ends:
        evidence = f"{ends[0].node} has a publisher on {topic}, and nothing was published there."
        hint = "Does the callback that publishes run at all? To what does its node listen?"
        return Diagnosis("never-published", evidence, hint)
    return no_publisher(seen, topic)


def no_publisher(seen: Observation, topic: str) -> Diagnosis:
    """What to say of an output that nobody publishes."""
    names = {end.name for end in seen.graph.endpoints if end.kind == "publisher"} - set(OUTPUTS)
    near = nearest(topic, names)
    if near:
        evidence = (
            f"Somebody publishes on {near}, and {topic} is agreed: {difference(near, topic)}."
        )
        hint = "Names of topics match letter by letter, whatever stands before a slash included."
        return Diagnosis("topic-misspelled", evidence, hint)
    evidence = f"No node has a publisher on {topic}."
    return Diagnosis("no-publisher", evidence, "Which node of your drawing has this task?")


def stamp(time: float) -> str:
    """A time for evidence."""
    return f"{round(time, 2):g} s"
