"""What goes into a sandbox and comes out of it, as lines."""

import json
from dataclasses import replace

import pytest

from rosbeat.errors import GradingError
from rosbeat.grading.jobs import FORGED, Job, Observed, read_job, read_observed, write_line

JOB = Job("03a", "Beat", "class Beat: ...\n", ("a = 1",), "import rclpy", ("x = 2",), given="{}")
SEEN = Observed(FORGED, 9, "{}", "ValueError", "é\ud800\x1b", 3, "x", ("json.dumps",), "o\n", 0.5)


def test_what_is_written_is_read_on_one_line():
    for value, read in ((JOB, read_job), (SEEN, read_observed)):
        line = write_line(value)
        assert read(line) == value
        assert line.isascii()
        assert "\n" not in line


def test_equal_jobs_give_equal_lines_and_others_give_others():
    assert write_line(replace(JOB)) == write_line(JOB)
    for change in ({"answer": "b"}, {"given": '{"a": 1}'}, {"earlier": ()}, {"subject": "Ear"}):
        assert write_line(replace(JOB, **change)) != write_line(JOB)


@pytest.mark.parametrize("read", [read_job, read_observed])
@pytest.mark.parametrize(
    "line",
    ["", "half a {", "[]", "null", "5", "{}", '{"exercise": "03a"}', "[" * 100_000,
     json.dumps({"how": "ended", "more": 1}), write_line(JOB)[:-5], write_line(SEEN)[:-5]],
    ids=range(11),
)  # fmt: skip
def test_anything_else_is_refused(read, line, says):
    with pytest.raises(GradingError) as caught:
        read(line)
    says(caught.value, "already stays graded")


def test_one_is_not_read_as_the_other():
    with pytest.raises(GradingError):
        read_job(write_line(SEEN))
    with pytest.raises(GradingError):
        read_observed(write_line(JOB))
