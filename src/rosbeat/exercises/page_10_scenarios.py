"""Page 10, find the fault: what somebody wrote down about the patients of a ward.

The ward itself is not needed to see that, so nobody's fault is known where an answer runs.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from rosbeat.exercises.scenarios import report

SCENARIOS: dict[str, Callable[[Any], Any]] = {"10a": report, "10b": report, "10c": report}
