"""What is wrong with the programs that a build script names."""

from __future__ import annotations

from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.workspace.meanings.flaws import MISTAKE_OF
from rosbeat.workspace.packages import Package
from rosbeat.workspace.setup_script import NO_CALL, EntryPoint, SetupScript
from rosbeat.workspace.targets import Flaw

_ANATOMY = "An entry point is 'executable = package.module:function'."
_PLAIN = (
    "Some entries are calculated, and this check reads setup.py without running it. Write both "
    "as plain texts."
)
_CALLED = (
    "The executable is the name before the equals sign, and the exercise says what it is called. "
    "It is not the name of the node."
)

#: What is wrong with an entry point, by the kind of the flaw, and what to do about it.
FLAWS = {
    "missing-comma": (
        "two entries have become one",
        "A comma is missing after the first one: Python glues texts together.",
    ),
    "no-equals": ("has no equals sign", _ANATOMY),
    "two-equals": ("has two equals signs", "One equals sign is enough: it is no comparison."),
    "bad-name": ("begins with a name that no program can have", _ANATOMY),
    "slash": ("has a slash in the module", "Modules are written with dots: package.module."),
    "suffix": (
        "names a file, with .py, and not a module",
        "Leave out .py: a module is named without it.",
    ),
    "no-function-part": (
        "names no function",
        "After the module comes a colon and the name of the function.",
    ),
    "no-module": (
        "names a module that does not exist",
        "The module is package.file: the folder with __init__.py, a dot, the file's name.",
    ),
    "syntax-error": (
        "names a module that Python cannot read",
        "Mend the file, on page 03 or 04, and run its cell again.",
    ),
    "no-function": (
        "names a function that its module does not have",
        "Look for `def` in the file. The name stands without brackets here.",
    ),
}


def diagnose_script(setup: SetupScript) -> Diagnosis | None:
    """Recognise what keeps a build script from being one.

    Args:
        setup: What it says.
    """
    if setup.problem == NO_CALL:
        return Diagnosis(
            "no-setup-call",
            f"setup.py cannot be used: {setup.problem}.",
            "setup(...) has to be called when the file is run, at its left margin.",
        )
    if setup.problem and not setup.line and "No such file" in setup.problem:
        said = "setup.py is gone."
        return Diagnosis("marker-missing", said, "Run the cell above again: it writes the file.")
    if setup.problem:
        where = f", line {setup.line}" if setup.line else ""
        return Diagnosis(
            "syntax-error",
            f"setup.py cannot be read: {setup.problem}{where}.",
            "Each entry is a text between quotes, with a comma after it, inside the square "
            "brackets.",
        )
    return _group(setup.misspelled_group)


def _group(found: str) -> Diagnosis | None:
    if not found:
        return None
    return Diagnosis(
        "group-misspelled",
        f"setup.py puts its entries under {found}, and nobody looks for them there.",
        "Compare that word with the page, letter by letter.",
    )


def diagnose_name(package: Package) -> Diagnosis | None:
    """Recognise a build script that calls its package by another name than the manifest does.

    Args:
        package: The package.
    """
    name = package.setup.package_name
    if name in ("", package.name):
        return None
    return Diagnosis(
        "names-differ",
        f"setup.py calls the package {name}, and package.xml calls it {package.name}.",
        "A package has one name, the same in both files; setup.py makes names of files of it, too. "
        "Compare `package_name`, or what stands behind `name=`, with <name> in package.xml.",
    )


def diagnose_entries(package: Package, programs: tuple[str, ...]) -> Diagnosis | None:
    """Recognise what is wrong with the entry points of a package.

    Args:
        package: The package, whose build script can be read.
        programs: The executables that are wanted, each like its module in the package, with
            `main` in it.
    """
    renamed = diagnose_name(package)
    if renamed:  # first: entries made of the name are wrong only because of it
        return renamed
    if package.flaws:
        return _flawed(package.flaws[0])
    targets = {one.executable: one for one in package.setup.entry_points}
    for program in programs:
        wanted = f"{package.name}.{program}:main"
        found = (
            _other_target(targets[program], wanted)
            if program in targets
            else _missing(package.setup, program, wanted)
        )
        if found:
            return found
    return _of_package(package)


def _of_package(package: Package) -> Diagnosis | None:
    """What keeps entry points that are right from becoming programs."""
    name = package.name
    kind = package.manifest.build_type
    if kind.endswith("cmake"):
        said = (
            f"setup.py is fine, and package.xml says {kind}: colcon would not even read setup.py."
        )
        return Diagnosis("build-type", said, "<build_type> belongs to a package for Python.")
    if not package.setup.installs(name):
        return _nothing_installed(name)
    if not package.has_init and name not in (package.setup.packages or ()):
        return Diagnosis(
            "marker-missing",
            f"setup.py is fine, and {name}/__init__.py is gone: find_packages would not see the "
            "folder.",
            "It is an empty file; `touch` makes one.",
        )
    if package.scripts_are_found:
        return None
    return Diagnosis(
        "marker-missing",
        "setup.py is fine, and setup.cfg does not say where programs go: `ros2 run` would not "
        "find them.",
        "Compare it with the setup.cfg that page 02 shows.",
    )


def _flawed(flaw: Flaw) -> Diagnosis:
    said, cure = FLAWS[flaw.kind]
    where = f"Line {flaw.entry.line} of" if flaw.entry.file == "setup.py" else "In"
    return Diagnosis(
        MISTAKE_OF[flaw.kind], f"{where} {flaw.entry.file}, '{flaw.entry.text}': {said}.", cure
    )


def _target(entry: EntryPoint) -> str:
    return f"{entry.module}:{entry.function}"


def _other_target(entry: EntryPoint, wanted: str) -> Diagnosis | None:
    if _target(entry) == wanted:
        return None
    return Diagnosis(
        "entry-point-target",
        f"{entry.executable} would call {_target(entry)}.",
        "It should call main in the file of the same name.",
    )


def _missing(setup: SetupScript, program: str, wanted: str) -> Diagnosis:
    if setup.incomplete:
        return Diagnosis(
            "entry-points-hidden", f"There is no {program} that can be read here.", _PLAIN
        )
    names = [one.executable for one in setup.entry_points]
    renamed = any(_target(one) == wanted for one in setup.entry_points)
    return Diagnosis(
        "executable-misspelled" if renamed else "entry-point-missing",
        f"There is no {program}. The executables are: {', '.join(names)}.",
        _CALLED,
    )


def _nothing_installed(name: str) -> Diagnosis:
    return Diagnosis(
        "packages-missing",
        f"Both entries are there, and `packages` of setup.py leaves out {name}: their code would "
        "not be installed.",
        "find_packages finds every folder that has an __init__.py, but for those that it is told "
        "to leave out.",
    )


def differences(package: Package) -> tuple[str, ...]:
    """Return a remark if a build script says something else than its manifest, besides the name.

    Args:
        package: The package.
    """
    manifest = package.manifest
    said = dict(package.setup.about)
    texts = {"version": manifest.version, "description": manifest.description}
    texts["license"] = manifest.license
    other = [key for key, text in texts.items() if key in said and text and said[key] != text]
    if not other:
        return ()
    return (
        f"setup.py and package.xml do not say the same of the package: {', '.join(other)}. "
        "Nothing compares the two, so you do.",
    )
