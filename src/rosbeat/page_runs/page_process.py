"""Run a page of a learner inside a sandbox, from top to bottom, and write down what was seen.

The cells run in a shell that behaves as the kernel of a page does, and the page goes on after an
exception. `check("03a", Anything)` observes what it is given in a fork of its own, hands out the
evidence, and the page goes on. Nothing in this module decides about a mark.

What is written are lines, each with a seal in front of it, so that what a program writes by
accident is told apart: see `transcript`.
"""

from __future__ import annotations

import ast
import asyncio
import builtins
import io
import json
import os
import re
import select
import signal
import sys
import threading
import time
import traceback
import warnings
from asyncio import events
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import Any

from IPython.core.error import StdinNotImplementedError
from IPython.core.interactiveshell import InteractiveShell
from traitlets.config import Config

import rosbeat
from rosbeat import page_names
from rosbeat.exercises import cells as exercise_cells
from rosbeat.exercises import check as check_module
from rosbeat.exercises.evidence import to_json
from rosbeat.exercises.exercise import Exercise
from rosbeat.exercises.registry import EXERCISES
from rosbeat.page_runs import system_calls
from rosbeat.page_runs.jobs import FORGED, Evidence, PageCell, PageJob
from rosbeat.page_runs.tampering import watch_tampering
from rosbeat.workspace import register as register_commands
from rosbeat.workspace.location import PAGE, STEADY
from rosbeat.workspace.location import workspace as workspace_folder

#: Seconds after which a cell that still runs is interrupted, as a learner does it, and that the
#: observation of one answer may take.
CELL_SECONDS, CHECK_SECONDS = 20.0, 60.0
#: Seconds after its first interrupt in which a cell has to end; else its process is ended.
GRACE = 5.0
#: Seconds that a page may lose to cells and answers that do not end. When they are used up, each of
#: the others has a part of the usual time: most need less than a second.
LOST_AT_MOST, HURRIED = 60.0, 1 / 6
#: Characters that a cell, or an answer that is observed, may print.
MOST_PRINTED = 4_000_000
#: Characters of what was printed that are kept, and of an exception's text.
_MOST_KEPT, _MOST_TEXT = 2_000, 1_000
#: What the main program of a kernel is started with.
_ARGUMENTS = ["ipykernel_launcher.py", "-f", "kernel.json"]
# Looked up before a learner's code runs, which may change these modules.
_fork, _pipe, _read, _write, _close, _exit = os.fork, os.pipe, os.read, os.write, os.close, os._exit
_waitpid, _kill, _getpid, _poll = os.waitpid, os.kill, os.getpid, select.poll
_monotonic, _sleep, _signal = time.monotonic, time.sleep, signal.signal
_encode, _urandom, _to_text = json.JSONEncoder().encode, os.urandom, to_json


@dataclass(frozen=True)
class Earlier:
    """Hold what earlier runs of a page have shown, which ended in the middle.

    Attributes:
        left_out: Cells that have ended the process, by their number, and how.
        given_up: Exercises whose observation has ended the process, and how.
        lost: Seconds that were lost to cells and answers that do not end.
    """

    left_out: Mapping[int, Evidence] = field(default_factory=dict)
    given_up: Mapping[str, Evidence] = field(default_factory=dict)
    lost: float = 0.0


def run_page(job: PageJob, earlier: Earlier, seal: str, result: int) -> None:
    """Run a page, and write what was seen.

    Args:
        job: The page.
        earlier: What earlier runs of it have shown.
        seal: What each line begins with.
        result: The descriptor to write to.
    """
    if os.geteuid() == 0:
        _give_up_root(Path.cwd())
    # What is typed in a terminal is another process, and may not look into this one.
    system_calls.prctl(system_calls.PR_SET_DUMPABLE, 0)
    warnings.simplefilter("ignore")  # a warning ends no cell
    # A steady home, as when pages are built: what it prints names no machine and no person. The
    # workspace is as the pages before leave it; what makes it is not in here, so no page is.
    os.environ[STEADY] = str(Path.cwd() / "home")
    os.environ.pop(PAGE, None)
    Path(os.environ[STEADY]).mkdir(parents=True, exist_ok=True)
    _put(job.files, workspace_folder())
    os.chdir(os.environ[STEADY])
    _Page(job, earlier, _writer(seal, result)).run()


#: Users that nobody is. The kernel may count the processes of one user in all containers together,
#: so each page has another one.
_FIRST_USER, _USERS = 20_000, 40_000


def _give_up_root(folder: Path) -> None:
    """Become another user, if one can run a page here: without a sandbox, pages begin as root.

    That is so in the containers of autograders. Another user reads neither files nor memory that
    are root's, and cannot change what is said of the page.

    Args:
        folder: The page's own; it belongs to that user then.
    """
    for parent in folder.parents:
        if parent.name.startswith("rosbeat-"):  # the grader's own
            parent.chmod(0o711)
    user = _FIRST_USER + _getpid() % _USERS
    try:
        os.setgroups([])
        os.setegid(user)
        os.seteuid(user)
        able = all(os.access(path, os.R_OK, effective_ids=True) for path in (__file__, os.__file__))
    except OSError:  # a container with few users
        able = False
    os.seteuid(0)
    os.setegid(0)
    if able:
        os.chown(folder, user, user)
        os.setresgid(user, user, user)
        os.setresuid(user, user, user)
    # Whoever changes its user is not ended with its parent any more, until this is said again.
    system_calls.prctl(system_calls.PR_SET_PDEATHSIG, signal.SIGKILL)


def _put(files: Mapping[str, str], root: Path) -> None:
    for name, content in files.items():
        path = root / name
        if name.endswith("/"):
            path.mkdir(parents=True, exist_ok=True)
        else:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content.encode("latin-1"))


Write = Callable[[Mapping[str, Any]], None]


def _writer(seal: str, result: int) -> Write:
    """Return what writes a line: the seal and an object of JSON."""

    def write(message: Mapping[str, Any]) -> None:
        _write_all(result, f"{seal}{_encode(message)}\n")

    return write


def _write_all(descriptor: int, text: str) -> None:
    data = memoryview(text.encode("utf-8", "replace"))
    while data:
        data = data[_write(descriptor, data) :]


class TooMuchOutput(KeyboardInterrupt):
    """End a cell that prints without end."""


class _Sink(io.TextIOBase):
    """Take what is printed, keep its beginning, and interrupt whoever prints without end."""

    def __init__(self) -> None:
        self.begin()

    def begin(self) -> None:
        """Begin a new cell."""
        self.printed, self.kept = 0, ""

    def writable(self) -> bool:
        return True

    def write(self, text: str) -> int:
        if len(self.kept) < _MOST_KEPT:
            self.kept += text[:_MOST_KEPT]
        self.printed += len(text)
        if self.printed > MOST_PRINTED:
            raise TooMuchOutput
        return len(text)


class _Patience:
    """Interrupt what goes on for long, as a learner does with a cell whose `main` spins.

    Args:
        lost: Seconds that earlier runs of the page have lost.
        give_up: Called when a cell goes on after it was interrupted; it ends the process.
    """

    def __init__(self, lost: float, give_up: Callable[[], None]) -> None:
        self._until: float | None = None
        self._interrupted_at: float | None = None
        self._paused, self.lost = 0.0, lost
        self._give_up = give_up
        threading.Thread(target=self._watch, args=(_getpid(),), daemon=True).start()

    def seconds(self, usual: float) -> float:
        """Return how long something may take, of which there may have been much already."""
        return usual if self.lost < LOST_AT_MOST else usual * HURRIED

    @contextmanager
    def cell(self) -> Iterator[None]:
        """Interrupt the block when it takes too long."""
        began, paused = _monotonic(), self._paused
        patience = self.seconds(CELL_SECONDS)
        self._interrupted_at = None
        self._until = began + patience
        try:
            yield
        finally:
            self._until = None
            taken = _monotonic() - began - (self._paused - paused)
            self.lost += taken if taken >= patience else 0.0

    @contextmanager
    def paused(self) -> Iterator[None]:
        """Wait for the block, which has a deadline of its own."""
        began, self._until = _monotonic(), None
        try:
            yield
        finally:
            self._until = _monotonic() + self.seconds(CELL_SECONDS)
            taken = _monotonic() - began
            self._paused += taken
            self.lost += taken if taken >= self.seconds(CHECK_SECONDS) else 0.0

    def _watch(self, process: int) -> None:
        # Nodes that run replace what `threading` waits with; this thread uses nothing of it.
        while True:
            _sleep(0.1)
            until = self._until
            if until is None or _monotonic() <= until:
                continue
            if self._interrupted_at is None:
                self._interrupted_at = _monotonic()
            elif _monotonic() > self._interrupted_at + GRACE:
                self._give_up()
            self._until = _monotonic() + 1.0  # who catches it is interrupted again
            _kill(process, signal.SIGINT)


class _Shell(InteractiveShell):
    """Behave as the shell of a kernel does that nobody sits in front of."""

    def raw_input(self, prompt: str = "") -> str:
        """Refuse a question, as a kernel does of which nobody has asked for them."""
        raise StdinNotImplementedError(
            "raw_input was called, but this frontend does not support input requests."
        )

    def showtraceback(self, *_: object, **__: object) -> None:
        """Show nothing: nobody reads it, and to format an exception may take for ever."""

    def set_custom_exc(self, *_: object) -> None:
        """Let nobody else show an exception either, such as the course, which explains them."""
        self.custom_exceptions = ()

    def _format_exception_for_storage(self, *_: object, **__: object) -> dict[str, object]:
        # IPython keeps each exception as it would show it; of a thousand calls, that takes seconds.
        return {}

    def enable_gui(self, gui: object = None) -> None:
        """Open no windows: `%matplotlib inline` needs none."""

    def ask_exit(self) -> None:
        """Go on: `exit` and `quit` end no page that runs from top to bottom."""


class _Page:
    """Run the cells of one page."""

    def __init__(self, job: PageJob, earlier: Earlier, write: Write) -> None:
        self._job, self._earlier, self._write = job, earlier, write
        self._given: set[str] = set()
        self._failures: dict[int, Evidence] = dict(earlier.left_out)
        self._failed_checks: dict[str, tuple[int, Evidence]] = {}
        self._sink = _Sink()
        self._patience = _Patience(earlier.lost, self._give_up)
        self._to_text = _to_text  # what is looked up by name, an answer may have changed
        self._loop = asyncio.new_event_loop()
        self._shell = _new_shell()

    def run(self) -> None:
        """Run all cells, then the checks that are missing."""
        sys.stdout = sys.stderr = self._sink
        null = os.open(os.devnull, os.O_RDWR)
        for descriptor in (0, 1, 2):
            os.dup2(null, descriptor)
        sys.argv = [*_ARGUMENTS]
        builtins.input = self._shell.raw_input  # as a kernel does
        check_module.hand_over_to(self._shell, self._check)
        watch_tampering(lambda remark: self._write({"remark": remark}))
        for number, cell in enumerate(self._job.cells):
            if number not in self._earlier.left_out:
                self._write({"cell": number})
                self._run_cell(number, cell)
            self._after_cell(number, cell)
        self._write({"cell": len(self._job.cells)})
        for exercise in self._job.subjects:
            if exercise not in self._given:
                self._check_at_the_end(exercise)
        self._write({"done": True})

    def _give_up(self) -> None:
        """End the process with a cell that no interrupt ends; the page is run again without it."""
        self._write({"stuck": True})
        _exit(1)

    def _run_cell(self, number: int, cell: PageCell) -> None:
        self._sink.begin()
        _signal(signal.SIGINT, signal.default_int_handler)  # as a kernel does for each cell
        result: Any = None
        error: BaseException | None = None
        with self._patience.cell():
            try:
                result = self._loop.run_until_complete(self._executed(cell.source))
            except BaseException as caught:  # an interrupt that no cell has caught
                error = caught
        if result is not None:
            error = result.error_before_exec or result.error_in_exec
        if error is not None:
            self._failures[number] = self._failure(error, cell.source)

    async def _executed(self, source: str) -> Any:  # noqa: ANN401 - IPython carries no types
        """Run a cell as ipykernel does: in a loop that runs, and awaited only if it awaits."""
        shell = self._shell
        try:
            transformed, problem = shell.transform_cell(source), None
        except Exception:
            transformed, problem = source, sys.exc_info()
        if shell.should_run_async(
            source, transformed_cell=transformed, preprocessing_exc_tuple=problem
        ):
            return await shell.run_cell_async(
                source,
                store_history=True,
                transformed_cell=transformed,
                preprocessing_exc_tuple=problem,
            )
        return shell.run_cell(source, store_history=True)

    def _failure(self, error: BaseException, source: str) -> Evidence:
        """Return how a cell failed."""
        if isinstance(error, TooMuchOutput):
            return Evidence("output")
        line = _line(error, self._shell.user_ns)
        lines = source.splitlines()
        code = lines[line - 1].strip() if 0 < line <= len(lines) else ""
        kind = type(error).__name__
        return Evidence("ended", raised=kind, text=_text(error), line=line, code=code)

    # Checks.

    def _check(self, exercise: Exercise[Any], answer: Any) -> None:  # noqa: ANN401 - any answer
        """Observe an answer; a cell of the page calls it, by `check`."""
        if exercise.id not in self._job.subjects:
            return
        self._write({"check": exercise.id})
        if exercise.id in self._earlier.given_up:
            self._give(exercise.id, self._earlier.given_up[exercise.id])
            return
        with self._patience.paused():
            if _is_looked_at(answer):
                self._look(exercise, answer)
            else:
                self._fork(exercise, answer)

    def _observed(self, exercise: Exercise[Any], answer: Any) -> str:  # noqa: ANN401 - any answer
        given = json.loads(self._job.given.get(exercise.id, "{}"))
        seen = exercise.observed(answer, self._job.seeds.get(exercise.id, 0), **given)
        return self._to_text(seen)

    def _look(self, exercise: Exercise[Any], answer: Any) -> None:  # noqa: ANN401 - any answer
        """Look at what a page has left in files and terminals; nothing of a learner's runs."""
        began = _monotonic()
        try:
            evidence = Evidence("ended", seen=self._observed(exercise, answer))
        except Exception as error:
            evidence = self._failure(error, "")
        self._give(exercise.id, evidence, began)

    def _fork(self, exercise: Exercise[Any], answer: Any) -> None:  # noqa: ANN401 - any answer
        """Observe an answer in a process of its own, so that whatever it does, the page goes on."""
        began, seconds = _monotonic(), self._patience.seconds(CHECK_SECONDS)
        reads, writes = _pipe()
        token = _urandom(16).hex()
        child = _fork()
        if child == 0:
            _close(reads)
            self._be_observed(exercise, answer, writes, token)
        _close(writes)
        written, is_late = _all_written(reads, child, began + seconds)
        _close(reads)
        code = _ended(child)
        if is_late:
            self._give(exercise.id, Evidence("deadline"), began)
        elif not written:
            self._give(exercise.id, Evidence("signal" if code < 0 else "exit", abs(code)), began)
        elif not written.startswith(token):
            self._give(exercise.id, Evidence(FORGED), began)
        else:
            self._given.add(exercise.id)
            report, seconds = written.removeprefix(token), round(_monotonic() - began, 3)
            self._write({"evidence": exercise.id, "report": report, "seconds": seconds})

    def _be_observed(
        self,
        exercise: Exercise[Any],
        answer: Any,  # noqa: ANN401 - any answer
        writes: int,
        token: str,
    ) -> None:
        """Be the process that observes an answer; it does not return."""
        code = 1
        try:
            # asyncio asks for the process in which a loop runs.
            events._set_running_loop(self._loop)
            self._sink.begin()
            try:
                evidence = Evidence("ended", seen=self._observed(exercise, answer))
                if self._sink.printed > MOST_PRINTED:
                    evidence = Evidence("output")
            except BaseException as error:
                evidence = self._failure(error, "")
            report = {**vars(evidence), "output": self._sink.kept}
            _write_all(writes, f"{token}{_encode(report)}")
            code = 0
        finally:
            _exit(code)

    def _give(self, exercise: str, evidence: Evidence, began: float | None = None) -> None:
        """Write the evidence of an exercise, with the seconds since its check began."""
        self._given.add(exercise)
        seconds = 0.0 if began is None else round(_monotonic() - began, 3)
        self._write({"evidence": exercise, **vars(evidence), "seconds": seconds})

    def _after_cell(self, number: int, cell: PageCell) -> None:
        """Note a check that its cell never came to; make one that is missing and cannot wait."""
        failure = self._failures.get(number)
        for exercise in cell.checks:
            if failure is not None and exercise in self._job.subjects:
                self._failed_checks[exercise] = number, failure
        exercise = cell.exercise
        if exercise in self._job.subjects and exercise not in self._checked():
            subject = self._job.subjects[exercise]
            # Later cells give another value to a name that several exercises ask for.
            if list(self._job.subjects.values()).count(subject) > 1 and failure is None:
                self._check_subject(exercise)

    def _checked(self) -> set[str]:
        return {exercise for cell in self._job.cells for exercise in cell.checks}

    def _check_at_the_end(self, exercise: str) -> None:
        """Make the check that a learner has removed, or say why the page's own gave no answer."""
        if exercise in self._failed_checks:
            number, failure = self._failed_checks[exercise]
            self._give(exercise, self._cause(exercise, number, failure))
        else:  # also if it is in a block that did not run, or a function that nobody has called
            self._check_subject(exercise)

    def _check_subject(self, exercise: str) -> None:
        text = self._job.subjects[exercise]
        self._sink.begin()
        with self._patience.cell():
            try:
                page_names.bring(self._shell, text)
                code = compile(text, "<check>", "eval", dont_inherit=True)
                self._check(EXERCISES[exercise], eval(code, self._shell.user_ns))
            except BaseException as error:
                failure = self._failure(error, text)
                self._give(exercise, self._cause(exercise, len(self._job.cells), failure))

    def _cause(self, exercise: str, before: int, failure: Evidence) -> Evidence:
        """Return why a name is not there that a check asks for: the cell of the answer failed."""
        names = _names_in(self._job.subjects[exercise])
        if failure.raised != "NameError" or not any(f"'{name}'" in failure.text for name in names):
            return failure
        pattern = re.compile(rf"\b(?:{'|'.join(map(re.escape, names))})\b")
        numbered = list(enumerate(self._job.cells))[:before]
        own = [
            number
            for number, cell in numbered
            if cell.exercise == exercise or (not cell.checks and pattern.search(cell.source))
        ]
        failed = [number for number in own if number in self._failures]
        if failed:
            return self._failures[failed[-1]]
        is_named = any(pattern.search(cell.source) for _, cell in numbered if not cell.checks)
        return replace(failure, is_missing=not is_named)


def _new_shell() -> Any:  # noqa: ANN401 - IPython carries no types
    config = Config()
    config.HistoryManager.enabled = False
    config.InteractiveShell.colors = "NoColor"
    shell: Any = _Shell.instance(config=config)
    exercise_cells.register(shell)
    page_names.register(shell, rosbeat.__all__, partial(getattr, rosbeat))
    register_commands(shell)
    return shell


def _is_looked_at(answer: Any) -> bool:  # noqa: ANN401 - any answer
    """Return whether an answer is the workspace or a terminal, of which nothing is called."""
    from rosbeat.workspace.terminals.terminal import Terminal

    return type(answer) in (str, Terminal) or isinstance(answer, Path)


def _all_written(reads: int, child: int, until: float) -> tuple[str, bool]:
    """Return what a process has written before it ended, and whether it took too long."""
    written = bytearray()
    ended = system_calls.pidfd_open(child)
    poll = _poll()
    poll.register(reads, select.POLLIN)
    poll.register(ended, select.POLLIN)
    try:
        while True:
            left = until - _monotonic()
            ready = dict(poll.poll(max(0, left) * 1000)) if left > 0 else {}
            if not ready:
                return "", True
            if reads in ready:
                data = _read(reads, 1 << 20)
                written += data
                if not data:
                    poll.unregister(reads)
                continue
            # It has ended, and all is read; others that it has started may still hold the pipe.
            return written.decode("utf-8", "replace"), False
    finally:
        _close(ended)


def _ended(child: int) -> int:
    """End a process, and return its exit code, or less a signal."""
    with suppress(ProcessLookupError):
        _kill(child, signal.SIGKILL)
    _, status = _waitpid(child, 0)
    return os.waitstatus_to_exitcode(status)


def _names_in(expression: str) -> tuple[str, ...]:
    """Return the names that an expression begins with, such as `HumiditySensor`."""
    tree = ast.parse(expression, mode="eval")
    return tuple(sorted({node.id for node in ast.walk(tree) if isinstance(node, ast.Name)}))


def _text(error: BaseException) -> str:
    try:
        text = error.msg if isinstance(error, SyntaxError) else str(error)
    except BaseException:  # a broken __str__
        text = ""
    return text[:_MOST_TEXT]


def _line(error: BaseException, space: Mapping[str, Any]) -> int:
    """Return the line of the cell in which an exception came up; 0 if that is not known."""
    if isinstance(error, SyntaxError) and str(error.filename).startswith("<ipython"):
        return error.lineno or 0
    lines = [
        number
        for frame, number in traceback.walk_tb(error.__traceback__)
        if frame.f_globals is space
    ]
    return lines[-1] if lines else 0
