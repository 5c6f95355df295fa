"""Why nothing arrives on a topic: from what was seen to an explanation. Pure functions."""

from __future__ import annotations

from dataclasses import dataclass, field
from html import escape
from textwrap import fill

from rosbeat.diagnosis.explanation_elsewhere import elsewhere, stale
from rosbeat.diagnosis.explanation_links import Sides, links, sides_of
from rosbeat.diagnosis.explanation_nodes import nodes
from rosbeat.diagnosis.explanation_parts import Finding, Mark, finding, link
from rosbeat.diagnosis.explanation_report import arrival, report
from rosbeat.diagnosis.mistakes import UNKNOWN, Diagnosis
from rosbeat.diagnosis.situation import Scene
from rosbeat.records import GraphSnapshot

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
    """Why nothing arrives on a topic, or that all is well; shows itself at the end of a cell.

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
        """Whether nothing is wrong."""
        return self.verdict == WELL

    @property
    def title(self) -> str:
        """What is the matter, one sentence."""
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
        seen = "".join(f"<li>{escape(one)}</li>" for one in self.sentences)
        head = f"<strong>{self._sign} {escape(self.title)}</strong>"
        return f'<div style="{style}">{head}{causes}<ul style="margin:0.3em 0">{seen}</ul></div>'

    @property
    def _sign(self) -> str:
        return "\N{CHECK MARK}" if self.is_well else "\N{BALLOT X}"

    def _html_of(self, number: int) -> str:
        one = self.diagnoses[number]
        also = f"<strong>Also: {escape(self.headlines[number])}.</strong> " if number else ""
        return f"<div>{also}{escape(one.evidence)}<br><em>Hint:</em> {escape(one.hint)}</div>"


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
        found[0].diagnosis.mistake,
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
    return finding(
        UNKNOWN,
        "this is new to me",
        "Both sides are there and fit, and whether messages come could not be seen.",
        "Listen yourself, in a terminal: "
        f"`ros2 topic echo {sides.topic}`. If that knows no such message type, run `source "
        "install/setup.bash` in the workspace first.",
        [link(end, "nothing seen") for end in sides.publishers],
    )


def _ordered(found: list[Finding]) -> list[Finding]:
    rank = {name: number for number, name in enumerate(_ORDER)}
    return sorted(found, key=lambda one: rank.get(one.diagnosis.mistake, len(rank)))


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
