"""What a `setup.py` says, read from its syntax tree and never run."""

from __future__ import annotations

import ast
import posixpath
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from difflib import get_close_matches
from fnmatch import fnmatchcase
from pathlib import Path

from rosbeat.records import OMIT_EMPTY
from rosbeat.workspace.parsing import decoded, parse, pieces
from rosbeat.workspace.seen_names import reached
from rosbeat.workspace.seen_values import Seen, entries_of, items_of, keywords_of, text_of

#: A name and what stands for an equals sign; `talk ==` is a slip of its own, and one name.
_NAMED = re.compile(r"[\w.-]+\s*=+")
#: The line is told beside the problem.
_DETECTED = re.compile(r" \(detected at line \d+\)")
_SCRIPTS = "console_scripts"
#: What a build script says of a package besides its code, and the manifest says, too.
_ABOUT = ("version", "description", "license")
_FINDERS = ("find_packages", "find_namespace_packages")
#: How much alike two words have to be, from 0 to 1, to be taken for one with a letter wrong.
_ALIKE = 0.75
NO_CALL = "it does not call setup()"


@dataclass(frozen=True)
class EntryPoint:
    """One line of `console_scripts`.

    Attributes:
        text: The whole string.
        line: Its line in `setup.py`, counted from 1.
        executable: The name before `=`.
        module: The module before `:`.
        function: The function behind `:`, or empty.
        pieces: How many texts in a row Python joins to this one.
        file: The file that it stands in.
    """

    text: str
    line: int
    executable: str
    module: str
    function: str
    pieces: int = 1
    file: str = "setup.py"

    @property
    def joined(self) -> bool:
        """Whether two entry points have become one, because a comma is missing between them."""
        return self.pieces > 1 and len(_NAMED.findall(self.text)) > 1


@dataclass(frozen=True)
class SetupScript:
    """The parts of a build script that the course speaks about.

    Attributes:
        package_name: What `name=` says.
        entry_points: The console scripts.
        end_of_scripts: The line of the bracket that closes their list, or 0 if there is no list.
        end_column: The column behind that bracket, in bytes of UTF-8.
        incomplete: Whether there may be console scripts that cannot be seen without running it.
        problem: Why the file cannot be read, or empty.
        line: The line of that problem, or 0.
        keywords: What `setup` is given by name, sorted.
        groups: The groups of entry points, sorted.
        packages: Patterns of the Python packages that it installs; None if that cannot be seen.
        excluded: Patterns of those that it leaves out.
        about: Its version, description and license, as far as it says them as texts.
        left_out: The marker and the manifest, if it certainly does not install them where every
            ROS package has them.
    """

    package_name: str = ""
    entry_points: tuple[EntryPoint, ...] = ()
    end_of_scripts: int = 0
    end_column: int = 0
    incomplete: bool = False
    problem: str = ""
    line: int = 0
    keywords: tuple[str, ...] = ()
    groups: tuple[str, ...] = ()
    packages: tuple[str, ...] | None = None
    excluded: tuple[str, ...] = ()
    about: tuple[tuple[str, str], ...] = ()
    left_out: tuple[str, ...] = field(default=(), metadata=OMIT_EMPTY)

    def installs(self, package: str) -> bool:
        """Whether a Python package is installed, as far as can be seen.

        Args:
            package: Its name.
        """
        if self.packages is None:
            return True
        wanted = any(fnmatchcase(package, one) for one in self.packages)
        return wanted and not any(fnmatchcase(package, one) for one in self.excluded)

    @property
    def misspelled_group(self) -> str:
        """A keyword or a group that is nearly the one for programs, or an empty text."""
        if "entry_points" not in self.keywords:
            return next(iter(get_close_matches("entry_points", self.keywords, 1, _ALIKE)), "")
        if self.entry_points or _SCRIPTS in self.groups:
            return ""
        return next(iter(get_close_matches(_SCRIPTS, self.groups, 1, _ALIKE)), "")


def read_setup(path: Path) -> SetupScript:
    """Read a build script; a bad one has a `problem` and nothing else.

    Args:
        path: The `setup.py`.
    """
    try:
        return parse_setup(path.read_bytes())
    except OSError as error:
        return SetupScript(problem=error.strerror or "it cannot be read")


def parse_setup(data: bytes) -> SetupScript:
    """Read the bytes of a build script; bad ones give a `problem` and nothing else.

    Args:
        data: What the file holds.
    """
    try:
        return _script(parse(data), decoded(data))
    except SyntaxError as error:
        return SetupScript(problem=_DETECTED.sub("", error.msg), line=error.lineno or 0)
    except (ValueError, RecursionError, MemoryError) as error:
        return SetupScript(problem=str(error) or type(error).__name__)


def _script(tree: ast.Module, source: str) -> SetupScript:
    call = reached(tree, "setup")
    if call is None or not isinstance(call.node, ast.Call):
        return SetupScript(problem=NO_CALL)
    everything = keywords_of(call, call.node)
    given = _readable(call, call.node) if everything is None else everything
    groups = _groups(given.get("entry_points"))
    found, complete = _entry_points(groups or {}, source)
    end = _end((groups or {}).get(_SCRIPTS))
    packages, excluded = _packages(given.get("packages"), everything is not None)
    return SetupScript(
        package_name=_text(given.get("name")),
        entry_points=found,
        end_of_scripts=(end.end_lineno or 0) if end else 0,
        end_column=(end.end_col_offset or 0) if end else 0,
        incomplete=everything is None or groups is None or not complete,
        keywords=tuple(sorted(given)),
        groups=tuple(sorted(groups or ())),
        packages=packages,
        excluded=excluded,
        about=tuple((key, _text(given[key])) for key in _ABOUT if _text(given.get(key))),
        left_out=() if everything is None else _left_out(given),
    )


def _readable(call: Seen, node: ast.Call) -> dict[str, Seen]:
    """What is given by name and can be seen, if something else cannot."""
    return {one.arg: call.of(one.value) for one in node.keywords if one.arg}


def _text(seen: Seen | None) -> str:
    return (text_of(seen) if seen else None) or ""


def _end(scripts: Seen | None) -> ast.List | None:
    return scripts.node if scripts and isinstance(scripts.node, ast.List) else None


def _groups(value: Seen | None) -> Mapping[str, Seen] | None:
    """The groups of entry points; None if they cannot all be seen."""
    if value is None:
        return {}
    text = text_of(value)
    return _read_groups(text, value) if text is not None else _visible(value)


def _visible(value: Seen) -> Mapping[str, Seen] | None:
    found = entries_of(value)
    if found is None and isinstance(value.node, ast.Dict):
        # A star in it hides other groups; what stands beside it can be seen all the same.
        keys = zip(value.node.keys, value.node.values, strict=True)
        names = {text_of(value.of(key)): one for key, one in keys if key}
        shown = names.get(_SCRIPTS)
        return {_SCRIPTS: value.of(shown)} if shown else None
    return found


def _read_groups(text: str, value: Seen) -> Mapping[str, Seen]:
    """The groups of a text such as `[console_scripts]` with one entry in each line below it."""
    parts = re.split(r"^\s*\[(.+?)\]\s*$", text, flags=re.MULTILINE)
    pairs = zip(parts[1::2], parts[2::2], strict=True)
    lines = {name: ast.copy_location(ast.Constant(lines), value.node) for name, lines in pairs}
    return {name: Seen(node, {}) for name, node in lines.items()}


def _entry_points(groups: Mapping[str, Seen], source: str) -> tuple[tuple[EntryPoint, ...], bool]:
    """The programs that can be seen, and whether these are all.

    On Linux the group for windows makes the same programs as the one for terminals.
    """
    found: list[EntryPoint | None] = []
    for name in (_SCRIPTS, "gui_scripts"):
        if name in groups:
            found += _programs(groups[name], source)
    entries = tuple(one for one in found if one is not None)
    return entries, len(entries) == len(found)


def _programs(scripts: Seen, source: str) -> list[EntryPoint | None]:
    """The entry points of a group; None stands for what cannot be seen."""
    lines = text_of(scripts)
    if lines is not None:
        return list(entry_points_in(lines, scripts.node.lineno))
    items = items_of(scripts)
    if items is None:
        return [*(_item(one, source) for one in _beside_stars(scripts)), None]
    return [_item(one, source) for one in items]


def _beside_stars(scripts: Seen) -> list[Seen]:
    node = scripts.node
    return [scripts.of(one) for one in node.elts] if isinstance(node, ast.List | ast.Tuple) else []


def _item(seen: Seen, source: str) -> EntryPoint | None:
    text = text_of(seen)
    if text is None:
        return None
    line = getattr(seen.node, "lineno", 0)
    segment = ast.get_source_segment(source, seen.node) if line else None
    return entry_point(text, line, pieces(segment or ""))


def entry_points_in(lines: str, line: int, file: str = "setup.py") -> list[EntryPoint]:
    """Return the entry points of a text that has one in each line.

    Args:
        lines: The text.
        line: Where it begins.
        file: The file that it stands in.
    """
    plain = [one.strip() for one in lines.splitlines()]
    return [entry_point(one, line, 1, file) for one in plain if one and one[0] not in "#;"]


def entry_point(text: str, line: int, parts: int = 1, file: str = "setup.py") -> EntryPoint:
    """Take the text of an entry point apart.

    Args:
        text: As in `talk = rosie.voice:main`.
        line: Its line.
        parts: How many texts in a row Python joined to this one.
        file: The file that it stands in.
    """
    executable, _, target = text.partition("=")
    module, _, function = target.partition(":")
    function = function.split("[")[0]
    return EntryPoint(text, line, executable.strip(), module.strip(), function.strip(), parts, file)


def _left_out(given: Mapping[str, Seen]) -> tuple[str, ...]:
    """Return the files of every ROS package that `data_files` leaves out; none if some is unseen.

    Paths are compared as setuptools understands them: `./package.xml` is `package.xml`.
    """
    name = _text(given.get("name"))
    wanted = {
        f"resource/{name}": f"share/ament_index/resource_index/packages/{name}",
        "package.xml": f"share/{name}/package.xml",
    }
    pairs = items_of(given["data_files"]) if "data_files" in given else []
    if not name or pairs is None:
        return ()
    installed = set()
    for pair in map(items_of, pairs):
        if pair is None or len(pair) != 2:
            return ()
        folder, files = text_of(pair[0]), _texts(pair[1])
        if folder is None or files is None:
            return ()
        installed |= {posixpath.normpath(f"{folder}/{posixpath.basename(one)}") for one in files}
    return tuple(source for source, place in wanted.items() if place not in installed)


def _packages(
    value: Seen | None, everything: bool
) -> tuple[tuple[str, ...] | None, tuple[str, ...]]:
    """Patterns of what is installed and of what is not.

    Without `packages`, setuptools looks by itself, and refuses where it finds two folders: every
    ROS package has `resource` beside its code.
    """
    if value is None:
        return () if everything else None, ()
    node = value.node
    if isinstance(node, ast.Call) and ast.unparse(node.func).split(".")[-1] in _FINDERS:
        return _found(value, node)
    return _texts(value), ()


def _found(value: Seen, node: ast.Call) -> tuple[tuple[str, ...] | None, tuple[str, ...]]:
    names = ("where", "exclude", "include")
    given = {**dict(zip(names, node.args, strict=False)),
             **{one.arg: one.value for one in node.keywords if one.arg}}  # fmt: skip
    include = _texts(value.of(given["include"])) if "include" in given else ("*",)
    exclude = _texts(value.of(given["exclude"])) if "exclude" in given else ()
    where = text_of(value.of(given["where"])) if "where" in given else "."
    if include is None or exclude is None or where is None:
        return None, ()
    return (include if where in (".", "./", "") else ()), exclude


def _texts(value: Seen) -> tuple[str, ...] | None:
    texts = [text_of(one) for one in items_of(value) or ()]
    known = tuple(text for text in texts if text is not None)
    return known if items_of(value) is not None and len(known) == len(texts) else None
