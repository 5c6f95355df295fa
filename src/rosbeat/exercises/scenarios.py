"""Run or inspect an answer: what the scenarios of several pages share."""

from __future__ import annotations

import json
import re
import sys
from collections.abc import Callable, Iterable, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any, TypeAlias

from rosbeat.diagnosis.connections import Wire
from rosbeat.errors import ExerciseError
from rosbeat.records import Observation, QoS
from rosbeat.ros.isolation import Deadline
from rosbeat.workspace.commands import recognise
from rosbeat.workspace.packages import Package, find_packages, is_stray, read_package

# What `ros` runs answers with, imported when the first one runs.

#: An answer: whatever a learner handed over.
Answer: TypeAlias = Any
#: Any value, such as an option or the data of a message.
Value: TypeAlias = Any
#: A node of rclpy, and a step of `rosbeat.ros.scenario`; neither is imported here.
Node: TypeAlias = Any
Step: TypeAlias = Any


def observe(answer: Answer, seconds: float, **options: Value) -> Observation:
    """Run an answer in virtual time; see `rosbeat.ros.scenario.observe`."""
    from rosbeat.ros import scenario

    return scenario.observe(answer, seconds, **options)


def overheard() -> AbstractContextManager[list[str]]:
    """Collect the beginning of what answers print; see `rosbeat.ros.isolation.overheard`."""
    from rosbeat.ros import isolation

    return isolation.overheard()


def observe_system(answer: Answer, seconds: float, **options: Value) -> Observation:
    """Run several nodes in virtual time; see `rosbeat.ros.scenario.observe_system`."""
    from rosbeat.ros import scenario

    return scenario.observe_system(answer, seconds, **options)


def feeder(name: str, wire: Wire, values: Iterable[Value], **options: Value) -> Callable[[], Node]:
    """Return what makes a node that publishes one value a second; see `test_nodes.feeder`."""
    from rosbeat.ros import test_nodes

    return test_nodes.feeder(name, wire.topic, wire.type_name, values, **options)


def listener(name: str, wire: Wire, qos: QoS | int = 10) -> Callable[[], Node]:
    """Return what makes a node that logs the messages on a topic; see `test_nodes.listener`."""
    from rosbeat.ros import test_nodes

    return test_nodes.listener(name, wire.topic, wire.type_name, qos)


def station(name: str, topic: str, readings: Iterable[float | None]) -> Callable[[], Node]:
    """Return what makes a sensor of one `Float32` a second; None is a second without a message."""
    values = [None if reading is None else float(reading) for reading in readings]
    return feeder(name, Wire(topic, "std_msgs/msg/Float32"), values)


def drift(phases: Sequence[tuple[float, float]]) -> Callable[[], Node]:
    """Return what makes a node that tilts random numbers; see `test_nodes.drift`."""
    from rosbeat.ros import test_nodes

    return test_nodes.drift(phases)


def started(make: Answer, **start: Value) -> Answer:
    """Return an answer to run beside another, started like `Session.add(make, **start)`."""
    from rosbeat.ros import launch

    return launch.Maker(make, launch.checked(**start))


def publishing(wire: Wire, said: Iterable[tuple[float, Any]], qos: QoS | None = None) -> list[Step]:
    """Return steps that publish values, each at its time in seconds."""
    from rosbeat.ros.scenario import Publish

    make = partial(Publish, topic=wire.topic, type_name=wire.type_name, qos=qos or QoS())
    return [make(at, values=(value,)) for at, value in said]


def adding(at: float, make: Callable[[], Node]) -> Step:
    """Return a step that adds a node at a time in seconds."""
    from rosbeat.ros.scenario import Add

    return Add(at, make=make)


def removing(at: float, node: str) -> Step:
    """Return a step that destroys a node at a time in seconds."""
    from rosbeat.ros.scenario import Remove

    return Remove(at, node)


# A function whose result is the answer: called once, and what it gave back as plain data.

#: Seconds of wall time that the function may take.
FUNCTION_DEADLINE = 2.0
#: Characters of JSON that a result may have.
MOST = 20_000


@dataclass(frozen=True)
class Report:
    """Hold what a function gave back.

    Attributes:
        result: Its result as a text of JSON, where tuples are lists and keys of dicts are texts;
            empty if it gave back something else, or raised.
        problem: The exception that it raised, or why its result is no plain data; or empty.
        type_name: The type of its result.
    """

    result: str
    problem: str = ""
    type_name: str = ""

    @property
    def value(self) -> Value:
        """Return the result, any plain data; None if there is none."""
        return json.loads(self.result) if self.result else None


def report(answer: Answer, *arguments: Value) -> Report:
    """Call a function and write down what it gives back.

    Args:
        answer: The function.
        arguments: What it is called with.
    """
    seen = Report("", f"Deadline: it was still running after {FUNCTION_DEADLINE:g} s")
    with Deadline(FUNCTION_DEADLINE) as deadline:
        try:
            seen = _written(answer(*arguments))
        except (Exception, SystemExit) as error:  # whatever a learner's function does is evidence
            seen = Report("", f"{type(error).__name__}: {error}")
    late = f"Deadline: it was still running after {FUNCTION_DEADLINE:g} s"
    return Report("", late) if deadline.passed else seen


def _written(value: Value) -> Report:
    kind = type(value).__name__
    if value is None:
        return Report("", "", kind)
    try:
        text = json.dumps(_plain(value))
    except (TypeError, ValueError, RecursionError) as error:
        return Report("", f"NotPlain: {error}", kind)
    if len(text) > MOST:
        return Report("", f"NotPlain: it is {len(text)} characters long", kind)
    return Report(text, "", kind)


def _plain(value: Value) -> Value:
    """Return a value with Python's own numbers in the place of NumPy's."""
    numpy = sys.modules.get("numpy")  # where nobody has imported it, nothing is of its types
    if numpy and isinstance(value, numpy.generic):
        return value.item()
    if isinstance(value, dict):
        return {_plain(key): _plain(item) for key, item in value.items()}
    return [_plain(item) for item in value] if isinstance(value, list | tuple) else value


# Scenarios that look: at a workspace, or at a terminal. Nothing of a learner's is run here.

#: What colcon makes; it belongs to no exercise.
_BUILT = {"build", "install", "log", "kept"}
#: A line that was typed, behind its prompt.
_TYPED = re.compile(r"^(\S+)\$ (.+)$", re.MULTILINE)


@dataclass(frozen=True)
class Workspace:
    """Hold what is in a workspace.

    Attributes:
        folders: Every folder, relative to the workspace, without links and what colcon makes.
        packages: Every package, wherever it lies.
        strays: Each `package.xml` that makes a package of a folder for packages, relative to the
            workspace: colcon finds none of those below it.
    """

    folders: tuple[str, ...]
    packages: dict[str, Package]
    strays: tuple[str, ...] = ()

    def place_of(self, name: str, root: str = "src") -> str:
        """Return where a package lies that is not in `root`, or an empty text."""
        package = self.packages.get(name)
        parent = package.folder.parent.as_posix() if package else root
        return "" if parent == root else parent.replace(".", "the workspace itself")


@dataclass(frozen=True)
class CommandMeaning:
    """Hold what a command's outcome means, as `workspace.commands` recognised it on the spot.

    The files that a command was about are gone when the evidence is judged.

    Attributes:
        mistake: The mistake's id.
        evidence: What shows it.
        hint: What to try.
    """

    mistake: str
    evidence: str
    hint: str


@dataclass(frozen=True)
class TypedIn:
    """Hold what was typed in a terminal, and where that led.

    Attributes:
        folder: The folder it is in, relative to the workspace; absolute if that is outside.
        commands: Each line that was typed, with the folder it was typed in, as the prompt said it.
        exit_code: Of the last command that ended.
        text: All that it shows.
        meaning: What a line that was typed has led to, if it is a known mistake.
    """

    folder: str
    commands: tuple[tuple[str, str], ...]
    exit_code: int | None
    text: str
    meaning: CommandMeaning | None = None


def look_at_workspace(answer: Answer) -> Workspace:
    """Look at a workspace.

    Args:
        answer: Its folder; `workspace.folder()` on a page.

    Raises:
        ExerciseError: If that is no folder.
    """
    # An empty text would be the folder of the notebook.
    root = Path(answer) if isinstance(answer, (str, Path)) and str(answer).strip() else None
    if root is None or not root.is_dir():
        raise ExerciseError(
            f"There is no workspace at {root or repr(answer)}.",
            "This check examines the folders of your workspace.",
            "Write workspace.folder(), and run the cells above first: they create the workspace.",
        )
    folders = find_packages(root)
    strays = [one for one in folders if is_stray(one, root)]
    read = (read_package(folder, root) for folder in folders if folder not in strays)
    found = [replace(one, folder=one.folder.relative_to(root)) for one in read]
    # Of two with one name, the one in src under that name counts; a backup has its name, too.
    packages = sorted(found, key=lambda one: one.folder.as_posix() == f"src/{one.name}")
    return Workspace(
        _folders(root),
        {package.name: package for package in packages},
        tuple((one.relative_to(root) / "package.xml").as_posix() for one in strays),
    )


def look_at_terminal(answer: Answer, root: Path, about: str = "") -> TypedIn:
    """Look at a terminal of the page.

    Args:
        answer: The terminal; `workspace.terminal("one")` on a page.
        root: The workspace.
        about: What the line holds whose meaning is asked for; of several the last one. By default,
            and if there is none, it is the last line of all.

    Raises:
        ExerciseError: If that is no terminal.
    """
    if not all(hasattr(answer, name) for name in ("folder", "text", "exit_code")):
        raise ExerciseError(
            f"{answer!r} is not a terminal.",
            "This check looks at a terminal of the page.",
            'Write workspace.terminal("...") with the name of the terminal in the cell above.',
        )
    folder, text, code = Path(answer.folder), answer.text, answer.exit_code
    typed = list(_TYPED.finditer(text))
    at = max((at for at, one in enumerate(typed) if about in one[2]), default=len(typed) - 1)
    return TypedIn(
        _inside(folder, root),
        tuple((one[1], one[2]) for one in typed),
        code,
        text,
        _meaning(typed[at:], text, code, folder, root) if typed else None,
    )


def page_terminals() -> Iterable[Any]:
    """Return the open terminals of this page; none where there is no page."""
    from IPython import get_ipython

    from rosbeat.workspace.terminals import terminals_of

    shell = get_ipython()
    return terminals_of(shell) if shell else ()


def typed_about(
    root: Path, is_about: Callable[[str], bool]
) -> tuple[tuple[tuple[str, str], ...], CommandMeaning | None]:
    """Return what was typed about something in the terminals of this page.

    Args:
        root: The workspace.
        is_about: Tells whether a line is about it.

    Returns:
        Each such line, with the folder it was typed in, as the prompt said it; and what the last of
        them has led to, if it is a known mistake.
    """
    typed: tuple[tuple[str, str], ...] = ()
    meaning = None
    for terminal in page_terminals():
        lines = tuple(one for one in look_at_terminal(terminal, root).commands if is_about(one[1]))
        if lines:
            typed += lines
            meaning = look_at_terminal(terminal, root, lines[-1][1]).meaning
    return typed, meaning


def meaning_of(
    command: str, output: str, code: int, folder: Path, root: Path
) -> CommandMeaning | None:
    """Return the mistake behind a command's outcome, or None if it is not a known one.

    Args:
        command: The command line.
        output: The output in the terminal.
        code: The exit code.
        folder: The current folder of the terminal.
        root: The workspace; its files are read, and nothing is run.
    """
    found = recognise(command, output, code, folder, root)
    return CommandMeaning(found.mistake, found.evidence, found.hint) if found else None


def _meaning(
    lines: list[re.Match[str]], text: str, code: int | None, folder: Path, root: Path
) -> CommandMeaning | None:
    """Return what the first of some lines has led to; of earlier ones no exit code is known."""
    end = lines[1].start() if len(lines) > 1 else len(text)
    output = text[lines[0].end() : end]
    return meaning_of(lines[0][2], output, 1 if len(lines) > 1 else code or 0, folder, root)


def _folders(root: Path) -> tuple[str, ...]:
    found = (path.relative_to(root) for path in root.rglob("*")
             if path.is_dir() and not path.is_symlink())  # fmt: skip
    return tuple(sorted(path.as_posix() for path in found if path.parts[0] not in _BUILT))


def _inside(folder: Path, root: Path) -> str:
    folder, root = folder.resolve(), root.resolve()
    return folder.relative_to(root).as_posix() if root in (folder, *folder.parents) else str(folder)
