"""Page 05, set the entry points: write the entries of a setup.py, and repair those of another."""

from __future__ import annotations

from functools import partial
from typing import Any

from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.exercises.exercise import BLANK, NOT_SAVED, Exercise, Verdict, not_attempted, passed
from rosbeat.exercises.scenarios import Workspace, look_at_workspace
from rosbeat.exercises.workspace_model import (
    diagnose_entries,
    diagnose_script,
    remarks_on_strays,
)
from rosbeat.workspace.packages import Package

# A setup.py is read and never run, so nothing is drawn.


def _judge_setup(seen: Workspace, name: str, programs: tuple[str, str]) -> Verdict:
    """Judge the build script of a package.

    Args:
        seen: The workspace.
        name: The name of the package.
        programs: Its executables, each like its module, with `main` in it.
    """
    package = seen.packages.get(name)
    if package is None:
        return not_attempted(f"There is no package {name} in src yet.")
    found = diagnose_script(package)
    entries = package.setup.entry_points
    if not found and not package.setup.incomplete and all(BLANK in one.text for one in entries):
        return not_attempted(f"setup.py has no entry points yet. {NOT_SAVED}")
    found = found or diagnose_entries(package, programs) or _diagnose_data_files(package)
    if found:
        return found
    said = f"setup.py names {' and '.join(programs)}."
    return passed(said, *_remarks_on_texts(package), *remarks_on_strays(seen.strays))


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


EXERCISES: tuple[Exercise[Any], ...] = (
    Exercise("05a", look_at_workspace,
        partial(_judge_setup, name="sensor_simulator",
                programs=("temperature_publisher", "temperature_subscriber")),
        title="two programs", points=2, hints=(
        "Each program needs one string in the list of console scripts.",
        "An entry consists of the name that you type after `ros2 run` and the package, an "
        "equals sign, and the place of the code.",
        "The place of the code is: the package, a dot, the file without .py, a colon, the "
        "function.",
        "Two entries are two strings: put quotes around each, and a comma after each.",
    )),
    Exercise("05b", look_at_workspace,
        partial(_judge_setup, name="lamp_control", programs=("lamp", "switch")),
        title="repair a setup.py", hints=(
        "Hold each entry against the form executable = package.module:function, from left to "
        "right, one character at a time.",
        "Read the sections on what went wrong above once more: each of the four mistakes is "
        "mentioned on this page.",
    )),
)  # fmt: skip
