"""The three outcomes, and the reasons that every exercise shares."""

from __future__ import annotations

from rosbeat.diagnosis.mistakes import UNKNOWN, Diagnosis
from rosbeat.records import Fault, Observation, Outcome

PASSED, FAILED, NOT_ATTEMPTED = "passed", "failed", "not attempted"

#: What a learner replaces; the name is never defined, so running it raises a NameError.
BLANK = "____"

_STILL_BLANK = f"There is still a blank, {BLANK}, in the cell above."

#: Signs in an error, and what it means in an answer of a page.
_HINTS = (
    (
        ("invalid allocator", "existing topic name"),
        "What this error means: the topic exists already, with another message type. Both sides "
        "must use the same type.",
    ),
    (
        ("must be of type 'float'",),
        "A Float32 carries a float. 18 is an int: write 18.0, with a decimal point.",
    ),
    (
        ("'NoneType' object is not callable", "required positional argument: 'msg'"),
        "Hand over the method itself, without brackets after its name: ROS calls it later.",
    ),
    (
        ("NameError:",),
        "Python does not know this name. A text needs quotes; a method of the node needs self. "
        "before it.",
    ),
)


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
    """Whether an exception came from a blank that was not filled in."""
    return fault.kind == "NameError" and f"'{BLANK}'" in fault.text


def before_judging(exercise: str, observation: Observation) -> Outcome | None:
    """What can be said whatever the exercise asks: a blank, or an exception; else None."""
    if any(is_blank(fault) for fault in observation.faults):
        return not_attempted(exercise)
    if observation.faults:
        return _raised(exercise, observation.faults[0])
    return None


def _raised(exercise: str, fault: Fault) -> Outcome:
    if fault.callback in ("add", "run"):  # the session itself refused; its sentence is complete
        return failed(exercise, fault.text, "Hand over the class that you wrote, by its name.")
    where = f" Line {fault.line} of your cell: `{fault.code}`." if fault.line else ""
    return failed(
        exercise,
        f"{fault.callback} raised {fault.kind}: {_first_sentence(fault.text)}.{where}",
        _hint_for(fault),
    )


def _first_sentence(text: str) -> str:
    # Errors of the middleware go on for lines with addresses of its own source files.
    return text.split(", at ")[0].split("\n")[0].rstrip(".")


def _hint_for(fault: Fault) -> str:
    for signs, hint in _HINTS:
        if any(sign in f"{fault.kind}: {fault.text}" for sign in signs):
            return hint
    return (
        "An exception ends a node. Read the last sentence of the error first; it says what was "
        "expected there."
    )
