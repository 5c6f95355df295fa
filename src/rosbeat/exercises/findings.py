"""What a learner found out about a system, laid beside what the system does.

Pure functions. What is true is read from a record of the system each time; nothing here knows it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.exercises import findings_facts as facts
from rosbeat.exercises.exercise import BLANK, failed, not_attempted, passed
from rosbeat.exercises.findings_facts import GreenhouseFindings, full
from rosbeat.exercises.model import before_reading
from rosbeat.exercises.scenarios import Report
from rosbeat.records import Outcome

_EXAMPLE = 'check("07a", findings)'
#: A rate that was measured may be off by so much of it.
_TOLERANCE = 0.06
_NUMBERS = ("number", "rate")
#: What is the matter with an answer of the right kind; None if no more can be said than that it is.
Doubt = Callable[[GreenhouseFindings, Any], Diagnosis | None]


@dataclass(frozen=True)
class Question:
    """One thing to find out.

    Attributes:
        key: How it is called in the dict of findings.
        kind: `node`, `topic`, `type`, `number`, or `rate` for a number that was measured.
        truth: The right answers, from a record of the system.
        doubt: What is the matter with a wrong answer.
        instrument: Where to look, without the answer.
    """

    key: str
    kind: str
    truth: Callable[[GreenhouseFindings], set[Any]]
    doubt: Doubt
    instrument: str


def judge_findings(
    exercise: str, seen: GreenhouseFindings, questions: tuple[Question, ...]
) -> Outcome:
    """Compare each finding with the system.

    Args:
        exercise: The exercise's id.
        seen: What was said, and the system.
        questions: What was to be found out.
    """
    early = before_reading(exercise, seen.said, _EXAMPLE)
    if early:
        return early
    said = seen.said.value
    if not isinstance(said, dict):
        evidence = f"The function gave back a {seen.said.type_name}."
        return failed(exercise, evidence, "Leave the dict with its keys as it was.", "other-kind")
    wrong = [found for found in (_asked(seen, one, said) for one in questions) if found]
    if wrong:
        more = f" And {len(wrong) - 1} more to look at again." if len(wrong) > 1 else ""
        first = wrong[0]
        return failed(exercise, first.evidence + more, first.hint, first.mistake)
    blank = [one.key for one in questions if _is_blank(said[one.key])]
    return _complete(exercise, len(questions), blank)


def _complete(exercise: str, count: int, blank: list[str]) -> Outcome:
    if not blank:
        return passed(exercise, f"All {count} findings agree with what the greenhouse does.")
    if len(blank) == count:
        return not_attempted(exercise)
    said = f"{count - len(blank)} of {count} are found, and right. Still open: {', '.join(blank)}."
    return not_attempted(exercise, said)


def _is_blank(given: object) -> bool:
    return isinstance(given, str) and given.strip() in (BLANK, "")


def _asked(seen: GreenhouseFindings, question: Question, said: dict[str, Any]) -> Diagnosis | None:
    """What is wrong with the answer to one question, or None; a blank is not wrong."""
    if question.key not in said:
        return Diagnosis(
            "finding-missing",
            f"There is nothing about `{question.key}` in what the function gives back.",
            "Leave the keys of the dict as they were; only the values change.",
        )
    given = said[question.key]
    if _is_blank(given):
        return None
    value = _of_kind(given, question.kind)
    if value is None:
        return _other_kind(question, given)
    if _is_true(value, question.truth(seen), question.kind == "rate"):
        return None
    plain = Diagnosis("finding-wrong", "The greenhouse says something else.", question.instrument)
    found = _near_kind(seen, question, value) or question.doubt(seen, value) or plain
    hint = found.hint or question.instrument
    return Diagnosis(found.mistake, _about(question, given, found.evidence), hint)


def _of_kind(given: Any, kind: str) -> Any:  # noqa: ANN401 - a number or a text
    """An answer as it is compared; None if it is of another kind."""
    if isinstance(given, bool):
        return None
    if kind in _NUMBERS:
        try:
            return float(given)
        except (TypeError, ValueError):
            return None
    if not isinstance(given, str):
        return None
    text = given.strip()
    return text.replace(".", "/") if kind == "type" else full(text)


def _is_true(value: Any, truth: set[Any], measured: bool = False) -> bool:  # noqa: ANN401
    # A number that somebody chose is exact; what was measured is not.
    return value in truth or (measured and any(_is_near(value, one) for one in truth))


def _is_near(value: float, wanted: float) -> bool:
    return abs(value - wanted) <= _TOLERANCE * wanted


def _other_kind(question: Question, given: object) -> Diagnosis:
    wanted = "a number" if question.kind in _NUMBERS else "a text in quotes"
    return Diagnosis(
        "other-kind",
        _about(question, given, f"What is asked for is {wanted}."),
        "Give the bare number." if _holds_number(question, given) else question.instrument,
    )


def _holds_number(question: Question, given: object) -> bool:
    return question.kind in _NUMBERS and any(sign.isdigit() for sign in str(given))


def _about(question: Question, given: object, evidence: str) -> str:
    return f"For '{question.key}' you wrote {given!r}. {evidence}"


def _near_kind(seen: GreenhouseFindings, question: Question, value: Any) -> Diagnosis | None:  # noqa: ANN401
    """A name, but of something else; or a name that nothing has."""
    if question.kind not in ("node", "topic"):
        return None
    nodes, topics = facts.nodes(seen), {*facts.topics(seen), *facts.INFRASTRUCTURE_TOPICS}
    mine, others = (nodes, topics) if question.kind == "node" else (topics, nodes)
    if value in mine:
        return None
    other = "topic" if question.kind == "node" else "node"
    if value in others:
        evidence = f"That is a {other}, and a {question.kind} is asked for."
        return Diagnosis("other-kind", evidence, question.instrument)
    return Diagnosis(
        "not-in-graph",
        f"The greenhouse has no {question.kind} of this name.",
        "Copy names from what an instrument shows, letter by letter.",
    )


def judge_report(said: Report) -> Outcome:
    """Judge what somebody says of the greenhouse of page 07, beside one of our own.

    Args:
        said: What the learner's function gave back.
    """
    return judge_greenhouse(facts.beside_the_greenhouse(said))


def judge_greenhouse(seen: GreenhouseFindings) -> Outcome:
    """Judge what was found out about the greenhouse of page 07."""
    return judge_findings("07a", seen, QUESTIONS)


# The doubts.


def _publisher(seen: GreenhouseFindings, given: str) -> Diagnosis | None:
    if given in facts.ends(seen, "/moisture", "subscription"):
        return Diagnosis(
            "sides-confused",
            f"{given} has a subscription there, and no publisher.",
            "Which of the two lists names those that send?",
        )
    return Diagnosis("finding-wrong", f"{given} has nothing to do with /moisture.", "")


def _type(seen: GreenhouseFindings, given: str) -> Diagnosis | None:
    if given.count("/") < 2:
        return Diagnosis(
            "name-incomplete",
            "A type's full name has three parts: package, `msg`, name.",
            "ros2 topic list -t shows it in brackets.",
        )
    if given.strip("[]") != given:
        evidence = "The brackets are not a part of the type's name."
        return Diagnosis("stray-characters", evidence, "What stands inside of them is the name.")
    used = [one for one in facts.topics(seen) if facts.type_of(seen, one) == given]
    said = f"That is the type of {used[0]}." if used else "No topic of the greenhouse has it."
    return Diagnosis("finding-wrong", said, "")


def _rate(seen: GreenhouseFindings, given: float) -> Diagnosis | None:
    rate = facts.rate(seen, "/moisture")
    if rate and abs(given * rate - 1) < _TOLERANCE:
        return Diagnosis(
            "period-for-rate",
            "That is the time from one message to the next, in seconds.",
            "A rate says how many there are in one second.",
        )
    same = [one for one in facts.topics(seen) if _is_near(given, facts.rate(seen, one))]
    said = f"That is the rate of {same[0]}." if same else "Messages come at another rate."
    return Diagnosis("finding-wrong", said, "")


def _depth(seen: GreenhouseFindings, given: float) -> Diagnosis | None:
    other = [one.qos.depth for one in seen.system.graph.on("/moisture", "publisher")]
    if given in other:
        return Diagnosis(
            "sides-confused",
            "So long is the queue of the publisher there.",
            "The other side of the topic has a queue of its own.",
        )
    return Diagnosis("finding-wrong", "That queue has another length.", "")


def _unheard(seen: GreenhouseFindings, given: str) -> Diagnosis | None:
    heard = facts.ends(seen, given, "subscription")
    mistake = "finding-wrong" if facts.ends(seen, given, "publisher") else "sides-confused"
    return _brought(given) or Diagnosis(mistake, f"{facts.listed(heard)} listens to it.", "")


def _unspoken(seen: GreenhouseFindings, given: str) -> Diagnosis | None:
    spoken = facts.ends(seen, given, "publisher")
    mistake = "finding-wrong" if facts.ends(seen, given, "subscription") else "sides-confused"
    return _brought(given) or Diagnosis(mistake, f"{facts.listed(spoken)} publishes there.", "")


def _brought(given: str) -> Diagnosis | None:
    if given not in facts.INFRASTRUCTURE_TOPICS:
        return None
    evidence = "Every node brings this one along; it is no work of the greenhouse's."
    return Diagnosis("finding-wrong", evidence, "")


def _warns(seen: GreenhouseFindings, given: str) -> Diagnosis | None:
    levels = sorted({one.level for one in seen.system.logs if full(one.name) == given})
    said = f"It logs, but only {facts.listed(levels)}." if levels else "It never logs a line."
    return Diagnosis("finding-wrong", said, "")


def _parameter(seen: GreenhouseFindings, given: float) -> Diagnosis | None:
    same = [name for name, value in seen.parameters.items() if given == value]
    if not same:
        hint = "If you have set it yourself: what was it when the greenhouse was started?"
        return Diagnosis("finding-wrong", "It has another value.", hint)
    return Diagnosis("finding-wrong", f"That is the value of `{same[0]}`.", "")


QUESTIONS = (
    Question("publisher of /moisture", "node",
             lambda seen: facts.ends(seen, "/moisture", "publisher"), _publisher,
             "ros2 topic info --verbose lists both sides of a topic."),
    Question("type of /moisture", "type",
             lambda seen: {facts.type_of(seen, "/moisture")}, _type,
             "ros2 topic list -t shows a topic's type in brackets."),
    Question("messages a second on /moisture", "rate",
             lambda seen: {facts.rate(seen, "/moisture")}, _rate,
             "ros2 topic hz measures it, if you wait for a second line."),
    Question("queue depth of /gardener for /moisture", "number",
             lambda seen: facts.depths(seen, "/gardener", "/moisture"), _depth,
             "Terminals are not told. The graph of the session is: look for depth in ros.graph()."),
    Question("topic without a listener", "topic",
             lambda seen: facts.one_sided(seen, "publisher", "subscription"), _unheard,
             "ros2 topic info counts both sides. Ask about each topic, or look at all nodes."),
    Question("topic without a publisher", "topic",
             lambda seen: facts.one_sided(seen, "subscription", "publisher"), _unspoken,
             "ros2 topic info counts both sides. Ask about each topic, or look at all nodes."),
    Question("node that warns", "node",
             lambda seen: {full(one.name) for one in seen.system.logs if one.level == "WARN"},
             _warns,
             "Log lines come over /rosout; the field level of a warning is 30."),
    Question("dry_below of /gardener", "number",
             lambda seen: {seen.parameters["/gardener dry_below"]}, _parameter,
             "ros2 param get takes the node and the parameter."),
)  # fmt: skip
