"""Declare the arguments of the grading commands, in a small module that every start imports."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path

DEFAULT_ASSIGNMENT = "rosbeat"
_DUE = 'the deadline: "2026-11-30 18:00", or 2026-11-30 for the end of that day'
_ROSTER = "who is in the class: names or ids, one a line, or CSV of Moodle or Canvas"
_POINTS = "a CSV file with exercise,points"


def release_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what is typed after `rosbeat release`."""
    add = parser.add_argument
    add("folder", type=Path, metavar="DIR", help="a new folder, or an earlier release")
    add("--lessons", nargs="+", default=(), metavar="PAGE", help="03, a name (default: all pages)")
    add("--points", type=Path, metavar="FILE", help=_POINTS)
    add("--github", action="store_true", help="add a workflow that checks the pages on each push")


def collect_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what is typed after `rosbeat collect`."""
    add = parser.add_argument
    add("submissions", type=Path, metavar="SUBMISSIONS", help="a folder or a zip file")
    add("--due", metavar="WHEN", help=_DUE)
    add("--roster", type=Path, metavar="FILE", help=_ROSTER)
    add("--lessons", nargs="+", default=(), metavar="PAGE", help="03, a name (default: all pages)")
    add("--json", action="store_true", help="the same as JSON, for programs")


def grade_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what is typed after `rosbeat grade`."""
    add = parser.add_argument
    add("submissions", type=Path, metavar="SUBMISSIONS", help="a folder or a zip file")
    add("--out", type=Path, required=True, metavar="GRADES", help="the folder for all results")
    add("--lessons", nargs="+", default=(), metavar="PAGE", help="pages that count (default: any)")
    add("--points", type=Path, metavar="FILE", help=_POINTS)
    add("--due", metavar="WHEN", help=_DUE)
    add("--late", metavar="RULE", help='what a late page loses: "10%%/day", or "20%%" (nothing)')
    add("--roster", type=Path, metavar="FILE", help=_ROSTER)
    missing = "what who handed in nothing gets (zero)"
    add("--missing", choices=("zero", "empty"), default="zero", help=missing)
    add("--assignment", default=DEFAULT_ASSIGNMENT, metavar="TITLE", help="its title in Canvas")
    add("--json", action="store_true", help="print the summary as JSON, for programs")
    many = "answers at a time (default: one per processor)"
    add("--workers", type=_from(1), metavar="N", help=many)
    add("--scheduler", metavar="ADDRESS", help="a Dask cluster that observes, instead of --workers")
    add("--review", action="store_true", help="then mark by eye, in a browser on this computer")
    add("--unsafe-no-sandbox", action="store_true", help="run strangers' code with limits only")


def check_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what is typed after `rosbeat check`."""
    add = parser.add_argument
    add("pages", nargs="+", type=Path, metavar="PAGE", help="the file of a page, an .ipynb")
    add("--json", action="store_true", help="the same as JSON, for programs")


def class_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what is typed after `rosbeat class`."""
    add = parser.add_argument
    folder = "where learners share (default: what ROSBEAT_CLASS names)"
    add("folder", nargs="?", type=Path, metavar="FOLDER", help=folder)
    add("--port", type=_from(0), default=0, metavar="N", help="on this computer (default: any)")
    add("--no-browser", action="store_true", help="print the address only")
    add("--forget", action="store_true", help="delete what learners have shared, and end")


def _from(least: int) -> Callable[[str], int]:
    """Return what reads a whole number and refuses one that is too small."""

    def whole_number(text: str) -> int:
        try:
            number = int(text)
        except ValueError:
            number = least - 1
        if number < least:
            raise argparse.ArgumentTypeError(f"{text!r} is not a whole number from {least} on")
        return number

    return whole_number
