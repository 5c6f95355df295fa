"""A deadline, as a person types it."""

from datetime import datetime, timezone

import pytest

from rosbeat.errors import GradingError
from rosbeat.grading.deadlines import read_due


def test_a_day_ends_at_midnight():
    last = datetime(2026, 11, 30, 23, 59, 59).timestamp()
    assert last < read_due("2026-11-30") < datetime(2026, 12, 1).timestamp()


def test_a_time_is_that_of_this_computer():
    assert read_due(" 2026-11-30 18:00 ") == datetime(2026, 11, 30, 18).timestamp()
    assert read_due("2026-11-30T18:00:30") == datetime(2026, 11, 30, 18, 0, 30).timestamp()


def test_a_time_may_name_its_zone():
    moment = datetime(2026, 11, 30, 17, tzinfo=timezone.utc).timestamp()
    assert read_due("2026-11-30 18:00+01:00") == moment
    assert read_due("2026-11-30T17:00Z") == moment


@pytest.mark.parametrize(
    "text", ["", "tomorrow", "30.11.2026", "2026-13-01", "nan", "\x1b[31m", "Z"]
)
def test_what_is_no_deadline_is_refused(text, says):
    with pytest.raises(GradingError) as caught:
        read_due(text)
    says(caught.value, "2026-11-30 18:00")
    assert "\x1b" not in str(caught.value)
