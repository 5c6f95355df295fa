"""Page 05, set the entry points: what is in the workspace, and what a function gives back."""

from __future__ import annotations

from rosbeat.scenarios.calls import call
from rosbeat.scenarios.looking import look_at_workspace

SCENARIOS = {"05a": look_at_workspace, "05b": call}
