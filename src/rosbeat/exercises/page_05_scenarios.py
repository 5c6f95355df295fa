"""Page 05, set the entry points: what is in the workspace, and what a function gives back."""

from __future__ import annotations

from rosbeat.exercises.call_runs import call
from rosbeat.exercises.scenarios import look_at_workspace

SCENARIOS = {"05a": look_at_workspace, "05b": call}
