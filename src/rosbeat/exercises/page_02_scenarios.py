"""Page 02, create a package: what is in the workspace."""

from __future__ import annotations

from rosbeat.exercises.scenarios import look_at_workspace

SCENARIOS = {"02a": look_at_workspace, "02b": look_at_workspace}
