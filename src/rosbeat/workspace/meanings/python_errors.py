"""Errors of Python in a node, by the texts that rclpy gives them (mistakes 1 to 12, and 17)."""

from __future__ import annotations

from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.diagnosis.programs import meaning_of_output
from rosbeat.workspace.meanings.running import last_error
from rosbeat.workspace.meanings.situation import Situation

#: What any program in Python may come upon; the others are mistakes of a node.
_PLAIN = frozenset(
    ("name-error", "wrong-attribute", "no-value-yet", "not-importable", "text-and-number")
)


def no_rclpy(seen: Situation) -> Diagnosis | None:
    """A Python without ROS."""
    if not seen.code or "No module named 'rclpy'" not in last_error(seen.traceback):
        return None
    return Diagnosis(
        "other-python",
        "The Python that ran is not the one of the course, and it has no ROS.",
        "`which python3` shows which one a terminal uses; open a terminal from the course, or "
        "run `./environment/course shell` first.",
    )


def in_a_node(seen: Situation) -> Diagnosis | None:
    """An error that rclpy raises for a mistake in a node, or Python for a misspelt name."""
    meaning = meaning_of_output(seen.traceback)
    if meaning is None or meaning.mistake == "ctrl-c-traceback":  # that is told by `ending`
        return None
    if not seen.about_ros and meaning.mistake not in _PLAIN:
        return None
    return Diagnosis(meaning.mistake, meaning.beside_error, meaning.to_try)
