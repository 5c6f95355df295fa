"""Find the answers on a submitted page, and create a job for each.

A cell is found by its id, else by the exercise in its metadata, else because it defines the same
names as the exercise's cell. Every repair that was needed to find or run an answer is reported in a
sentence. No answer is held because of what it imports or names: `remarks_on` points out what an
instructor may want to look at, and the mark stands.
"""

from __future__ import annotations

import ast
import builtins
import json
import re
from collections.abc import Iterable, Sequence, Set
from dataclasses import dataclass, replace
from functools import lru_cache

from rosbeat.exercises.exercise import BLANK
from rosbeat.exercises.registry import EXERCISES
from rosbeat.grading.jobs import Job
from rosbeat.grading.notebook import Cell, CoursePage, Wanted

#: What is said of an answer that is nowhere, and of one of which a part is.
NOT_THERE, PART_NOT_THERE = "Its cell is not on the page.", "A cell of it is not on the page."
#: Characters of a cell that is read as a program, and of all cells that are searched for helpers:
#: no answer is as long, and parsing takes a second for each of some 100,000 characters.
_MOST_PARSED, _MOST_SEARCHED = 100_000, 500_000
#: Names that every cell of a notebook has, besides those of Python itself.
OF_A_NOTEBOOK = ("display", "get_ipython")


@dataclass(frozen=True)
class Answer:
    """Describe one answer of one learner.

    Attributes:
        job: What has to be observed; None if its cell is as it is on the course's page, or lost.
        repairs: What was done to find and to run the answer, a sentence each.
        remarks: What an instructor should know of it, a sentence each; see `remarks_on`.
    """

    exercise: str
    job: Job | None
    repairs: tuple[str, ...] = ()
    remarks: tuple[str, ...] = ()
    source: str = ""


def answers_on(page: CoursePage, cells: Sequence[Cell], seed: int = 0) -> tuple[Answer, ...]:
    """Find the answers on a page that was handed in."""
    found = find_cells(page.wanted, cells)
    parts: dict[str, list[tuple[Wanted, Found]]] = {}
    for wanted, one in zip(page.wanted, found, strict=True):
        parts.setdefault(wanted.exercise, []).append((wanted, one))
    return tuple(_answer(page, some, cells, seed) for some in parts.values())


def _answer(
    page: CoursePage, parts: Sequence[tuple[Wanted, Found]], cells: Sequence[Cell], seed: int
) -> Answer:
    wanted = parts[-1][0]
    source = "\n\n".join(found.source for _, found in parts)
    repairs = tuple(dict.fromkeys(said for _, found in parts for said in found.repairs))
    if all(found.source.strip() in ("", one.blank.strip()) for one, found in parts):
        return Answer(wanted.exercise, None, repairs=repairs, source=source)
    base = Job(
        *(wanted.exercise, subject_of(page, wanted.exercise), parts[-1][1].source),
        imports=imports_of(page),
        given=json.dumps(EXERCISES[wanted.exercise].given(), sort_keys=True),
        seed=seed,
    )
    if is_replayed(page, wanted):
        job = replace(base, replay=_replay(page, wanted, base.answer), page=page.number)
        return Answer(wanted.exercise, job, repairs=repairs, source=source)
    run = [without_magics(found.source) for _, found in parts]
    texts = [text for text, _ in run]
    place = min((found.place for _, found in parts if found.place >= 0), default=-1)
    earlier = _earlier(page, wanted, texts, place, cells, base.imports)
    job = replace(base, answer=texts[-1], parts=tuple(texts[:-1]), earlier=earlier)
    said = dict.fromkeys(said for _, some in run for said in some)
    remarks = _remarks(page, texts, earlier, base.imports)
    return Answer(wanted.exercise, job, (*repairs, *said), remarks, source=source)


# What the course's page says about its exercises.


def is_replayed(page: CoursePage, wanted: Wanted) -> bool:
    """Return whether an exercise is about what was typed, so that its page is run up to it."""
    return wanted.blank.startswith("%%") or "workspace." in subject_of(page, wanted.exercise)


@lru_cache(maxsize=256)
def subject_of(page: CoursePage, exercise: str) -> str:
    """Return the expression that the check of an exercise hands over, such as `HumiditySensor`."""
    cell = next((one for one in page.cells if one.check == exercise), None)
    tree = ast.parse(cell.source) if cell else ast.Module([], [])
    calls = [one for one in ast.walk(tree) if isinstance(one, ast.Call)]
    checks = [one for one in calls if getattr(one.func, "id", "") == "check" and len(one.args) > 1]
    return ast.unparse(checks[0].args[1]) if checks else "None"


@lru_cache(maxsize=64)
def imports_of(page: CoursePage) -> str:
    """Return the imports of a page's cell of imports, without what that cell does besides."""
    for cell in page.cells:
        if _imports(cell):
            tree = ast.parse(cell.source)
            tree.body = [one for one in tree.body if isinstance(one, (ast.Import, ast.ImportFrom))]
            return ast.unparse(tree)
    return ""


def _imports(cell: Cell) -> bool:
    return cell.sort == "code" and "from rosbeat import" in cell.source


def _replay(page: CoursePage, wanted: Wanted, answer: str) -> tuple[str, ...]:
    """Return the course's cells up to the check, with this answer; other answers stay blank.

    The imports are left out: what they bring is in `Job.imports`. So are diagrams, which change
    nothing and load a library for drawing.
    """
    end = next((one.place for one in page.cells if one.check == wanted.exercise), len(page.cells))
    cells = [one for one in page.cells if one.sort == "code" and one.place < end and not one.check]
    return tuple(
        answer if one.id == wanted.id else one.source
        for one in cells
        if not (_imports(one) or one.source.startswith("viz.diagram("))
    )


# Which cells hold the answers, whatever has happened to the page.


@dataclass(frozen=True)
class Found:
    """Hold the cell of one exercise as it was handed in.

    Attributes:
        source: The text of its cell; empty if there is none.
        place: The cell's place on the page, or -1.
        repairs: What was done to find it, a sentence each; nothing if it was where it belongs.
    """

    exercise: str
    source: str = ""
    place: int = -1
    repairs: tuple[str, ...] = ()


def find_cells(wanted: Sequence[Wanted], cells: Sequence[Cell]) -> tuple[Found, ...]:
    """Find the cells with answers on a page.

    Args:
        wanted: The cells that wait for one, in the order of the course's page.
        cells: The cells that were handed in.

    Returns:
        One for each wanted cell, in the same order.
    """
    cells = [cell for cell in cells if not cell.check]
    taken: set[int] = set()
    answers = []
    for one in wanted:
        others = {other.id for other in wanted if other is not one}
        free = [cell for cell in cells if cell.place not in taken and cell.id not in others]
        shared = any(other.exercise == one.exercise for other in wanted if other is not one)
        found = _find(one, free, shared)
        taken.add(found.place)
        answers.append(found)
    return tuple(answers)


def _find(wanted: Wanted, cells: Sequence[Cell], is_part: bool) -> Found:
    """Find a cell by its id, else by its exercise, else by what it defines.

    Args:
        wanted: The cell of the course's page.
        cells: The cells that were handed in and may be it.
        is_part: Whether the exercise has several cells: then its name does not say which it is.
    """
    by_id = [cell for cell in cells if cell.id and cell.id == wanted.id]
    by_name = [cell for cell in cells if cell.exercise == wanted.exercise]
    if is_part:
        by_name = _alike(wanted, by_name) or _alike(wanted, cells) or by_name[:1]
    if by_id:
        return _chosen(wanted, by_id if is_part else [*by_id, *by_name], "")
    if by_name:
        which = "A cell of it" if is_part else "Its cell"
        return _chosen(wanted, by_name, f"{which} has another id than on the course's page.")
    if alike := _alike(wanted, cells):
        said = "Its cell has lost its name and was found by what it defines."
        return _chosen(wanted, alike, said)
    return Found(wanted.exercise, repairs=(PART_NOT_THERE if is_part else NOT_THERE,))


def _chosen(wanted: Wanted, found: Sequence[Cell], said: str) -> Found:
    """Choose the last cell in which something was tried, and the last one if nothing was."""
    cells = sorted({cell.place: cell for cell in found}.values(), key=lambda cell: cell.place)
    repairs = [said] if said else []
    tried = [cell for cell in cells if BLANK not in cell.source and cell.source.strip()]
    cell = (tried or cells)[-1]
    if len(cells) > 1:
        repairs.append(f"Its cell is there {len(cells)} times; the last one that is filled counts.")
    if cell.sort != "code":
        repairs.append(f"Its cell was turned into a {cell.sort} cell and was read as code.")
    return Found(wanted.exercise, cell.source, cell.place, tuple(repairs))


_DEFINED = re.compile(r"^(?:class|def)\s+(\w+)", re.MULTILINE)


def _alike(wanted: Wanted, cells: Sequence[Cell]) -> list[Cell]:
    names = set(_DEFINED.findall(wanted.blank))
    return [cell for cell in cells if names & set(_DEFINED.findall(cell.source))]


@lru_cache(maxsize=512)
def _parsed(text: str) -> ast.Module | None:
    if len(text) > _MOST_PARSED:
        return None
    try:
        return ast.parse(text)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return None


# Commands of IPython in a cell of Python.

#: Commands that run a cell or a line as it is, and measure it or keep what it prints.
_TRANSPARENT = frozenset(("time", "timeit", "capture", "prun"))
_LINE = re.compile(r"(?P<left>\s*(?:[\w.]+\s*=\s*)?)(?P<sign>[%!?])(?P<rest>.*)")
_HELP = re.compile(r"(?P<left>\s*)[%\w.]+\?{1,2}\s*")
# Each option is matched in one way only: a line with many of them must not take for ever.
_OPTIONS = re.compile(r"(?:\s*-\w+(?:\s+\d+)?)*\s+")


def without_magics(source: str) -> tuple[str, tuple[str, ...]]:
    """Return a cell as plain Python, with its lines where they were, and what was left out.

    `%%time` and others that run their body give the body; `!ls` and others that need a shell or a
    kernel are left out, each with a sentence. A cell that is Python already stays as it is.
    """
    if _parsed(source) is not None:
        return source, ()
    lines, said = source.split("\n"), []
    for number, line in enumerate(lines):
        if line.lstrip().startswith("%%"):
            name = re.split(r"\s", line.strip()[2:], maxsplit=1)[0]
            lines[number] = ""
            if name not in _TRANSPARENT:
                said.append(f"The cell was left out: grading cannot run it with %%{name[:20]}.")
                lines[:] = []
                break
        elif line.strip():
            break
    text = "\n".join(lines)
    if _parsed(text) is not None:
        return text, tuple(said)
    goes_on = False
    for number, line in enumerate(lines):
        lines[number] = "" if goes_on else _plain_line(line)
        is_left_out = lines[number] != line and lines[number].endswith(("pass", "None"))
        goes_on = (is_left_out or goes_on) and line.rstrip().endswith("\\")
        if is_left_out:
            said.append(
                f"Line {number + 1} was left out, a command of IPython: {line.strip()[:60]}"
            )
    return "\n".join(lines), tuple(said)


def _plain_line(line: str) -> str:
    """Return a line of a cell as Python: what a command measures, or nothing at all."""
    found = _LINE.fullmatch(line) or _HELP.fullmatch(line)
    if found is None:
        return line
    left = found["left"]
    name, _, rest = found.groupdict().get("rest", "").partition(" ")
    if found.groupdict().get("sign") == "%" and name in _TRANSPARENT and rest:
        return left + _OPTIONS.sub("", f" {rest}", count=1)
    return left + ("None" if left.strip() else "pass")


# Statements of other cells that an answer needs.

#: What may stand at the top of a cell so that running it defines something.
_DEFINES = (
    *(ast.Import, ast.ImportFrom, ast.FunctionDef, ast.ClassDef, ast.AsyncFunctionDef),
    *(ast.Assign, ast.AnnAssign),
)


def _earlier(
    page: CoursePage,
    wanted: Wanted,
    texts: Sequence[str],
    place: int,
    cells: Sequence[Cell],
    imports: str,
) -> tuple[str, ...]:
    """Return what runs before the answer: learner's cells above it count more than the course's."""
    above = [one for one in cells if one.place < place] if place >= 0 else cells
    end = next((one.place for one in page.cells if one.id == wanted.id), len(page.cells))
    given = [one for one in page.cells if one.place < end and not one.exercise]
    known = {*dir(builtins), *OF_A_NOTEBOOK, *_names_of(ast.parse(imports))}
    return statements_needed(texts, (*_python(reversed(above)), *_python(given)), known)


def _python(cells: Iterable[Cell]) -> tuple[str, ...]:
    return tuple(
        without_magics(one.source)[0] for one in cells if one.sort == "code" and not one.check
    )


def statements_needed(
    texts: Iterable[str], cells: Iterable[str], names: Iterable[str]
) -> tuple[str, ...]:
    """Return the statements of other cells that define what texts use, in the order to run them.

    Only the statements that are needed are there, and what these need.

    Args:
        texts: Cells that are about to run; what they define themselves is theirs to define.
        cells: The other cells, those that count more first.
        names: What is defined already.
    """
    todo: list[ast.AST] = [tree for tree in map(_parsed, texts) if tree is not None]
    known = set(names).union(*map(_names_of, todo))
    offered: dict[str, _Offer] | None = None
    wanted: dict[_Offer, None] = {}
    while todo:
        for name in sorted(_named(todo.pop(), ast.Load) - known):
            if offered is None:  # most answers need nothing, and reading all cells takes its time
                offered = _offers(cells)
            found = offered.get(name)
            if found is not None:
                wanted.pop(found, None)
                wanted[found] = None
                known |= found.names
                todo.append(found.statement)
    return tuple(one.text for one in reversed(wanted))  # what others build on was found last


@dataclass(frozen=True, eq=False)
class _Offer:
    """Hold a statement that defines names, and the cell in which it stands."""

    statement: ast.stmt
    names: frozenset[str]
    cell: str

    @property
    def text(self) -> str:
        try:
            return ast.unparse(self.statement)
        except RecursionError:  # a sum of hundreds of terms
            return ast.get_source_segment(self.cell, self.statement) or ""


def _offers(cells: Iterable[str]) -> dict[str, _Offer]:
    """Return what cells define by its name; the first cell counts, and its last definition."""
    found: dict[str, _Offer] = {}
    left = _MOST_SEARCHED
    for cell in cells:
        left -= len(cell)
        if left < 0:
            break
        for one in _offered(cell):
            for name in one.names:
                found.setdefault(name, one)
    return found


@lru_cache(maxsize=512)
def _offered(cell: str) -> tuple[_Offer, ...]:
    """Return what a cell defines, the last first."""
    tree = _parsed(cell)
    defining = [one for one in tree.body if isinstance(one, _DEFINES)] if tree else []
    return tuple(_Offer(one, frozenset(_names_of(one)), cell) for one in reversed(defining))


def _names_of(tree: ast.AST) -> set[str]:
    """Return the names that a statement, or the top of a cell, defines."""
    found: set[str] = set()
    for one in tree.body if isinstance(tree, ast.Module) else [tree]:
        if isinstance(one, (ast.FunctionDef, ast.ClassDef, ast.AsyncFunctionDef)):
            found.add(one.name)
        elif isinstance(one, (ast.Import, ast.ImportFrom)):
            found |= {alias.asname or alias.name.split(".")[0] for alias in one.names}
        else:
            found |= _named(one, ast.Store)
    return found


def _named(tree: ast.AST, how: type[ast.expr_context]) -> set[str]:
    names = (one for one in ast.walk(tree) if isinstance(one, ast.Name))
    return {one.id for one in names if isinstance(one.ctx, how)}


# What an instructor should know of an answer.

#: Modules that show or change what runs a program.
_INNER_MODULES = frozenset(("ctypes", "_ctypes", "gc", "inspect", "tracemalloc", "rosbeat"))
#: Names that lead from a value to what runs it.
_INNER_NAMES = frozenset(
    (
        *("f_back", "f_globals", "f_locals", "f_code", "tb_frame", "gi_frame", "cr_frame"),
        *("ag_frame", "_getframe", "_current_frames", "settrace", "setprofile", "session_core"),
        *("recorder", "__globals__", "__code__", "__closure__", "__builtins__", "__subclasses__"),
        *("__kwdefaults__", "__defaults__"),
    )
)


def remarks_on(source: str, imports: str = "") -> tuple[str, ...]:
    """Say where an answer reaches for what runs and observes it. It may be a slip; the mark stands.

    Returns:
        A sentence for each line, without a full stop; nothing for a text that is no Python.
    """
    tree = _parsed(source)
    if tree is None:
        return ()
    given = _names_of(ast.parse(imports))
    brought = given.union(*(_brought(one) for one in ast.walk(tree)))
    found: dict[int, str] = {}
    for node in ast.walk(tree):
        said = _of_import(node, given) or _of_name(node) or _of_change(node, brought)
        if said:
            found.setdefault(getattr(node, "lineno", 0), said)
    return tuple(f"line {line} {found[line]}" for line in sorted(found))


def _brought(node: ast.AST) -> set[str]:
    """Return names of what is imported, message classes left out: those are for everybody."""
    if isinstance(node, ast.ImportFrom):
        of_messages = str(node.module).rpartition(".")[2] in ("msg", "srv", "action")
        return set() if of_messages else _names_of(node)
    return _names_of(node) if isinstance(node, ast.Import) else set()


def _of_import(node: ast.AST, given: Set[str]) -> str:
    if isinstance(node, ast.Import):
        modules = [one.name for one in node.names]
    elif isinstance(node, ast.ImportFrom):
        if all(one.name in given for one in node.names):
            return ""  # as the page itself does
        modules = [node.module or "."]
    else:
        return ""
    inner = [one for one in modules if one.split(".")[0] in _INNER_MODULES]
    return f"imports {inner[0]}" if inner else ""


def _of_name(node: ast.AST) -> str:
    name = getattr(node, "attr", "") or getattr(node, "id", "")
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        name = node.value
    is_inner = name in _INNER_NAMES or re.fullmatch(r"rosbeat(\.\w+)+", name)
    return f"uses {name}" if is_inner else ""


def _of_change(node: ast.AST, brought: Set[str]) -> str:
    """Return what is said of an imported thing that is given other parts."""
    targets: list[ast.expr] = []
    if isinstance(node, (ast.Assign, ast.Delete)):
        targets = node.targets
    elif isinstance(node, (ast.AugAssign, ast.AnnAssign)):
        targets = [node.target]
    for target in targets:
        root: ast.expr = target
        while isinstance(root, (ast.Attribute, ast.Subscript)):
            root = root.value
        if root is not target and isinstance(root, ast.Name) and root.id in brought:
            return f"changes {root.id}"
    return ""


def _remarks(
    page: CoursePage, texts: Sequence[str], earlier: Sequence[str], imports: str
) -> tuple[str, ...]:
    """Return what is said of an answer, and of the learner's own statements that it needs."""
    ours = _statements_of(page)
    own = [one for one in earlier if one not in ours]
    said = [one for text in texts for one in remarks_on(text, imports)]
    above = [one for text in own for one in remarks_on(text, imports)]
    return (*said, *(f"of another cell that it needs, {one}" for one in above))


@lru_cache(maxsize=64)
def _statements_of(page: CoursePage) -> frozenset[str]:
    cells = _python(page.cells)
    return frozenset(one.text for cell in cells for one in _offered(cell))
