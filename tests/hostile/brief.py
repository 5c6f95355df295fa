"""Sandboxes in which answers have less time and memory."""

import os
from dataclasses import replace
from functools import partial
from pathlib import Path

from rosbeat.page_runs import pool

_TESTS = Path(__file__).parents[1]


def be_brief(monkeypatch):
    """Let pools run `brief_worker`, and give a page less of everything."""
    monkeypatch.setattr(pool, "_MODULE", "hostile.brief_worker")
    monkeypatch.setenv("PYTHONPATH", str(_TESTS), prepend=os.pathsep)
    view = pool.view_of_answers()
    shown = replace(view, readable=[*view.readable, str(_TESTS)])
    monkeypatch.setattr(pool, "view_of_answers", lambda: shown)
    monkeypatch.setattr(pool, "WALL", 10.0)
    # To use up a whole gigabyte takes a busy machine seconds; a page needs half of this.
    monkeypatch.setattr(pool, "Limits", partial(pool.Limits, memory=300 * 1_000_000))
