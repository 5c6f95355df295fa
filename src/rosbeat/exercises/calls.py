"""A function that writes entry points, judged by its texts."""

from __future__ import annotations

import re
from importlib.metadata import EntryPoint

from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.exercises.call_runs import ARGUMENTS, LATE, Calls


def diagnose_calls(seen: Calls) -> Diagnosis | None:
    """Recognise what is wrong with a function that writes entry points.

    Args:
        seen: What it gave back.
    """
    if seen.problem:
        mistake, hint = _of_problem(seen)
        return Diagnosis(mistake, _said(seen.problem), hint)
    # Whatever the evidence says of the arguments: these are what the function was called with.
    for arguments, (_, result), kind in zip(ARGUMENTS, seen.results, seen.kinds, strict=True):
        wrong = _of_kind(kind) or _of_text(arguments, result)
        if wrong:
            mistake, hint = wrong
            return Diagnosis(mistake, f"entry_point{arguments} gives {result!r}.", hint)
    return None


def _said(problem: str) -> str:
    late = problem.startswith(LATE)
    return f"It does not end{problem.removeprefix(LATE)}." if late else f"It raised {problem}."


_HAND_OVER = 'Hand over the function itself, by its name: check("05b", entry_point).'
_GIVES_TEXT = 'The function gives back one text. f"{executable} ..." puts values into a text.'


def _of_problem(seen: Calls) -> tuple[str, str]:
    if seen.problem.startswith(LATE):
        return "does-not-return", "The function needs no loop: it returns one text."
    if seen.problem.startswith("SystemExit"):
        return "exits", "A function ends with return; exit would end the whole program."
    if "object is not callable" in seen.problem and not seen.results:
        return "no-function", _HAND_OVER
    if re.search(r"takes \d+ positional|missing \d+ required positional", seen.problem):
        return (
            "parameters-changed",
            "It is called with three arguments, and with four: keep the line that begins with def.",
        )
    if seen.problem.startswith("NameError"):
        return (
            "name-error",
            "Python does not know this name. The function has four parameters, and what is to "
            "appear as it stands needs quotes.",
        )
    return "raised", _GIVES_TEXT


def _of_kind(kind: str) -> tuple[str, str] | None:
    if kind == "str":
        return None
    if kind == "NoneType":
        return (
            "returns-nothing",
            "Nothing came back: the function needs a return, and print gives back nothing.",
        )
    return "not-a-text", _GIVES_TEXT


_ENOUGH = "Return the bare text: no quotes, brackets or blanks around it."
_NO_MORE = "Nothing stands after the name of the function: no brackets, no comma."
_FIRST = "What is typed after ros2 run comes first, then an equals sign."
_DOT = "Between the equals sign and the colon stands package.module, with a dot."
_COLON = "After a colon comes the name of the function that was handed over."
_USE_ALL = "The text has to change with what the function is given: put its parameters in."


def _of_text(arguments: tuple[str, ...], result: str) -> tuple[str, str] | None:
    function = arguments[3] if len(arguments) > 3 else "main"
    if "{" in result:
        return (
            "f-missing",
            "The braces are still there: an f before the first quote fills them in.",
        )
    if result.strip() != result or result[:1] in "'\"(":
        return "stray-characters", _ENOUGH
    name, equals, target = result.partition("=")
    if not equals or name.strip() != arguments[0]:
        return _of_name(arguments, result)
    return _of_target(arguments, function, target.strip())


def _of_name(arguments: tuple[str, ...], result: str) -> tuple[str, str]:
    used = any(part in result.replace("=", " ").split() for part in arguments)
    if not used and not any(f"{part}." in result or f".{part}" in result for part in arguments):
        return "swallowed-parameter", _USE_ALL
    return "entry-point-form", _FIRST


def _of_target(arguments: tuple[str, ...], function: str, target: str) -> tuple[str, str] | None:
    try:
        found = EntryPoint("any", target, "console_scripts")
        module, called = found.module, found.attr
    except AttributeError:  # that is how the library says that it is none
        module, called = "", ""
    dotted = f"{arguments[1]}.{arguments[2]}"
    if (module, called) == (dotted, function) and target.endswith(function):
        return None
    return _of_parts(arguments, function, target)


def _of_parts(arguments: tuple[str, ...], function: str, target: str) -> tuple[str, str]:
    dotted = f"{arguments[1]}.{arguments[2]}"
    left, colon, right = (part.strip() for part in target.partition(":"))
    if left == dotted and right.startswith(function):
        return "stray-characters", _NO_MORE
    if "/" in left:
        return "slash-in-module", _DOT
    if left.startswith("="):
        return "entry-point-form", "One equals sign is enough: it is no comparison."
    if left == dotted and colon and right == "main":
        return "swallowed-parameter", f"{_COLON} It is not always main."
    if left == dotted or left == f"{dotted}.{function}":
        return "entry-point-target", _COLON
    return "entry-point-target", _DOT
