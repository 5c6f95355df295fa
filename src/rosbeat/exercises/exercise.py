"""Define an exercise, and what a judge says of an answer."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Generic, TypeAlias, TypeVar

from rosbeat.diagnosis.connections import why_raised
from rosbeat.diagnosis.exceptions import first_sentence, line_of
from rosbeat.diagnosis.mistakes import UNKNOWN, Diagnosis
from rosbeat.exercises.random_inputs import PAGE, Draw
from rosbeat.records import Fault, Observation, Outcome

if TYPE_CHECKING:
    from rosbeat.viz import Picture

# What an exercise is.

Seen = TypeVar("Seen")
#: What a judge says: that the answer passed or was not attempted, or the mistake that it shows. The
#: exercise's id and the points are filled in by `Exercise.outcome`.
Verdict: TypeAlias = Outcome | Diagnosis


@dataclass(frozen=True)
class Exercise(Generic[Seen]):
    """Define one exercise.

    Attributes:
        id: Page number and a letter, such as `03a`.
        scenario: Runs an answer, or looks at what it left, and writes down what is there as plain
            data. The only part that runs foreign code. It gets the answer, and the inputs if there
            are any to draw.
        judge: A pure function from that, and the inputs, to a verdict. Of a node it is asked only
            if the answer has no blank left and raised nothing.
        title: What it is about, a few words, such as `another sensor`.
        points: What a right answer is worth.
        hints: What `hint` gives, one more each time, from general to exact. The answer itself is
            not among them; `hint` gives it last.
        draw: Draws the inputs of a run, such as readings; None if nothing is fed to an answer.
        given: Makes what the scenario is handed besides an answer, by name, as plain data: what it
            needs where neither this room nor any file of an instructor's can be read.
        tells_hints: Whether a check says how many hints were used. They cost nothing.
        explains: Names the mistake behind an exception that means something else here than
            elsewhere; None leaves it to `diagnosis.faults`.
        picture: Draws what was seen, for a page, which shows it above the outcome; None for
            nothing to show.
    """

    id: str
    scenario: Callable[..., Seen]
    judge: Callable[..., Verdict]
    title: str = ""
    points: int = 1
    hints: tuple[str, ...] = ()
    draw: Callable[[Draw], Any] | None = None
    given: Callable[[], dict[str, Any]] = dict
    tells_hints: bool = False
    explains: Callable[[Fault], Diagnosis | None] = lambda _: None
    picture: Callable[[Seen], Picture | None] = lambda _: None

    def inputs(self, seed: int = PAGE) -> tuple[Any, ...]:
        """Return what scenario and judge get for a seed, beside answer and evidence."""
        return () if self.draw is None else (self.draw(Draw(seed)),)

    def observed(self, answer: Any, seed: int = PAGE, **given: Any) -> Seen:  # noqa: ANN401 - any
        """Run the scenario with an answer, whatever that is, and return what was seen.

        Args:
            answer: What a learner handed over.
            seed: Of the inputs.
            given: What `given` makes; made here by default.
        """
        return self.scenario(answer, *self.inputs(seed), **(given or self.given()))

    def judged(self, seen: Seen, seed: int = PAGE) -> Outcome:
        """Return the outcome of what was seen, blanks and exceptions included.

        Args:
            seen: What the scenario has written down.
            seed: Of the inputs with which it ran.
        """
        early = before_judging(seen, self.explains) if isinstance(seen, Observation) else None
        return self.outcome(early or self.judge(seen, *self.inputs(seed)))

    def outcome(self, verdict: Verdict) -> Outcome:
        """Return a verdict as an outcome of this exercise, with its points.

        Points are whole: of a part that is right, those that it has reached.
        """
        share = float(not isinstance(verdict, Diagnosis) and verdict.status == PASSED)
        if isinstance(verdict, Diagnosis):
            share = verdict.share
            verdict = failed(self.id, verdict.evidence, verdict.hint, verdict.mistake)
        reached = int(self.points * share + 1e-9)  # 3 * (1 / 3) may be a little less than 1
        if verdict.parts:  # points for each requirement, whether the whole is right or not
            reached = sum(part.points for part in verdict.parts)
        return replace(verdict, exercise=self.id, points=reached, out_of=self.points)


# What judges return, and the reasons that every exercise shares.

PASSED, FAILED, NOT_ATTEMPTED = "passed", "failed", "not attempted"

#: What a learner replaces; the name is never defined, so running it raises a NameError.
BLANK = "____"
#: Why a file may be as it was although somebody has begun to fill in its cell.
NOT_SAVED = f"A cell that still has a blank, {BLANK}, is not saved."

#: What to do about an exception that has no name here.
NEW_TO_ME = (
    "The last sentence of an error says what Python met and, often, what it expected there; the "
    "line says where. Print the values on that line before it runs."
)
_STILL_BLANK = f"There is still a blank, {BLANK}, in the cell above."


def passed(evidence: str, *remarks: str) -> Outcome:
    """Return the verdict on a right answer; `remarks` are worth knowing all the same."""
    return Outcome("", PASSED, evidence, remarks=remarks)


def not_attempted(evidence: str = _STILL_BLANK) -> Outcome:
    """Return the verdict if a blank is still a blank, or what was asked for is not there."""
    return Outcome("", NOT_ATTEMPTED, evidence)


def failed(exercise: str, evidence: str, hint: str, mistake: str = UNKNOWN) -> Outcome:
    """Return a failed outcome; judges return a `Diagnosis` instead.

    Args:
        exercise: The exercise's id.
        evidence: What was observed, one or two sentences.
        hint: Where to look, without the answer.
        mistake: Id of the mistake, from `diagnosis.mistakes`.
    """
    return Outcome(exercise, FAILED, evidence, hint, mistake)


def is_blank(fault: Fault) -> bool:
    """Return whether an exception came from a blank that was not filled in."""
    return fault.kind == "NameError" and f"'{BLANK}'" in fault.text


def before_judging(
    observation: Observation, explains: Callable[[Fault], Diagnosis | None] = lambda _: None
) -> Verdict | None:
    """Return what can be said whatever the exercise asks: a blank, or an exception; else None."""
    if any(is_blank(fault) for fault in observation.faults):
        return not_attempted()
    if not observation.faults:
        return None
    fault = observation.faults[0]
    return explains(fault) or why_raised(observation, fault) or _unexplained(fault)


def _unexplained(fault: Fault) -> Diagnosis:
    if fault.callback in ("add", "run"):  # the session itself refused; its sentence is complete
        return Diagnosis(UNKNOWN, fault.text, "Hand over the class that you wrote, by its name.")
    raised = f"{fault.callback} raised {fault.kind}: {first_sentence(fault.text)}.{line_of(fault)}"
    return Diagnosis(UNKNOWN, raised, NEW_TO_ME)
