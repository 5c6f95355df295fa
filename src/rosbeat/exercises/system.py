"""The whole system: both programs of the tutorial, built, run, and ended with Ctrl+C."""

from __future__ import annotations

import re
from collections.abc import Sequence
from itertools import pairwise
from statistics import median
from typing import Any

from rosbeat.diagnosis.mistakes import UNKNOWN, Diagnosis
from rosbeat.diagnosis.programs import diagnose_output
from rosbeat.exercises.entries import diagnose_entries, diagnose_script
from rosbeat.exercises.exercise import Exercise, failed_by, not_attempted, passed
from rosbeat.exercises.meanings import diagnosis_of
from rosbeat.exercises.system_remarks import ends_by_the_tutorial, remarks_on
from rosbeat.exercises.system_run import MONITOR, PACKAGE, SENSOR, TOPIC, SystemRun, run_system
from rosbeat.records import Outcome, ProgramRun

ID = "system"
_FLOAT = "std_msgs/msg/Float32"
_WORDS = ("High", "Low", "Normal")
_NUMBER = re.compile(r"-?\d+(?:\.\d+)?")
#: Two decimals are logged; a float32 has about seven digits.
_ROUNDING = 0.0051
#: Seconds between two readings, on a machine that may be busy.
_BEAT = (0.7, 1.4)


def _judge(seen: SystemRun) -> Outcome:
    if seen.package is None:
        return not_attempted(ID, f"There is no package {PACKAGE} in src yet.")
    if not any(one.ends for one in seen.sources) and not seen.package.setup.entry_points:
        return not_attempted(ID, f"The package {PACKAGE} has no programs yet.")
    wrong = (
        _package(seen) or _build(seen) or _start(seen) or _monitor(seen) or _sensor(seen)
        or _crossing(seen) or _endings(seen)
    )  # fmt: skip
    if wrong:
        return failed_by(ID, wrong)
    return passed(
        ID,
        f"{PACKAGE} was built, and both programs ran: {len(seen.heard)} readings crossed, with "
        "the right status each.",
        *remarks_on(seen),
    )


# The package and its build.


def _package(seen: SystemRun) -> Diagnosis | None:
    package = seen.package
    assert package is not None
    if seen.place:
        return Diagnosis(
            "wrong-folder",
            f"The package {PACKAGE} lies in {seen.place}.",
            "A workspace keeps its packages in src.",
        )
    kind = package.manifest.build_type
    if kind != "ament_python":
        return Diagnosis(
            "build-type",
            f"package.xml gives the build type {kind or '(none)'}.",
            "Nodes in Python need a package of the type ament_python; page 02 makes one.",
        )
    if not package.has_init or not package.has_marker:
        gone = f"{PACKAGE}/__init__.py" if not package.has_init else f"resource/{PACKAGE}"
        return Diagnosis(
            "marker-missing", f"{gone} is gone.", "It is an empty file: make it again with touch."
        )
    return diagnose_script(package.setup) or diagnose_entries(package, (SENSOR, MONITOR))


def _build(seen: SystemRun) -> Diagnosis | None:
    if seen.build_code == 0:
        return None
    said = f"ended with {seen.build_code}"
    if seen.build_code is None:
        said = "took too long" if seen.build_output else "was not even tried, as the package is"
    return diagnosis_of(seen.meaning) or Diagnosis(
        UNKNOWN,
        f"colcon build {said}: {_last_line(seen.build_output)}",
        "Run colcon build in a terminal, and read the first error that it prints.",
    )


def _start(seen: SystemRun) -> Diagnosis | None:
    for run in (seen.monitor, seen.sensor):
        if run is not None and run.ended_early:
            return diagnosis_of(seen.meaning) or diagnose_output(run.output) or _ended(run)
    return None


def _ended(run: ProgramRun) -> Diagnosis:
    return Diagnosis(
        UNKNOWN,
        f"{run.program} ended by itself, with exit code {run.exit_code}: {_last_line(run.output)}",
        f"Start it with ros2 run {PACKAGE} {run.program} and read what it prints. A node runs "
        "until Ctrl+C: does main call rclpy.spin?",
    )


def _last_line(text: str) -> str:
    lines = [line.strip() for line in text.splitlines() if line.strip()]
    lines = [line for line in lines if not line.startswith("[ros2run]")] or ["it said nothing"]
    return lines[-1]


# The monitor.


def _monitor(seen: SystemRun) -> Diagnosis | None:
    if not seen.met:
        return Diagnosis(
            "no-subscription",
            f"{MONITOR} runs, and does not listen on /{TOPIC} for messages of {_FLOAT}.",
            "Compare the topic's name and the message type in create_subscription.",
        )
    for value, text in seen.answers:
        wrong = _status(value, text)
        if wrong:
            return wrong
    return None


def _status(value: float, text: str) -> Diagnosis | None:
    wanted = "High" if value > 26.0 else "Low" if value < 20.0 else "Normal"
    found = _words(text)
    if found == [wanted]:
        return None
    if not text.strip():
        said = f"{MONITOR} got a reading of {value:g} and printed nothing."
        return Diagnosis("nothing-logged", said, "End the callback with self.get_logger().info.")
    said = f"For a reading of {value:g}, {MONITOR} said {' and '.join(found) or 'no status'}."
    if value in (26.0, 20.0):
        hint = f"Exactly {value:g} is Normal: above 26 is High, below 20 is Low."
        return Diagnosis("boundary", said, hint)
    return Diagnosis("wrong-state", said, f"Which of your conditions is true for {value:g}?")


def _words(text: str) -> list[str]:
    return [word for word in _WORDS if re.search(rf"\b{word}\b", text, re.IGNORECASE)]


# The sensor.


def _sensor(seen: SystemRun) -> Diagnosis | None:
    values = [value for _, value in seen.heard]
    if len(values) < 2:
        return _silent(seen)
    pauses = [later - sooner for (sooner, _), (later, _) in pairwise(seen.heard)]
    beat = median(pauses)
    if not _BEAT[0] <= beat <= _BEAT[1]:
        return Diagnosis(
            "wrong-rate",
            f"A reading came every {beat:.2g} seconds.",
            "One a second is wanted: the first argument of create_timer is the time between two.",
        )
    return _walk(values)


def _silent(seen: SystemRun) -> Diagnosis:
    others = sorted({end.name for end in seen.publishers} - {f"/{TOPIC}"})
    kinds = sorted({end.type_name for end in seen.publishers if end.name == f"/{TOPIC}"})
    if others and not kinds:
        said = f"{SENSOR} publishes on {', '.join(others)}, and nothing on /{TOPIC}."
        return Diagnosis("topic-misspelled", said, f"The topic is called {TOPIC}, exactly so.")
    if kinds and kinds != [_FLOAT]:
        said = f"{SENSOR} publishes {', '.join(kinds)} on /{TOPIC}, and {MONITOR} wants {_FLOAT}."
        return Diagnosis("type-mismatch", said, "Both sides of a topic must use the same type.")
    if kinds:
        said = f"{SENSOR} has a publisher on /{TOPIC}, and hardly anything came."
        return Diagnosis("never-published", said, "Does a timer call publish, again and again?")
    said = f"{SENSOR} runs and has no publisher."
    return Diagnosis("no-publisher", said, "self.create_publisher makes one, in __init__.")


def _walk(values: Sequence[float]) -> Diagnosis | None:
    shown = ", ".join(f"{value:.2f}" for value in values)
    if min(values) < 10.2 - _ROUNDING or max(values) > 28.0 + _ROUNDING:
        hint = "It stays between two limits: max and min cut off what is beyond."
        return Diagnosis("no-clamp", f"The readings were {shown}.", hint)
    if max(abs(b - a) for a, b in pairwise((22.0, *values))) > 0.5 + _ROUNDING:
        hint = "It starts at 22.0, and each step is at most 0.5 up or down."
        return Diagnosis("step-too-wide", f"The readings were {shown}.", hint)
    if len(set(values)) == 1:
        hint = "Each call must add a random number to self.temperature."
        return Diagnosis("never-changes", f"The readings were {shown}.", hint)
    return None


# What crossed, and the ends.


def _crossing(seen: SystemRun) -> Diagnosis | None:
    """What the monitor said to the sensor's readings, as far as it names numbers."""
    lines = [line for line in seen.repeated.splitlines() if _words(line) and _value(line)]
    pairs = [(_reading(line, seen), line) for line in lines]
    strange = next((line for value, line in pairs if value is None), None)
    if strange:
        return Diagnosis(
            "wrong-values",
            f"{MONITOR} said {strange.strip()!r}, and no such reading was published.",
            "Does it log the number in the message, as it came?",
        )
    known = [(value, line) for value, line in pairs if value is not None]
    return next((wrong for value, line in known if (wrong := _status(value, line))), None)


def _value(line: str) -> list[str]:
    return _NUMBER.findall(line.rpartition("]: ")[2])


def _reading(line: str, seen: SystemRun) -> float | None:
    """The reading that a line is about: one of its numbers, rounded as it is written."""
    for text in _value(line):
        digits = len(text.partition(".")[2])
        for _, value in seen.heard:
            if abs(float(text) - value) <= 0.51 * 10.0**-digits:
                return value
    return None


def _endings(seen: SystemRun) -> Diagnosis | None:
    runs = [run for run in (seen.sensor, seen.monitor) if run is not None]
    return next((wrong for run in runs if (wrong := _ending(run))), None)


def _ending(run: ProgramRun) -> Diagnosis | None:
    if run.exit_code == 0 or ends_by_the_tutorial(run):
        return None
    if run.exit_code is None:
        said = f"{run.program} did not end within five seconds of Ctrl+C."
        return Diagnosis(
            "ctrl-c-traceback", said, "main should end when rclpy.spin is interrupted."
        )
    return Diagnosis(
        "ctrl-c-traceback",
        f"After Ctrl+C, {run.program} ended with exit code {run.exit_code}: "
        f"{_last_line(run.output)}",
        "Catch KeyboardInterrupt around rclpy.spin, and tidy up after it.",
    )


EXERCISES: tuple[Exercise[Any], ...] = (
    Exercise(
        ID,
        run_system,
        _judge,
        title="the whole system",
        points=5,
        hints=(
            "The check does what page 06 does: it builds the package and runs both programs.",
            "Do the same in two terminals, and look at what they print, line by line.",
            "End each program with Ctrl+C, and type echo $? then: a clean end is 0.",
        ),
    ),
)
