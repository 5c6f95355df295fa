"""Several workers, whatever happens to any of them."""

import os
import time
from pathlib import Path

import pytest

from fake_worker import NOTES
from rosbeat.errors import GradingError
from rosbeat.grading import pool as module
from rosbeat.grading.jobs import LOST, Job
from rosbeat.grading.pool import Pool, Worker

TESTS = Path(__file__).parents[2]


def job(word):
    return Job("03a", "Beat", word)


def is_alive(pid):
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"


@pytest.fixture
def notes(tmp_path, monkeypatch):
    """What the fake workers were given, with their process ids."""
    monkeypatch.setattr(module, "_MODULE", "fake_worker")
    monkeypatch.setenv("PYTHONPATH", str(TESTS))
    monkeypatch.setenv(NOTES, str(tmp_path / "notes"))

    def read(word=""):
        lines = [one.split(" ", 1) for one in (tmp_path / "notes").read_text().splitlines()]
        return [int(pid) for pid, said in lines if said.startswith(word)]

    return read


def done(pool, *words):
    return dict(pool.observe((one, job(one)) for one in words))


def test_each_job_is_done_once_and_known_by_its_key(notes):
    words = [f"job{number} \u00e9\ud800" for number in range(40)]
    with Pool(3) as pool:
        found = done(pool, *words)
    assert {key: seen.evidence for key, seen in found.items()} == {one: one for one in words}
    assert len(notes("job")) == 40
    assert len(notes("start")) == 3


def test_no_job_is_no_trouble(notes):
    with Pool(1) as pool:
        assert done(pool) == {}


def test_jobs_are_taken_as_they_are_needed(notes):
    taken = []

    def endless():
        while True:
            taken.append(len(taken))
            yield taken[-1], job("job")

    with Pool(2) as pool:
        found = pool.observe(endless())
        for _ in range(5):
            next(found)
        found.close()
    assert len(taken) <= 5 + 2 * 2 + 1


@pytest.mark.parametrize("word", ["die", "half", "nonsense", "forged"])
def test_a_job_that_loses_two_workers_is_given_up_and_the_others_go_on(notes, word):
    words = [word, *(f"job{number}" for number in range(10))]
    with Pool(2) as pool:
        found = done(pool, *words)
        assert len(pool.pids) == 2
    assert found.pop(word).how == LOST
    assert {one.how for one in found.values()} == {"ended"}
    assert len(set(notes(word))) == 2


def test_a_job_that_loses_one_worker_is_done_by_the_next(notes, tmp_path):
    with Pool(1) as pool:
        (seen,) = done(pool, f"die-once {tmp_path}/died").values()
    assert seen.how == "ended"
    assert len(notes("die-once")) == 2


def test_a_silent_worker_is_replaced(notes):
    with Pool(1, patience=1.5) as pool:
        found = done(pool, "silent", "job")
    assert {key: seen.how for key, seen in found.items()} == {"silent": LOST, "job": "ended"}
    assert not any(map(is_alive, notes("start")))


def test_no_sandbox_stops_everything_and_is_said(notes, says):
    with Pool(2) as pool, pytest.raises(GradingError) as caught:
        done(pool, "job", "refuse", "job2")
    says(caught.value, "No sandbox.", "Nothing was run.", "Try this.")


def test_a_worker_that_cannot_start_is_no_fault_of_an_answer(notes, monkeypatch, says):
    monkeypatch.setenv("ROSBEAT_NEVER_READY", "1")
    with Pool(2) as pool, pytest.raises(GradingError) as caught:
        done(pool, "job", "job2")
    says(caught.value, "does not start", "course doctor")
    assert notes("job") == []


def test_nothing_is_left_when_somebody_stops_in_the_middle(notes, eventually):
    with Pool(2) as pool:
        found = pool.observe((one, job(one)) for one in ("job", "silent", "silent", "job"))
        next(found)
        eventually(lambda: notes("silent"))
        pids, began = pool.pids, time.monotonic()
    assert time.monotonic() - began < 5  # nobody waits for the silent one
    assert pool.pids == pids  # and nobody takes its place
    assert not any(map(is_alive, pids))


def test_workers_are_told_that_there_is_no_sandbox(notes):
    with Pool(1, unsafe=True) as pool:
        done(pool, "job")
    assert len(notes("start --unsafe-no-sandbox")) == 1


def test_a_worker_that_is_gone_says_nothing(notes):
    worker = Worker()
    assert worker.observe(job("job")).how == "ended"
    worker.kill()
    assert worker.observe(job("job")) is None
    worker.close()
    worker.close()
    assert not is_alive(worker.pid)
