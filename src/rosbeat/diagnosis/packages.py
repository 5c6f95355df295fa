"""Describe a ROS package as plain data, and say what is wrong with its entry points.

`rosbeat.workspace.packages` fills these records from the files of a workspace. Whatever judges a
package or a failed command reads only the records.
"""

from __future__ import annotations

import ast
import re
import warnings
from dataclasses import dataclass
from difflib import get_close_matches
from fnmatch import fnmatchcase
from pathlib import Path

from rosbeat.diagnosis.mistakes import Diagnosis

#: The `problem` of a build script that can be read and never calls `setup`.
NO_CALL = "it does not call setup()"
_SCRIPTS = "console_scripts"
#: How similar two words have to be, from 0 to 1, to be the same word with a typing error.
_ALIKE = 0.75
#: A name and an equals sign; `talk ==` is a mistake of its own, and one name.
_EQUALS = re.compile(r"[\w.-]+\s*=+")
_NAME = re.compile(r"\w[\w.-]*")


# The records.


@dataclass(frozen=True)
class Manifest:
    """Hold the parts of a `package.xml` that the course speaks about; an absent one is empty.

    Attributes:
        name: The package.
        version: Its version.
        description: A sentence.
        license: Its license; several are joined with commas.
        maintainer: A name.
        email: The maintainer's address.
        build_type: `ament_python`, `ament_cmake` or another.
        depends: Packages that it needs to run or to be built.
        problem: Why the file cannot be read, or empty.
        format: The version of the manifest format that it declares.
        tags: Every tag below the outermost one, each once, in order.
    """

    name: str = ""
    version: str = ""
    description: str = ""
    license: str = ""
    maintainer: str = ""
    email: str = ""
    build_type: str = ""
    depends: tuple[str, ...] = ()
    problem: str = ""
    format: str = ""
    tags: tuple[str, ...] = ()


@dataclass(frozen=True)
class EntryPoint:
    """Hold one line of `console_scripts`.

    Attributes:
        text: The whole string.
        executable: The name before `=`.
        module: The module before `:`.
        function: The function after `:`, or empty.
        pieces: How many adjacent strings Python joined to this one.
        file: The file that it is in.
    """

    text: str
    executable: str
    module: str
    function: str
    pieces: int = 1
    file: str = "setup.py"

    @property
    def joined(self) -> bool:
        """Return whether two entry points became one because a comma is missing between them."""
        return self.pieces > 1 and len(_EQUALS.findall(self.text)) > 1


def entry_point(text: str, pieces: int = 1, file: str = "setup.py") -> EntryPoint:
    """Return the parts of an entry point, such as `talk = rosie.voice:main`.

    Args:
        text: The whole string.
        line: Its line in the file, counted from 1.
        pieces: How many adjacent strings Python joined to this one.
        file: The file that it is in.
    """
    executable, _, target = text.partition("=")
    module, _, function = target.partition(":")
    parts = (executable.strip(), module.strip(), function.split("[")[0].strip())
    return EntryPoint(text, *parts, pieces, file)


@dataclass(frozen=True)
class SetupScript:
    """Hold the parts of a `setup.py` that the course speaks about.

    Attributes:
        package_name: The argument `name`.
        entry_points: The console scripts.
        incomplete: Whether there may be console scripts that were not found.
        problem: Why the file cannot be read, or empty.
        place: Where in the file that problem is, or empty.
        keywords: The keyword arguments of `setup`, sorted.
        groups: The groups of entry points, sorted.
        packages: Patterns of the Python packages that it installs; None if unknown.
        excluded: Patterns of those that it leaves out.
        about: Its version, description and license, as far as it gives them as strings.
        left_out: The marker and the manifest, if it certainly does not install them where every
            ROS package has them.
    """

    package_name: str = ""
    entry_points: tuple[EntryPoint, ...] = ()
    incomplete: bool = False
    problem: str = ""
    place: str = ""
    keywords: tuple[str, ...] = ()
    groups: tuple[str, ...] = ()
    packages: tuple[str, ...] | None = None
    excluded: tuple[str, ...] = ()
    about: tuple[tuple[str, str], ...] = ()
    left_out: tuple[str, ...] = ()

    def installs(self, package: str) -> bool:
        """Return whether a Python package is installed, as far as that is known.

        Args:
            package: Its name.
        """
        if self.packages is None:
            return True
        wanted = any(fnmatchcase(package, one) for one in self.packages)
        return wanted and not any(fnmatchcase(package, one) for one in self.excluded)

    @property
    def misspelled_group(self) -> str:
        """Return a keyword or group that is nearly the right one for programs, or an empty text."""
        if "entry_points" not in self.keywords:
            return next(iter(get_close_matches("entry_points", self.keywords, 1, _ALIKE)), "")
        if self.entry_points or _SCRIPTS in self.groups:
            return ""
        return next(iter(get_close_matches(_SCRIPTS, self.groups, 1, _ALIKE)), "")


@dataclass(frozen=True)
class Flaw:
    """Hold what is wrong with an entry point, or with the module that it names.

    Attributes:
        kind: A key of `FLAWS`.
        entry: The entry point.
        wrong: The part that is wrong.
        right: What was probably meant, or empty.
        place: Where in the module a syntax error is, or empty.
    """

    kind: str
    entry: EntryPoint
    wrong: str
    right: str = ""
    place: str = ""


@dataclass(frozen=True)
class Installed:
    """Hold what `colcon build` has installed of a package.

    Attributes:
        prefix: The folder it is installed in.
        executables: The programs that `ros2 run` can start, sorted.
        linked: Whether it was built with `--symlink-install`, so that edits of modules count.
        unfinished: Whether that build failed after it had made the link, so that no terminal is
            told of it.
        changed: Source files, relative to the package, whose installed copy is different or absent.
    """

    prefix: Path
    executables: tuple[str, ...] = ()
    linked: bool = False
    unfinished: bool = False
    changed: tuple[str, ...] = ()


@dataclass(frozen=True)
class Package:
    """Hold what the files of a ROS package say.

    Attributes:
        folder: The folder of its `package.xml`.
        name: Its name in the manifest, or else the name of its folder.
        manifest: Its `package.xml`.
        setup: Its `setup.py`.
        scripts_folder: The folder in which `setup.cfg` installs executables, or empty.
        has_marker: Whether `resource/<name>` exists.
        has_init: Whether `<name>/__init__.py` exists.
        tests: The files of its test folder, sorted.
        modules: The modules of its Python package, without `__init__`, sorted.
        flaws: What is wrong with its entry points and the modules that they name.
        installed: What `colcon build` has installed, or None.
    """

    folder: Path
    name: str
    manifest: Manifest
    setup: SetupScript
    scripts_folder: str
    has_marker: bool
    has_init: bool
    tests: tuple[str, ...]
    modules: tuple[str, ...]
    flaws: tuple[Flaw, ...]
    installed: Installed | None

    @property
    def scripts_are_found(self) -> bool:
        """Return whether `setup.cfg` installs executables where `ros2 run` looks for them."""
        return self.scripts_folder == f"$base/lib/{self.name}"

    def module_with_syntax_error(self) -> tuple[str, str] | None:
        """Return the first module that Python cannot read and the place, or None."""
        for module in self.modules:
            place = top_level_names(self.folder / self.name / f"{module}.py")[1]
            if place:
                return module, place
        return None


# Names and modules.


def nearest(word: str, names: list[str], cutoff: float = 0.6) -> str | None:
    """Return the name that was probably meant, or None if no name is similar.

    Args:
        word: The word that was typed.
        names: The words that would have been right.
        cutoff: How similar they have to be, from 0 to 1.
    """
    by_lower = {name.lower(): name for name in names}
    found = get_close_matches(word.lower(), by_lower, n=1, cutoff=cutoff)
    return by_lower[found[0]] if found else None


def parse(text: str | bytes) -> ast.Module:
    """Return the syntax tree of a module, checked as far as the compiler checks it.

    Args:
        text: The text of the module; it is not executed, and causes no warnings.

    Raises:
        SyntaxError: If it is not Python, or has `return` outside of a function.
        ValueError: If it cannot be decoded.
    """
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        tree = ast.parse(text)
        compile(tree, "<module>", "exec", dont_inherit=True)
    return tree


def place_of(error: SyntaxError) -> str:
    """Return where an error of syntax is in a file: the number of the line, and the line itself.

    A learner who saved the file from a cell finds the line by its text: there, the line of `%%save`
    comes first.
    """
    code = (error.text or "").strip()
    return f"line {error.lineno or 1}" + (f" (`{code}`)" if code else "")


def top_level_names(path: Path) -> tuple[list[str] | None, str]:
    """Return the names that a module defines, and the place of its syntax error, or nothing.

    Args:
        path: The file of the module.

    Returns:
        None instead of the names if they are known only by running the module.
    """
    try:
        tree = parse(path.read_bytes())
    except SyntaxError as error:
        return [], place_of(error)
    except (OSError, ValueError, RecursionError, MemoryError):
        return None, ""
    names = [name for node in tree.body for name in _names_of(node)]
    return (None, "") if "*" in names else (names, "")


def _names_of(node: ast.stmt) -> list[str]:
    if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
        return [node.name]
    if isinstance(node, ast.Import | ast.ImportFrom):
        return [(one.asname or one.name).split(".")[0] for one in node.names]
    inside = list(ast.walk(node))
    functions = [one.name for one in inside if isinstance(one, ast.FunctionDef)]
    stored = [one.id for one in inside
              if isinstance(one, ast.Name) and isinstance(one.ctx, ast.Store)]  # fmt: skip
    return functions + stored


def _module_file(module: str, folder: Path) -> Path | None:
    stem = folder.joinpath(*module.split("."))
    candidates = (stem.with_name(stem.name + ".py"), stem / "__init__.py")
    return next((one for one in candidates if one.is_file()), None)


# What is wrong with an entry point.


def flaw_of(entry: EntryPoint, folder: Path) -> Flaw | None:
    """Return the first thing that is wrong with an entry point, or None.

    Args:
        entry: The entry point.
        folder: The folder of the ROS package, which holds its `setup.py`.
    """
    return _flaw_of_form(entry) or _flaw_of_target(entry, folder)


def _flaw_of_form(entry: EntryPoint) -> Flaw | None:
    module = entry.module
    forms: tuple[tuple[object, str, str, str], ...] = (
        (entry.joined, "missing-comma", entry.text, ""),
        (not _is_of_the_form(entry), "form", entry.text, ""),
        ("/" in module, "slash", module, module.replace("/", ".").removesuffix(".py")),
        (module.endswith(".py"), "suffix", module, module.removesuffix(".py")),
        (not entry.function, "no-function-part", module, "main"),
        (entry.function.endswith("()"), "called", entry.function, entry.function[:-2]),
    )
    found = (Flaw(kind, entry, wrong, right) for holds, kind, wrong, right in forms if holds)
    return next(found, None)


def _is_of_the_form(entry: EntryPoint) -> bool:
    # An extra in brackets may hold another sign.
    signs = "=" in entry.text if "[" in entry.text else entry.text.count("=") == 1
    return signs and _NAME.fullmatch(entry.executable) is not None


def _flaw_of_target(entry: EntryPoint, folder: Path) -> Flaw | None:
    path = _module_file(entry.module, folder)
    if path is None:
        return Flaw("no-module", entry, entry.module, _nearest_module(entry.module, folder))
    names, place = top_level_names(path)
    if place:
        return Flaw("syntax-error", entry, entry.module, place=place)
    if names is not None and entry.function.split(".")[0] not in names:
        return Flaw("no-function", entry, entry.function, nearest(entry.function, names) or "")
    return None


def _nearest_module(module: str, folder: Path) -> str:
    files = [one.relative_to(folder) for one in folder.glob("*/*.py") if one.parent.name != "test"]
    known = [".".join(one.with_suffix("").parts) for one in files if one.stem != "__init__"]
    tails = {name.rpartition(".")[2]: name for name in known}
    return nearest(module, known) or tails.get(module.rpartition(".")[2], "")


_NAMED = "The entry point {entry.executable} in {entry.file} names "
BROKEN = Diagnosis("syntax-error",
    "Python cannot read {path}: there is a syntax error on {place} or just before it.",
    "colcon copies modules without running them, so the build does not detect the error. Correct "
    "that line and build again.")  # fmt: skip
#: What is said about each kind of flaw of an entry point; `{wrong}` is the part that is wrong, and
#: `{right}` what was probably meant.
FLAWS = {
    "missing-comma": Diagnosis("comma-missing",
        "A comma is missing in {entry.file}, between the entry point {entry.executable} and the "
        "next one: without it, Python joins two adjacent strings into one.",
        "Put a comma at the end of every entry point."),
    "form": Diagnosis("entry-point-form",
        "The entry point `{entry.text}` in {entry.file} is not of the form  name = "
        "package.module:function.",
        "Write a name, a single `=`, and the function, as in  'name = package.module:main'."),
    "slash": Diagnosis("slash-in-module",
        f"{_NAMED}its module with a `/`, like a path.",
        "The parts of a Python module's name are separated by dots: {right}"),
    "suffix": Diagnosis("entry-point-target",
        f"{_NAMED}a file, {{wrong}}.",
        "A module's name does not end in `.py`: write {right}:{function}"),
    "no-function-part": Diagnosis("entry-point-target",
        f"{_NAMED}a module, but no function in it.",
        "Add the function after a colon: {wrong}:main"),
    "called": Diagnosis("entry-point-form",
        "The entry point {entry.executable} in {entry.file} ends with {wrong}: an entry point "
        "names a function without calling it.",
        "Leave out the parentheses: write {right}"),
    "no-module": Diagnosis("entry-point-target",
        f"{_NAMED}the module {{wrong}}, which does not exist.",
        "Did you mean {right}?"),
    "syntax-error": BROKEN,
    "no-function": Diagnosis("entry-point-target",
        f"{_NAMED}the function {{wrong}}, which {{entry.module}} does not define.",
        "Did you mean {right}?"),
}  # fmt: skip
#: What to try if nothing is like what was written.
_NOTHING_NEAR = {
    "no-module": "Compare it with the names of your files: the package, a dot, and the file "
    "without `.py`.",
    "no-function": "Define that function, or name one that exists.",
}


def diagnose_flaw(flaw: Flaw) -> Diagnosis:
    """Say what is wrong with an entry point, and what to write instead.

    Args:
        flaw: What was found.
    """
    row = FLAWS[flaw.kind]
    hint = row.hint if flaw.right else _NOTHING_NEAR.get(flaw.kind, row.hint)
    values = {
        **vars(flaw),
        "function": flaw.entry.function or "main",
        "path": f"{flaw.wrong.replace('.', '/')}.py",
    }
    return Diagnosis(row.mistake, row.evidence.format_map(values), hint.format_map(values))
