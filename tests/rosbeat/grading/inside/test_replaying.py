"""A page of terminals and files, run in a sandbox up to one check."""

import pytest

from bank.graded_workspaces import job_of, usable
from rosbeat.exercises.registry import EXERCISES
from rosbeat.grading.inside import replaying
from rosbeat.grading.judging import judge
from rosbeat.grading.pool import Pool


def test_files_and_folders_are_put_where_they_belong(tmp_path):
    replaying._put({"src/": b"", "src/a/b.py": b"\xff", "c": b""}, tmp_path / "new")
    assert (tmp_path / "new/src/a/b.py").read_bytes() == b"\xff"
    assert (tmp_path / "new/src").is_dir()
    assert (tmp_path / "new/c").read_bytes() == b""
    replaying._put({"c": b"again"}, tmp_path / "new")
    assert (tmp_path / "new/c").read_bytes() == b"again"


@pytest.mark.ros
@pytest.mark.timeout(300)
def test_what_was_typed_is_judged_by_what_it_has_left():
    right = next(one for one in usable("01a") if one.status == "passed")
    wrong = next(one for one in usable("01a") if one.status == "failed")
    with Pool(2) as pool:
        seen = dict(pool.observe((one.status, job_of(one)) for one in (right, wrong)))
    found = {status: judge(EXERCISES["01a"], one) for status, one in seen.items()}
    assert {status: one.status for status, one in found.items()} == {
        "passed": "passed",
        "failed": "failed",
    }, (found, seen)
    assert found["failed"].mistake in wrong.mistakes
