"""The whole system: both programs of the tutorial, built, run, and ended with Ctrl+C.

The package is built with colcon and its programs are started with `ros2 run`, as a learner would.
It is copied into an empty workspace; the learner's own files are only read. The monitor comes first
and is told some numbers; then comes the sensor, and both the monitor and a probe hear it.
"""

from __future__ import annotations

import re
import shutil
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import ExitStack
from dataclasses import dataclass, replace
from itertools import pairwise
from math import inf, nextafter
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from rosbeat.diagnosis.mistakes import UNKNOWN, Diagnosis
from rosbeat.diagnosis.programs import diagnose_output
from rosbeat.exercises.exercise import Exercise, Verdict, not_attempted, passed
from rosbeat.exercises.model import STATUSES, Mismatch, Track, diagnose, status_of, variants
from rosbeat.exercises.scenarios import Answer, CommandMeaning, look_at_workspace, meaning_of
from rosbeat.exercises.workspace_model import diagnose_entries, diagnose_script, diagnosis_of
from rosbeat.records import Endpoint, LogRecord, ProgramRun
from rosbeat.ros.programs import (
    DomainProbe,
    Program,
    domain_probe,
    private_domain,
    program_environment,
)
from rosbeat.viz.text_format import count
from rosbeat.workspace.busy_notice import step
from rosbeat.workspace.packages import Package

if TYPE_CHECKING:
    from rosbeat.viz import Picture

ID = "system"
PACKAGE = "sensor_simulator"
SENSOR, MONITOR = "temperature_publisher", "temperature_subscriber"
TOPIC = "temperature"

# The scenario.

#: What the monitor is told: each side of both limits, the limits, and beyond them.
TOLD = (26.0, 20.0, 26.5, 19.5, 35.25, -3.5, 22.75)
_READINGS = 5
# Seconds of wall time, for a busy machine; usually it takes a tenth of each.
_TO_BUILD, _TO_MEET, _TO_ANSWER, _TO_READ = 90.0, 20.0, 2.0, 20.0
_TO_HEAR_THE_LAST = 0.5
#: A number for the first answer, and seconds for it: the monitor may still be starting.
_FIRST_TOLD, _TO_START = 23.5, 6.0


@dataclass(frozen=True)
class SystemRun:
    """Record what became of a package, from its source to the end of its programs.

    Attributes:
        package: The package in the learner's workspace, or None.
        place: Where it lies, if that is not `src`.
        has_programs: Whether one of its two programs is there.
        build_code: Exit code of `colcon build`; None if it was not built.
        build_output: What that printed.
        meaning: What the first failure means, if its command is known to fail like this.
        sensor: The sensor's run, or None.
        monitor: The monitor's run, or None.
        met: Whether the monitor listens on the topic.
        answers: Each number that the monitor was told, and what it printed then.
        heard: When each reading of the sensor came, in seconds since the first, and the reading.
        publishers: What the sensor publishes.
        repeated: What the monitor printed while the sensor was there.
        sent: What the sensor logged, as it was read.
        taken: What the monitor logged meanwhile.
    """

    package: Package | None = None
    place: str = ""
    has_programs: bool = False
    build_code: int | None = None
    build_output: str = ""
    meaning: CommandMeaning | None = None
    sensor: ProgramRun | None = None
    monitor: ProgramRun | None = None
    met: bool = False
    answers: tuple[tuple[float, str], ...] = ()
    heard: tuple[tuple[float, float], ...] = ()
    publishers: tuple[Endpoint, ...] = ()
    repeated: str = ""
    sent: tuple[LogRecord, ...] = ()
    taken: tuple[LogRecord, ...] = ()


def run_system(answer: Answer) -> SystemRun:
    """Build the package and run its two programs.

    Args:
        answer: The folder of the workspace; `workspace.folder()` on a page.

    Raises:
        ExerciseError: If that is no folder.
        KeyboardInterrupt: If Interrupt was pressed; the programs are ended then, too.
    """
    seen = look_at_workspace(answer)
    package = seen.packages.get(PACKAGE)
    if package is None:
        return SystemRun()
    folder = Path(answer) / package.folder
    programs = (folder / PACKAGE / f"{name}.py" for name in (SENSOR, MONITOR))
    found = SystemRun(package, seen.place_of(PACKAGE), any(one.is_file() for one in programs))
    entries = {one.executable for one in package.setup.entry_points}
    missing = not {SENSOR, MONITOR} <= entries and not package.setup.incomplete
    # A look is enough where there is nothing to build, or it cannot be built.
    unfit = found.place or package.manifest.build_type != "ament_python" or not package.has_init
    if unfit or package.setup.problem or package.flaws or missing:
        return found
    with TemporaryDirectory(prefix="rosbeat-") as place, private_domain() as domain_id:
        return _build_and_run(found, folder, Path(place), domain_id)


def _build_and_run(found: SystemRun, folder: Path, place: Path, domain_id: int) -> SystemRun:
    root, home = place / "workspace", place / "home"
    home.mkdir()
    ignored = shutil.ignore_patterns("__pycache__", ".git", "build", "install", "log")
    shutil.copytree(folder, root / "src" / PACKAGE, symlinks=True, ignore=ignored)
    environ = program_environment(home, domain_id)
    command = ("colcon", "build", "--packages-select", PACKAGE)
    step("building the package with colcon")
    with Program(command, environ, root) as building:
        building.wait(lambda _: False, _TO_BUILD)
        built = building.finish()
    found = replace(found, build_code=built.exit_code, build_output=built.output)
    if built.exit_code != 0:
        code = -1 if built.exit_code is None else built.exit_code
        meaning = meaning_of(" ".join(command), built.output, code, root, root)
        return replace(found, meaning=meaning)

    def start(name: str) -> Program:
        line = f"source install/setup.bash && exec ros2 run {PACKAGE} {name}"
        return Program(("bash", "-c", line), environ, root, name)

    found = _run_both(found, start, domain_id)
    for run in (found.monitor, found.sensor):
        if run is not None and run.ended_early:
            line, code = f"ros2 run {PACKAGE} {run.program}", run.exit_code or 0
            return replace(found, meaning=meaning_of(line, run.output, code, root, root))
    return found


def _run_both(found: SystemRun, start: Callable[[str], Program], domain_id: int) -> SystemRun:
    """Run both programs from their start to their end, and add what they did."""
    with ExitStack() as stack:
        step(f"starting {MONITOR}, and waiting until it listens")
        monitor = stack.enter_context(start(MONITOR))
        probe = stack.enter_context(domain_probe(domain_id, TOPIC))
        probe.wait(lambda: probe.has_subscriber() or not monitor.running, _TO_MEET)
        met = probe.has_subscriber()
        step("telling it readings, and waiting for what it says to each")
        if met:
            _wait_for_first_answer(probe, monitor)
        answers = tuple((value, _tell(probe, monitor, value)) for value in TOLD if met)
        probe.clear()
        said = len(monitor.output)
        step(f"starting {SENSOR}, and listening to {_READINGS} readings")
        sensor = stack.enter_context(start(SENSOR))
        publishers = _listen(probe, sensor)
        # The last reading may still be on its way to the monitor.
        heard = len(probe.received)
        monitor.wait(lambda output: output.count("\n", said) >= heard, _TO_HEAR_THE_LAST)
        repeated = monitor.output[said:]
        sent, taken = sensor.logs(), monitor.logs(said)
        step("ending both programs with Ctrl+C")
        return replace(
            found, met=met, answers=answers, heard=probe.received, publishers=publishers,
            repeated=repeated, sent=sent, taken=taken, sensor=sensor.finish(),
            monitor=monitor.finish(),
        )  # fmt: skip


def _wait_for_first_answer(probe: DomainProbe, monitor: Program) -> None:
    """Wait until the monitor has answered a number once.

    It listens before its constructor has ended, so what it prints first is no answer yet. A
    monitor that does not repeat the number is given the time all the same.
    """
    sign = re.compile(rf"(?<![\d.]){_FIRST_TOLD:g}(?:[.]\d+)?(?!\d).*\n")
    before = len(monitor.output)
    probe.publish(_FIRST_TOLD)
    monitor.wait(lambda output: bool(sign.search(output, before)), _TO_START)


def _tell(probe: DomainProbe, monitor: Program, value: float) -> str:
    """Publish a number, and return what the monitor prints then."""
    before = len(monitor.output)
    probe.publish(value)
    monitor.wait(lambda output: "\n" in output[before:], _TO_ANSWER)
    return monitor.output[before:]


def _listen(probe: DomainProbe, sensor: Program) -> tuple[Endpoint, ...]:
    """Wait for some readings, and return what the sensor publishes."""
    probe.wait(lambda: probe.publishers() or not sensor.running, _TO_READ)
    topics = [end.name for end in probe.publishers()]
    if f"/{TOPIC}" in topics or not topics:
        probe.wait(lambda: len(probe.received) >= _READINGS or not sensor.running, _TO_READ)
    return probe.publishers()


# The judge. Its parts follow the system from its package to its end; the first mistake counts.

_FLOAT = "std_msgs/msg/Float32"
#: Two decimals are logged; a float32 has about seven digits.
_ROUNDING = 0.0051
#: Seconds between two readings, on a machine that may be busy.
_BEAT = (0.7, 1.4)
#: How the tutorial's own `main` ends after Ctrl+C, where the signal has shut ROS down already.
_ENDINGS = ("rcl_shutdown already called", "ExternalShutdownException")


def _judge(seen: SystemRun) -> Verdict:
    package = seen.package
    if package is None:
        return not_attempted(f"There is no package {PACKAGE} in src yet.")
    if not seen.has_programs and not package.setup.entry_points:
        return not_attempted(f"The package {PACKAGE} has no programs yet.")
    wrong = (
        _diagnose_package(seen, package) or _diagnose_build(seen) or _diagnose_start(seen)
        or _diagnose_monitor(seen) or _diagnose_sensor(seen) or _diagnose_crossing(seen)
        or next(filter(None, map(_diagnose_end, _runs(seen))), None)
    )  # fmt: skip
    return wrong or passed(_praise(seen), *_remarks(seen))


@dataclass(frozen=True)
class Built:
    """Hold what somebody has built, by the names and numbers of a run that has passed.

    Attributes:
        sensor: The node that publishes.
        monitor: The node that subscribes.
        crossed: How many readings came from the one process to the other.
    """

    sensor: str
    monitor: str
    crossed: int


def built(seen: SystemRun) -> Built:
    """Return what somebody has built; nodes that logged nothing go by their programs' names."""
    crossed = [one for one in seen.taken if _words(one.text)]
    printed = [line for line in seen.repeated.splitlines() if _words(line)]
    return Built(
        next((one.name for one in seen.sent), SENSOR),
        next((one.name for one in crossed), MONITOR),
        len(crossed or printed),
    )


def _praise(seen: SystemRun) -> str:
    found = built(seen)
    return (
        f"You have built a robot system, and it works: your node {found.sensor} published on "
        f"/{TOPIC}, and your node {found.monitor}, in another process, received "
        f"{count(found.crossed, 'reading')} and judged each of them."
    )


def _runs(seen: SystemRun) -> list[ProgramRun]:
    return [run for run in (seen.sensor, seen.monitor) if run is not None]


def _diagnose_package(seen: SystemRun, package: Package) -> Diagnosis | None:
    kind = package.manifest.build_type
    if seen.place:
        said = f"The package {PACKAGE} lies in {seen.place}."
        return Diagnosis("wrong-folder", said, "A workspace keeps its packages in src.")
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
    return diagnose_script(package) or diagnose_entries(package, (SENSOR, MONITOR))


def _diagnose_build(seen: SystemRun) -> Diagnosis | None:
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


def _diagnose_start(seen: SystemRun) -> Diagnosis | None:
    early = next((run for run in reversed(_runs(seen)) if run.ended_early), None)
    if early is None:
        return None
    return diagnosis_of(seen.meaning) or diagnose_output(early.output) or Diagnosis(
        UNKNOWN,
        f"{early.program} ended by itself, with exit code {early.exit_code}: "
        f"{_last_line(early.output)}",
        f"Start it with ros2 run {PACKAGE} {early.program} and read what it prints. A node runs "
        "until Ctrl+C: does main call rclpy.spin?",
    )  # fmt: skip


def _last_line(text: str) -> str:
    lines = [line.strip() for line in text.splitlines() if line.strip()]
    lines = [line for line in lines if not line.startswith("[ros2run]")] or ["it said nothing"]
    return lines[-1]


# The monitor, by models of what it says to each reading.


def _words(text: str) -> tuple[str, ...]:
    """Return the statuses that a text names."""
    return tuple(word for word in STATUSES if re.search(rf"\b{word}\b", text, re.IGNORECASE))


def _monitor(
    values: Iterable[float],
    low: float = 20.0,
    high: float = 26.0,
    instead: Mapping[str, str] = MappingProxyType({}),
) -> Track:
    """Return what a monitor with these limits says to each reading, or other words instead."""
    said = ((value, status_of(value, low, high)) for value in values)
    return {value: (instead.get(word, word),) for value, word in said}


_AT_LIMIT = "is Normal: above 26 is High, below 20 is Low."
_UNDER_26, _OVER_20 = nextafter(26.0, 0.0), nextafter(20.0, inf)
_SUSPECTS = variants(_monitor, (
    ("boundary", f"Exactly 26 {_AT_LIMIT}", {"high": _UNDER_26}),
    ("boundary", f"Exactly 20 {_AT_LIMIT}", {"low": _OVER_20}),
    ("boundary", f"Exactly 26 or 20 {_AT_LIMIT}", {"low": _OVER_20, "high": _UNDER_26}),
    ("wrong-state", "High and Low are swapped: compare `<` and `>` in both conditions.",
     {"instead": {"High": "Low", "Low": "High"}}),
    ("wrong-state", "A reading above 26 is not High: does an earlier condition catch it?",
     {"high": inf}),
    ("wrong-state", "A reading below 20 is not Low: does an earlier condition catch it?",
     {"low": -inf}),
))  # fmt: skip


def _diagnose_monitor(seen: SystemRun) -> Diagnosis | None:
    if not seen.met:
        return Diagnosis(
            "no-subscription",
            f"{MONITOR} runs, and does not listen on /{TOPIC} for messages of {_FLOAT}.",
            "Compare the topic's name and the message type in create_subscription.",
        )
    silent = next((value for value, text in seen.answers if not text.strip()), None)
    if silent is not None:
        said = f"{MONITOR} got a reading of {silent:g} and printed nothing."
        return Diagnosis("nothing-logged", said, "End the callback with self.get_logger().info.")
    return _diagnose_statuses({value: _words(text) for value, text in seen.answers})


def _diagnose_statuses(done: Track) -> Diagnosis | None:
    """Return what is wrong with the statuses that a monitor gave to readings."""
    return diagnose(tuple(done), done, _monitor(done), _SUSPECTS, _other_status)


def _other_status(mismatch: Mismatch) -> Diagnosis:
    said = " and ".join(mismatch.done) or "no status"
    return Diagnosis(
        "wrong-state",
        f"For a reading of {mismatch.at:g}, {MONITOR} said {said}.",
        f"Which of your conditions is true for {mismatch.at:g}?",
    )


# The sensor.


def _diagnose_sensor(seen: SystemRun) -> Diagnosis | None:
    values = [value for _, value in seen.heard]
    if len(values) < 2:
        return _diagnose_silence(seen)
    pauses = [later - sooner for (sooner, _), (later, _) in pairwise(seen.heard)]
    beat = median(pauses)
    if not _BEAT[0] <= beat <= _BEAT[1]:
        return Diagnosis(
            "wrong-rate",
            f"A reading came every {beat:.2g} seconds.",
            "One a second is wanted: the first argument of create_timer is the time between two.",
        )
    return _diagnose_walk(values)


def _diagnose_silence(seen: SystemRun) -> Diagnosis:
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


def _diagnose_walk(values: Sequence[float]) -> Diagnosis | None:
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


def _diagnose_crossing(seen: SystemRun) -> Diagnosis | None:
    """Return what is wrong with what the monitor said to the sensor, where it names numbers."""
    lines = [line for line in seen.repeated.splitlines() if _words(line) and _numbers(line)]
    pairs = [(_reading(line, seen), line) for line in lines]
    strange = next((line for value, line in pairs if value is None), None)
    if strange is None:
        return _diagnose_statuses({value: _words(line) for value, line in pairs})
    return Diagnosis(
        "wrong-values",
        f"{MONITOR} said {strange.strip()!r}, and no such reading was published.",
        "Does it log the number in the message, as it came?",
    )


def _numbers(line: str) -> list[str]:
    return re.findall(r"-?\d+(?:\.\d+)?", line.rpartition("]: ")[2])


def _reading(line: str, seen: SystemRun) -> float | None:
    """Return the reading that a line is about: one of its numbers, rounded as it is written."""
    for text in _numbers(line):
        digits = len(text.partition(".")[2])
        for _, value in seen.heard:
            if abs(float(text) - value) <= 0.51 * 10.0**-digits:
                return value
    return None


def _diagnose_end(run: ProgramRun) -> Diagnosis | None:
    if run.exit_code == 0 or _ends_by_the_tutorial(run):
        return None
    if run.exit_code is None:
        said = f"{run.program} did not end within five seconds of Ctrl+C."
        hint = "main should end when rclpy.spin is interrupted."
        return Diagnosis("ctrl-c-traceback", said, hint)
    return Diagnosis(
        "ctrl-c-traceback",
        f"After Ctrl+C, {run.program} ended with exit code {run.exit_code}: "
        f"{_last_line(run.output)}",
        "Catch KeyboardInterrupt around rclpy.spin, and tidy up after it.",
    )


def _ends_by_the_tutorial(run: ProgramRun) -> bool:
    """Return whether a program ends with the traceback that the tutorial's own `main` has."""
    return run.exit_code is not None and any(sign in run.output for sign in _ENDINGS)


def _remarks(seen: SystemRun) -> Iterator[str]:
    """Generate a remark on each program that ends with the tutorial's traceback."""
    for run in _runs(seen):
        if _ends_by_the_tutorial(run):
            yield (
                f"After Ctrl+C, {run.program} prints a traceback: ROS has shut down already. "
                "rclpy.try_shutdown() instead of rclpy.shutdown(), and ExternalShutdownException "
                "beside KeyboardInterrupt, end it quietly."
            )


# The picture.


def _draw(seen: SystemRun) -> Picture | None:
    """Return which readings crossed between the two programs; None if none was logged."""
    # Drawing loads matplotlib, which grading does without.
    from rosbeat.viz.message_flows import first_number, message_flow

    if not any(first_number(one.text) for one in seen.sent):
        return None
    return message_flow(seen.sent, seen.taken)


EXERCISES: tuple[Exercise[Any], ...] = (
    Exercise(ID, run_system, _judge, picture=_draw, title="the whole system", points=5, hints=(
        "The check does what page 06 does: it builds the package and runs both programs.",
        "Do the same in two terminals, and look at what they print, line by line.",
        "End each program with Ctrl+C, and type echo $? then: a clean end is 0.",
    )),
)  # fmt: skip
