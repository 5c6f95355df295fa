"""Page 01, create a workspace: its folders, and where a terminal is."""

from __future__ import annotations

from typing import Any

from rosbeat.exercises.scenarios import TypedIn, look_at_terminal, look_at_workspace
from rosbeat.workspace.place import workspace


def _in_terminal(answer: Any) -> TypedIn:  # noqa: ANN401 - whatever a learner hands over
    return look_at_terminal(answer, workspace())


SCENARIOS = {"01a": look_at_workspace, "01b": _in_terminal}
