"""Page 05, set the entry points: two programs in setup.py, and what an entry point is made of."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from rosbeat.checks.verdicts import BLANK, failed, not_attempted, passed
from rosbeat.exercises.exercise import Exercise
from rosbeat.exercises.looking import Workspace, look_at_workspace
from rosbeat.records import Outcome
from rosbeat.workspace.packages import Package
from rosbeat.workspace.targets import Flaw

_PACKAGE = "sensor_simulator"
_PROGRAMS = ("temperature_publisher", "temperature_subscriber")
_ANATOMY = "An entry point is 'executable = package.module:function'."

_PLAIN = (
    "Some entries are calculated, and this check reads setup.py without running it. Write both "
    "as plain texts."
)
_CALLED = (
    "The executable is the name before the equals sign, and the exercise says what it is called. "
    "It is not the name of the node."
)

#: What is wrong with an entry point, by the kind of the flaw.
_FLAWS = {
    "missing-comma": "two entries have become one",
    "no-equals": "has no equals sign",
    "two-equals": "has two equals signs",
    "bad-name": "begins with a name that no program can have",
    "slash": "has a slash in the module",
    "suffix": "names a file, with .py, and not a module",
    "no-function-part": "names no function",
    "no-module": "names a module that does not exist",
    "syntax-error": "names a module that Python cannot read",
    "no-function": "names a function that its module does not have",
}
_CURES = {
    "missing-comma": "A comma is missing after the first one: Python glues texts together.",
    "no-equals": _ANATOMY,
    "two-equals": "One equals sign is enough: it is no comparison.",
    "bad-name": _ANATOMY,
    "slash": "Modules are written with dots: package.module.",
    "suffix": "Leave out .py: a module is named without it.",
    "no-function-part": "After the module comes a colon and the name of the function.",
    "no-module": "The module is package.file: the folder with __init__.py, a dot, the file's name.",
    "syntax-error": "Mend the file, on page 03 or 04, and run its cell again.",
    "no-function": "Look for `def` in the file. The name stands without brackets here.",
}


def _judge_setup(seen: Workspace) -> Outcome:
    package = seen.packages.get(_PACKAGE)
    if package is None:
        return not_attempted("05a", f"There is no package {_PACKAGE} in src yet.")
    if package.setup.problem:
        return failed(
            "05a",
            f"setup.py cannot be read: {package.setup.problem}, line {package.setup.line}.",
            "Each entry is a text between quotes, with a comma after it, inside the square "
            "brackets.",
        )
    if not package.setup.entry_points and not package.setup.incomplete:
        return not_attempted("05a", "setup.py has no entry points yet.")
    return _judge_entries(package)


def _judge_entries(package: Package) -> Outcome:
    if package.flaws:
        return _flawed(package.flaws[0])
    targets = {e.executable: f"{e.module}:{e.function}" for e in package.setup.entry_points}
    for program in _PROGRAMS:
        wanted = f"{_PACKAGE}.{program}:main"
        if program not in targets and package.setup.incomplete:
            return failed("05a", f"There is no {program} that can be read here.", _PLAIN)
        if program not in targets:
            found = ", ".join(targets)
            return failed("05a", f"There is no {program}. The executables are: {found}.", _CALLED)
        if targets[program] != wanted:
            return failed(
                "05a",
                f"{program} would call {targets[program]}.",
                "It should call main in the file of the same name.",
            )
    return passed("05a", f"setup.py names {' and '.join(_PROGRAMS)}.")


def _flawed(flaw: Flaw) -> Outcome:
    return failed(
        "05a",
        f"Line {flaw.entry.line} of setup.py, '{flaw.entry.text}': {_FLAWS[flaw.kind]}.",
        _CURES[flaw.kind],
    )


@dataclass(frozen=True)
class Calls:
    """What a function gave back.

    Attributes:
        results: Arguments and result of each call, as text.
        problem: The exception that ended the calls, or empty.
    """

    results: tuple[tuple[tuple[str, ...], str], ...]
    problem: str = ""


_ARGUMENTS = (
    ("talk", "rosie", "voice"),
    ("watch_room", "house", "monitor", "start"),
    ("a", "b", "c", "d"),
)


def _call(answer: Any) -> Calls:  # noqa: ANN401 - whatever a learner hands over
    done: list[tuple[tuple[str, ...], str]] = []
    try:
        for arguments in _ARGUMENTS:
            done.append((arguments, str(answer(*arguments))))
    except Exception as error:  # whatever a learner's function raises is evidence
        return Calls(tuple(done), f"{type(error).__name__}: {error}")
    return Calls(tuple(done))


def _judge_calls(seen: Calls) -> Outcome:
    if f"'{BLANK}'" in seen.problem:
        return not_attempted("05b")
    if "not callable" in seen.problem and not seen.results:
        return failed("05b", f"It raised {seen.problem}.", _HAND_OVER)
    if seen.problem:
        return failed("05b", f"It raised {seen.problem}.", _GIVES_TEXT)
    for arguments, result in seen.results:
        wrong = _wrong_part(arguments, result)
        if wrong:
            return failed("05b", f"entry_point{arguments} gives {result!r}.", wrong)
    return passed("05b", f"For example {seen.results[0][1]!r}.")


_HAND_OVER = 'Hand over the function itself, by its name: check("05b", entry_point).'
_GIVES_TEXT = 'The function gives back one text. f"{executable} ..." puts values into a text.'


def _wrong_part(arguments: tuple[str, ...], result: str) -> str:
    executable, package, module = arguments[:3]
    function = arguments[3] if len(arguments) > 3 else "main"
    name, equals, target = result.partition("=")
    if result == "None":
        return "Nothing came back: the function needs a return, and print gives back nothing."
    if "{" in result:
        return "The braces are still there: an f before the first quote fills them in."
    if result.strip() != result or result[:1] in "'\"(":
        return "Return the bare text: no quotes, brackets or blanks around it."
    if not equals or name.strip() != executable:
        return "What is typed after ros2 run comes first, then an equals sign."
    dotted, colon, called = target.strip().partition(":")
    if dotted != f"{package}.{module}":
        return "Between the equals sign and the colon stands package.module, with a dot."
    if called.startswith(function) and called != function:
        return "Nothing stands after the name of the function: no brackets, no comma."
    if not colon or called != function:
        return "After a colon comes the name of the function that was handed over."
    return ""


EXERCISES: tuple[Exercise[Any], ...] = (
    Exercise("05a", look_at_workspace, _judge_setup),
    Exercise("05b", _call, _judge_calls),
)
