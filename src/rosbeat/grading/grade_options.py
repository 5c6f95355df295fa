"""What is typed after `rosbeat grade`; apart, because every start of `rosbeat` reads it."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path

DEFAULT_ASSIGNMENT = "rosbeat"
#: What is said of `--due`, here and where submissions are collected.
DUE = 'the deadline: "2026-11-30 18:00", or 2026-11-30 for the end of that day; takes no points'


def arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what is typed after `rosbeat grade`."""
    add = parser.add_argument
    add("submissions", type=Path, metavar="SUBMISSIONS", help="a folder or a zip file")
    add("--out", type=Path, required=True, metavar="GRADES", help="the folder for all results")
    add("--lessons", nargs="+", default=(), metavar="PAGE", help="pages that count (default: any)")
    add("--points", type=Path, metavar="FILE", help="a CSV file with exercise,points")
    add("--due", metavar="WHEN", help=DUE)
    add("--assignment", default=DEFAULT_ASSIGNMENT, metavar="TITLE", help="its title in Canvas")
    many = "answers at a time (default: one per processor)"
    add("--workers", type=_from(1), metavar="N", help=many)
    add("--scheduler", metavar="ADDRESS", help="a Dask cluster that observes, instead of --workers")
    few = "answers tried in a kernel too (2)"
    add("--sample", type=_from(0), default=2, metavar="N", help=few)
    add("--review", action="store_true", help="then mark by eye, in a browser on this computer")
    add("--unsafe-no-sandbox", action="store_true", help="run strangers' code with limits only")


def _from(least: int) -> Callable[[str], int]:
    """What reads a whole number and refuses one that is too small."""

    def whole_number(text: str) -> int:
        try:
            number = int(text)
        except ValueError:
            number = least - 1
        if number < least:
            raise argparse.ArgumentTypeError(f"{text!r} is no whole number from {least} on")
        return number

    return whole_number
