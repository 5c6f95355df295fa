"""Page 05, set the entry points: two programs in setup.py, and what an entry point is made of."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

from rosbeat.diagnosis.mistakes import UNKNOWN, Diagnosis
from rosbeat.exercises.draw import Draw
from rosbeat.exercises.exercise import BLANK, Exercise, Verdict, not_attempted, passed
from rosbeat.exercises.scenarios import Answer, Report, Workspace, look_at_workspace, report
from rosbeat.exercises.workspace_model import diagnose_entries, diagnose_script
from rosbeat.workspace.packages import Package

# 05a, two programs: a setup.py, which is read and never run, so nothing is drawn.

_PACKAGE = "sensor_simulator"
_PROGRAMS = ("temperature_publisher", "temperature_subscriber")


def _judge_setup(seen: Workspace) -> Verdict:
    package = seen.packages.get(_PACKAGE)
    if package is None:
        return not_attempted(f"There is no package {_PACKAGE} in src yet.")
    found = diagnose_script(package)
    entries = package.setup.entry_points
    if not found and not package.setup.incomplete and all(BLANK in one.text for one in entries):
        return not_attempted("setup.py has no entry points yet.")
    found = found or diagnose_entries(package, _PROGRAMS) or _diagnose_data_files(package)
    if found:
        return found
    said = f"setup.py names {' and '.join(_PROGRAMS)}."
    return passed(said, *_remarks_on_texts(package))


def _diagnose_data_files(package: Package) -> Diagnosis | None:
    if not package.setup.left_out:
        return None
    return Diagnosis(
        "data-files-missing",
        f"Both entries are there, and `data_files` of setup.py leaves out "
        f"{' and '.join(package.setup.left_out)}, or puts it into another folder.",
        "`data_files` names what is installed besides code: every ROS package installs its marker "
        "and its manifest. Compare both lines with the setup.py that the page shows.",
    )


def _remarks_on_texts(package: Package) -> tuple[str, ...]:
    """Return a remark if setup.py says something else than package.xml, besides the name."""
    said, manifest = dict(package.setup.about), package.manifest
    texts = {
        "version": manifest.version,
        "description": manifest.description,
        "license": manifest.license,
    }
    other = [key for key, text in texts.items() if key in said and text and said[key] != text]
    if not other:
        return ()
    return (
        f"setup.py and package.xml do not say the same of the package: {', '.join(other)}. "
        "Nothing compares the two, so you do.",
    )


# 05b, write entry points: a function, called with several arguments.

#: What the function is called with, one call after the other.
Calls = tuple[tuple[str, ...], ...]


def draw_calls(draw: Draw) -> Calls:
    """Draw the names with which the function is called.

    The capital letters, underscores and last letters show whether it changes what it is given.
    """
    return (
        draw.shuffled(("talk", "rosie", "voice")),
        draw.shuffled(("watch_room", "house", "monitor", "start")),
        draw.shuffled(("a", "b", "c", "d")),
        draw.shuffled(("showRoom_2", "lampKit_1", "bigDisplay_3", "runAll_4")),
        draw.shuffled(("puppy", "happy", "copy")),
    )


_NO_FUNCTION = "NoFunction"


def _call(answer: Answer, calls: Calls) -> Report:
    """Call a function that writes entry points, with several arguments."""
    if not callable(answer):
        return Report("", _NO_FUNCTION)
    return report(lambda: [_plain(answer(*arguments)) for arguments in calls])


#: The key under which a tuple is written down, which JSON would make a list of.
_TUPLE = "tuple"


def _plain(result: object) -> object:
    """Return a result as plain data that tells a tuple of texts from a list."""
    is_tuple = type(result) is tuple and all(type(one) is str for one in result)
    return {_TUPLE: result} if is_tuple else result


def _shown(result: object) -> str:
    """Return a result as Python writes it."""
    if isinstance(result, dict) and list(result) == [_TUPLE]:
        return repr(tuple(result[_TUPLE]))
    return repr(result)


_GIVES_TEXT = 'The function returns one string. f"{executable} ..." inserts values into a string.'
#: How an exception begins or reads, the mistake behind it, and where to look.
_PROBLEMS = (
    (r"Deadline", "does-not-return", "The function needs no loop: it returns one text."),
    (r"SystemExit", "exits", "A function ends with return; exit would end the whole program."),
    (
        _NO_FUNCTION,
        "no-function",
        'Hand over the function itself, by its name: check("05b", entry_point).',
    ),
    (
        r".*(takes (from )?\d+ .*positional|missing \d+ required positional)",
        "parameters-changed",
        "It is called with three arguments, and with four: keep the line that begins with def.",
    ),
    (
        r"NameError",
        "name-error",
        "Python does not know this name. The function has four parameters, and what is to appear "
        "as it stands needs quotes.",
    ),
    (r"NotPlain", "not-a-text", _GIVES_TEXT),
    (r"", "raised", _GIVES_TEXT),
)


def _judge_calls(seen: Report, calls: Calls) -> Verdict:
    if f"'{BLANK}'" in seen.problem:
        return not_attempted()
    if seen.problem:
        return _diagnose_problem(seen.problem)
    return _diagnose_texts(seen.value, calls) or passed(f"For example {seen.value[0]!r}.")


def _diagnose_problem(problem: str) -> Diagnosis:
    mistake, hint = next(row[1:] for row in _PROBLEMS if re.match(row[0], problem, re.DOTALL))
    said = {
        "does-not-return": f"It does not end{problem.removeprefix('Deadline')}.",
        "no-function": "What was handed over is not a function.",
        "not-a-text": f"The results are not texts: {problem.partition(': ')[2]}.",
    }
    return Diagnosis(mistake, said.get(mistake, f"It raised {problem}."), hint)


def _diagnose_texts(results: list[Any], calls: Calls) -> Diagnosis | None:
    for arguments, result in zip(calls, results, strict=True):
        evidence = f"entry_point{arguments} gives {_shown(result)}."
        if result is None:
            hint = "Nothing came back: the function needs a return, and print gives back nothing."
            return Diagnosis("returns-nothing", evidence, hint)
        if not isinstance(result, str):
            return Diagnosis("not-a-text", evidence, _GIVES_TEXT)
        if "{" in result:
            hint = "The braces are still there: an f before the first quote fills them in."
            return Diagnosis("f-missing", evidence, hint)
    for arguments, result in zip(calls, results, strict=True):
        if _without_spaces(result) != _right(arguments):
            mistake, hint = _slip(results, calls)
            return Diagnosis(mistake, f"entry_point{arguments} gives {result!r}.", hint)
    return None


def _without_spaces(text: str) -> str:
    """Return an entry point without the spaces around its signs, which mean nothing."""
    return re.sub(r"[ \t]*([=:]+)[ \t]*", r"\1", text)


def _right(arguments: tuple[str, ...]) -> str:
    return "{}={}.{}:{}".format(*arguments, "main")


_DOT = "Between the equals sign and the colon stands package.module, with a dot."
_COLON = "After a colon comes the name of the function that was handed over."
#: What is wrong if one of the signs is another, or a name beside it is not at its place.
_SLIPS = {
    "=": (
        "entry-point-form",
        "What is typed after ros2 run comes first, then an equals sign.",
    ),
    ".": ("entry-point-target", _DOT),
    ":": ("entry-point-target", _COLON),
}
#: The same, by the right sign and the one that was written.
_SLIPS_OF_SIGNS = {
    ("=", "=="): ("entry-point-form", "One equals sign is enough: it is no comparison."),
    (".", "/"): ("slash-in-module", _DOT),
    (":", ".py:"): ("entry-point-target", "A module is named without .py."),
}


def _slip(results: Sequence[str], calls: Calls) -> tuple[str, str]:
    """Return the mistake in texts that are not all right, and a hint.

    The names with which the function was called are looked for in what it returned; what is left
    between them are the signs.
    """
    unknown = UNKNOWN, "Compare it with the table on the page, character by character."
    plain = [_without_spaces(one).lower().replace("-", "_") for one in results]
    if plain == [_right(given).lower() for given in calls]:
        return "wrong-values", "Names count letter by letter: put the parameters in as they are."
    given = calls[1]
    before, *parts = re.split(f"({'|'.join(given)})", _without_spaces(results[1]))
    names, signs = parts[::2], parts[1::2]
    words = re.findall(r"\w*[^\W_]\w*", " ".join([before, *parts]).replace(".py", ""))
    if words != names:  # some are written out
        at_place = all(
            one == name or one not in given for one, name in zip(words, given, strict=False)
        )
        if names and not (at_place and len(words) == len(given)):
            return unknown
        always_main = f"{_COLON} It is not always main."
        use_all = "The result has to depend on the arguments: use the function's parameters."
        return "swallowed-parameter", always_main if words[:3] == names else use_all
    for at, (name, sign) in enumerate(zip(given, "=..:", strict=True)):
        if names[at : at + 1] != [name]:
            return _SLIPS[sign]
    for found, sign in zip(signs, "=.:", strict=False):
        if found != sign:
            return _SLIPS_OF_SIGNS.get((sign, found), _SLIPS[sign])
    if before or signs[-1]:
        return "stray-characters", "Return just the entry point, with nothing before or after it."
    return unknown


EXERCISES: tuple[Exercise[Any], ...] = (
    Exercise(
        "05a",
        look_at_workspace,
        _judge_setup,
        title="two programs",
        points=2,
        hints=(
            "Each program needs one string in the list of console scripts.",
            (
                "An entry consists of the name that you type after `ros2 run` and the"
                " package, an equals sign, and the place of the code."
            ),
            (
                "The place of the code is: the package, a dot, the file without .py, "
                "a colon, the function."
            ),
            ("Two entries are two strings: put quotes around each, and a comma after each."),
        ),
    ),
    Exercise(
        "05b",
        _call,
        _judge_calls,
        title="write entry points",
        hints=(
            "The function returns one string, made of its arguments.",
            ("An f before the opening quote inserts values where the braces are."),
            ("Insert four values, with three characters between them, as in the table above."),
        ),
        draw=draw_calls,
    ),
)
