"""What is wrong with an entry point, in words."""

from __future__ import annotations

from collections.abc import Callable

from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.workspace.targets import Flaw

#: The mistake behind each kind of flaw.
MISTAKE_OF = {
    "missing-comma": "comma-missing",
    "no-equals": "entry-point-form",
    "two-equals": "entry-point-form",
    "bad-name": "entry-point-form",
    "slash": "slash-in-module",
    "suffix": "entry-point-target",
    "no-function-part": "entry-point-target",
    "called": "entry-point-form",
    "no-module": "entry-point-target",
    "no-function": "entry-point-target",
    "syntax-error": "syntax-error",
}


def diagnose_flaw(flaw: Flaw) -> Diagnosis:
    """Say what is wrong with an entry point, and what to write instead.

    Args:
        flaw: What was found.
    """
    return Diagnosis(MISTAKE_OF[flaw.kind], *_WORDS[flaw.kind](flaw))


def _missing_comma(flaw: Flaw) -> tuple[str, str]:
    return (
        f"A comma is missing in {flaw.entry.file}, between the entry point in line "
        f"{flaw.entry.line} and the one after it: Python joins two texts with no comma between "
        "them into one.",
        "Put a comma at the end of every entry point.",
    )


def _no_equals(flaw: Flaw) -> tuple[str, str]:
    return (
        f"The entry point in line {flaw.entry.line} of {flaw.entry.file} has no `=`.",
        "Write it as  'name = package.module:main'.",
    )


def _two_equals(flaw: Flaw) -> tuple[str, str]:
    return (
        f"The entry point in line {flaw.entry.line} of {flaw.entry.file} has more than one `=`.",
        "Write it with one, as  'name = package.module:main'.",
    )


def _bad_name(flaw: Flaw) -> tuple[str, str]:
    return (
        f"The entry point in line {flaw.entry.line} of {flaw.entry.file} has no usable name "
        "before the `=`.",
        "Put the word there that you want to type behind `ros2 run`.",
    )


def _slash(flaw: Flaw) -> tuple[str, str]:
    return (
        f"The entry point in line {flaw.entry.line} of {flaw.entry.file} names its module with "
        "a `/`, like a path.",
        f"Python's modules have dots between their parts: {flaw.right}",
    )


def _suffix(flaw: Flaw) -> tuple[str, str]:
    return (
        f"The entry point {flaw.entry.executable} in {flaw.entry.file} names a file, {flaw.wrong}.",
        f"A module has no `.py` at its end: write {flaw.right}:{flaw.entry.function or 'main'}",
    )


def _no_function_part(flaw: Flaw) -> tuple[str, str]:
    return (
        f"The entry point {flaw.entry.executable} in {flaw.entry.file} names a module and no "
        "function in it.",
        f"Put the function behind a colon: {flaw.wrong}:main",
    )


def _called(flaw: Flaw) -> tuple[str, str]:
    return (
        f"The entry point {flaw.entry.executable} in {flaw.entry.file} ends with {flaw.wrong}: an "
        "entry point names a function, and does not call it.",
        f"Leave out the brackets: write {flaw.right}",
    )


def _no_module(flaw: Flaw) -> tuple[str, str]:
    hint = (
        f"Did you mean {flaw.right}?"
        if flaw.right
        else ("Compare it with the names of your files: package, dot, file without `.py`.")
    )
    return (
        f"The entry point {flaw.entry.executable} in line {flaw.entry.line} of "
        f"{flaw.entry.file} names the module {flaw.wrong}, and there is none of that name.",
        hint,
    )


def _syntax_error(flaw: Flaw) -> tuple[str, str]:
    found = diagnose_syntax_error(flaw.wrong.replace(".", "/") + ".py", flaw.line)
    return found.evidence, found.hint


def _no_function(flaw: Flaw) -> tuple[str, str]:
    hint = f"Did you mean {flaw.right}?" if flaw.right else "Define it, or name the right one."
    return (
        f"The entry point {flaw.entry.executable} in {flaw.entry.file} names the function "
        f"{flaw.wrong}, and {flaw.entry.module} has none of that name.",
        hint,
    )


def diagnose_syntax_error(path: str, line: int) -> Diagnosis:
    """Say that a module cannot be read.

    Args:
        path: Its file.
        line: The line at which Python gives up.
    """
    return Diagnosis(
        "syntax-error",
        f"Python cannot read {path}: there is a syntax error at line {line} or just before it.",
        "colcon copies files without reading them, so a build does not notice. "
        "Mend that line and build again.",
    )


_WORDS: dict[str, Callable[[Flaw], tuple[str, str]]] = {
    "missing-comma": _missing_comma,
    "no-equals": _no_equals,
    "two-equals": _two_equals,
    "bad-name": _bad_name,
    "slash": _slash,
    "suffix": _suffix,
    "no-function-part": _no_function_part,
    "called": _called,
    "no-module": _no_module,
    "syntax-error": _syntax_error,
    "no-function": _no_function,
}
