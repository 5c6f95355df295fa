"""All cases, by name."""

from conformance import cases_executors, cases_middleware, cases_waiting
from conformance.programs import CASES

__all__ = ["CASES", "cases_executors", "cases_middleware", "cases_waiting"]
