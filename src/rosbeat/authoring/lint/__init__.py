"""The rules of a lesson, one small function each.

A lint takes a `Desk` (the lesson, its neighbours, the course's folders) and yields a `Finding` for
every place that breaks its rule. To add one, write the function and put it in `LINTS`.
"""

from __future__ import annotations

from rosbeat.authoring.lint.blanks import blank_outside_function, stray_blank, syntax
from rosbeat.authoring.lint.budgets import cell_budget, page_budget
from rosbeat.authoring.lint.desk import Desk, Finding, Lint
from rosbeat.authoring.lint.exercises import answer_outside_exercise, exercise_names, exercise_pairs
from rosbeat.authoring.lint.headings import heading_levels, heading_numbers, title
from rosbeat.authoring.lint.leaks import leaked_answer
from rosbeat.authoring.lint.links import alt_text, broken_link
from rosbeat.authoring.lint.marks import answer_markers
from rosbeat.authoring.lint.numbering import page_numbers
from rosbeat.authoring.lint.predictions import predictions
from rosbeat.authoring.lint.prose import code_as_prose, prose_as_code
from rosbeat.authoring.lint.running import endless, machine_path, unseen_by_nbval
from rosbeat.authoring.source import Course, Lesson

__all__ = ["LINTS", "Desk", "Finding", "Lint", "check_lessons"]

LINTS: tuple[Lint, ...] = (
    leaked_answer,
    prose_as_code,
    code_as_prose,
    syntax,
    blank_outside_function,
    stray_blank,
    answer_outside_exercise,
    exercise_names,
    exercise_pairs,
    predictions,
    cell_budget,
    page_budget,
    broken_link,
    alt_text,
    page_numbers,
    title,
    heading_levels,
    heading_numbers,
    endless,
    unseen_by_nbval,
    machine_path,
)
"""Every rule but the one about markers, which comes first: the others rely on it."""


def check_lessons(course: Course, lessons: list[Lesson], chosen: list[Lesson]) -> list[Finding]:
    """Apply every rule to the chosen lessons.

    Args:
        course: Where links lead.
        lessons: All lessons of the course.
        chosen: The lessons to check.

    Returns:
        What breaks a rule, by file and line.
    """
    findings = [f for lesson in chosen for f in _check(Desk(course, tuple(lessons), lesson))]
    return sorted(findings, key=lambda finding: (finding.file, finding.line, finding.lint))


def _check(desk: Desk) -> list[Finding]:
    return list(answer_markers(desk)) or [finding for lint in LINTS for finding in lint(desk)]
