"""Page 05, set the entry points: two programs in setup.py, and what an entry point is made of."""

from __future__ import annotations

from typing import Any

from rosbeat.exercises.call_runs import Calls
from rosbeat.exercises.calls import diagnose_calls
from rosbeat.exercises.entries import diagnose_entries, diagnose_script, differences
from rosbeat.exercises.exercise import BLANK, Exercise, failed_by, not_attempted, passed
from rosbeat.exercises.page_05_scenarios import SCENARIOS
from rosbeat.exercises.scenarios import Workspace
from rosbeat.records import Outcome
from rosbeat.workspace.packages import Package

_PACKAGE = "sensor_simulator"
_PROGRAMS = ("temperature_publisher", "temperature_subscriber")


def _judge_setup(seen: Workspace) -> Outcome:
    package = seen.packages.get(_PACKAGE)
    if package is None:
        return not_attempted("05a", f"There is no package {_PACKAGE} in src yet.")
    found = diagnose_script(package.setup)
    if found:
        return failed_by("05a", found)
    if _is_untouched(package):
        return not_attempted("05a", "setup.py has no entry points yet.")
    found = diagnose_entries(package, _PROGRAMS)
    if found:
        return failed_by("05a", found)
    said = f"setup.py names {' and '.join(_PROGRAMS)}."
    return passed("05a", said, *differences(package))


def _is_untouched(package: Package) -> bool:
    entries = package.setup.entry_points
    return not package.setup.incomplete and all(BLANK in one.text for one in entries)


def _judge_calls(seen: Calls) -> Outcome:
    if f"'{BLANK}'" in seen.problem:
        return not_attempted("05b")
    found = diagnose_calls(seen)
    return (
        failed_by("05b", found) if found else passed("05b", f"For example {seen.results[0][1]!r}.")
    )


EXERCISES: tuple[Exercise[Any], ...] = (
    Exercise(
        "05a",
        SCENARIOS["05a"],
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
        SCENARIOS["05b"],
        _judge_calls,
        title="write entry points",
        points=1,
        hints=(
            "The function gives back one text, made of what it was given.",
            "An f before the first quote fills in what stands between braces.",
            "Four values are to be filled in, and three signs stand between them, as in the table "
            "above.",
        ),
    ),
)
