"""What is wrong with an entry point, in words."""

from __future__ import annotations

from collections.abc import Callable

from rosbeat.workspace.targets import Flaw


def flaw_in_words(flaw: Flaw) -> str:
    """Say what is wrong with an entry point, and what to write instead.

    Args:
        flaw: What was found.
    """
    return _WORDS[flaw.kind](flaw)


def _missing_comma(flaw: Flaw) -> str:
    return (
        f"A comma is missing in setup.py, between the entry point in line {flaw.entry.line} and "
        "the one after it: Python joins two texts with no comma between them into one. "
        "Put a comma at the end of every entry point."
    )


def _no_equals(flaw: Flaw) -> str:
    return (
        f"The entry point in line {flaw.entry.line} of setup.py has no `=`. "
        "Write it as  'name = package.module:main'."
    )


def _two_equals(flaw: Flaw) -> str:
    return (
        f"The entry point in line {flaw.entry.line} of setup.py has more than one `=`. "
        "Write it with one, as  'name = package.module:main'."
    )


def _bad_name(flaw: Flaw) -> str:
    return (
        f"The entry point in line {flaw.entry.line} of setup.py has no usable name before "
        "the `=`. Put the word there that you want to type behind `ros2 run`."
    )


def _slash(flaw: Flaw) -> str:
    return (
        f"The entry point in line {flaw.entry.line} of setup.py names its module with a `/`, "
        f"like a path. Python's modules have dots between their parts: {flaw.right}"
    )


def _suffix(flaw: Flaw) -> str:
    return (
        f"The entry point {flaw.entry.executable} in setup.py names a file, {flaw.wrong}. "
        "A module has no `.py` at its end: "
        f"write {flaw.right}:{flaw.entry.function or 'main'}"
    )


def _no_function_part(flaw: Flaw) -> str:
    return (
        f"The entry point {flaw.entry.executable} in setup.py names a module and no function "
        f"in it. Put the function behind a colon: {flaw.wrong}:main"
    )


def _no_module(flaw: Flaw) -> str:
    hint = (
        f"Did you mean {flaw.right}?"
        if flaw.right
        else ("Compare it with the names of your files: package, dot, file without `.py`.")
    )
    return (
        f"The entry point {flaw.entry.executable} in line {flaw.entry.line} of setup.py names "
        f"the module {flaw.wrong}, and there is none of that name. {hint}"
    )


def _syntax_error(flaw: Flaw) -> str:
    path = flaw.wrong.replace(".", "/") + ".py"
    return syntax_error_in_words(path, flaw.line)


def _no_function(flaw: Flaw) -> str:
    hint = f"Did you mean {flaw.right}?" if flaw.right else "Define it, or name the right one."
    return (
        f"The entry point {flaw.entry.executable} in setup.py names the function {flaw.wrong}, "
        f"and {flaw.entry.module} has none of that name. {hint}"
    )


def syntax_error_in_words(path: str, line: int) -> str:
    """Say that a module cannot be read.

    Args:
        path: Its file.
        line: The line at which Python gives up.
    """
    return (
        f"Python cannot read {path}: there is a syntax error at line {line} or just before it. "
        "colcon copies files without reading them, so a build does not notice. "
        "Mend that line and build again."
    )


_WORDS: dict[str, Callable[[Flaw], str]] = {
    "missing-comma": _missing_comma,
    "no-equals": _no_equals,
    "two-equals": _two_equals,
    "bad-name": _bad_name,
    "slash": _slash,
    "suffix": _suffix,
    "no-function-part": _no_function_part,
    "no-module": _no_module,
    "syntax-error": _syntax_error,
    "no-function": _no_function,
}
