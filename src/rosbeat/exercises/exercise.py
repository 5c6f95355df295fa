"""Define an exercise, and the outcomes of a check."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, Generic, TypeVar

from rosbeat.diagnosis.exceptions import first_sentence, line_of
from rosbeat.diagnosis.mistakes import UNKNOWN, Diagnosis
from rosbeat.diagnosis.wires import why_raised
from rosbeat.records import Fault, Observation, Outcome

# What an exercise is.

Seen = TypeVar("Seen")


@dataclass(frozen=True)
class Exercise(Generic[Seen]):
    """One exercise.

    Attributes:
        id: Page number and a letter, such as `03a`.
        scenario: Runs an answer, or looks at what it left, and writes down what is there as plain
            data. The only part that runs foreign code.
        judge: A pure function from that to an outcome. Of a node it is asked only if the answer has
            no blank left and raised nothing.
        title: What it is about, a few words, such as `another sensor`.
        points: What a right answer is worth.
        hints: What `hint` gives, one more each time, from general to exact. The answer itself is
            not among them; `hint` gives it last.
        given: Makes what the scenario is handed besides an answer, by name, as plain data: what it
            needs where neither this room nor any file of an instructor's can be read.
        tells_hints: Whether a check says how many hints were used. They cost nothing.
        explains: Names the mistake behind an exception that means something else here than
            elsewhere; None leaves it to `diagnosis.faults`.
    """

    id: str
    scenario: Callable[..., Seen]
    judge: Callable[[Seen], Outcome]
    title: str = ""
    points: int = 1
    hints: tuple[str, ...] = ()
    given: Callable[[], dict[str, Any]] = dict
    tells_hints: bool = False
    explains: Callable[[Fault], Diagnosis | None] = lambda _: None

    def judged(self, seen: Seen) -> Outcome:
        """The outcome of what was seen, with its points; blanks and exceptions included."""
        early = None
        if isinstance(seen, Observation):
            early = before_judging(self.id, seen, self.explains)
        outcome = early or self.judge(seen)
        reached = self.points if outcome.status == PASSED else 0
        if outcome.parts:  # points for each requirement, whether the whole is right or not
            reached = sum(part.points for part in outcome.parts)
        return replace(outcome, points=reached, out_of=self.points)


# The three outcomes, and the reasons that every exercise shares.

PASSED, FAILED, NOT_ATTEMPTED = "passed", "failed", "not attempted"

#: What a learner replaces; the name is never defined, so running it raises a NameError.
BLANK = "____"

#: What to do about an exception that has no name here.
NEW_TO_ME = (
    "The last sentence of an error says what Python met and, often, what it expected there; the "
    "line says where. Print the values on that line before it runs."
)
_STILL_BLANK = f"There is still a blank, {BLANK}, in the cell above."


def passed(exercise: str, evidence: str, *remarks: str) -> Outcome:
    """The answer does what was asked; `remarks` are worth knowing all the same."""
    return Outcome(exercise, PASSED, evidence, remarks=remarks)


def failed(exercise: str, evidence: str, hint: str, mistake: str = UNKNOWN) -> Outcome:
    """The answer does something else; `evidence` says what, `hint` where to look.

    Args:
        exercise: The exercise's id.
        evidence: What was observed, one or two sentences.
        hint: Where to look, without the answer.
        mistake: Id of the mistake, from `diagnosis.mistakes`.
    """
    return Outcome(exercise, FAILED, evidence, hint, mistake)


def failed_by(exercise: str, diagnosis: Diagnosis) -> Outcome:
    """The answer failed, and the mistake was recognised."""
    return failed(exercise, diagnosis.evidence, diagnosis.hint, diagnosis.mistake)


def not_attempted(exercise: str, evidence: str = _STILL_BLANK) -> Outcome:
    """Nothing was tried yet: a blank is still a blank, or what was asked for is not there."""
    return Outcome(exercise, NOT_ATTEMPTED, evidence)


def is_blank(fault: Fault) -> bool:
    """Return whether an exception came from a blank that was not filled in."""
    return fault.kind == "NameError" and f"'{BLANK}'" in fault.text


def before_judging(
    exercise: str,
    observation: Observation,
    explains: Callable[[Fault], Diagnosis | None] = lambda _: None,
) -> Outcome | None:
    """Return what can be said whatever the exercise asks: a blank, or an exception; else None."""
    if any(is_blank(fault) for fault in observation.faults):
        return not_attempted(exercise)
    if observation.faults:
        fault = observation.faults[0]
        return _raised(exercise, fault, explains(fault) or why_raised(observation, fault))
    return None


def _raised(exercise: str, fault: Fault, known: Diagnosis | None) -> Outcome:
    if known is not None:
        return failed_by(exercise, known)
    if fault.callback in ("add", "run"):  # the session itself refused; its sentence is complete
        return failed(exercise, fault.text, "Hand over the class that you wrote, by its name.")
    return failed(
        exercise,
        f"{fault.callback} raised {fault.kind}: {first_sentence(fault.text)}.{line_of(fault)}",
        NEW_TO_ME,
    )
