"""`rosbeat grade` is killed, its ledger damaged, its folder shared: the grades stay the same.

Whatever happens, the command is run once more, and `grades.csv` has the bytes of a run that nobody
has disturbed. `--thorough` tries more moments and more kinds of damage.
"""

import json
import os
import shutil
import signal
import subprocess
import sys
import time
from contextlib import suppress
from random import Random

import psutil
import pytest

from bank.class_of_learners import distinct_texts_of, hand_in
from bank.pages import ROOT
from rosbeat.grading.ledger import FILE, SEED_FILE

pytestmark = [pytest.mark.ros, pytest.mark.timeout(600)]

LEARNERS = 6
PAGE = "03"
#: Files that have to be those of an undisturbed run.
COMPARED = ("grades.csv", "results.json", "class.html")
DEADLINE = 120.0


class Class:
    """A class that hands in page 03, with the results of a run that nobody has disturbed."""

    def __init__(self, folder):
        self.folder = folder
        hand_in(folder / "class", LEARNERS, texts=distinct_texts_of, numbers=[PAGE])
        self.plain = folder / "plain"
        self.grade(self.plain)
        self.judged = len(judged(self.plain))
        learners = json.loads((self.plain / "results.json").read_text())["learners"]
        assert {"passed", "failed"} <= {one["status"] for each in learners for one in each["marks"]}

    def start(self, out):
        """Begin to grade into a folder."""
        command = [sys.executable, "-m", "rosbeat", "grade", self.folder / "class"]
        return subprocess.Popen(
            [*command, "--out", out, "--workers", "2"],
            cwd=ROOT, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
        )  # fmt: skip

    def grade(self, out):
        """Grade into a folder; all answers have to be marked."""
        with self.start(out) as process:
            _, said = process.communicate(timeout=DEADLINE)
        assert process.returncode == 0, said.decode()

    def new(self, name, ledger=None):
        """Make a folder of results with the seed of the undisturbed run, and a ledger."""
        out = self.folder / name
        out.mkdir()
        shutil.copy(self.plain / SEED_FILE, out)
        if ledger is not None:
            (out / FILE).write_bytes(ledger)
        return out

    def require_same(self, out):
        """Go on, and compare what there is then with the undisturbed run."""
        self.grade(out)
        for name in COMPARED:
            assert (out / name).read_bytes() == (self.plain / name).read_bytes(), name


@pytest.fixture(scope="module")
def graded(tmp_path_factory):
    return Class(tmp_path_factory.mktemp("class"))


def judged(out):
    """The lines of a ledger."""
    with suppress(FileNotFoundError):
        return (out / FILE).read_bytes().splitlines(keepends=True)
    return []


def keys(out):
    """The keys of the answers that have been judged, in order; a line may be broken off."""
    found = []
    for line in judged(out):
        with suppress(ValueError):
            found.append(json.loads(line)[1]["key"])
    return found


# Killed.


def sandboxes_of(parent):
    return [child for child in parent.children() if "rosbeat.page_runs.worker" in child.cmdline()]


def firsts_of(parent):
    """Process 1 of each sandbox."""
    return [first for sandbox in sandboxes_of(parent) for first in sandbox.children()]


def pages_of(parent):
    return [page for first in firsts_of(parent) for page in first.children()]


def all_of(parent):
    return [parent, *parent.children(recursive=True)]


#: What is killed, and which processes of a grading run those are; of `all`, each is killed.
KINDS = {
    "sandbox": sandboxes_of,
    "process 1": firsts_of,
    "page": pages_of,
    "all": all_of,
    "parent": lambda parent: [parent],
}


def kill(process, kind, random):
    """Kill one of a kind, as soon as there is one; return whether there was one."""
    deadline = time.monotonic() + DEADLINE
    while process.poll() is None:
        assert time.monotonic() < deadline, f"there was no {kind}"
        with suppress(psutil.Error, IndexError, OSError):
            found = KINDS[kind](psutil.Process(process.pid))
            victims = found if kind == "all" else random.sample(found, min(1, len(found)))
            for one in victims:
                os.kill(one.pid, signal.SIGKILL)
            if victims:
                return True
    return False


def killed_in_turn(graded, out, kinds, random):
    """Grade, and kill one after the other, a few answers apart; begin again if it has ended.

    It ends with its parent, and if a sandbox is lost before anything was observed in it.
    """
    process, done = graded.start(out), []
    try:
        for kind in kinds:
            wanted = len(judged(out)) + random.randrange(1, 3)
            while len(judged(out)) < wanted and process.poll() is None:
                time.sleep(0.002)
            while not kill(process, kind, random):
                process.communicate()
                assert len(judged(out)) < graded.judged, f"all is judged before {kind}"
                process = graded.start(out)
            done.append(kind)
            if kind in ("parent", "all"):
                process.communicate(timeout=DEADLINE)
        process.communicate(timeout=DEADLINE)
    finally:
        process.kill()
        process.wait()
    return done


@pytest.mark.parametrize(
    "seed", [0, *(pytest.param(seed, marks=pytest.mark.thorough) for seed in range(1, 8))]
)
def test_whatever_is_killed_the_grades_are_the_same(graded, seed):
    random = Random(seed)
    kinds = random.sample(list(KINDS), len(KINDS))
    out = graded.new(f"killed-{seed}")
    assert killed_in_turn(graded, out, kinds, random) == kinds
    before = keys(out)
    graded.require_same(out)
    after = keys(out)
    assert after[: len(before)] == before
    assert len(after) == len(set(after))
    assert set(after) == set(keys(graded.plain))


@pytest.mark.parametrize(
    "file",
    [
        *("feedback", "grades.csv"),
        *(pytest.param(one, marks=pytest.mark.thorough) for one in ("class.html", "results.json")),
    ],
)
def test_killed_while_results_are_written(graded, file):
    out = graded.new(f"killed-at-{file}", (graded.plain / FILE).read_bytes())
    with graded.start(out) as process:
        while not (out / file).exists():
            assert process.poll() is None
        process.kill()
    graded.require_same(out)


# A damaged ledger; `test_ledger.py` tries each byte, without grading anything.


def test_a_damaged_ledger_changes_no_grade(graded):
    random, data = Random("flipped"), bytearray((graded.plain / FILE).read_bytes())
    for _ in range(20):
        data[random.randrange(len(data))] ^= 1 << random.randrange(8)
    graded.require_same(graded.new("damaged", bytes(data)))


def test_a_folder_in_place_of_the_ledger_is_refused_and_nothing_is_written(graded):
    out = graded.new("folder")
    (out / FILE).mkdir()
    with graded.start(out) as process:
        _, said = process.communicate(timeout=DEADLINE)
    assert process.returncode == 1
    assert FILE.encode() in said
    assert sorted(one.name for one in out.iterdir()) == sorted([FILE, SEED_FILE])
    (out / FILE).rmdir()
    (out / FILE).write_bytes((graded.plain / FILE).read_bytes())
    graded.require_same(out)


# Two at once.


def test_two_runs_in_one_folder_at_once_agree(graded):
    out = graded.new("two", b"".join(judged(graded.plain)[: graded.judged // 2]))
    runs = [graded.start(out) for _ in range(2)]
    for run in runs:
        _, said = run.communicate(timeout=DEADLINE)
        assert run.returncode == 0, said.decode()
    graded.require_same(out)
