"""Page 06, build, source, run: a change that has no effect yet, and links instead of copies."""

from __future__ import annotations

import ast
import re
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from rosbeat.diagnosis.mistakes import UNKNOWN, Diagnosis
from rosbeat.diagnosis.packages import diagnose_flaw, parse
from rosbeat.diagnosis.terminal import commands_in, substitution, writes_file
from rosbeat.exercises.exercise import Exercise, Verdict, not_attempted, passed
from rosbeat.exercises.model import spelling
from rosbeat.exercises.scenarios import (
    Answer,
    CommandMeaning,
    Workspace,
    look_at_workspace,
    typed_about,
)
from rosbeat.exercises.workspace_model import (
    FLAW_HINTS,
    SETUP_ANEW,
    about_stray,
    alike,
    diagnose_script,
    diagnosis_of,
    in_workspace,
)
from rosbeat.workspace.packages import Package

_PACKAGE = "sensor_simulator"

# 06a, change the code: what the monitor's file says, and what its installed copy says.

_MONITOR, _SENSOR = "temperature_subscriber.py", "temperature_publisher.py"
#: Texts that the monitor logs of a reading, and what is no text, such as a format: `.2f`.
_OF_READINGS = re.compile(r"^Temperature: |Status:|^(High|Low|Normal|\W*\w{0,2}\W*)$")
_OLD, _NEW = "Temperature Monitor Node Started", "Temperature Monitor Version 2"


@dataclass(frozen=True)
class CodeChange:
    """Record the texts that are written in the monitor's file, and in files beside it.

    Attributes:
        package: The package, or None.
        source: The texts in the file, comments and docstrings left out.
        logged: Those that the file logs.
        other: Those in the sensor's file.
        copies: Those in the copies of the monitor's file that colcon has installed.
        tried: The last line that was to change a file; empty where a page has no terminals.
        meaning: What that line has led to, if it is a known mistake.
    """

    package: Package | None = None
    source: tuple[str, ...] = ()
    logged: tuple[str, ...] = ()
    other: tuple[str, ...] = ()
    copies: tuple[str, ...] = ()
    tried: str = ""
    meaning: CommandMeaning | None = None


#: Programs that change a text.
_EDITORS = ("sed", "perl", "awk", "python", "python3", "nano", "vi", "vim", "emacs", "tee", "patch")


def _changes(line: str) -> bool:
    return ">" in line or any(words[0] in _EDITORS for words in commands_in(line))


def look_at_change(answer: Answer) -> CodeChange:
    """Read what the monitor's file says in src, and in install.

    Args:
        answer: The folder of the workspace; `workspace.folder()` on a page.

    Raises:
        ExerciseError: If that is no folder.
    """
    package = look_at_workspace(answer).packages.get(_PACKAGE)
    if package is None:
        return CodeChange()
    root = Path(answer)
    typed, meaning = typed_about(root, _changes)
    modules = root / package.folder / _PACKAGE
    installed = sorted(root.glob(f"install/**/site-packages/{_PACKAGE}/{_MONITOR}"))
    copies = tuple(text for path in installed for text in _texts(path))
    monitor = modules / _MONITOR
    return CodeChange(
        *(package, _texts(monitor), _logged(monitor), _texts(modules / _SENSOR), copies),
        tried=typed[-1][1] if typed else "",
        meaning=meaning,
    )


def _nodes(path: Path) -> list[ast.AST]:
    """Return the syntax tree of a file of Python, node by node; none if it cannot be read."""
    try:
        return [*ast.walk(parse(path.read_bytes()))]
    except (OSError, SyntaxError, ValueError, RecursionError, MemoryError):
        return []


#: Methods of a logger whose lines a terminal shows.
_LOGS = ("info", "warn", "warning", "error", "fatal")


def _logged(path: Path) -> tuple[str, ...]:
    """Return the texts that a file logs, as they are or by the name of a variable."""
    nodes = _nodes(path)
    named: dict[str, list[str]] = {}
    for node in nodes:
        if isinstance(node, ast.Assign | ast.AnnAssign) and node.value:
            for target in node.targets if isinstance(node, ast.Assign) else [node.target]:
                named.setdefault(_name(target), []).extend(_strings(node.value))
    found: list[str] = []
    for node in nodes:
        if isinstance(node, ast.Call) and _name(node.func) in _LOGS:
            inner = [one for part in node.args for one in ast.walk(part)]
            found += [
                text for part in inner for text in (*_strings(part), *named.get(_name(part), ()))
            ]
    return tuple(dict.fromkeys(found))


def _name(node: ast.AST) -> str:
    """Return the last part of a name, such as `info` of `self.get_logger().info`."""
    return str(getattr(node, "attr", getattr(node, "id", "")))


def _strings(node: ast.AST) -> list[str]:
    return [node.value] if isinstance(node, ast.Constant) and isinstance(node.value, str) else []


def _texts(path: Path) -> tuple[str, ...]:
    """Return the texts that are written in a file of Python; none if it cannot be read."""
    nodes = _nodes(path)
    docstrings = {id(one.value) for one in nodes if isinstance(one, ast.Expr)}
    constants = (
        one for one in nodes if isinstance(one, ast.Constant) and id(one) not in docstrings
    )
    return tuple(one.value for one in constants if isinstance(one.value, str))


def _judge_change(seen: CodeChange) -> Verdict:
    if seen.package is None:
        return not_attempted(f"There is no package {_PACKAGE} in src yet.")
    if seen.package.flaws:
        flaw = seen.package.flaws[0]
        found = diagnose_flaw(flaw)
        hint = FLAW_HINTS[flaw.kind]
        hint = hint if "%%save" in hint else f"{hint} {_WAY_BACK}"
        return Diagnosis(found.mistake, found.evidence, hint)
    if _NEW in seen.source and _NEW not in seen.logged:
        hint = f"It was logged with self.get_logger().info(...). Only the words change. {_WAY_BACK}"
        return Diagnosis(
            "nothing-logged", f"The file in src says {_NEW!r}, and logs it nowhere.", hint
        )
    if _NEW in seen.source and _OLD not in seen.source:
        return passed(f"The file in src says {_NEW!r}{_about_copies(seen)}.")
    return _diagnose_change(seen)


def _about_copies(seen: CodeChange) -> str:
    installed = seen.package.installed if seen.package else None
    if installed is None:
        return ""
    if installed.linked:
        return ", and install is a link to it"
    if _OLD in seen.copies:
        return f", and its copy in install still says {_OLD!r}"
    return ", and so does its copy in install"


def _diagnose_change(seen: CodeChange) -> Verdict:
    if _NEW in seen.source:
        hint = f"Replace the old text; don't add a second one. {_WAY_BACK}"
        return Diagnosis("wrong-word", f"The file in src says {_OLD!r}, too.", hint)
    if _NEW in seen.copies:
        return Diagnosis(
            "edited-in-install",
            "The copy in install has the new text, and the file in src has the old one.",
            "Your code is in src; the next build replaces what is in install.",
        )
    if _NEW in seen.other:
        return Diagnosis(
            "other-file",
            f"{_SENSOR} has the new text, and {_MONITOR} has the old one.",
            "The monitor is the program that subscribes.",
        )
    if _OLD in seen.source:
        return _diagnose_nothing_changed(seen)
    # What the monitor logs instead, and else what it says anywhere that is nearly the text.
    said = [one for one in seen.logged if not _OF_READINGS.search(one)]
    said += [one for one in seen.source if " " in one and alike(one, _NEW)]
    if not said:
        return Diagnosis(
            "nothing-logged",
            "The text that the monitor logs at its start is gone.",
            f"Only the end of {_OLD!r} changes. {_WAY_BACK}",
        )
    said.sort(key=lambda one: -len(set(one.split()).intersection(_NEW.split())))
    evidence = f"The file in src says {said[0]!r}; {_NEW!r} was asked for."
    hint = spelling(said[0], [_NEW]) or "Compare the two, letter by letter."
    if _NEW in said[0]:
        hint = (
            "The text has more words than that. Only those that the exercise names are asked for."
        )
    return Diagnosis("wrong-word", evidence, f"{hint} {_about_trying_again(seen)}".strip())


#: How to have the file again as it was before the first try.
_WAY_BACK = (
    "To begin anew, run the cell of page 04 that saves the file, `%%save`; your version is kept."
)


def _about_trying_again(seen: CodeChange) -> str:
    """Say how the next try finds the words that an earlier one has written."""
    words = next((words for words in commands_in(seen.tried) if words[0] == "sed"), [])
    made = substitution(words)
    if made is None:
        return ""
    with suppress(re.error):  # quotes and parentheses are around a text and not in it
        if any(re.search(made[0].strip("\"'()"), text) for text in seen.source):
            return "Correct the line and run it again."
    return f"The file no longer holds {made[0]!r}, for which that `sed` looks. {_WAY_BACK}"


def _diagnose_nothing_changed(seen: CodeChange) -> Verdict:
    """Return why what was typed has left the monitor's file as it was; the line itself tells."""
    said = f"The monitor's file in src still says {_OLD!r}."
    if not seen.tried:
        return not_attempted(said)
    tried = f"You typed `{seen.tried}`. {said}"
    words = next((words for words in commands_in(seen.tried) if words[0] == "sed"), [])
    if writes_file(words) and not any(word.endswith(_MONITOR) for word in words):
        return Diagnosis("other-file", tried, f"The monitor's file is {_MONITOR}.")
    known = diagnosis_of(seen.meaning)
    if known:
        return known
    said = tried
    if words and not writes_file(words):
        hint = "sed prints the changed text. Which option writes it into the file instead?"
        return Diagnosis("only-printed", said, hint)
    if words:
        hint = "The first of the two texts has to be in the file, letter by letter."
        return Diagnosis("nothing-replaced", said, hint)
    return Diagnosis(UNKNOWN, said, f"Only the end of {_OLD!r} changes, in the line that logs it.")


# 06b, link instead of copy: how the package is installed.


@dataclass(frozen=True)
class LinkMaking:
    """Record the packages of a workspace, and what was typed to build one.

    Attributes:
        workspace: What is in the workspace.
        tried: The last build that was typed, besides the one at the top of the page; empty if there
            was none, or where a page has no terminals.
        meaning: What that line has led to, if it is a known mistake.
    """

    workspace: Workspace
    tried: str = ""
    meaning: CommandMeaning | None = None


#: The build with which the page begins.
_FIRST_BUILD = f"colcon build --packages-select {_PACKAGE}"


def _builds(line: str) -> bool:
    return any(
        words[0] == "colcon" and "build" in words and not {"-h", "--help"}.intersection(words)
        for words in commands_in(line)
    )


def _look_at_links(answer: Answer) -> LinkMaking:
    found = look_at_workspace(answer)
    typed, meaning = typed_about(Path(answer), _builds)
    lines = [line for _, line in typed]
    if lines and lines[0].strip() == _FIRST_BUILD:
        del lines[0]
    return LinkMaking(found, lines[-1], meaning) if lines else LinkMaking(found)


def _judge_links(made: LinkMaking) -> Verdict:
    seen = made.workspace
    package = seen.packages.get(_PACKAGE)
    if package is None:
        return not_attempted(f"There is no package {_PACKAGE} in src yet.")
    if package.installed and package.installed.linked:
        return passed(f"{_PACKAGE} is installed as a link to src.")
    if made.tried and seen.strays:
        return about_stray(seen.strays[0])
    found = _diagnose_build(seen, package)
    if found:
        return found
    said = f"{_PACKAGE} is installed as a copy so far."
    if package.installed is None:
        said = f"{_PACKAGE} is not built yet."
    if not made.tried:
        return not_attempted(said)
    known = diagnosis_of(made.meaning)
    if known:
        return known
    said = f"You typed `{made.tried}`. {said}"
    if package.installed is None:
        return Diagnosis(UNKNOWN, said, "The last lines that colcon printed say what went wrong.")
    hint = "Without an option, colcon copies. `colcon build --help` lists the one for links."
    return Diagnosis("not-linked", said, hint)


def _diagnose_build(seen: Workspace, package: Package) -> Diagnosis | None:
    """Return what went wrong with a build whose traces are there."""
    stray = next((one for one in seen.folders if one.endswith(f"install/{_PACKAGE}")), "")
    if stray:
        place = stray.removesuffix(f"/install/{_PACKAGE}")
        return Diagnosis(
            "wrong-folder",
            f"There is a folder install in {place}: the build was made there.",
            "colcon builds into the folder where it is typed. Remove what it has made there, `rm "
            f"-r {in_workspace(place)}/{{build,install,log}}`, go back with "
            f"`cd {in_workspace('')}`, and build there.",
        )
    flaws = [one for one in package.flaws if one.kind in ("missing-comma", "slash")]
    broken = diagnose_script(package) or (diagnose_flaw(flaws[0]) if flaws else None)
    if broken and "%%save" not in broken.hint:
        broken = replace(broken, hint=f"{broken.hint} {SETUP_ANEW}")
    others = [name for name, one in seen.packages.items() if one.installed and one.installed.linked]
    if broken or not others:
        return broken
    return Diagnosis(
        "other-package",
        f"{others[0]} is installed as a link, and {_PACKAGE} is not.",
        "`--packages-select` is followed by the package that is to be built.",
    )


EXERCISES: tuple[Exercise[Any], ...] = (
    Exercise("06a", look_at_change, _judge_change, title="change the code", hints=(
        "`sed -i 's/old/new/' file` replaces the first text by the second one, wherever it is "
        "in a line; `.*` in the first one stands for any words.",
        "The new text ends with a number. Compare it with the text above, with its capital "
        "letter and its space.",
    )),
    Exercise("06b", _look_at_links, _judge_links, title="link instead of copy", hints=(
        "colcon has an option for this, and its help lists the option's name.",
        "The line above the cell searches that help for a word. An option begins with two "
        "dashes.",
    )),
)  # fmt: skip
