"""Diagnoses given in the clinic: read from a report, and held against what the charts show.

The scenario only calls the learner's function. The patients are examined here, where none of a
learner's code runs: of each ward and patient there is one chart, always the same.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING

from rosbeat.exercises.claims import Claim, claims_of, shape, ward_of
from rosbeat.exercises.exercise import failed, not_attempted, passed
from rosbeat.exercises.model import before_reading
from rosbeat.exercises.scenarios import Report
from rosbeat.records import Outcome

if TYPE_CHECKING:
    from rosbeat.clinic.charts import Chart

_EXAMPLE = 'check("{}", diagnoses)'


@dataclass(frozen=True)
class Rounds:
    """Diagnoses, and the patients that they are about.

    Attributes:
        report: What the learner's function gave back.
        charts: What the instruments show of the patients, each with what is the matter; none if the
            report cannot be read.
    """

    report: Report
    charts: tuple[Chart, ...] = ()


def examine(exercise: str, report: Report, patients: Sequence[int]) -> Rounds:
    """Examine the patients that a report is about.

    Args:
        exercise: The exercise's id.
        report: What the learner's function gave back.
        patients: Numbers of the patients that are asked for.
    """
    seed = ward_of(report.value)
    if seed is None or shape(exercise, report.value, patients):
        return Rounds(report)
    return Rounds(report, tuple(_chart(seed, one) for one in patients))


@lru_cache(maxsize=64)
def _chart(seed: int, number: int) -> Chart:
    """Examine a patient once: it is the same each time."""
    # Imported here: what is the matter with a patient is not known where an answer runs.
    from rosbeat.clinic.ward import Ward

    return Ward(seed).chart(number)


def judge(exercise: str, patients: Sequence[int]) -> Callable[[Report], Outcome]:
    """A judge of the diagnoses of some patients.

    Args:
        exercise: The exercise's id.
        patients: Numbers of the patients that are asked for.
    """
    return lambda report: judge_rounds(exercise, examine(exercise, report, patients), patients)


def judge_rounds(exercise: str, seen: Rounds, patients: Sequence[int]) -> Outcome:
    """Hold diagnoses against the charts of the patients.

    Args:
        exercise: The exercise's id.
        seen: The diagnoses, and the charts.
        patients: Numbers of the patients that are asked for.
    """
    early = before_reading(exercise, seen.report, _EXAMPLE.format(exercise))
    early = early or shape(exercise, seen.report.value, patients)
    if early:
        return early
    given = {one.number: claims_of(seen.report.value, one.number) for one in seen.charts}
    if not any(given.values()):
        return not_attempted(exercise, "No patient has a diagnosis yet.")
    return _of_all(exercise, seen, given)


def _of_all(exercise: str, seen: Rounds, given: dict[int, list[Claim]]) -> Outcome:
    from rosbeat.exercises.weighing import weighed

    weights = [(chart.number, weighed(chart, given[chart.number])) for chart in seen.charts]
    wrong = [(number, found) for number, found in weights if found is not None]
    right = _numbers(number for number, found in weights if found is None)
    if not wrong:
        return passed(exercise, f"{right} are diagnosed.")
    # Nobody has to have seen all patients before the first one is judged.
    said = [(n, found) for n, found in wrong if found.mistake != "no-diagnosis-yet"] or wrong[:1]
    evidence = " ".join(f"Patient {number}: {found.evidence}" for number, found in said)
    head = f"{right} {'is' if right.count(' ') == 1 else 'are'} right. " if right else ""
    worst = said[0][1]
    return failed(exercise, f"{head}{evidence}", worst.hint, worst.mistake)


def _numbers(numbers: Iterator[int]) -> str:
    found = [str(one) for one in numbers]
    if len(found) < 2:
        return f"patient {found[0]}".capitalize() if found else ""
    return f"Patients {', '.join(found[:-1])} and {found[-1]}"
