"""A function that writes entry points, called with several arguments."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from rosbeat.ros.isolation import Deadline


@dataclass(frozen=True)
class Calls:
    """What a function gave back.

    Attributes:
        results: Arguments and result of each call, as text.
        problem: The exception that ended the calls, or empty.
        kinds: The type of each result.
    """

    results: tuple[tuple[tuple[str, ...], str], ...]
    problem: str = ""
    kinds: tuple[str, ...] = ()


#: How long all calls together may take, in seconds.
_SECONDS = 2.0
#: How `problem` begins if the calls took longer.
LATE = "DeadlinePassed"
#: What the function is called with, one call after the other.
ARGUMENTS = (
    ("talk", "rosie", "voice"),
    ("watch_room", "house", "monitor", "start"),
    ("a", "b", "c", "d"),
)


def call(answer: Any) -> Calls:  # noqa: ANN401 - whatever a learner hands over
    """Call a function that writes entry points, with several arguments.

    Args:
        answer: The function.
    """
    done: list[tuple[tuple[str, ...], str]] = []
    kinds: list[str] = []
    problem = ""
    with Deadline(_SECONDS) as deadline:
        try:
            for arguments in ARGUMENTS:
                result = answer(*arguments)
                done.append((arguments, str(result)))
                kinds.append(type(result).__name__)
        except (Exception, SystemExit) as error:  # whatever a learner's function does is evidence
            problem = f"{type(error).__name__}: {error}"
    if deadline.passed:
        problem = f"{LATE}: it was still running after {_SECONDS:g} s"
    return Calls(tuple(done), problem, tuple(kinds[: len(done)]))
