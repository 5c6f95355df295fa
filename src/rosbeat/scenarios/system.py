"""The whole system: both programs of the tutorial, built and run."""

from __future__ import annotations

from rosbeat.scenarios.system_run import run_system

SCENARIOS = {"system": run_system}
