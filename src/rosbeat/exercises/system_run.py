"""The whole tutorial, run as a learner would: built with colcon, started with `ros2 run`, ended.

The package is copied into an empty workspace; the learner's own files are only read. The monitor
comes first and is told some numbers; then comes the sensor, and both the monitor and we hear it.
"""

from __future__ import annotations

import re
import shutil
from contextlib import ExitStack
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from rosbeat.exercises.scenarios import CommandMeaning, look_at_workspace, meaning_of
from rosbeat.exercises.sources import Source, read_source
from rosbeat.records import Endpoint, ProgramRun
from rosbeat.ros.programs import (
    DomainProbe,
    Program,
    domain_probe,
    private_domain,
    program_environment,
)
from rosbeat.workspace.packages import Package

PACKAGE = "sensor_simulator"
SENSOR, MONITOR = "temperature_publisher", "temperature_subscriber"
TOPIC = "temperature"
#: What the monitor is told: each side of both limits, the limits, and beyond them.
TOLD = (26.0, 20.0, 26.5, 19.5, 35.25, -3.5, 22.75)
_READINGS = 5
# Seconds of wall time, for a busy machine; usually it takes a tenth of each.
_TO_BUILD, _TO_MEET, _TO_ANSWER, _TO_READ = 90.0, 20.0, 2.0, 20.0
#: A number to knock with, and seconds for the first answer: the monitor may still be starting.
_KNOCK, _TO_KNOCK = 23.5, 6.0


@dataclass(frozen=True)
class SystemRun:
    """What became of a package, from its source to the end of its programs.

    Attributes:
        package: The package in the learner's workspace, or None.
        place: Where it lies, if that is not `src`.
        sources: Its two programs.
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
    """

    package: Package | None = None
    place: str = ""
    sources: tuple[Source, ...] = ()
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


def run_system(answer: Any) -> SystemRun:  # noqa: ANN401 - whatever a learner hands over
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
    modules = (read_source(folder / PACKAGE / f"{name}.py") for name in (SENSOR, MONITOR))
    found = SystemRun(package, seen.place_of(PACKAGE), tuple(modules))
    return found if is_unfit(found) else _build_and_run(found, folder)


def is_unfit(seen: SystemRun) -> bool:
    """Whether a look is enough: there is nothing to build, or it cannot be built."""
    package = seen.package
    if package is None or seen.place or package.manifest.build_type != "ament_python":
        return True
    entries = {one.executable for one in package.setup.entry_points}
    missing = not {SENSOR, MONITOR} <= entries and not package.setup.incomplete
    return bool(package.setup.problem or package.flaws or missing or not package.has_init)


def _build_and_run(found: SystemRun, folder: Path) -> SystemRun:
    with TemporaryDirectory(prefix="rosbeat-") as place, private_domain() as domain_id:
        root, home = Path(place) / "workspace", Path(place) / "home"
        home.mkdir()
        ignored = shutil.ignore_patterns("__pycache__", ".git", "build", "install", "log")
        shutil.copytree(folder, root / "src" / PACKAGE, symlinks=True, ignore=ignored)
        environ = program_environment(home, domain_id)
        command = ("colcon", "build", "--packages-select", PACKAGE)
        with Program(command, environ, root) as building:
            building.wait(lambda _: False, _TO_BUILD)
            built = building.finish()
        found = replace(found, build_code=built.exit_code, build_output=built.output)
        if built.exit_code != 0:
            code = -1 if built.exit_code is None else built.exit_code
            meaning = meaning_of(" ".join(command), built.output, code, root, root)
            return replace(found, meaning=meaning)
        return _Play(root, environ, domain_id).perform(found)


class _Play:
    """Both programs, from their start to their end."""

    def __init__(self, root: Path, environ: dict[str, str], domain_id: int) -> None:
        self._root, self._environ, self._domain_id = root, environ, domain_id

    def perform(self, found: SystemRun) -> SystemRun:
        """Run them and add what they did."""
        with ExitStack() as stack:
            monitor = stack.enter_context(self._start(MONITOR))
            probe = stack.enter_context(domain_probe(self._domain_id, TOPIC))
            met = probe.wait(lambda: probe.has_subscriber() or not monitor.running, _TO_MEET)
            met = met and probe.has_subscriber()
            if met:
                _knock(probe, monitor)
            answers = tuple((value, _tell(probe, monitor, value)) for value in TOLD if met)
            probe.clear()
            said = len(monitor.output)
            sensor = stack.enter_context(self._start(SENSOR))
            publishers = _listen(probe, sensor)
            repeated = monitor.output[said:]
            found = replace(
                found, met=met, answers=answers, heard=probe.received, publishers=publishers,
                repeated=repeated, sensor=sensor.finish(), monitor=monitor.finish(),
            )  # fmt: skip
        return replace(found, meaning=self._meaning(found))

    def _start(self, name: str) -> Program:
        command = f"source install/setup.bash && exec ros2 run {PACKAGE} {name}"
        return Program(("bash", "-c", command), self._environ, self._root, name)

    def _meaning(self, found: SystemRun) -> CommandMeaning | None:
        """Why a program has ended by itself."""
        for run in (found.monitor, found.sensor):
            if run is not None and run.ended_early:
                command = f"ros2 run {PACKAGE} {run.program}"
                code = run.exit_code or 0
                return meaning_of(command, run.output, code, self._root, self._root)
        return None


def _knock(probe: DomainProbe, monitor: Program) -> None:
    """Wait until the monitor has answered a number once.

    It listens before its constructor has ended, so what it prints first is no answer yet. A
    monitor that does not repeat the number is given the time all the same.
    """
    sign = re.compile(rf"(?<![\d.]){_KNOCK:g}(?:[.]\d+)?(?!\d).*\n")
    before = len(monitor.output)
    probe.publish(_KNOCK)
    monitor.wait(lambda output: bool(sign.search(output, before)), _TO_KNOCK)


def _tell(probe: DomainProbe, monitor: Program, value: float) -> str:
    """Tell the monitor a number; what it prints then."""
    before = len(monitor.output)
    probe.publish(value)
    monitor.wait(lambda output: "\n" in output[before:], _TO_ANSWER)
    return monitor.output[before:]


def _listen(probe: DomainProbe, sensor: Program) -> tuple[Endpoint, ...]:
    """Wait for some readings; what the sensor publishes."""
    probe.wait(lambda: probe.publishers() or not sensor.running, _TO_READ)
    named = [end.name for end in probe.publishers()]
    if f"/{TOPIC}" in named or not named:
        probe.wait(lambda: len(probe.received) >= _READINGS or not sensor.running, _TO_READ)
    return probe.publishers()
