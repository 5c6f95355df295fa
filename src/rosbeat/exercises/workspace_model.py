"""Judge what lies in a workspace: names that are nearly right, and the programs of a package."""

from __future__ import annotations

from collections.abc import Sequence
from difflib import SequenceMatcher

from rosbeat.diagnosis.mistakes import MISTAKES, UNKNOWN, Diagnosis
from rosbeat.diagnosis.packages import NO_CALL, diagnose_flaw
from rosbeat.exercises.model import Mismatch, Track, diagnose, variants
from rosbeat.exercises.scenarios import CommandMeaning
from rosbeat.workspace.location import VARIABLE
from rosbeat.workspace.packages import Package

#: How much alike two names have to be, from 0 to 1, to be taken for one with a letter wrong.
_ALIKE = 0.75


def alike(one: str, other: str) -> bool:
    """Return whether two names differ only in a letter or two, in capitals, or in their order."""
    one, other = one.lower(), other.lower()
    turned = sorted(one) == sorted(other)
    return turned or SequenceMatcher(None, one, other).ratio() >= _ALIKE


def diagnosis_of(meaning: CommandMeaning | None) -> Diagnosis | None:
    """Return what was recognised on the spot as a diagnosis.

    Evidence comes from where a learner's code has run, so a mistake with a name that the catalogue
    does not have is an unknown one.
    """
    if meaning is None:
        return None
    mistake = meaning.mistake if meaning.mistake in MISTAKES else UNKNOWN
    return Diagnosis(mistake, meaning.evidence, meaning.hint)


# A manifest in a folder that holds packages.


def in_workspace(path: str) -> str:
    """Return a path of the workspace as it can be typed in any folder.

    Args:
        path: Relative to the workspace.
    """
    return f'"${VARIABLE}"/{path}'


def about_stray(path: str) -> Diagnosis:
    """Say what a `package.xml` does in a folder that is to hold packages, and how to undo that.

    Args:
        path: The file, relative to the workspace.
    """
    place = path.rpartition("/")[0] or "the workspace itself"
    return Diagnosis(
        "wrong-folder",
        f"There is a package.xml in {place}, so colcon takes {place} for one package and finds "
        "none of the packages below it.",
        f"Each package has its own package.xml. Remove this one: `rm {in_workspace(path)}`",
    )


def remarks_on_strays(strays: Sequence[str]) -> tuple[str, ...]:
    """Return a remark on each `package.xml` that a right answer leaves in the way of colcon."""
    return tuple(f"{found.evidence} {found.hint}" for found in map(about_stray, strays))


# A build script. It is read and never run, so what is wrong with it is told by its text.

#: What to do about a flaw of an entry point, by its kind, without giving the answer away.
FLAW_HINTS = {
    "missing-comma": "A comma is missing after the first one: two entries have become one.",
    "form": "An entry point is 'executable = package.module:function', with one equals sign.",
    "slash": "Modules are written with dots: package.module.",
    "suffix": "Leave out .py: a module is named without it.",
    "no-function-part": "After the module comes a colon and the name of the function.",
    "called": "The name of the function is enough, without parentheses.",
    "no-module": "The module is package.file: the folder with __init__.py, a dot, the file's name.",
    "syntax-error": "Correct the file, or begin anew: run the cell of page 03 or 04 that saves "
    "it, `%%save`.",
    "no-function": "Look for `def` in the file. Compare the two names letter by letter.",
}


#: How to have a `setup.py` again.
SETUP_ANEW = "The cell of page 05 that saves setup.py, `%%save`, writes it anew."


def diagnose_script(package: Package) -> Diagnosis | None:
    """Return what keeps a build script from being one of its package.

    Args:
        package: The package.
    """
    setup = package.setup
    if setup.problem == NO_CALL:
        return Diagnosis(
            "no-setup-call",
            f"setup.py cannot be used: {setup.problem}.",
            f"setup(...) has to be called when the file is run, without indentation. {SETUP_ANEW}",
        )
    if setup.problem and not setup.place and "No such file" in setup.problem:
        return Diagnosis("marker-missing", "setup.py is gone.", SETUP_ANEW)
    if setup.problem:
        where = f", {setup.place}" if setup.place else ""
        return Diagnosis(
            "syntax-error",
            f"setup.py cannot be read: {setup.problem}{where}.",
            "Each entry is a string in quotes, with a comma after it, inside the square brackets. "
            f"{SETUP_ANEW}",
        )
    if setup.misspelled_group:
        return Diagnosis(
            "group-misspelled",
            f"setup.py puts its entries under {setup.misspelled_group}, and no tool looks for "
            "them there.",
            "Compare that word with the page, letter by letter.",
        )
    if setup.package_name in ("", package.name):
        return None
    # Before the entries: those that are made of the name are wrong only because of it.
    return Diagnosis(
        "names-differ",
        f"setup.py calls the package {setup.package_name}, and package.xml calls it "
        f"{package.name}.",
        "A package has one name, the same in both files; setup.py makes names of files of it, too. "
        "Compare `package_name`, or what stands behind `name=`, with <name> in package.xml.",
    )


def _with_functions_of(right: Track, files: tuple[int, int]) -> Track:
    """Return what each of two programs calls if it gets the function of the file at that place."""
    programs = sorted(right)
    return {program: right[programs[at]] for program, at in zip(programs, files, strict=True)}


_SWAPPED = (
    "The functions of the two files are swapped: an executable calls the function in the file of "
    "its own name."
)
_ONE_FILE = "Both entries call the function of one file: each executable has a file of its own."
_SUSPECTS = variants(
    _with_functions_of,
    [
        ("other-function", _SWAPPED, {"files": (1, 0)}),
        ("other-function", _ONE_FILE, {"files": (0, 0)}, {"files": (1, 1)}),
    ],
)


def diagnose_entries(package: Package, programs: tuple[str, str]) -> Diagnosis | None:
    """Return what is wrong with the entry points of a package.

    Args:
        package: The package, whose build script can be read.
        programs: The executables that are wanted, each like its module in the package, with
            `main` in it.
    """
    if package.flaws:
        found = diagnose_flaw(package.flaws[0])
        return Diagnosis(found.mistake, found.evidence, FLAW_HINTS[package.flaws[0].kind])
    targets = {one.executable: (f"{one.module}:{one.function}",)
             for one in package.setup.entry_points}  # fmt: skip
    right = {program: (f"{package.name}.{program}:main",) for program in programs}
    done = {program: targets[program] for program in programs if program in targets}

    def describe(mismatch: Mismatch) -> Diagnosis:
        if not mismatch.done:
            return _diagnose_missing(package, mismatch.at, mismatch.right in targets.values())
        evidence = f"{mismatch.at} would call {mismatch.done[0]}."
        other = "It should call main in the file of the same name."
        is_file_of_other = mismatch.done[0] in {target for (target,) in right.values()}
        return Diagnosis(
            "other-function" if is_file_of_other else "entry-point-target", evidence, other
        )

    return diagnose(right, done, right, _SUSPECTS, describe) or _diagnose_installation(package)


def _diagnose_missing(package: Package, program: str, is_renamed: bool) -> Diagnosis:
    if package.setup.incomplete:
        return Diagnosis(
            "entry-points-hidden",
            f"There is no {program} that can be read here.",
            "Some entries are calculated, and this check reads setup.py without running it. Write "
            "both as plain texts.",
        )
    names = ", ".join(one.executable for one in package.setup.entry_points)
    return Diagnosis(
        "executable-misspelled" if is_renamed else "entry-point-missing",
        f"There is no {program}. The executables are: {names}.",
        "The executable is the name before the equals sign, and the exercise says what it is "
        "called. It is not the name of the node.",
    )


def _diagnose_installation(package: Package) -> Diagnosis | None:
    """Return what keeps entry points that are right from becoming programs."""
    name, kind = package.name, package.manifest.build_type
    if kind.endswith("cmake"):
        return Diagnosis(
            "build-type",
            f"setup.py is fine, and package.xml says {kind}: colcon would not even read setup.py.",
            "<build_type> belongs to a package for Python. `sed -i 's/ament_cmake/ament_python/' "
            f"{in_workspace(package.folder.as_posix())}/package.xml` writes it.",
        )
    if not package.setup.installs(name):
        return Diagnosis(
            "packages-missing",
            f"Both entries are there, and `packages` of setup.py leaves out {name}: their code "
            "would not be installed.",
            "find_packages finds every folder that has an __init__.py, but for those that it is "
            "told to leave out.",
        )
    if not package.has_init and name not in (package.setup.packages or ()):
        return Diagnosis(
            "marker-missing",
            f"setup.py is fine, and {name}/__init__.py is gone: find_packages would not see the "
            "folder.",
            f"It is an empty file: `touch {in_workspace(package.folder.as_posix())}/{name}"
            "/__init__.py` makes one.",
        )
    if package.scripts_are_found:
        return None
    return Diagnosis(
        "marker-missing",
        "setup.py is fine, and setup.cfg does not say where programs go: `ros2 run` would not "
        "find them.",
        "Compare it with the setup.cfg that page 02 shows, and write its four lines there: "
        "double-click the file in the file browser.",
    )
