"""All cases, by name."""

from conformance import (
    cases_driving,
    cases_entities,
    cases_executors,
    cases_middleware,
    cases_surroundings,
    cases_threads,
    cases_waiting,
)
from conformance.programs import CASES

__all__ = [
    "CASES",
    "cases_driving",
    "cases_entities",
    "cases_executors",
    "cases_middleware",
    "cases_surroundings",
    "cases_threads",
    "cases_waiting",
]
