"""Decide which files are late, and how many points are deducted."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass, replace
from datetime import datetime, time, timedelta
from math import ceil, inf

from rosbeat.errors import GradingError
from rosbeat.grading.files import printable
from rosbeat.grading.remarks import Remark
from rosbeat.grading.submissions import Collection, HandedIn, Submission

_DAY, _HOUR = 86_400.0, 3_600.0


def read_due(text: str) -> float:
    """Return a deadline in seconds since 1970; what is newer is late.

    Args:
        text: A day, which lasts until midnight, or a day and a time, such as `2026-11-30 18:00`; in
            the time zone of this computer unless it names another, as `2026-11-30 18:00+01:00`.

    Raises:
        GradingError: If it is neither.
    """
    text = text.strip()
    try:
        found = datetime.fromisoformat(f"{text[:-1]}+00:00" if text.endswith("Z") else text)
        if len(text) <= len("2026-11-30"):
            found = datetime.combine(found, time(23, 59, 59, 999_999))
        return found.timestamp()
    except (ValueError, OverflowError, OSError):
        raise GradingError(
            f"{printable(text)!r} is neither a day nor a time.",
            "Files that were changed after the deadline are late, so it has to be exact.",
            'Write a day, or a day and a time:  --due "2026-11-30 18:00"',
        ) from None


_EXTENSION = re.compile(r"\+?(\d{1,4}(?:[.,]\d+)?)\s*(d|days?|h|hours?|w|weeks?)?")


def read_extension(text: str, due: float | None) -> float:
    """Return one learner's deadline, in seconds since 1970.

    Args:
        text: How much later than that of the class, such as `3`, `3 days`, `12 h` or `1 week`; or
            the deadline itself.
        due: The deadline of the class, if there is one.

    Raises:
        GradingError: If it is neither, or if it is later than a deadline that is not known.
    """
    found = _EXTENSION.fullmatch(text.strip().casefold())
    if found is None:
        return read_due(text)
    if due is None:
        raise GradingError(
            f"{printable(text)!r} is later than a deadline that is not known.",
            "An extension is counted from the deadline of the class.",
            "Give it with --due, or write a day and a time instead of the extension.",
        )
    unit = {"h": timedelta(hours=1), "w": timedelta(weeks=1)}.get((found[2] or "d")[0])
    return due + float(found[1].replace(",", ".")) * (unit or timedelta(days=1)).total_seconds()


@dataclass(frozen=True)
class LateRule:
    """Hold what is taken off the points of a page that is late.

    Attributes:
        share: The share of the points that is taken off, for each `every` that has begun.
        every: Seconds; infinite if the share is taken off once.
        most: The largest share that is taken off.
    """

    share: float = 0.0
    every: float = inf
    most: float = 1.0

    @property
    def needs_a_date(self) -> bool:
        """Return whether it matters how late a page is."""
        return self.every != inf

    def off(self, late_by: float) -> float:
        """Return the share that is taken off a page, so many seconds after the deadline."""
        begun = max(1, ceil(late_by / self.every)) if self.needs_a_date else 1
        return min(self.most, self.share * begun)


_NUMBER = r"(\d{1,3}(?:\.\d+)?)\s*%"
_RULE = re.compile(rf"{_NUMBER}(?:\s*/\s*(day|hour))?(?:\s*,?\s*at most\s+{_NUMBER})?")


def read_late_rule(text: str) -> LateRule:
    """Return what is taken off a late page.

    Args:
        text: Such as `10%/day`, `1%/hour`, `20%`, or `10%/day, at most 50%`.

    Raises:
        GradingError: If it is nothing of the kind.
    """
    found = _RULE.fullmatch(text.strip().casefold())
    shares = [float(one) / 100 for one in (found[1], found[3] or "100")] if found else [inf]
    if found is None or max(shares) > 1:
        raise GradingError(
            f"{printable(text)!r} does not say what a late page loses.",
            "Points would be taken off, or not, against what you want; so nothing is graded.",
            'Write a share of the points:  --late "10%/day"  or  --late "10%/day, at most 50%"',
        )
    every = {"day": _DAY, "hour": _HOUR}.get(found[2] or "", inf)
    return LateRule(shares[0], every, shares[1])


def mark_late(
    found: Collection, due_of: Callable[[Submission], float | None], rule: LateRule | None = None
) -> Collection:
    """Note for each page whether it is late, and what share of its points is taken off.

    Where a platform dates every file at the moment of the download and marks those that are late,
    its mark decides, and how late a page is nobody knows.

    Args:
        found: What a class handed in.
        due_of: Returns the deadline of a learner in seconds since 1970; None if there is none.
        rule: What is taken off.

    Returns:
        The same with `late` and `off` of each page, and a remark for each page that is late.
    """
    submissions = tuple(_with_lateness(one, due_of(one), rule) for one in found.submissions)
    return replace(found, submissions=submissions)


def _with_lateness(one: Submission, due: float | None, rule: LateRule | None) -> Submission:
    told: list[Remark] = []
    pages = tuple(_page(page, due, rule, told) for page in one.pages)
    return replace(one, pages=pages, remarks=(*one.remarks, *told))


def _page(page: HandedIn, due: float | None, rule: LateRule | None, told: list[Remark]) -> HandedIn:
    late_by = page.modified - due if due is not None and page.is_dated else 0.0
    if not (page.late or late_by > 0):
        return page
    said = _lateness(page.modified, late_by) if late_by > 0 else "It is marked as late."
    off = 0.0
    if rule is not None and rule.needs_a_date and not late_by > 0:
        said += " How late is not known, so nothing is taken off: decide by hand."
    elif rule is not None:
        off = rule.off(late_by)
        said += f" {100 * off:g}% of the points of this page are taken off."
    told.append(Remark("late", printable(page.path), said))
    return replace(page, late=True, off=off)


def _lateness(modified: float, late_by: float) -> str:
    days, hours = int(late_by // _DAY), int(late_by % _DAY // _HOUR)
    told = f"{days} d {hours} h" if days or hours else f"{ceil(late_by / 60)} min"
    date = f"{datetime.fromtimestamp(modified):%Y-%m-%d %H:%M}"
    return f"The date of the file, {date}, is {told} after the deadline."
