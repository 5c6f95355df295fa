"""The greenhouse of the last page: what is required, and the weather to try it in.

The rooms of this house: `rubric` (what is required, read from a file), `reading` and the judges of
the requirements beside it (pure functions), `judge` (from all of them to an outcome), `showing`
(for the page). What runs a greenhouse, and in which weather, stands in
`rosbeat.exercises.greenhouse`.
"""

from __future__ import annotations

from rosbeat.exercises.greenhouse.showing import requirements as requirements
from rosbeat.exercises.greenhouse.showing import weather as weather

__all__ = ["requirements", "weather"]
