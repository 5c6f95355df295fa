"""What Ctrl+C leaves on the screen (mistake 29)."""

from __future__ import annotations

from rosbeat.workspace.meanings.situation import Situation

_MEND = "except (KeyboardInterrupt, ExternalShutdownException):"


def ended_twice(seen: Situation) -> str | None:
    """`rclpy.shutdown()` after Ctrl+C has shut ROS down."""
    if "rcl_shutdown already called" not in seen.text:
        return None
    return (
        "Ctrl+C has shut ROS down already when `main` calls `rclpy.shutdown()`, and a second time "
        "is an error. The node did its work; only its end is untidy. "
        "Write `rclpy.try_shutdown()` in `main` instead."
    )


def not_caught(seen: Situation) -> str | None:
    """A `main` that catches the end of ROS not at all, or only in one of its two forms."""
    lines = seen.text.splitlines()
    if "in __init__" in seen.text:
        return (
            "Ctrl+C came while the node was still starting, before `main` could catch it. Nothing "
            "is broken: start it again, and wait for its first line."
        )
    for name, cause in (
        ("ExternalShutdownException", "ROS was shut down while the node was spinning"),
        ("KeyboardInterrupt", "Ctrl+C ended the node in the middle of its work"),
    ):
        if any(line.split(".")[-1].split(":")[0] == name for line in lines):
            return (
                f"{cause}, and `main` does not expect that, so Python shows a traceback. Nothing "
                f"is broken. Put `rclpy.spin(node)` into `try:`, and below it  {_MEND} pass"
            )
    return None
