"""Remember how the cells of exercises ended, so that a check knows what it judges.

JupyterLab sends a cell's id and metadata with its code (`execute_request`), and the metadata of a
page of the course name the exercise. Where nobody sends them, as under nbclient, nbval and
nbgrader, nothing is remembered of exercises, and nothing here stops a check.
"""

from __future__ import annotations

import ast
import re
import sys
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from textwrap import shorten
from typing import Any, TypeAlias

from rosbeat.errors import ExerciseError, RosbeatError
from rosbeat.exercises.deferred_output import Withheld

#: IPython's shell, and what it tells about a cell; neither carries types.
Shell: TypeAlias = Any
Info: TypeAlias = Any
Answer: TypeAlias = Any

#: Stands for an answer that is not there; None is one that is.
NOTHING: Answer = object()
#: Characters of what a cell raised that are shown.
_LONGEST, _MOST_READ = 200, 10_000
_HELD_AS = "_rosbeat_cells"
_SAVE = re.compile(r"%%save\s+(\S+)")
#: The guess of a prediction, of which nothing else in its cell depends.
_GUESS = re.compile(r"""(?<![\w.])predict\(\s*("[^"\n]*"|'[^'\n]*'|[^,\n]*)""")
#: A prediction that nobody has made yet.
_ASKS = re.compile(r"""(?<![\w.])predict\(\s*["']_+["']""")
_BLANK = re.compile(r"(?<!\w)_{4}(?!\w)")


@dataclass(frozen=True)
class Run:
    """Hold how one run of a cell ended.

    Attributes:
        cell: The cell's id; empty if the front end sent none.
        exercise: Id of the exercise whose cell it is, or an empty text.
        bound: The names that it defined.
        failure: What it raised and in which line, such as `line 7: SyntaxError: invalid syntax`;
            empty if it ran to its end.
        blank: Whether it stopped at a blank, `____`.
        file: The file that it was to save, and did not; None if there is none.
        stamp: When that file was changed last, in nanoseconds; 0 if it is not there.
    """

    cell: str
    exercise: str = ""
    bound: tuple[str, ...] = ()
    failure: str = ""
    blank: bool = False
    file: Path | None = None
    stamp: int = 0


@dataclass(frozen=True)
class Beginning:
    """Hold what came out when a prediction's cell ran for the first time.

    Attributes:
        source: The cell's text, without the guess.
        above: The texts of the cells that had run before, by their ids.
        happened: What was compared with the guesses, in order.
    """

    source: str
    above: Mapping[str, str]
    happened: list[Answer]


class Cells:
    """Follow the cells that a kernel runs.

    Args:
        shell: The kernel's shell.
    """

    def __init__(self, shell: Shell) -> None:
        self._shell = shell
        #: The texts of the cell that runs, and of those that it runs.
        self._begun: list[str] = []
        self._last: dict[str, Run] = {}
        self._binder: dict[str, Run] = {}
        self._handed: dict[str, ast.expr] = {}
        #: The text of each cell's last run, without guesses and exercises.
        self._texts: dict[str, str] = {}
        self._beginnings: dict[str, Beginning] = {}
        self._compared = 0
        self.worked_on = ""
        #: What the cell that runs keeps back until its prediction is made, if it does.
        self.withheld: Withheld | None = None
        #: The widgets that each cell shows, by its id.
        self.widgets: dict[str, list[Any]] = {}

    def begin(self, info: Info) -> None:
        """Note that a cell runs (IPython's event `pre_run_cell`)."""
        self._begun.append(str(info.raw_cell))
        if len(self._begun) == 1 and self.for_a_browser:
            self._compared = 0
            self._close(str(self._sent()["cellId"]))
            if _ASKS.search(self._begun[0]):
                self.withheld = Withheld(self._shell)

    def end(self, result: Info) -> None:
        """Note how a cell ended (IPython's event `post_run_cell`)."""
        if not self._begun:  # it has imported rosbeat, and nobody has seen it begin
            return
        self._begun.pop()
        if self.withheld is not None and not self._begun:
            self.withheld.end_of_cell()
            self.withheld = None
        meta = self._metadata(result.info)
        for gone in meta.get("deletedCells") or ():
            self._last.pop(str(gone), None)
            self._close(str(gone))
        marks = meta.get("rosbeat") or {}
        cell, exercise = str(meta.get("cellId") or ""), str(marks.get("exercise") or "")
        if cell and not exercise and "check" not in marks:
            self._texts[cell] = _without_guess(str(result.info.raw_cell))
        run = self._ended(result, Run(cell, exercise))
        self._binder.update(dict.fromkeys(run.bound, run))
        if run.exercise:
            self._last.pop(run.cell, None)  # the newest stands last
            self._last[run.cell] = run
        self.worked_on = run.exercise or self.worked_on

    @property
    def for_a_browser(self) -> bool:
        """Return whether a notebook in a browser runs this cell: it sends the cell's id."""
        return bool(self._begun and self._sent().get("cellId"))

    def ask(self, exercise: str) -> None:
        """Note that the cell that runs asks for a check of an exercise, and of what.

        Args:
            exercise: The exercise's id.
        """
        self.worked_on = exercise
        expression = answer_in(self._begun[0], exercise) if self._begun else None
        if expression is not None:
            self._handed[exercise] = expression

    def first_outcome(self, happened: Answer) -> Answer:
        """Return what came out when the cell that runs made this comparison for the first time.

        A cell may change what it looks at, so that it has another outcome each time, and the page
        goes on meanwhile. The first outcome stays until the learner begins anew: changes this cell,
        more than its guess, or one that had run before it, and runs it again.

        Args:
            happened: What came out now.

        Returns:
            The first outcome; the present one where the front end does not tell cells apart.
        """
        if not self.for_a_browser:
            return happened
        cell, source = str(self._sent()["cellId"]), _without_guess(self._begun[0])
        first = self._beginnings.get(cell)
        if first is None or first.source != source or not self._is_above(first):
            above = {key: text for key, text in self._texts.items() if key != cell}
            first = self._beginnings[cell] = Beginning(source, above, [])
        number, self._compared = self._compared, self._compared + 1
        if number == len(first.happened):
            first.happened.append(happened)
        return first.happened[number]

    def _is_above(self, first: Beginning) -> bool:
        return all(self._texts.get(cell) == text for cell, text in first.above.items())

    def hold(self, widget: Any) -> None:  # noqa: ANN401 - ipywidgets takes a while to load
        """Hold a widget that the cell shows until it runs again, which takes it from the page.

        Args:
            widget: The widget.
        """
        self.widgets.setdefault(str(self._sent().get("cellId", "")), []).append(widget)

    def answer(self, exercise: str) -> Answer:
        """Return the answer to an exercise as it is now.

        Args:
            exercise: The exercise's id.

        Returns:
            The answer; `NOTHING` if no cell has handed one to `check`, or defined one.

        Raises:
            Exception: What the expression raises that a cell has handed over.
        """
        expression = self._handed.get(exercise)
        if expression is not None:
            return eval(
                compile(ast.Expression(expression), "<answer>", "eval"), self._shell.user_ns
            )
        bound = [name for run in self._runs(exercise) for name in run.bound]
        return self._shell.user_ns.get(bound[-1], NOTHING) if bound else NOTHING

    def refuse_stale(self, exercise: str) -> bool:
        """Refuse to judge what the last run of an exercise's cell did not define.

        An answer is stale if a cell of an exercise has defined it, and has run again since without
        defining it; and if the cell was to save a file, and has not saved it.

        Args:
            exercise: The exercise's id.

        Returns:
            Whether the cell still has a blank, so that there is nothing to judge.

        Raises:
            ExerciseError: If the cell failed when it ran last, or defines another name by now.
        """
        unsaved = [
            one for one in self._runs(exercise)
            # Later, somebody may have changed the file by hand.
            if one.file is not None and _stamp(one.file) == one.stamp
        ]  # fmt: skip
        expression = self._handed.get(exercise)
        names = () if expression is None else ast.walk(expression)
        stale = {
            one.id: now
            for one in names
            if isinstance(one, ast.Name)
            if (now := self._rerun_without(one.id)) is not None
        }
        for run in (*unsaved, *stale.values()):
            if run.blank:
                return True
            if run.failure:
                raise _did_not_run(run)
        for name, run in stale.items():
            raise _other_name(name, run)
        return False

    def _runs(self, exercise: str) -> list[Run]:
        return [one for one in self._last.values() if one.exercise == exercise]

    def _rerun_without(self, name: str) -> Run | None:
        """Return the last run of the cell that has defined a name, if it did not define it."""
        binder = self._binder.get(name)
        now = self._last.get(binder.cell) if binder is not None else None
        return now if now is not binder else None

    def _close(self, cell: str) -> None:
        for widget in self.widgets.pop(cell, ()):
            widget.close()

    def _ended(self, result: Info, run: Run) -> Run:
        raw, space = str(result.info.raw_cell), self._shell.user_ns
        error = result.error_before_exec or result.error_in_exec
        line = _line(error, space) if error is not None else 0
        try:
            source = self._shell.transform_cell(raw)
        except SyntaxError:  # indentation that fits no block
            source = raw
        run = replace(run, bound=_bound(source, error, line))
        file = _file_of(raw)
        blank = isinstance(error, NameError) and getattr(error, "name", "") == "____"
        blank = blank or (file is not None and bool(_BLANK.search(raw)))
        if error is None and not blank:
            return run
        failure = _failure(error, line) if error is not None else ""
        run = replace(run, failure=failure, blank=blank)
        if file is None:
            return run
        # A file that was saved can be judged, whatever its text did when it ran on the page.
        saved = not blank and _holds(file, raw.partition("\n")[2])
        return replace(run, failure="") if saved else replace(run, file=file, stamp=_stamp(file))

    def _metadata(self, info: Info) -> Mapping[str, Any]:
        """Return what the front end sent about a cell; empty if it did not send this cell."""
        meta = self._sent()
        own = getattr(info, "cell_id", None)
        return meta if own is not None and own == meta.get("cellId") else {}

    def _sent(self) -> Mapping[str, Any]:
        parent: Mapping[str, Any] = getattr(self._shell, "get_parent", dict)() or {}
        return parent.get("metadata") or {}


def cells_of(shell: Shell = None) -> Cells | None:
    """Return what the cells of a shell have done; None if nobody follows them.

    Args:
        shell: The shell, by default the one of this process.
    """
    if shell is None and (ipython := sys.modules.get("IPython")):
        shell = ipython.get_ipython()
    found = getattr(shell, _HELD_AS, None)
    return found if isinstance(found, Cells) else None


def worked_on() -> str:
    """Return the id of the exercise that this kernel was last about, or an empty text."""
    cells = cells_of()
    return cells.worked_on if cells else ""


def register(shell: Shell) -> None:
    """Follow the cells of a shell; a second time changes nothing.

    Args:
        shell: The running shell.
    """
    if cells_of(shell) is None:
        cells = Cells(shell)
        setattr(shell, _HELD_AS, cells)
        shell.events.register("pre_run_cell", cells.begin)
        shell.events.register("post_run_cell", cells.end)


#: A call of `check` with an id, on a line that is no comment.
_CHECK = re.compile(r"""(?m)^[^#\n]*?\bcheck\(\s*(?:exercise\s*=\s*)?["']\s*(\w+)\s*["']""")


def checks_in(source: str) -> tuple[str, ...]:
    """Return the ids of the exercises that a cell checks, in order.

    Args:
        source: The cell's text, which need not be Python.
    """
    return tuple(dict.fromkeys(name.lower() for name in _CHECK.findall(source)))


def answer_in(source: str, exercise: str) -> ast.expr | None:
    """Return what a cell hands to `check` as the answer to an exercise; None if that is not clear.

    Args:
        source: The cell's text.
        exercise: The exercise's id.
    """
    try:
        calls = [one for one in ast.walk(ast.parse(source)) if isinstance(one, ast.Call)]
    except (SyntaxError, ValueError, RecursionError):
        return None
    found = [args[1] for args in map(_arguments, calls) if len(args) == 2
             and isinstance(args[0], ast.Constant) and not isinstance(args[1], ast.Starred)
             and str(args[0].value).strip().lower() == exercise]  # fmt: skip
    return found[0] if len(found) == 1 else None


def _arguments(call: ast.Call) -> list[ast.expr]:
    named = isinstance(call.func, ast.Name) and call.func.id == "check"
    given = {one.arg: one.value for one in call.keywords}
    rest = [given[name] for name in ("exercise", "answer")[len(call.args) :] if name in given]
    return [*call.args, *rest] if named else []


def _without_guess(source: str) -> str:
    return _GUESS.sub("predict(", source)


def _bound(source: str, error: BaseException | None, line: int) -> tuple[str, ...]:
    """Return the names that the statements of a cell have defined.

    Args:
        source: The cell as Python.
        error: What the cell raised; None if it ran to its end.
        line: The line at which it did; 0 if it did not begin to run.
    """
    try:
        statements = ast.parse(source).body
    except (SyntaxError, ValueError, RecursionError):
        return ()
    names: list[str] = []
    for one in statements:
        if error is not None and (one.end_lineno or 0) >= line:
            break
        if isinstance(one, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
            names.append(one.name)
        elif isinstance(one, ast.Assign | ast.AnnAssign):
            targets = one.targets if isinstance(one, ast.Assign) else [one.target]
            names += [target.id for target in targets if isinstance(target, ast.Name)]
    return tuple(names)


def _failure(error: BaseException, line: int) -> str:
    """Return what a cell raised, and in which of its lines."""
    if isinstance(error, RosbeatError):  # what it says is a sentence of its own
        return error.what.rstrip(".")
    # Of an exception's text, which may be anything, a few lines are read.
    text = str(error)[:_MOST_READ].strip().split("\n")[0]
    line = getattr(error, "lineno", None) or line
    said = re.fullmatch(r"(.*) \([^()]*, line (\d+)\)", text)
    if said:  # a SyntaxError, and ours for the text of a file, which has nothing but its text
        text, line = said[1], int(said[2])
    what = ": ".join(filter(None, (type(error).__name__, shorten(text, _LONGEST))))
    return f"line {line}: {what}" if line else what


def _line(error: BaseException, space: Mapping[str, Any]) -> int:
    """Return the line of the cell in which an exception came up; 0 if that is not known."""
    trace = error.__traceback__
    while trace is not None:
        if trace.tb_frame.f_globals is space and trace.tb_frame.f_code.co_name == "<module>":
            return trace.tb_lineno
        trace = trace.tb_next
    return 0


def _file_of(source: str) -> Path | None:
    """Return the file that a cell saves; None if it saves none, or one that cannot be told."""
    found = _SAVE.match(source)
    if found is None:
        return None
    # Importing the workspace makes its commands known, and a page does that itself.
    from rosbeat.workspace.location import workspace
    from rosbeat.workspace.saving import locate

    try:
        return locate(found[1], workspace())[1]
    except (RosbeatError, OSError, ValueError):
        return None


def _holds(path: Path, text: str) -> bool:
    try:
        return path.read_bytes().decode("utf-8", "replace").strip() == text.strip()
    except OSError:
        return False


def _stamp(path: Path) -> int:
    try:
        return path.stat().st_mtime_ns
    except OSError:
        return 0


def _did_not_run(run: Run) -> ExerciseError:
    what, rest = "did not run", "What an earlier run defined is still there"
    if run.file is not None:
        what, rest = f"did not save {run.file.name}", "The file is still the one from before"
    return ExerciseError(
        f"The cell above {what} ({run.failure}).",
        f"{rest}, so there is no verdict on what the cell has now.",
        "Correct the cell and run it, then run this check again.",
    )


def _other_name(name: str, run: Run) -> ExerciseError:
    defined = f"defined `{run.bound[-1]}`" if run.bound else "did not define it"
    return ExerciseError(
        f"You checked `{name}`, which an earlier run of the cell defined; the last run of the cell "
        f"{defined}.",
        f"`{name}` is still what it was then, so there is no verdict on what the cell has now.",
        f"Write `{name}` in the cell and run it, then run this check again.",
    )
