"""Page 05, set the entry points: two programs in setup.py, and what an entry point is made of."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import chain, combinations, product
from typing import Any

from rosbeat.diagnosis.mistakes import UNKNOWN, Diagnosis
from rosbeat.exercises.exercise import BLANK, Exercise, Verdict, not_attempted, passed
from rosbeat.exercises.model import Suspect, Track, first_mismatch, matching, name_mistake
from rosbeat.exercises.scenarios import Answer, Report, Workspace, look_at_workspace, report
from rosbeat.exercises.workspace_model import diagnose_entries, diagnose_script
from rosbeat.workspace.packages import Package

# 05a, two programs: a setup.py, which is read and never run.

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

#: What the function is called with, one call after the other. The capital letters and
#: underscores show whether it changes what it is given.
ARGUMENTS = (
    ("talk", "rosie", "voice"),
    ("watch_room", "house", "monitor", "start"),
    ("a", "b", "c", "d"),
    ("showRoom_2", "lampKit_1", "bigDisplay_3", "runAll_4"),
)
_NO_FUNCTION = "NoFunction"


def _call(answer: Answer) -> Report:
    """Call a function that writes entry points, with several arguments."""
    if not callable(answer):
        return Report("", _NO_FUNCTION)
    return report(lambda: [_plain(answer(*arguments)) for arguments in ARGUMENTS])


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


_GIVES_TEXT = 'The function gives back one text. f"{executable} ..." puts values into a text.'
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


def _judge_calls(seen: Report) -> Verdict:
    if f"'{BLANK}'" in seen.problem:
        return not_attempted()
    found = _diagnose_problem(seen.problem) if seen.problem else _diagnose_texts(seen.value)
    return found if found else passed(f"For example {seen.value[0]!r}.")


def _diagnose_problem(problem: str) -> Diagnosis:
    mistake, hint = next(row[1:] for row in _PROBLEMS if re.match(row[0], problem, re.DOTALL))
    said = {
        "does-not-return": f"It does not end{problem.removeprefix('Deadline')}.",
        "no-function": "What was handed over is not a function.",
        "not-a-text": f"The results are not texts: {problem.partition(': ')[2]}.",
    }
    return Diagnosis(mistake, said.get(mistake, f"It raised {problem}."), hint)


def _diagnose_texts(results: list[Any]) -> Diagnosis | None:
    for arguments, result in zip(ARGUMENTS, results, strict=True):
        evidence = f"entry_point{arguments} gives {_shown(result)}."
        if result is None:
            hint = "Nothing came back: the function needs a return, and print gives back nothing."
            return Diagnosis("returns-nothing", evidence, hint)
        if not isinstance(result, str):
            return Diagnosis("not-a-text", evidence, _GIVES_TEXT)
        if "{" in result:
            hint = "The braces are still there: an f before the first quote fills them in."
            return Diagnosis("f-missing", evidence, hint)
    done: Track = {call: (result,) for call, result in enumerate(results)}
    mismatch = first_mismatch(done, _entry_points(_RIGHT), _same_entry)
    if mismatch is None:
        return None
    evidence = f"entry_point{ARGUMENTS[mismatch.at]} gives {mismatch.done[0]!r}."
    single = chain(_SUSPECTS, _with_fixed_parts(results[0]))
    fit = matching(None, done, single, _same_entry) or matching(None, done, _pairs(), _same_entry)
    return name_mistake(fit[:1], Diagnosis(UNKNOWN, evidence, _COMPARE))


#: The parts of an entry point in their order; `{0}` to `{3}` are the arguments.
_RIGHT = {
    "before": "", "executable": "{0}", "equals": "=", "package": "{1}", "dot": ".",
    "module": "{2}", "colon": ":", "function": "{3}", "after": "",
}  # fmt: skip
_SPACES = re.compile(r"[ \t]*([=:]+)[ \t]*")


def _entry_points(parts: Mapping[str, str], calls: Sequence[tuple[str, ...]] = ARGUMENTS) -> Track:
    """Return the text for each call of a function that writes these parts."""
    text = "".join(parts.values())
    return {call: (text.format(*given, "main"),) for call, given in enumerate(calls)}


def _same_entry(one: str, other: str) -> bool:
    """Return whether two entry points are the same, whatever spaces are around their signs."""
    return _without_spaces(one) == _without_spaces(other)


def _without_spaces(text: str) -> str:
    return _SPACES.sub(r"\1", text)


_FIRST = "What is typed after ros2 run comes first, then an equals sign."
_ONE_SIGN = "One equals sign is enough: it is no comparison."
_DOT = "Between the equals sign and the colon stands package.module, with a dot."
_COLON = "After a colon comes the name of the function that was handed over."
_USE_ALL = "The text has to change with what the function is given: put its parameters in."
_ENOUGH = "Return the bare text: no quotes, brackets or spaces around it."
_NO_MORE = "Nothing stands after the name of the function: no brackets, no comma."
_AS_GIVEN = "Names count letter by letter: put the parameters in as they are."
_COMPARE = "Compare it with the parts in the table of the page, sign by sign and in their order."


def _slips() -> Iterator[tuple[str, str, Mapping[str, str]]]:
    """Generate each slip: its mistake, its hint, and the parts that are written with it."""
    yield "slash-in-module", _DOT, {"dot": "/"}
    yield "swallowed-parameter", f"{_COLON} It is not always main.", {"function": "main"}
    for pair in ("''", '""', "``", "()", "[]", "<>"):
        yield "stray-characters", _ENOUGH, {"before": pair[0], "after": pair[1]}
    for space in (" ", "\n", "\t"):
        yield "stray-characters", _ENOUGH, {"before": space}
        yield "stray-characters", _ENOUGH, {"after": space}
    for end in ("()", ",", ";", ".", ":", "(", ")", ".py"):
        yield "stray-characters", _NO_MORE, {"after": end}
    yield "entry-point-form", _ONE_SIGN, {"equals": "=="}
    for sign in (":", " ", "", "->", ":="):
        yield "entry-point-form", _FIRST, {"equals": sign}
    for sign in (":", "::", "\\", "_", "-", " ", "", ".."):
        yield "entry-point-target", _DOT, {"dot": sign}
    for sign in (".", "::", "/", " ", "", "=", "-", "#"):
        yield "entry-point-target", _COLON, {"colon": sign}
    yield "entry-point-target", _COLON, {"colon": "", "function": ""}
    yield "entry-point-target", _DOT, {"package": "", "dot": ""}
    yield "entry-point-target", _DOT, {"dot": "", "module": ""}
    yield "entry-point-target", "A module is named without .py.", {"module": "{2}.py"}
    yield "entry-point-form", _FIRST, {"executable": "", "equals": ""}
    turned = {"executable": "{1}.{2}:{3}", "package": "{0}"}
    yield "entry-point-form", _FIRST, {**dict.fromkeys(_RIGHT, ""), **turned, "equals": "="}


_PARAMETERS = ("executable", "package", "module", "function")


def _other_orders() -> Iterator[tuple[str, str, Mapping[str, str]]]:
    """Generate the slips in which one parameter is mistaken for another."""
    right = tuple(_RIGHT[name] for name in _PARAMETERS)
    slips = (("entry-point-form", _FIRST), *[("entry-point-target", _DOT)] * 2,
             ("entry-point-target", _COLON))  # fmt: skip
    for order in product(right, repeat=4):
        wrong = [slip for slip, one, other in zip(slips, order, right, strict=True) if one != other]
        if wrong:
            yield *wrong[0], dict(zip(_PARAMETERS, order, strict=True))


def _suspect(mistake: str, hint: str, parts: Mapping[str, str]) -> Suspect:
    return Suspect(mistake, hint, lambda _: _entry_points({**_RIGHT, **parts}))


def _changes_names(change: Callable[[str], str], *changed: int) -> Suspect:
    """Return a suspect who changes the letters of some arguments."""
    calls = [
        tuple(change(one) if at in changed else one for at, one in enumerate((*given, "main")))
        for given in ARGUMENTS
    ]
    return Suspect("wrong-values", _AS_GIVEN, lambda _: _entry_points(_RIGHT, calls))


_SUSPECTS = (
    *(_suspect(*slip) for slip in chain(_slips(), _other_orders())),
    *(
        _changes_names(change, *changed)
        for change in (str.lower, str.upper, str.title, lambda name: name.replace("_", "-"))
        for changed in ((0, 1, 2, 3), (0,), (1,), (2,), (3,))
    ),
)


def _pairs() -> Iterator[Suspect]:
    """Generate a suspect for every two slips at once."""
    for (mistake, hint, parts), (_, more, others) in combinations(_slips(), 2):
        if not parts.keys() & others.keys():
            both = " ".join(dict.fromkeys((hint, more)))
            yield _suspect(mistake, both, {**parts, **others})


def _with_fixed_parts(first: str) -> Iterator[Suspect]:
    """Generate suspects who write a name of the first call where a parameter belongs.

    Args:
        first: The result of the first call, which shows that name.
    """
    whole = {**dict.fromkeys(_RIGHT, ""), "before": first.replace("}", "}}")}
    yield _suspect("swallowed-parameter", _USE_ALL, whole)
    given = dict(zip(_PARAMETERS, (*ARGUMENTS[0], "main"), strict=True))
    for names in chain.from_iterable(combinations(_PARAMETERS, count) for count in (1, 2, 3)):
        fixed = {name: rf"(?P<{name}>[\w.]+)" for name in names}
        pattern = "".join({**_RIGHT, "dot": r"\.", **given, **fixed}.values())
        shown = re.fullmatch(pattern, _without_spaces(first))
        if shown:
            yield _suspect("swallowed-parameter", _USE_ALL, shown.groupdict())


EXERCISES: tuple[Exercise[Any], ...] = (
    Exercise(
        "05a",
        look_at_workspace,
        _judge_setup,
        title="two programs",
        points=2,
        hints=(
            "Each program needs one line of text in the list of console scripts.",
            "A line is made of what you type after `ros2 run` and its package, an equals sign, "
            "and where the code is.",
            "Where the code is: the package, a dot, the file without .py, a colon, the function.",
            "Two lines are two texts: quotes around each, and a comma after each.",
        ),
    ),
    Exercise(
        "05b",
        _call,
        _judge_calls,
        title="write entry points",
        hints=(
            "The function gives back one text, made of what it was given.",
            "An f before the first quote fills in what stands between braces.",
            "Four values are to be filled in, and three signs stand between them, as in the table "
            "above.",
        ),
    ),
)
