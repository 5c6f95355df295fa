"""What the doctor finds."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal


@dataclass(frozen=True)
class Finding:
    """One thing that was looked at: `ok`, a `note` that harms nothing, or a `problem`."""

    state: Literal["ok", "note", "problem"]
    subject: str
    text: str
    cure: str = ""


def ok(subject: str, text: str) -> Finding:
    """Return a finding that is as it should be."""
    return Finding("ok", subject, text)


def note(subject: str, text: str, cure: str = "") -> Finding:
    """Return a finding worth knowing that stops nothing."""
    return Finding("note", subject, text, cure)


def problem(subject: str, text: str, cure: str) -> Finding:
    """Return a finding that stops something, and its cure."""
    return Finding("problem", subject, text, cure)
