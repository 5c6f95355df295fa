"""What Ctrl+C leaves on the screen (mistake 29)."""

from __future__ import annotations

from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.workspace.meanings.running import last_error
from rosbeat.workspace.meanings.situation import Situation

_MEND = "except (KeyboardInterrupt, ExternalShutdownException):"
_CAUSES = {
    "ExternalShutdownException": "ROS was shut down while the node was spinning",
    "KeyboardInterrupt": "Ctrl+C ended the node in the middle of its work",
}


def ended_twice(seen: Situation) -> Diagnosis | None:
    """`rclpy.shutdown()` after Ctrl+C has shut ROS down."""
    if not seen.code or "rcl_shutdown already called" not in last_error(seen.traceback):
        return None
    return Diagnosis(
        "ctrl-c-traceback",
        "Ctrl+C has shut ROS down already when `main` calls `rclpy.shutdown()`, and a second time "
        "is an error.",
        "The node did its work; only its end is untidy. "
        "Write `rclpy.try_shutdown()` in `main` instead.",
    )


def not_caught(seen: Situation) -> Diagnosis | None:
    """A `main` that catches the end of ROS not at all, or only in one of its two forms."""
    last = last_error(seen.traceback)
    cause = _CAUSES.get(last.split(":")[0].split(".")[-1])
    if not cause or not seen.code or not seen.about_ros:
        return None
    if "in __init__" in seen.traceback:
        return _while_starting()
    return Diagnosis(
        "ctrl-c-traceback",
        f"{cause}, and `main` does not expect that, so Python shows a traceback.",
        f"Nothing is broken. Put `rclpy.spin(node)` into `try:`, and below it  {_MEND} pass",
    )


def _while_starting() -> Diagnosis:
    return Diagnosis(
        "ctrl-c-traceback",
        "Ctrl+C came while the node was still starting, before `main` could catch it.",
        "Nothing is broken: start it again, and wait for its first line.",
    )
