"""What is worth knowing about a system that works: slips of the tutorial that are in it, too."""

from __future__ import annotations

from collections.abc import Iterator

from rosbeat.exercises.sources import Source
from rosbeat.exercises.system_run import MONITOR, SENSOR, SystemRun
from rosbeat.records import ProgramRun

_MISSPELT = "TemperaturSensor"
#: How the tutorial's own `main` ends after Ctrl+C, where the signal has shut ROS down already.
_ENDINGS = ("rcl_shutdown already called", "ExternalShutdownException")


def ends_by_the_tutorial(run: ProgramRun) -> bool:
    """Whether a program ends with the traceback that the tutorial's own `main` ends with."""
    return run.exit_code is not None and any(sign in run.output for sign in _ENDINGS)


def remarks_on(seen: SystemRun) -> tuple[str, ...]:
    """The slips of the tutorial that are in a system."""
    return tuple(_remarks(seen))


def _remarks(seen: SystemRun) -> Iterator[str]:
    runs = [run for run in (seen.sensor, seen.monitor) if run is not None]
    for run in runs:
        if ends_by_the_tutorial(run):
            yield (
                f"After Ctrl+C, {run.program} prints a traceback: ROS has shut down already. "
                "rclpy.try_shutdown() instead of rclpy.shutdown(), and ExternalShutdownException "
                "beside KeyboardInterrupt, end it quietly."
            )
    for source in seen.sources:
        yield from _slips(source)


def _slips(source: Source) -> Iterator[str]:
    if _MISSPELT in source.classes:
        yield f"The class {_MISSPELT} is spelled TemperatureSensor elsewhere in the tutorial."
    if source.module == SENSOR and 10.2 in source.numbers:
        yield "The lower limit is 10.2, as the tutorial has it; 18.0 was probably meant."
    tidies = {"destroy_node", "shutdown", "try_shutdown"} & set(source.ends)
    if source.module == MONITOR and source.ends and not tidies:
        yield f"main in {MONITOR} leaves its node and ROS as they are; the sensor tidies up."
