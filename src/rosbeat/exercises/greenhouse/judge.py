"""From what a greenhouse did in all trials to an outcome with points for each requirement."""

from __future__ import annotations

from collections.abc import Callable

from rosbeat.diagnosis.exceptions import diagnose_fault, first_sentence, line_of
from rosbeat.diagnosis.mistakes import UNKNOWN, Diagnosis
from rosbeat.exercises.exercise import FAILED, NEW_TO_ME, PASSED, failed, failed_by, not_attempted
from rosbeat.exercises.greenhouse.alarms import judge_alarms
from rosbeat.exercises.greenhouse.believing import judge_belief
from rosbeat.exercises.greenhouse.commands import judge_calm, judge_latecomers
from rosbeat.exercises.greenhouse.pump import judge_interlock, judge_pump
from rosbeat.exercises.greenhouse.reports import judge_reports
from rosbeat.exercises.greenhouse.rubric import Requirement, rubric_of
from rosbeat.exercises.greenhouse.structure import judge_endings, judge_parameters, judge_tasks
from rosbeat.exercises.greenhouse.trials import OTHER, Trials, is_hopeless
from rosbeat.exercises.greenhouse.vent import judge_vent
from rosbeat.records import Fault, Outcome, Part

Judge = Callable[[Trials], Diagnosis | None]

#: Who says whether a requirement is met: None if it is, or why not.
JUDGES: dict[str, Judge] = {
    "R1": judge_vent,
    "R2": judge_pump,
    "R3": judge_interlock,
    "R4": judge_alarms,
    "R5": judge_belief,
    "R6": judge_reports,
    "R7": judge_calm,
    "R8": judge_tasks,
    "R9": judge_endings,
    "R10": judge_latecomers,
    "R11": judge_parameters,
}


def judge_greenhouse(exercise: str, trials: Trials) -> Outcome:
    """Judge a greenhouse.

    Args:
        exercise: The exercise's id.
        trials: What it did.

    Returns:
        The outcome, with a part for each requirement; without any if there was no greenhouse.

    Raises:
        ExerciseError: If the trials were made with other numbers than the rubric's.
    """
    requirements = rubric_of(trials.numbers).requirements
    early = _before(exercise, trials)
    if early:
        return early
    found = {one.id: JUDGES[one.id](trials) for one in requirements}
    parts = tuple(_part(one, found[one.id]) for one in requirements)
    met = sum(part.met for part in parts)
    evidence = f"{met} of {len(parts)} requirements are met."
    fault = _fault(trials)
    missed = [part.id for part in parts if not (part.met or part.optional)]
    if not (fault or missed):
        return Outcome(exercise, PASSED, evidence, parts=parts)
    first = fault or found[missed[0]] or Diagnosis(UNKNOWN, "", "")
    evidence += f" {first.evidence}" if fault else f" Look at {missed[0]} first."
    return Outcome(exercise, FAILED, evidence, first.hint, first.mistake, parts=parts)


def _part(one: Requirement, wrong: Diagnosis | None) -> Part:
    evidence = wrong.evidence if wrong else ""
    return Part(one.id, one.text, wrong is None, evidence, one.points, not one.required)


def _before(exercise: str, trials: Trials) -> Outcome | None:
    """What can be said whatever the nodes do: a blank, no list, a list that is never made."""
    seen = trials.plain
    if any("'____'" in fault.text for fault in seen.faults):
        return not_attempted(exercise)
    if not is_hopeless(seen):
        return None
    fault = next((one for one in seen.faults if one.kind == "DeadlinePassed"), seen.faults[0])
    if fault.kind in ("NoSystemError", "SessionError"):
        hint = (
            f'The check wants the function: check("{exercise}", greenhouse). It returns a list of '
            "classes, or of pairs of a class and a dict that says how to start it."
        )
        return failed(exercise, fault.text, hint, "no-system")
    return failed_by(exercise, _raised(fault))


def _fault(trials: Trials) -> Diagnosis | None:
    """The first exception that ended a node, those of other limits left out: R11 tells of them."""
    faults = [one for name, seen in trials.runs.items() if name != OTHER for one in seen.faults]
    return _raised(faults[0]) if faults else None


def _raised(fault: Fault) -> Diagnosis:
    node = f"{fault.node}: " if fault.node else ""
    known = diagnose_fault(fault)
    if known:
        return Diagnosis(known.mistake, node + known.evidence, known.hint)
    if fault.callback in ("add", "run"):
        return Diagnosis("no-node", fault.text, "Hand over classes, or functions that make a node.")
    text = f"{node}{fault.callback} raised {fault.kind}: {first_sentence(fault.text)}."
    return Diagnosis(UNKNOWN, f"{text}{line_of(fault)}", NEW_TO_ME)
