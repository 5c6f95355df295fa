"""Page 06, build, source, run: what a terminal has run, and what is installed."""

from __future__ import annotations

from typing import Any

from rosbeat.exercises.scenarios import TypedIn, look_at_terminal, look_at_workspace
from rosbeat.workspace.place import workspace

#: How the commands begin whose outcome is looked at.
RUN = "ros2 run"


def _in_terminal(answer: Any) -> TypedIn:  # noqa: ANN401 - whatever a learner hands over
    return look_at_terminal(answer, workspace(), RUN)


SCENARIOS = {"06a": _in_terminal, "06b": look_at_workspace}
