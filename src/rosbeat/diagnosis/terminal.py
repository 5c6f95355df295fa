"""Explain commands that failed, and commands that went wrong without an error.

`_RULES` is one table: the first rule that recognises a situation decides, and a situation that no
rule recognises gets no meaning. Most rules are rows; what a row cannot express is a function.
Numbers of rows in brackets are those of the table in docs/mistakes.md.
"""

from __future__ import annotations

import os
import re
import shlex
from collections.abc import Callable, Iterable
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import groupby, takewhile
from pathlib import Path, PurePosixPath

from rosbeat.diagnosis.absent_programs import PATTERN as ABSENT
from rosbeat.diagnosis.absent_programs import about_program
from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.diagnosis.modules import about_hidden, about_name, about_neighbor
from rosbeat.diagnosis.packages import BROKEN, NO_CALL, Package, diagnose_flaw, nearest
from rosbeat.diagnosis.programs import meaning_of_output

#: Holds the path of the workspace in every terminal, so that `cd "$ROS2_WORKSPACE"` works anywhere.
VARIABLE = "ROS2_WORKSPACE"

# A command that has ended, and what can be seen of it.

#: A program in Python: a script, or what `ros2 run` starts.
PYTHON = r"(?:\S*/)?python[\d.]*|\S*\.py|ros2 run"
_SEPARATORS = {";", "&&", "||", "|", "&"}
_SETTING = re.compile(r"[A-Za-z_]\w*=")
_TIME = re.compile(r"\d+(\.\d*)?[smhd]?")
_TRACEBACK = "Traceback (most recent call last)"
_ERROR = re.compile(r"^[A-Za-z_][\w.]*(?:Error|Exception|Interrupt|Exit)\b.*$", re.M)
_COLOUR = re.compile(r"\x1b\[[0-9;]*[A-Za-z]")


@dataclass(frozen=True)
class Call:
    """Hold one command of a line.

    Attributes:
        words: The program and its arguments.
        place: The folder it ran in.
    """

    words: tuple[str, ...]
    place: Path

    def after(self, option: str) -> list[str]:
        """Return the words behind an option, or an empty list if it was not given."""
        found = option in self.words
        return list(self.words[self.words.index(option) + 1 :]) if found else []


@dataclass(frozen=True)
class Situation:
    """Hold a command that has ended, and what can be seen of it.

    Attributes:
        command: What was typed; several lines, or several commands in a line, are fine.
        output: What the terminal showed.
        code: The exit code of the last command.
        folder: The folder that the terminal was in.
        workspace: The learner's workspace.
        home: The folder that the terminal calls `~`.
        look: Returns every package of the workspace; called when a rule first asks for them.
    """

    command: str
    output: str
    code: int
    folder: Path
    workspace: Path
    home: Path
    look: Callable[[], tuple[Package, ...]]

    @cached_property
    def text(self) -> str:
        """Return the output without colours, with one kind of line end and one kind of quote."""
        plain = _COLOUR.sub("", self.output).replace("\r\n", "\n").replace("\r", "\n")
        return plain.replace("‘", "'").replace("’", "'")

    @cached_property
    def calls(self) -> tuple[Call, ...]:
        """Return the commands one by one, each with the folder that `cd` had led to."""
        place = self.folder
        found = []
        for words in split_commands(self.command):
            found.append(Call(words, place))
            if words[0] in ("cd", "pushd"):
                place = self._after_cd(place, words)
        return tuple(found)

    def call(self, pattern: str) -> Call | None:
        r"""Return the last command whose first words match a regular expression, or None.

        Args:
            pattern: The expression, as in `ros2 run` or `python[\d.]*`; it ends with a word.
        """
        start = re.compile(rf"(?:{pattern})(?= |$)")
        return next((one for one in self.calls[::-1] if start.match(" ".join(one.words))), None)

    @cached_property
    def traceback(self) -> str:
        """Return what a program in Python shows of its error, or an empty text.

        The text of a traceback in a file that is only read does not count.
        """
        start = self.text.find(_TRACEBACK) if self.call(PYTHON) else -1
        return self.text[start:] if start >= 0 else ""

    @cached_property
    def error(self) -> str:
        """Return the last line of the traceback: the error's name and text."""
        lines = _ERROR.findall(self.traceback)
        return lines[-1] if lines else ""

    @property
    def about_ros(self) -> bool:
        """Return whether the traceback is that of a node."""
        return bool(self.traceback) and (
            "rclpy" in self.traceback or self.call("ros2 run") is not None
        )

    @cached_property
    def packages(self) -> tuple[Package, ...]:
        """Return every package of the workspace."""
        return self.look()

    def package(self, name: str) -> Package | None:
        """Return the package of a name, or None."""
        return next((one for one in self.packages if one.name == name), None)

    def _after_cd(self, place: Path, words: tuple[str, ...]) -> Path:
        """Return where `cd` leads; without such a folder it fails, and stays in the same place."""
        typed = next((word for word in words[1:] if word != "--"), "~")
        first, _, rest = typed.partition("/")
        workspace = dict.fromkeys((f"${VARIABLE}", f"${{{VARIABLE}}}"), self.workspace)
        known = {"~": self.home, **workspace}
        path = known[first] / rest.lstrip("/") if first in known else place / typed
        path = Path(os.path.normpath(path))  # `..` leads out of a folder that has gone, too
        return path.resolve() if path.is_dir() else place


def split_commands(text: str) -> list[tuple[str, ...]]:
    """Return the words of each command in a text, without settings and `timeout` in front.

    Args:
        text: What was typed; several lines, or several commands in a line, are fine.
    """
    lines = text.replace("\\\n", " ").splitlines()
    return [tuple(_from_the_program(one)) for line in lines for one in commands_in(line)]


def commands_in(line: str, escape: str = "\\") -> list[list[str]]:
    """Return the words of each command in a line.

    Args:
        line: What was typed.
        escape: What takes its meaning from the next sign; if it is empty, a backslash stays.
    """
    lexer = shlex.shlex(line, posix=True, punctuation_chars=True)
    lexer.whitespace_split, lexer.escape = True, escape
    try:
        words = list(lexer)
    except ValueError:  # a quote is not closed
        words = line.split()
    parts = groupby(words, _SEPARATORS.__contains__)
    return [list(one) for is_separator, one in parts if not is_separator]


def _from_the_program(words: list[str]) -> list[str]:
    """Return the words without `NAME=value` or `timeout 5` in front: neither is the program."""
    start = next((at for at, word in enumerate(words) if not _SETTING.match(word)), 0)
    rest = words[start:]
    if rest[0] == "timeout":
        rest = rest[next((at for at, word in enumerate(rest) if _TIME.fullmatch(word)), -1) + 1 :]
    return rest or words


# The shapes of a rule.

Found = re.Match[str]
Rules = tuple[Callable[[Situation], Diagnosis | None], ...]
#: A condition holds if it returns anything true.
When = Callable[[Situation, Call, Found], object]


def _always(*_: object) -> bool:
    return True


def _failed(seen: Situation, *_: object) -> bool:
    return seen.code != 0


@dataclass(frozen=True)
class Rule:
    """Recognise what a command printed, and let a function say what it means.

    Attributes:
        ran: A regular expression for the command's first words; `{1}` is the first group of the
            pattern. Output that another command merely shows, as `cat` does, does not count.
        pattern: A regular expression that is looked for in the output.
        says: What it means; None if it is not this mistake after all.
    """

    ran: str
    pattern: str
    says: Callable[[Situation, Call, Found], Diagnosis | None]

    def __call__(self, seen: Situation) -> Diagnosis | None:
        """Return what the function says if command and output fit; else None."""
        # Outputs may be long, so another command's is not searched.
        if "{" not in self.ran and not seen.call(self.ran):
            return None
        found = re.search(self.pattern, seen.text, re.MULTILINE)
        if not found:
            return None
        call = seen.call(self.ran.format(*map(re.escape, (found[0], *found.groups("")))))
        return self.says(seen, call, found) if call else None


@dataclass(frozen=True)
class Row:
    """Recognise a mistake by a command and what it printed.

    Attributes:
        mistake: The mistake's id.
        ran: The command, as in `Rule`.
        pattern: A regular expression that is looked for in the output.
        evidence: What happened; `{1}` is the first group of the pattern, and `{here}` the name of
            the folder that the command ran in.
        hint: Where to look, with groups as well.
        when: What else has to be true.
    """

    mistake: str
    ran: str
    pattern: str
    evidence: str
    hint: str
    when: When = _always

    def __call__(self, seen: Situation) -> Diagnosis | None:
        """Return the mistake if it is this one; else None."""
        return Rule(self.ran, self.pattern, self._says)(seen)

    def _says(self, seen: Situation, call: Call, found: Found) -> Diagnosis | None:
        if not self.when(seen, call, found):
            return None
        words, here = (found[0], *found.groups("")), call.place.name or "/"
        evidence, hint = (one.format(*words, here=here) for one in (self.evidence, self.hint))
        return Diagnosis(self.mistake, evidence, hint)


@dataclass(frozen=True)
class PackageRow:
    """Recognise a mistake in the files of a package.

    Attributes:
        mistake: The mistake's id.
        when: What is true of the package, and of the executable that was asked for.
        evidence: What is wrong, with attributes of the package, as in `{name}`, and `{executable}`
            or `{stem}`, the executable without `.py`.
        hint: Where to look, with the same.
    """

    mistake: str
    when: Callable[[Package, str], object]
    evidence: str
    hint: str

    def __call__(self, package: Package, executable: str) -> Diagnosis | None:
        """Return the mistake if the package has it; else None."""
        if not self.when(package, executable):
            return None
        stem = executable.removesuffix(".py")
        values = vars(package) | {"executable": executable, "stem": stem}
        evidence, hint = (one.format_map(values) for one in (self.evidence, self.hint))
        return Diagnosis(self.mistake, evidence, hint)


@dataclass(frozen=True)
class PackageRule:
    """Ask about the packages that a command was for, one after the other.

    Attributes:
        ran: The command: `_BUILD` or `_RUN`.
        says: Rows and functions that look at a package; the first that finds a mistake speaks.
        pattern: A regular expression that is looked for in the output.
        when: What else has to be true.
    """

    ran: str
    says: tuple[Callable[[Package, str], Diagnosis | None], ...]
    pattern: str = ""
    when: Callable[[Situation, Package], object] = _always

    def __call__(self, seen: Situation) -> Diagnosis | None:
        """Return the first mistake in a package that the command was for; else None."""
        call = seen.call(self.ran)
        if not call or not re.search(self.pattern, seen.text):
            return None
        asked = [one for one in _asked_for(seen, call) if self.when(seen, one[0])]
        return _first(say(*one) for one in asked for say in self.says)


_BUILD, _RUN, _CREATE = "colcon build", "ros2 run", "ros2 pkg create"


def _first(found: Iterable[Diagnosis | None]) -> Diagnosis | None:
    return next((one for one in found if one), None)


def _asked_for(seen: Situation, call: Call) -> list[tuple[Package, str]]:
    """Return the packages of a `colcon build`, or that of a `ros2 run` with its executable."""
    if call.words[0] == "colcon":
        names = [word for word in call.after("--packages-select") if not word.startswith("-")]
        every = "--packages-select" not in call.words
        return [(one, "") for one in seen.packages if every or one.name in names]
    given = _names_to_run(call)
    package = seen.package(given[0]) if len(given) > 1 else None
    return [(package, given[1])] if package else []


def _names_to_run(call: Call) -> list[str]:
    """Return the names behind `ros2 run`: the package and the executable, if both were given."""
    own = takewhile(lambda word: word != "--ros-args", call.words[2:])
    return [word for word in own if not word.startswith("-")]


def recognise(seen: Situation) -> Diagnosis | None:
    """Return the mistake behind a command's outcome, what shows it and what to try.

    Args:
        seen: The command; files of the workspace are read, and nothing is run.

    Returns:
        None if nothing is known for sure.
    """
    for rule in _RULES:
        with suppress(OSError):  # the workspace changes while it is looked at
            found = rule(seen)
            if found:
                return found
    return None


def explain(seen: Situation) -> str | None:
    """Return two or three sentences about a command's outcome: what it means and what to try.

    Args:
        seen: The command.

    Returns:
        None if nothing is known for sure, or if the output says the same itself.
    """
    found = recognise(seen)
    if found is None or re.search(_SAYS_IT_ITSELF.get(found.mistake, r"\Z."), seen.text):
        return None
    return " ".join(text for text in (found.evidence, found.hint) if text)


#: What the course's `ros2` prints about a package that was to be made in another one.
_INSIDE = "is a package itself (it holds a package.xml)"
#: What it prints where it says the same as we would, by mistake.
_SAYS_IT_ITSELF = {
    **dict.fromkeys(
        ("executable-misspelled", "package-misspelled", "word-misspelled", "option-misspelled"),
        r"Did you mean|' has: ",
    ),
    "build-type": r"Did you mean|course add messages",
    "wrong-folder": re.escape(_INSIDE),
}


# Folders: `cd` and `mkdir`, and a terminal whose folder has gone.

_BASH = r"^bash: (?:line \d+: )?"
_NO_FILE = "No such file or directory"
_MKDIR = r"^mkdir: cannot create directory '"
_TOP = "starts with `/`, the root of the file system"


def _way_to(relative: str = "") -> str:
    """Return the `cd` that leads to a folder of the workspace from everywhere."""
    rest = f"/{shlex.quote(relative)}" if relative not in ("", ".") else ""
    return f'cd "${VARIABLE}"{rest}'


def _near(base: Path, typed: str, folders: bool = False) -> str | None:
    """Return the path that was probably meant, written like the one that was typed, or None."""
    path = Path(typed)
    above = base / path.parent
    there = [one.name for one in above.iterdir()
             if one.is_dir() or not folders] if above.is_dir() else []  # fmt: skip
    meant = nearest(path.name, there)
    return str(path.parent / meant) if meant else None


def _folder_gone(seen: Situation, _: Call, __: Found) -> Diagnosis | None:
    """Recognise that the terminal's folder was removed, perhaps by another terminal."""
    failed = seen.code or ": error: " in seen.text
    # A new folder may have the name of the old one; then only the programs notice.
    noticed = "os.getcwd()" in seen.text and "FileNotFoundError: [Errno 2]" in seen.text
    if not failed or (seen.calls[-1].place.exists() and not noticed):
        return None
    way = _way_to() if seen.workspace.is_dir() else "cd"
    return Diagnosis(
        "folder-gone",
        "This terminal's current folder no longer exists.",
        f"Change to another folder: `{way}`",
    )


def _nothing_at_the_top(path: str) -> bool:
    """Return whether a path begins at `/` with a name that is not there, as in `/Documents`."""
    parts = PurePosixPath(path).parts
    return (
        len(parts) > 1 and parts[0] == "/" and parts[1] != "home" and not Path(*parts[:2]).exists()
    )


def _mkdir_at_the_top(_: Situation, __: Call, found: Found) -> Diagnosis | None:
    path = found[1]
    if not _nothing_at_the_top(path):
        return None
    return Diagnosis(
        "tilde-missing",
        f"{path} {_TOP}, where you may not create folders.",
        f"Your home folder is `~`: write  mkdir -p ~/{shlex.quote(path.lstrip('/'))}",
    )


def _typed_a_backslash(seen: Situation, *_: object) -> bool:
    lines = re.findall(r"^\s*cd\s+(\S*\\[^\s\\].*)$", seen.command, re.MULTILINE)
    return bool(lines) and r"\ " not in lines[-1]


def _cd_with_a_blank_too_many(_: Situation, call: Call, __: Found) -> Diagnosis:
    return Diagnosis(
        "space-too-many",
        f"`cd` takes one folder, but {len(call.words) - 1} words follow it.",
        "The parts of a path are joined by `/`, without spaces. If a name contains a space, put "
        "quotes around the whole path.",
    )


def _cd_failed(seen: Situation, call: Call, found: Found) -> Diagnosis:
    path = found[1].strip()
    if _nothing_at_the_top(path):
        below = path.strip("/")
        hint = "A path that begins with a name, without `/`, starts in the current folder."
        if (seen.home / below).is_dir():
            hint = f"Your home folder is `~`: write  cd ~/{shlex.quote(below)}"
        elif (seen.workspace / below).is_dir():
            hint = f"Your workspace has a folder of that name:  {_way_to(below)}"
        return Diagnosis("tilde-missing", f"{path} {_TOP}.", hint)
    where = "" if path.startswith("/") else " in the current folder"
    meant = _near(call.place, path, folders=True)
    hint = "`pwd` shows the current folder, and `ls` lists its content."
    if seen.workspace.name in PurePosixPath(path).parts:
        hint = f"Your workspace is here:  {_way_to()}"
        if not seen.workspace.is_dir():
            hint = f'You have no workspace yet. Page 01 creates it:  mkdir -p "${VARIABLE}/src"'
    elif meant:
        hint = f"Did you mean {shlex.quote(meant)}?"
    return Diagnosis("folder-not-found", f"There is no folder {path}{where}.", hint)


_CD_RULES = (
    Row("path-separator", "cd", rf"{_BASH}cd: .+: {_NO_FILE}",
        r"The path contains a `\`, which bash removes.",
        "On Linux, `/` separates the parts of a path.",
        _typed_a_backslash),
    Rule("cd", rf"{_BASH}cd: (.+): {_NO_FILE}", _cd_failed),
    Rule("cd", rf"{_BASH}cd: too many arguments", _cd_with_a_blank_too_many),
    Row("not-a-folder", "cd", rf"{_BASH}cd: *(\S.*?) *: Not a directory",
        "{1} is a file, but `cd` needs a folder.",
        "`cat` shows the content of a file."),
)  # fmt: skip
_MKDIR_RULES = (
    Row("folder-exists", "mkdir", rf"{_MKDIR}([^']+)': File exists",
        "{1} already exists, so `mkdir` changed nothing.",
        "With -p, `mkdir` does not complain about an existing folder."),
    Rule("mkdir", rf"{_MKDIR}([^']+)': (?:No such|Permission den)", _mkdir_at_the_top),
    Row("parents-missing", "mkdir", rf"{_MKDIR}(?:[^']*/)?([^'/]+)/*': No such file",
        "The parent folder of {1} does not exist.",
        "With -p, `mkdir` also creates missing parent folders."),
    Row("option-misspelled", "mkdir", r"^mkdir: (?:invalid|unrecognized) option (?:-- )?'([^']+)'",
        "`mkdir` has no option -{1}, so it created nothing.",
        "To create missing parent folders, the option is a lower-case letter: -p"),
    Row("word-missing", "mkdir", r"mkdir: missing operand",
        "`mkdir` was called without the name of a folder.",
        "Write the folder's name or path after `mkdir`, separated by a space."),
)  # fmt: skip


# Programs and files on the command line.

_KNOWN = (
    *("ros2", "colcon", "source", "mkdir", "cd", "chmod", "ls", "pwd", "cat", "cp", "mv"),
    *("echo", "python3", "python", "pip", "touch", "clear", "exit"),
)
#: Short words are easily alike: `screen` is not `tree`.
_ALIKE = 0.75
_SOURCE = r"source|\."
#: Commands that name a file or folder which they do not find, all in the same way.
_READS = "ls|cat|head|tail|less|wc|stat|find|grep|diff|sed|cp|mv|rm"
_SETUP = r"(?:\S*/)?install/(?:local_)?setup\.\w+"


def _not_found(words: str = r"[^\s:]+") -> str:
    """Return the pattern of what bash says about a command that it does not find."""
    return rf"{_BASH}({words}): command not found"


def _misspelt(_: Situation, __: Call, found: Found) -> Diagnosis | None:
    word = found[1]
    meant = nearest(word, [one for one in _KNOWN if one != word], _ALIKE)
    if not meant:
        return None
    return Diagnosis(
        "command-misspelled", f"There is no command `{word}`.", f"Did you mean `{meant}`?"
    )


def _no_such_file(seen: Situation, call: Call, found: Found) -> Diagnosis:
    """Say where in the workspace a file lies that is not here, or which one was meant."""
    path = found[1]
    where = "" if path.startswith("/") else " in the current folder"
    known = _misplaced(seen, call, found)
    return known or Diagnosis(
        "file-not-found", f"There is no {path}{where}.", "`ls` shows what is there."
    )


def _misplaced(seen: Situation, call: Call, found: Found) -> Diagnosis | None:
    """Say the same only if there is such a file or folder, or one of a similar name."""
    path = found[1]
    if path.startswith("/"):
        return None
    bases = (seen.workspace, *seen.workspace.glob("src/**/"))  # a new terminal is outside
    base = next((one for one in bases if (one / path).exists()), None)
    if base is not None and path.strip("./"):
        folder = base.relative_to(seen.workspace).as_posix()
        there = "" if folder == "." else f"{folder} of "
        return Diagnosis(
            "wrong-folder",
            f"There is no {path} in the current folder; it is in {there}your workspace.",
            f"Go to that folder first, with  {_way_to(folder)}",
        )
    meant = _near(call.place, path)
    if meant is None:
        return None
    return Diagnosis(
        "file-not-found",
        f"There is no {path} in the current folder.",
        f"Did you mean {shlex.quote(meant)}?",
    )


def _not_executable(_: Situation, __: Call, found: Found) -> Diagnosis:
    path = shlex.quote(found[1])
    return Diagnosis(
        "not-executable",
        f"{path} has no permission to run as a program.",
        f"`chmod +x {path}` grants it. `ros2 run` does not need that permission: it uses the "
        "entry points in setup.py.",
    )


#: `s/old/new/` of sed, with any sign between its parts, for all lines or for some.
_SUBSTITUTION = re.compile(r"(?:/[^/]*/)?\s*s([^\w\s\\])(.+?)\1([^&\\]*?)\1[gIip0-9]*")


def substitution(words: Iterable[str]) -> tuple[str, str] | None:
    """Return what a `sed` replaces, and by what; None if it does anything else.

    Args:
        words: The words of the command.
    """
    scripts = [found for word in words if (found := _SUBSTITUTION.fullmatch(word))]
    return (scripts[0][2], scripts[0][3]) if len(scripts) == 1 else None


def writes_file(words: Iterable[str]) -> bool:
    """Return whether a `sed` writes the changed text into the file.

    Args:
        words: The words of the command.
    """
    return any(re.match(r"-[a-zA-Z]*i|--in-place", word) for word in words)


def _nothing_replaced(_: Situation, call: Call, __: Found) -> Diagnosis | None:
    """Recognise a `sed -i` that found nothing: what it writes is not in the file afterwards."""
    made, path = substitution(call.words), call.place / call.words[-1]
    if made is None or not made[1] or not writes_file(call.words) or not path.is_file():
        return None
    if made[1] in path.read_text(encoding="utf-8", errors="replace"):
        return None
    return Diagnosis(
        "nothing-replaced",
        f"`sed` found nothing to replace: no line of {call.words[-1]} matches `{made[0]}`, so the "
        "file is as it was.",
        f"`cat {shlex.quote(call.words[-1])}` shows what it says now. Compare, letter by letter.",
    )


_COMMAND_RULES = (
    Row("dot-slash-missing", "{1}", _not_found(),
        "{1} is in this folder, but the shell does not search the current folder for programs:",
        "write ./{1}",
        lambda _, call, found: (call.place / found[1]).is_file()),
    Row("prompt-typed", "{1}", _not_found("[$#%]"),
        "`{1}` is the terminal's prompt, not a command.",
        "Type only the text after the prompt."),
    Row("environment-inactive", "{1}", _not_found("ros2|colcon"),
        "This terminal cannot find {1}: the course's environment is not active in it.",
        "Open a terminal in JupyterLab, or run `./environment/course shell` in the folder of the "
        "course."),
    Rule("{1}", _not_found(ABSENT), lambda _, __, found: about_program(found[1])),
    Rule("{1}", _not_found(), _misspelt),
)  # fmt: skip
_FILE_RULES: Rules = (
    Rule("sed", r"\A\s*\Z", _nothing_replaced),
    Rule("chmod", r"^chmod: cannot access '([^']+)': No such file", _no_such_file),
    Rule(
        _READS,
        rf"^(?:{_READS}): (?:can(?:not|'t) \w+ )?'?([^'\n]+?)'?: {_NO_FILE}",
        _misplaced,
    ),
    Row("word-misspelled", "chmod", r"^chmod: invalid mode: ",
        "`chmod` does not understand its first argument.",
        "A plus sign adds a permission: `+x` adds the permission to execute."),
    Row("word-missing", "chmod", r"chmod: missing operand",
        "`chmod` needs two arguments: the change and the file.",
        "For example:  chmod +x temperature_publisher.py"),
    Row("is-a-folder", "rm", r"^rm: cannot remove '([^']+)': Is a directory",
        "{1} is a folder, but without an option `rm` removes only files.",
        "`rm -r` removes a folder with all its content, and there is no trash to restore it "
        "from: check the line before you run it."),
    # Python shows the whole path, also of a name that was typed alone.
    Rule(r"python[\d.]*", r"can't open file '(?:[^']*/)?([^'/]+)': \[Errno 2\]", _no_such_file),
    Row("ros-elsewhere", _SOURCE, rf"{_BASH}/opt/ros/\S+: {_NO_FILE}",
        "That file belongs to a ROS installation, which this course does not use.",
        "Every terminal of this course already has ROS, so leave the line out."),
    Row("not-built", _SOURCE, rf"{_BASH}({_SETUP}): {_NO_FILE}",
        "{1} does not exist yet: `colcon build` creates it.",
        "Build in the workspace first, then source.",
        lambda seen, *_: not (seen.workspace / "install" / "setup.bash").is_file()),
    Row("wrong-folder", _SOURCE, rf"{_BASH}({_SETUP}): {_NO_FILE}",
        "{1} does not exist in the current folder.",
        f"That file is in your workspace: go there first, with  {_way_to()}",
        lambda seen, _, found: (seen.workspace / "install" / Path(found[1]).name).is_file()),
    Rule(r"\S*{2}", rf"{_BASH}((?:\S*/)?([^\s/]+\.py)): Permission denied", _not_executable),
)  # fmt: skip


# Words that `colcon` or `ros2` do not know.

_OPTIONS = (
    *("--packages-select", "--symlink-install", "--packages-up-to", "--packages-skip"),
    *("--parallel-workers", "--base-paths", "--cmake-args", "--ros-args", "--help"),
    *("--destination-directory", "--event-handlers", "--build-type", "--dependencies"),
    *("--node-name", "--once", "--show-types"),
)
_REQUIRED = r"error: the following arguments are required: "


def _unknown_word(_: Situation, __: Call, found: Found) -> Diagnosis:
    """Name the nearest verb that exists."""
    program, word = found[1], found[2]
    names = re.findall(r"[\w-]+", found[3])
    meant = nearest(word, names)
    return Diagnosis(
        # A build type is asked for by a word, too, and has a mistake of its own.
        "build-type" if word.startswith("ament") else "word-misspelled",
        f"`{program}` does not recognize `{word}`.",
        f"Did you mean `{meant}`?" if meant else f"You can choose from: {', '.join(names)}.",
    )


def _unknown_option(_: Situation, __: Call, found: Found) -> Diagnosis:
    """Name the nearest option that exists."""
    program, word = found[1], found[2].split()[0]
    meant = _option_like(word.split("=")[0])
    hint = f"Did you mean `{meant}`?" if meant else f"`{program} --help` lists the options."
    return Diagnosis("option-misspelled", f"`{program}` does not recognize `{word}`.", hint)


def _option_like(word: str) -> str | None:
    """Return the option that was meant: `-symlink-install` has a dash, `symlink_install` none."""
    plain = word.lstrip("-").replace("_", "-")
    if f"--{plain}" in _OPTIONS:
        return f"--{plain}"
    return nearest(word, list(_OPTIONS), 0.75) if word.startswith("-") else None


def _missing_word(_: Situation, __: Call, found: Found) -> Diagnosis:
    names = found[2].removesuffix(", argv").replace("_", " ")
    said = f"A required argument is missing after `{found[1]}`:"
    return Diagnosis("word-missing", said, f"{names}.")


_WORD_RULES = (
    Rule(
        "{1}",
        r"^(\w+)\b.*: error: .*invalid choice: '?([^'\s]+)'? \(choose from ([^)]*)\)",
        _unknown_word,
    ),
    # An option counted as one of the two names, or there was nothing.
    Row("word-missing", _RUN, r"^ros2.*: error: (unrecognized|the following) arguments",
        "`ros2 run` was called with fewer than two names.",
        "`ros2 run` takes two names: the package and the executable.",
        lambda _, call, __: len(_names_to_run(call)) < 2),
    Rule("{1}", r"^(colcon|ros2).*: error: unrecognized arguments: (.*\S.*)$", _unknown_option),
    Row("word-missing", "ros2", rf"^ros2 pkg create: {_REQUIRED}",
        "The package's name is missing, or an option has consumed it: `--dependencies` takes "
        "every word that follows it.",
        "Write the package's name first."),
    Rule("ros2", rf"^(ros2 .*): {_REQUIRED}(.+)$", _missing_word),
)  # fmt: skip


# `ros2 pkg create`.


def _options_missing(_: Situation, call: Call, found: Found) -> Diagnosis | None:
    """Recognise the values of options that were typed without the options themselves."""
    typed = any(word.startswith("--build-type") for word in call.words)
    kind = [] if typed or "ament_python" not in call.words else ["--build-type"]
    more = len(found[1].split()) - len(kind)
    names = ["--dependencies"] if more > 0 and "--dependencies" not in call.words else []
    missing = [*kind, *names]
    if not missing:
        return None
    plural = ("s", "are") if len(missing) > 1 else ("", "is")
    return Diagnosis(
        "option-missing",
        f"The option{plural[0]} {' and '.join(missing)} {plural[1]} missing.",
        "Write each option before its values.",
    )


def _made_elsewhere(seen: Situation, call: Call, _: Found) -> Diagnosis | None:
    """Recognise a package that was made outside of `src` (26)."""
    place, source = call.place.resolve(), (seen.workspace / "src").resolve()
    words = (word for word in call.words[3:] if not word.startswith("-"))
    name = next((word for word in words if (place / word / "package.xml").is_file()), None)
    if seen.code or not name or place == source or "--destination-directory" in call.words:
        return None
    way = "src/" if place == seen.workspace.resolve() else f'"${VARIABLE}"/src/'
    return Diagnosis(
        "wrong-folder",
        f"The package {name} was created in {call.place.name or '/'}, this terminal's current "
        "folder.",
        f"Packages belong in the src folder of the workspace. Move this one there: mv {name} {way}",
    )


_CREATE_RULES = (
    Row("package-exists", _CREATE, r"The directory already exists: (?:\S*/)?([^\s/]*)",
        "A folder {1} already exists, probably from the first time you ran this command.",
        "Nothing was changed. If that folder is your package, continue with it; if not, rename "
        "it first."),
    Row("build-type", _CREATE, r"^build type: (?:ament_)?cmake|Build type 'cmake' is left out",
        "Without `--build-type ament_python`, `ros2 pkg create` creates a C++ package, but your "
        "nodes are in Python.",
        "Remove the folder, and type the command again with that option. Only a package of your "
        "own messages needs no such option."),
    Row("package-name", _CREATE, r"cannot be the name of a package(?! to depend on)",
        "A Python package is imported by its name, so the name follows Python's rules:",
        "lower-case letters, digits and `_`, beginning with a letter."),
    Row("wrong-folder", _CREATE, re.escape(_INSIDE),
        "This terminal's current folder is inside a package, and a package cannot contain "
        "another one.",
        "Packages belong in the src folder of the workspace: go there first."),
    Rule(_CREATE, "", _made_elsewhere),
)  # fmt: skip
#: These come before the rules about words, which take the same outputs for misspelt options.
_OPTION_RULES = (
    Rule(_CREATE, r"^ros2.*: error: unrecognized arguments: ([^\s-].*)$", _options_missing),
    Row("commas-between-names", _CREATE, "",
        "There are commas after --dependencies.",
        "Separate the names with spaces, not with commas.",
        lambda seen, call, _: seen.code and "," in "".join(call.after("--dependencies"))),
)  # fmt: skip


# What is wrong with an entry point, and with a package.


def _broken_module(package: Package, _: str) -> Diagnosis | None:
    """Recognise a file of a package that has a syntax error (28)."""
    broken = package.module_with_syntax_error()
    if not broken:
        return None
    said = BROKEN.evidence.format(path=f"{package.name}/{broken[0]}.py", place=broken[1])
    return Diagnosis(BROKEN.mistake, said, BROKEN.hint)


def _is_for_cpp(package: Package, _: str = "") -> bool:
    return package.manifest.build_type.endswith("cmake")


_STILL = (
    "Nothing new was installed, so `ros2 run` still starts the previous build, if there is one."
)
#: The folders of a package in which messages, services and actions are defined.
_DEFINITIONS = ("msg/*.msg", "srv/*.srv", "action/*.action", "msg/*.idl", "srv/*.idl")


def _defines_messages(package: Package, _: str = "") -> bool:
    folder = package.folder
    return _is_for_cpp(package) and any(any(folder.glob(kind)) for kind in _DEFINITIONS)


_MESSAGES = PackageRow(
    "build-type",
    _defines_messages,
    "{name} defines messages of its own, so it is not a Python package: CMake makes code from its "
    "definitions, with packages of ROS that the course does not have until you add them.",
    "Once, in the folder of the course:  ./environment/course add messages\nThen build again.",
)
_FOR_CPP = PackageRow("build-type",
    lambda package, _: _is_for_cpp(package) and not _defines_messages(package),
    "{name} is a C++ package: the build type in its package.xml is {manifest.build_type}.",
    "`--build-type ament_python` creates a Python package. Rename the folder {name} or move it "
    "away, then create the package again with that option.")  # fmt: skip
_NO_RCLCPP = PackageRow("build-type",
    _is_for_cpp,
    "{name} needs rclcpp, the library for nodes in C++, which ROS 2 from pip does not have.",
    "Nodes in Python work here. A package of messages needs no rclcpp: take it out of its "
    "CMakeLists.txt and package.xml.")  # fmt: skip
_NO_BUILD_TOOLS = (
    r"Find(?:ament_cmake|rosidl_default_generators)\w*\.cmake|Could not find 'cmake'|"
    r"CMAKE_C(?:XX)?_COMPILER\b|No CMAKE_"
)
_NOT_INSTALLED = PackageRow("packages-missing",
    lambda package, _: not package.setup.installs(package.name),
    "The setup.py of {name} does not install the folder {name} with its modules: its `packages` "
    "argument leaves that folder out.",
    "Write packages=find_packages(exclude=['test']), and build again.")  # fmt: skip
#: Files that `ros2 pkg create` made and that are gone (27).
_PARTS = (
    PackageRow("marker-missing",
        lambda package, _: not (package.folder / "setup.py").is_file(),
        "The package {name} has no setup.py, so colcon cannot build it.",
        "Write that file again, as page 05 shows."),
    PackageRow("marker-missing",
        lambda package, _: (package.folder / package.name).is_dir() and not package.has_init,
        "The file {name}/__init__.py is missing from the package {name}, so Python does not "
        "treat that folder as a package, and its modules are not installed.",
        "Create an empty one: touch src/{name}/{name}/__init__.py"),
    PackageRow("marker-missing",
        lambda package, _: not package.scripts_are_found,
        "The setup.cfg of the package {name} is missing or changed. It installs the executables "
        "in lib/{name}, the only folder that `ros2 run` searches.",
        "That file needs the two lines `[install]` and `install_scripts=$base/lib/{name}`."),
)  # fmt: skip
_NO_MARKER = PackageRow("marker-missing",
    lambda package, _: not package.has_marker,
    "The file resource/{name} is missing from the package {name}. ROS finds packages by this "
    "empty marker file.",
    "Create it again in the package's folder: touch resource/{name}")  # fmt: skip
_SETUP_UNREADABLE = PackageRow("syntax-error",
    lambda package, _: package.setup.place,
    "Python cannot read the setup.py of {name}: {setup.problem}, on {setup.place} or just "
    "before it.",
    f"Look for a missing quote, comma or bracket there. {_STILL}")  # fmt: skip
_SETUP_NOT_CALLED = PackageRow("no-setup-call",
    lambda package, _: package.setup.problem == NO_CALL,
    "Python can read the setup.py of {name}, but {setup.problem}.",
    f"Write the call without indentation: setup( ... ). {_STILL}")  # fmt: skip


# `colcon build`, also what it says nothing about.

_NO_PACKAGES = r"(?s)\A(?!.*failed).*Summary: 0 packages finished"
_TWICE = r"Duplicate package names|have the same name"
_DID = {"build": "built", "test": "tested", "list": "listed"}


def _built_in_src(seen: Situation, call: Call, _: Found) -> bool:
    source = (seen.workspace / "src").resolve()
    inside = call.place.resolve().is_relative_to(source) and (call.place / "log").is_dir()
    return inside and "usage:" not in seen.text


def _unknown_package(seen: Situation, call: Call, found: Found) -> Diagnosis:
    """Name the package that `--packages-select` may have meant (13)."""
    did = _DID.get(call.words[1], "did") if len(call.words) > 1 else "did"
    meant = nearest(found[1], [one.name for one in seen.packages])
    return Diagnosis(
        "package-misspelled",
        f"colcon found no package {found[1]}, so it {did} nothing.",
        f"Did you mean {meant}?"
        if meant
        else "`colcon list` lists the packages that colcon finds.",
    )


def _twice_the_same(seen: Situation, _: Call, __: Found) -> Diagnosis | None:
    names = [one.name for one in seen.packages]
    twice = next((name for name in names if names.count(name) > 1), None)
    if not twice:
        return None
    folders = [one.folder for one in seen.packages if one.name == twice]
    places = " and ".join(str(one.relative_to(seen.workspace)) for one in folders)
    return Diagnosis(
        "package-twice",
        f"Two folders contain a package {twice}: {places}. colcon cannot tell which one to build.",
        "Move one of them out of the workspace.",
    )


def _entry_point_built(seen: Situation, call: Call, _: Found) -> Diagnosis | None:
    """Recognise an entry point that leads nowhere (21, 22), or to a file with an error (28)."""
    flaws = [flaw for package, _ in _asked_for(seen, call) for flaw in package.flaws]
    if not flaws:
        return None
    found = diagnose_flaw(flaws[0])
    if found.mistake == "syntax-error":  # its words say already that a build does not notice
        return found
    rest = _STILL if seen.code else "The build does not detect that; `ros2 run` would fail."
    return replace(found, hint=f"{found.hint} {rest}")


def _is_python(_: Situation, package: Package) -> bool:
    return package.manifest.build_type == "ament_python"


def _has_failed(seen: Situation, package: Package) -> bool:
    return bool(seen.code) and f"Failed   <<< {package.name}" in seen.text


def _stray_manifest(seen: Situation, _: Call, __: Found) -> Diagnosis | None:
    """Recognise a `package.xml` that makes one package of a folder that holds several."""
    above = (seen.workspace, seen.workspace / "src")
    strays = [one.folder for one in seen.packages if one.folder in above]
    if not strays:
        return None
    path = (strays[0] / "package.xml").relative_to(seen.workspace)
    return Diagnosis(
        "wrong-folder",
        f"There is a {path} in your workspace, so colcon takes {path.parent.name or 'all of it'} "
        "for one package and finds none of the packages below.",
        f'Each package has its own package.xml. Remove this one: rm "${VARIABLE}"/{path}',
    )


_BUILD_RULES = (
    Rule("colcon (?:build|list|test)", "", _stray_manifest),
    Row("wrong-folder", _BUILD, "",
        "You ran the build inside the folder {here}, so build, install and log are there now "
        "instead of in the workspace.",
        f"Go to the workspace with `{_way_to()}` and build there; "
        "you may remove the three folders from {here}.",
        _built_in_src),
    Row("option-misspelled", "colcon",
        r"ignoring unknown package '(symlink[-_]install|packages[-_]select)'",
        "colcon treated `{1}` as a package:",
        "an option begins with two dashes."),
    Rule("colcon", r"ignoring unknown package '([^']+)'", _unknown_package),
    Rule("colcon", _TWICE, _twice_the_same),
    Row("wrong-folder", _BUILD, _NO_PACKAGES,
        "colcon searched {here} and found no package there.",
        f"Go to the workspace with `{_way_to()}` and build there.",
        lambda seen, call, _: seen.packages and call.place.resolve() != seen.workspace.resolve()),
    Row("no-packages", _BUILD, _NO_PACKAGES,
        "colcon found no package: no folder below this one contains a package.xml.",
        "Create a package in src with `ros2 pkg create` first.",
        lambda seen, *_: not seen.packages),
    PackageRule(_BUILD, (_NO_RCLCPP,), r"Findrclcpp\w*\.cmake", _has_failed),
    PackageRule(_BUILD, (_MESSAGES,), _NO_BUILD_TOOLS, _has_failed),
    PackageRule(_BUILD, (_FOR_CPP,), rf"{_NO_BUILD_TOOLS}|contain CMakeLists\.txt", _has_failed),
    PackageRule(_BUILD, (_SETUP_UNREADABLE,)),
    PackageRule(_BUILD, (_SETUP_NOT_CALLED,), when=_failed),
    PackageRule(
        _BUILD,
        _PARTS,
        when=lambda seen, package: _is_python(seen, package) and not package.manifest.problem,
    ),
    Rule(_BUILD, "", _entry_point_built),
    PackageRule(
        _BUILD,
        (_NOT_INSTALLED,),
        when=lambda seen, package: (
            _is_python(seen, package) and package.modules and not package.setup.problem
        ),
    ),
    # A setup.py may name another file than the usual one, and then the build succeeds.
    PackageRule(
        _BUILD, (_NO_MARKER,), when=lambda seen, package: seen.code and not _is_for_cpp(package)
    ),
    PackageRule(_BUILD, (_broken_module,)),
)  # fmt: skip


# `ros2 run`.

_NO_PACKAGE = r"Package '([^']+)' not found"
_BEFORE = "The build fails because of that, so `ros2 run` started the previous build."
_AGAIN = "Build again with `colcon build` in the workspace."
_NO_MODULE = ("ModuleNotFoundError", "ImportError")
_UNREADABLE = ("SyntaxError", "IndentationError", "TabError")


def _no_such_package(seen: Situation, _: Call, found: Found) -> Diagnosis | None:
    asked = re.search(r"Did you mean '([^']+)'", seen.text)
    meant = nearest(found[1], [one.name for one in seen.packages]) or (asked and asked[1])
    if not meant:
        return None
    said = f"There is no package {found[1]} in your workspace."
    return Diagnosis("package-misspelled", said, f"Did you mean {meant}?")


def _executables(package: Package) -> list[str]:
    return [one.executable for one in package.setup.entry_points]


def _refused_flaw(package: Package, _: str) -> Diagnosis | None:
    """Recognise an entry point with which a build fails (22)."""
    flaws = (one for one in package.flaws if one.kind in ("missing-comma", "slash"))
    return _first(map(diagnose_flaw, flaws))


def _flaw_of_the_executable(package: Package, name: str) -> Diagnosis | None:
    flaws = (one for one in package.flaws if one.entry.executable == name)
    return _first(map(diagnose_flaw, flaws))


def _names_a_node(package: Package, name: str) -> bool:
    """Return whether a module of the package calls a node, or the class of one, by this name."""
    sign = re.compile(rf"__init__\(\s*['\"]{re.escape(name)}['\"]|class {re.escape(name)}\(")
    files = (package.folder / package.name / f"{module}.py" for module in package.modules)
    return any(sign.search(path.read_text(errors="replace")) for path in files)


def _is_module_only(package: Package, name: str) -> bool:
    stem = name.removesuffix(".py")
    return stem in package.modules and stem not in _executables(package)


def _no_such_executable(package: Package, name: str) -> Diagnosis:
    known, stem = _executables(package), name.removesuffix(".py")
    meant = stem if stem in known else nearest(name, known)
    hint = f"It has: {', '.join(known)}." if known else "Its setup.py has no entry points."
    if meant:
        hint = f"Did you mean {meant}? The executable's name is the one before the `=` in setup.py."
    return Diagnosis(
        "executable-misspelled" if known else "entry-point-missing",
        f"The package {package.name} has no executable {name}.",
        hint,
    )


def _lost_its_link(seen: Situation, package: Package) -> bool:
    """Return whether a package is installed as a link, and what was started does not find it."""
    return bool(
        package.installed
        and package.installed.linked
        and package.name.replace("_", "-")
        in "".join(re.findall(r"PackageNotFoundError: No package metadata .+", seen.error))
    )


def _link_unknown(seen: Situation, call: Call, found: Found) -> Diagnosis | None:
    """Recognize a link that has replaced the copy that this terminal was told of."""
    installed = next(
        (
            package.installed
            for package, _ in _asked_for(seen, call)
            if package.installed and package.name.replace("_", "-") in found[0]
        ),
        None,
    )
    if installed is None or not installed.linked:
        return None
    if installed.unfinished:
        return Diagnosis(
            "not-built",
            "The last build with `--symlink-install` failed: it removed the copy of the package, "
            "and did not get as far as telling terminals where the package is now.",
            "Build again, and mend what colcon prints below `stderr`. Then run "
            "`source install/setup.bash`.",
        )
    return Diagnosis(
        "not-sourced",
        "The package is now installed as a symbolic link, but this terminal sourced the workspace "
        "before that build.",
        "Run `source install/setup.bash` again.",
    )


def _is_about_loading(seen: Situation, _: Package) -> bool:
    last = seen.error
    return (
        last.startswith((*_NO_MODULE, *_UNREADABLE))
        or ("has no attribute" in last and last.startswith("AttributeError: module"))
        or "'module' object is not callable" in last
    )


def _runs_a_build(seen: Situation, package: Package) -> bool:
    """Return whether what ran was built before, and not by the same command."""
    return package.installed is not None and not seen.call(_BUILD)


def _refused_since(package: Package, name: str) -> Diagnosis | None:
    """Recognise that a build of this source fails, so an older one runs (22)."""
    setup, flaw = package.setup, _refused_flaw(package, name)
    if setup.place:
        said = f"Python cannot read setup.py: {setup.problem}, on {setup.place}."
        return Diagnosis("syntax-error", said, _BEFORE)
    return replace(flaw, hint=f"{flaw.hint} {_BEFORE}") if flaw else None


def _edited(package: Package, name: str) -> Diagnosis | None:
    """Recognise that what runs is older than what is written (24)."""
    modules = [one.module for one in package.setup.entry_points if one.executable == name]
    files = [module.replace(".", "/") + ".py" for module in modules]
    changed = package.installed.changed if package.installed else ()
    edited = [one for one in files if one in changed]
    if not edited:
        return None
    return Diagnosis(
        "not-rebuilt",
        f"{edited[0]} has been edited since the last build, but `ros2 run` starts the copy in "
        "install, so you see the old version.",
        f"{_AGAIN} With `--symlink-install`, edits take effect without a build.",
    )


def _lost_entry_point(package: Package, name: str) -> Diagnosis:
    """Recognize a program of an earlier build, whose entry point setup.py no longer has."""
    known = _executables(package)
    if name in known:
        said = f"The build in install does not have the entry point {name}, as setup.py has it."
        return Diagnosis("not-rebuilt", said, f"{_AGAIN} Then source install/setup.bash.")
    now = f"It has: {', '.join(known)}." if known else "It has none."
    return Diagnosis(
        "entry-point-missing",
        f"setup.py no longer has an entry point {name}. `ros2 run` started the program of that "
        "name from an earlier build: colcon leaves it in install, where it finds no function to "
        "call.",
        f"{now} Run one of these names, or write the old one into setup.py and build again. To "
        f"remove the old program, delete its package from install, and build again:  "
        f'rm -r "${VARIABLE}"/install/{package.name}'
        if known
        else f"{now} Write one into setup.py, 'executable = package.module:function', and build "
        "again.",
    )


_GROUP_MISSPELLED = PackageRow("group-misspelled",
    lambda package, _: package.setup.misspelled_group,
    "setup.py lists its entry points under {setup.misspelled_group}, where `ros2 run` does not "
    "find them.",
    f"Compare that word with page 05, letter by letter. {_AGAIN}")  # fmt: skip
_RUN_RULES = (
    Row("not-built", "ros2", _NO_PACKAGE,
        "The package {1} is in src, but it has not been built yet.",
        "In the workspace, run `colcon build` and then `source install/setup.bash`.",
        lambda seen, _, found: (package := seen.package(found[1])) and not package.installed),
    Row("not-sourced", "ros2", _NO_PACKAGE,
        "The package {1} is built, but the workspace is not sourced in this terminal.",
        "Source the workspace in every new terminal: run `source install/setup.bash` in the "
        "workspace, then try again.",
        lambda seen, _, found: seen.package(found[1])),
    Rule("ros2", _NO_PACKAGE, _no_such_package),
    PackageRule(
        _RUN,
        (
            PackageRow("build-type",
                _defines_messages,
                "{name} defines messages, and has no programs to run.",
                "`ros2 interface package {name}` lists them once it is built and sourced."),
            _FOR_CPP,
            *_PARTS,
            _refused_flaw,
            PackageRow("not-rebuilt",
                lambda package, name: name in _executables(package),
                "setup.py has the entry point {executable}, but the build in install is older "
                "than that line.",
                _AGAIN),
        ),
        "No executable found",
    ),
    PackageRule(
        _RUN,
        (
            _GROUP_MISSPELLED,
            PackageRow("entry-point-missing",
                _is_module_only,
                "{stem}.py is in the package, but setup.py has no entry point for it, so `ros2 "
                "run` cannot start it.",
                "Add an entry point, 'executable = package.module:function', and build again."),
            PackageRow("executable-misspelled",
                _names_a_node,
                "{executable} is the name of a node or its class.",
                "`ros2 run` takes the executable, the name before the `=` in setup.py."),
            _no_such_executable,
        ),
        "No executable found",
        lambda _, package: not package.setup.incomplete,
    ),
    PackageRule(
        _RUN,
        (_GROUP_MISSPELLED, _lost_entry_point),
        r"load_entry_point[\s\S]*\nStopIteration",
        lambda _, package: not package.setup.incomplete,
    ),
)  # fmt: skip


# Errors of Python, and what Ctrl+C leaves on the screen (29).

#: What any program in Python may come upon; the others are mistakes of a node.
_PLAIN = ("name-error", "wrong-attribute", "no-value-yet", "not-importable", "text-and-number")


def _in_a_node(seen: Situation, _: Call, __: Found) -> Diagnosis | None:
    """Recognise how a node ended: by Ctrl+C, or an error of rclpy's or Python's for a mistake."""
    found = meaning_of_output(seen.traceback)
    return found if found and (seen.about_ros or found.mistake in _PLAIN) else None


def _hidden_module(seen: Situation, call: Call, _: Found) -> Diagnosis | None:
    """Recognise a file that hides a module: beside the program, or where it was started."""
    scripts = [call.place / word for word in call.words if word.endswith(".py")]
    of_packages = [one.folder for one in seen.packages] if call.words[0] == "colcon" else []
    folders = [*(one.parent for one in scripts), call.place, *of_packages]
    return about_hidden(seen.text, [one.resolve() for one in folders])


def _neighbor_module(seen: Situation, _: Call, __: Found) -> Diagnosis | None:
    """Recognise the import of a file of a package without the package's name."""
    return about_neighbor(
        seen.error, [(one.name, module) for one in seen.packages for module in one.modules]
    )


def _not_built_yet(seen: Situation, _: Call, found: Found) -> Diagnosis | None:
    """Recognise a module that is in the source of a package, and in no build of it."""
    package = seen.package(found[1])
    if package is None or found[2] not in package.modules:
        return None
    return Diagnosis(
        "not-rebuilt",
        f"{found[2]}.py is in the package {found[1]}, but not in the build that was started.",
        _AGAIN,
    )


def _from_elsewhere(_: Situation, __: Call, found: Found) -> Diagnosis | None:
    return about_name(found[1])


_LOADING_RULES = (
    Rule(f"{PYTHON}|colcon build", "module|import name", _hidden_module),
    Rule(PYTHON, r"No module named '(\w+)\.(\w+)'", _not_built_yet),
    Rule(PYTHON, "No module named", _neighbor_module),
    Rule(PYTHON, r"No module named '([\w.]+)'", _from_elsewhere),
    Rule("ros2", r"(?:Package|Unknown package) '([^']+)'", _from_elsewhere),
    Row("other-python", PYTHON, "",
        "The program ran with another Python than the course's, and that Python has no ROS.",
        "`which python3` shows which Python a terminal uses. Open a terminal in "
        "JupyterLab, or run `./environment/course shell` in the folder of the course.",
        lambda seen, *_: seen.code and "No module named 'rclpy'" in seen.error),
    # A build that fails leaves half of a link, and no terminal can know the rest.
    PackageRule(_RUN, (_SETUP_UNREADABLE, _refused_flaw), when=_lost_its_link),
    Rule(_RUN, r"PackageNotFoundError: No package metadata .+", _link_unknown),
    PackageRule(
        _RUN,
        (*_PARTS, _NOT_INSTALLED),
        when=lambda seen, package: seen.error.startswith(_NO_MODULE) and package.name in seen.error,
    ),
    PackageRule(_RUN, (_flaw_of_the_executable,), when=_is_about_loading),
    PackageRule(_RUN, (_broken_module,), when=lambda seen, _: seen.error.startswith(_UNREADABLE)),
)  # fmt: skip
_RULES: Rules = (
    Rule(".*", "", _folder_gone),
    Row("space-missing", "cd{1}", rf"{_BASH}cd([.~/][^:]*): ",
        "A space is missing after `cd`:",
        "write  cd {1}"),
    Row("not-sourced", "{1}", rf"{_BASH}({_SETUP}): Permission denied",
        "{1} is not a program to start: it changes this terminal's environment, so it has to be "
        "sourced.",
        "Write `source` and a space before it: source {1}"),
    *_COMMAND_RULES,
    *_MKDIR_RULES,
    *_CD_RULES,
    *_FILE_RULES,
    *_OPTION_RULES,
    *_WORD_RULES,
    *_CREATE_RULES,
    *_BUILD_RULES,
    *_RUN_RULES,
    *_LOADING_RULES,
    # What runs is older than what is written.
    PackageRule(_RUN, (_refused_since,), when=_runs_a_build),
    PackageRule(_RUN, (_edited,), when=_runs_a_build),
    Rule(PYTHON, "", _in_a_node),
)  # fmt: skip
