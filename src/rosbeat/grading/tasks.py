"""From a page that was handed in to the jobs that have to be done for it."""

from __future__ import annotations

import ast
import builtins
import json
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

from rosbeat.exercises.registry import EXERCISES
from rosbeat.grading.course_pages import CoursePage
from rosbeat.grading.inside.definitions import definitions, names_of, needed
from rosbeat.grading.inspecting import Reason, reasons
from rosbeat.grading.jobs import Job
from rosbeat.grading.mending import Found, Wanted, find_answers, is_behind_the_end
from rosbeat.grading.notebook import Cell

#: Commands of a page that an answer may consist of.
_MAGICS = ("%%terminal", "%terminal", "%%save")


@dataclass(frozen=True)
class Task:
    """One answer of one learner.

    Attributes:
        exercise: The exercise's id.
        job: What has to be observed; None if nothing has to be, or may be.
        reasons: Why a person has to look at it.
        touched: Whether its cell is another text than on the course's page.
        repairs: What was done to find the answer, a sentence each.
        cut: Whether the file breaks off before its cell.
        source: If a person has to look at it, what there is to look at.
    """

    exercise: str
    job: Job | None
    reasons: tuple[Reason, ...] = ()
    touched: bool = True
    repairs: tuple[str, ...] = ()
    cut: bool = False
    source: str = ""


def tasks_of(page: CoursePage, cells: Sequence[Cell], cut: bool = False) -> tuple[Task, ...]:
    """Find the answers on a page that was handed in, and say what is to be done with each.

    Args:
        page: The course's own page.
        cells: The cells that were handed in.
        cut: Whether the file breaks off, so that there may have been more.
    """
    found = find_answers(page.wanted, cells)
    parts: dict[str, list[tuple[Wanted, Found]]] = {}
    for wanted, one in zip(page.wanted, found, strict=True):
        parts.setdefault(wanted.exercise, []).append((wanted, one))
    return tuple(
        Task(some[0][0].exercise, None, cut=True)
        if cut and any(_is_lost(page, *one, cells) for one in some)
        else _task(page, some, cells)
        for some in parts.values()
    )


def _is_lost(page: CoursePage, wanted: Wanted, found: Found, cells: Sequence[Cell]) -> bool:
    ids = [cell.id for cell in page.cells]
    behind = frozenset(ids[ids.index(wanted.id) + 1 :])
    return is_behind_the_end(wanted, found, cells, behind)


def _task(page: CoursePage, parts: Sequence[tuple[Wanted, Found]], cells: Sequence[Cell]) -> Task:
    wanted = parts[-1][0]
    sources = [found.source for _, found in parts]
    repairs = tuple(dict.fromkeys(said for _, found in parts for said in found.repairs))
    if all(_is_untouched(*one) for one in parts):
        return Task(wanted.exercise, None, touched=False, repairs=repairs)
    imports = imports_of(page)
    why = tuple(reason for source in sources for reason in _reasons(source, wanted, imports))
    if why:
        return Task(wanted.exercise, None, why, repairs=repairs, source="\n\n".join(sources))
    place = min((found.place for _, found in parts if found.place >= 0), default=-1)
    job = _job(page, wanted, sources, place, cells)
    why, above = _reasons_above(page, job)
    if why:
        source = "\n\n".join((*above, *sources))
        return Task(wanted.exercise, None, why, repairs=repairs, source=source)
    return Task(wanted.exercise, job, repairs=repairs)


def _is_untouched(wanted: Wanted, found: Found) -> bool:
    return found.source.strip() in ("", wanted.blank.strip())


def _job(
    page: CoursePage, wanted: Wanted, sources: Sequence[str], place: int, cells: Sequence[Cell]
) -> Job:
    exercise = wanted.exercise
    job = Job(
        *(exercise, subject_of(page, exercise), sources[-1], tuple(sources[:-1])),
        imports_of(page),
        given=json.dumps(EXERCISES[exercise].given(), sort_keys=True),
    )
    if is_replayed(page, wanted):
        return replace(job, replay=_replay(page, wanted, sources[-1]), page=page.number)
    above = [one for one in cells if one.place < place] if place >= 0 else cells
    earlier = (*_python(reversed(above)), *_python(_above(page, wanted)))
    return replace(job, earlier=earlier)


def is_replayed(page: CoursePage, wanted: Wanted) -> bool:
    """Whether an exercise is about what was typed, so that its page has to be run up to it."""
    return wanted.blank.startswith("%%") or "workspace." in subject_of(page, wanted.exercise)


@lru_cache(maxsize=256)
def subject_of(page: CoursePage, exercise: str) -> str:
    """The expression that the check of an exercise hands over, such as `HumiditySensor`."""
    cell = next((one for one in page.cells if one.check == exercise), None)
    tree = ast.parse(cell.source) if cell else ast.Module([], [])
    calls = [one for one in ast.walk(tree) if isinstance(one, ast.Call)]
    checks = [one for one in calls if getattr(one.func, "id", "") == "check" and len(one.args) > 1]
    return ast.unparse(checks[0].args[1]) if checks else "None"


@lru_cache(maxsize=64)
def imports_of(page: CoursePage) -> str:
    """The page's cell of imports; without what it does besides."""
    for cell in page.cells:
        if _imports(cell):
            tree = ast.parse(cell.source)
            tree.body = [one for one in tree.body if isinstance(one, (ast.Import, ast.ImportFrom))]
            return ast.unparse(tree)
    return ""


def _above(page: CoursePage, wanted: Wanted) -> list[Cell]:
    place = next((one.place for one in page.cells if one.id == wanted.id), len(page.cells))
    return [one for one in page.cells if one.place < place and not one.exercise]


def _python(cells: Iterable[Cell]) -> tuple[str, ...]:
    return tuple(
        one.source
        for one in cells
        if one.sort == "code" and not one.check and not one.source.startswith("%%")
    )


def _replay(page: CoursePage, wanted: Wanted, answer: str) -> tuple[str, ...]:
    """The course's cells up to the check, with this answer; other answers stay blank.

    The imports are left out: what they bring is in `Job.imports`.
    """
    end = next((one.place for one in page.cells if one.check == wanted.exercise), len(page.cells))
    cells = [one for one in page.cells if one.sort == "code" and one.place < end and not one.check]
    return tuple(
        answer if one.id == wanted.id else one.source for one in cells if not _imports(one)
    )


def _imports(cell: Cell) -> bool:
    return cell.sort == "code" and "from rosbeat import" in cell.source


def _reasons(source: str, wanted: Wanted, imports: str) -> tuple[Reason, ...]:
    if source.lstrip().startswith("%%"):  # empty lines above it do not matter to IPython
        allowed = source.split()[0] in _MAGICS and wanted.blank.startswith("%%")
        return () if allowed else (Reason(1, f"uses {source.split()[0][:20]}"),)
    found = reasons(source, imports)
    return found or _of_magics(source)


def _reasons_above(page: CoursePage, job: Job) -> tuple[tuple[Reason, ...], tuple[str, ...]]:
    """Reasons in statements of other cells that run because the answer needs them, and these."""
    known = {*dir(builtins), *names_of(ast.parse(job.imports))}
    found = needed((*job.parts, job.answer), job.earlier, known)
    if not found:
        return (), ()
    ours = _definitions_of(page)
    texts = [ast.unparse(one) for one in found if ast.dump(one) not in ours]
    why = {text: reasons(text, job.imports) for text in texts}
    told = (
        Reason(reason.line, f"of what it needs from another cell {reason.text}")
        for text in texts
        for reason in why[text]
    )
    return tuple(told), tuple(text for text in texts if why[text])


@lru_cache(maxsize=64)
def _definitions_of(page: CoursePage) -> frozenset[str]:
    return frozenset(ast.dump(one) for cell in _python(page.cells) for one in definitions(cell))


def _of_magics(source: str) -> tuple[Reason, ...]:
    """Commands of IPython, which are no Python; a text that is neither cannot run at all."""
    try:
        ast.parse(source)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        lines = enumerate(source.splitlines(), 1)
        return tuple(
            Reason(number, f"uses a command of IPython, {line.split()[0][:20]}")
            for number, line in lines
            if line.lstrip().startswith(("%", "!"))
        )
    return ()
