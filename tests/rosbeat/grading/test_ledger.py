"""What has been judged is not judged again, whatever became of the file meanwhile."""

from dataclasses import replace

import pytest

from rosbeat.errors import GradingError
from rosbeat.grading import ledger as module
from rosbeat.grading.ledger import FILE, SEED_FILE, Ledger, course_version, key_of, seed_of
from rosbeat.page_runs.jobs import PageCell, PageJob
from rosbeat.records import Outcome, Part

JOB = PageJob("03", (PageCell("class Beat: ..."),), {"03a": "Beat"})
OUTCOME = Outcome(
    "03a", "failed", "Seen: \x1b é \ud800", "h", "late", 1, 2, ("r",), (Part("R1", "t", True),)
)


@pytest.fixture
def path(tmp_path):
    return tmp_path / "out" / FILE


def kept(path):
    with Ledger(path) as ledger:
        return {key: ledger.get(key) for key in ledger._known}


def test_half_a_line_at_the_end_costs_that_line_only(path):
    with Ledger(path) as ledger:
        ledger.add("a", OUTCOME)
        ledger.add("b", OUTCOME)
    path.write_bytes(path.read_bytes()[:-20])
    with Ledger(path) as ledger:
        assert (ledger.get("a"), ledger.get("b")) == (OUTCOME, None)
        ledger.add("c", OUTCOME)
    assert kept(path) == {"a": OUTCOME, "c": OUTCOME}


def test_an_answer_may_keep_what_another_version_of_the_course_said(path):
    old, new = key_of(JOB, "1"), key_of(JOB, "2")
    other = key_of(replace(JOB, page="04"), "2")
    with Ledger(path) as ledger:
        ledger.add("a", OUTCOME)
        ledger.add(old, replace(OUTCOME, points=2), trace="trace", reaches=("x",))
        ledger.add(old, OUTCOME, trace="second", reaches=("y",))  # it was judged again
    with Ledger(path) as ledger:
        assert ledger.get(new) is None
    with Ledger(path, takes_earlier=True) as ledger:
        assert (ledger.get(new), ledger.trace(new), ledger.reaches(new)) == (
            OUTCOME, "second", ("y",)
        )  # fmt: skip
        assert ledger.get(other) is None
        assert ledger.get("") is None
        ledger.add(new, replace(OUTCOME, points=2))
        assert ledger.get(new) == replace(OUTCOME, points=2)
        assert ledger.get(old) == OUTCOME


def test_without_a_file_outcomes_are_kept_as_long_as_it_is_open(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with Ledger(None) as ledger:
        ledger.add("a", OUTCOME, trace="trace")
        assert (ledger.get("a"), ledger.trace("a"), len(ledger)) == (OUTCOME, "trace", 1)
    assert not list(tmp_path.iterdir())


def damaged(data):
    """What may become of a file: cut at any place, one bit of any byte turned, a piece missing."""
    for place in range(0, len(data), 7):
        yield data[:place]
        yield data[place:]
        yield data[:place] + bytes([data[place] ^ 1 << place % 8]) + data[place + 1 :]
        yield data[:place] + data[place + 1 + place % 99 :]


def test_nothing_damaged_is_taken_for_an_outcome(path):
    known = {"a": OUTCOME, "b": replace(OUTCOME, points=2)}
    with Ledger(path) as ledger:
        for key, outcome in known.items():
            ledger.add(key, outcome, trace=f"trace of {key}")
    whole, lost = path.read_bytes(), 0
    for data in damaged(whole):
        path.write_bytes(data)
        with Ledger(path) as ledger:
            for key, outcome in known.items():
                found = ledger.get(key), ledger.trace(key)
                assert found in ((outcome, f"trace of {key}"), (None, "")), data
                lost += found[0] is None
            assert len(ledger) <= len(known)
    assert lost > len(whole) // 7


def test_a_full_disk_is_said(path, monkeypatch, says):
    def full(_):
        raise OSError(28, "No space left on device")

    with Ledger(path) as ledger:
        ledger.add("a", OUTCOME)
        monkeypatch.setattr(module.os, "fdatasync", full)
        with pytest.raises(GradingError) as caught:
            ledger.add("b", OUTCOME)
        monkeypatch.undo()
    says(caught.value, "No space left on device", "--out")
    assert kept(path)["a"] == OUTCOME


def test_a_key_is_all_that_decides():
    assert key_of(JOB, "1") == key_of(replace(JOB), "1")
    others = [
        replace(JOB, cells=(PageCell("x"),)),
        replace(JOB, given={"03a": '{"a": 1}'}),
        replace(JOB, subjects={"03a": "Ear"}),
        replace(JOB, seeds={"03a": 1}),
    ]
    keys = {key_of(JOB, "1"), key_of(JOB, "2"), *(key_of(one, "1") for one in others)}
    assert len(keys) == 6
    assert key_of(replace(JOB, cells=(PageCell("\ud800"),)), "1")


def test_the_version_is_another_one_with_another_judge(tmp_path, monkeypatch):
    monkeypatch.setattr(module, "_PACKAGE", tmp_path)
    (tmp_path / "judge.py").write_text("a")
    (tmp_path / "notes.md").write_text("a")
    first = course_version()
    (tmp_path / "notes.md").write_text("b")
    assert course_version() == first
    (tmp_path / "judge.py").write_text("b")
    second = course_version()
    (tmp_path / "judge.py").rename(tmp_path / "other.py")
    assert len({first, second, course_version()}) == 3


def test_a_class_has_a_seed_of_its_own_that_stays(tmp_path, says):
    one, other = (seed_of(tmp_path / name) for name in "ab")
    assert one != other
    assert seed_of(tmp_path / "a") == one > 0
    path = tmp_path / "a" / SEED_FILE
    assert path.stat().st_mode & 0o777 == 0o600
    assert [one.name for one in path.parent.iterdir()] == [SEED_FILE]
    path.write_text("no number")
    with pytest.raises(GradingError) as caught:
        seed_of(path.parent)
    says(caught.value, SEED_FILE, "--out")
    assert path.read_text() == "no number"
