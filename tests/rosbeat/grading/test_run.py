"""A class from what was handed in to its gradebook, and the workers that observe its answers."""

import json
import os
import signal
import subprocess
import sys
from contextlib import nullcontext
from dataclasses import replace
from pathlib import Path

import nbformat
import psutil
import pytest
from nbclient import NotebookClient

from bank.graded import page_of, usable
from fake_sandbox import FakeSandbox
from grading_files import DONE, PAGE_03, PAGE_04, cell, notebook, page
from hostile.brief import be_brief
from rosbeat.diagnosis.mistakes import MISTAKES
from rosbeat.errors import GradingError
from rosbeat.exercises.evidence import to_json
from rosbeat.exercises.registry import EXERCISES
from rosbeat.grading.ledger import Ledger
from rosbeat.grading.marks import Points
from rosbeat.grading.run import Plan, cause_of, grade
from rosbeat.grading.submissions import collect
from rosbeat.page_runs import pool as module
from rosbeat.page_runs.jobs import (
    FORGED,
    LOST,
    Evidence,
    PageCell,
    PageEvidence,
    PageJob,
    read_line,
    to_line,
)
from rosbeat.page_runs.judging import judge
from rosbeat.page_runs.pool import Pool, Worker, files_before
from rosbeat.records import Fault, LogRecord, Observation, Outcome, Part
from rosbeat.workspace.prerequisites import Report

# From a class to its gradebook; answers are observed by somebody made up.

OTHER_03 = page(source=DONE.replace("1.0", "2.0"))
RAISES = Evidence("ended", raised="ZeroDivisionError", text="division by zero", line=3)


class Observer:
    """Says the same of every exercise of every page, and keeps what it was asked."""

    def __init__(self, seen=RAISES, after=None, remarks=()):
        self.seen, self.after, self.remarks, self.jobs = seen, after, remarks, []

    def __call__(self, submissions):
        for key, job in (one for some in submissions for one in some):
            if len(self.jobs) == self.after:
                raise KeyboardInterrupt
            self.jobs.append(job)
            yield key, PageEvidence(dict.fromkeys(job.subjects, self.seen), self.remarks)


@pytest.fixture
def graded(pages, handed_in, tmp_path):
    """Grade files, with a ledger that stays for the next time."""

    def run(files, observer, points=None, version="1", tell=lambda done, total: None, seed=0):
        plan = Plan(pages, version, points or Points(), seed)
        with Ledger(tmp_path / "ledger") as ledger:
            return grade(collect(handed_in(files), pages), plan, ledger, observer, tell)

    return run


def rows(book):
    return [
        (one.learner, mark.exercise, mark.status) for one in book.learners for mark in one.marks
    ]


def test_every_exercise_of_every_learner_has_a_mark(graded):
    files = {"ana/03.ipynb": PAGE_03, "ana/04.ipynb": PAGE_04, "ben/03.ipynb": page()}
    book = graded(files, Observer())
    assert rows(book) == [
        ("ana", "03a", "failed"), ("ana", "04a", "failed"),
        ("ben", "03a", "not attempted"), ("ben", "04a", "missing"),
    ]  # fmt: skip
    first = book.learners[0].marks[0]
    assert (first.mistake, first.page, first.points) == ("division-by-zero", "03_write", 0.0)
    assert first.out_of == EXERCISES["03a"].points
    assert all(mark.cause for one in book.learners for mark in one.marks)


def test_only_what_differs_is_observed(graded):
    """Equal answers once, unchanged ones never again; another version or seed judges anew."""
    files = {f"{name}/03.ipynb": PAGE_03 for name in ("ana", "ben", "cy")}
    files["ben/04.ipynb"] = PAGE_04
    observers = [Observer() for _ in range(5)]
    told = []
    first = graded(files, observers[0], tell=lambda *said: told.append(said))
    assert len({one.marks for one in first.learners}) == 2
    assert graded(files, observers[1], tell=lambda *said: told.append(said)) == first
    assert told == [(0, 2), (1, 2), (2, 2), (2, 2)]
    graded(files | {"ben/03.ipynb": OTHER_03}, observers[2])
    assert graded(files, observers[3], version="2").course == "2"
    graded(files, observers[4], seed=2)
    assert [len(one.jobs) for one in observers] == [2, 0, 1, 2, 2]
    assert "2.0" in str(observers[2].jobs[0].cells)
    drawn = [seed for job in observers[4].jobs for seed in job.seeds.values()]
    assert len({*drawn, 0, 2}) == 4  # from the secret, and another one for each page


def test_who_is_stopped_in_the_middle_goes_on_there(graded):
    files = {f"{n}/03.ipynb": page(source=DONE.replace("1.0", f"{n}.0")) for n in range(9)}
    with pytest.raises(KeyboardInterrupt):
        graded(files, Observer(after=5))
    rest = Observer()
    book = graded(files, rest)
    assert len(rest.jobs) == 4
    assert {status for _, _, status in rows(book)} >= {"failed"}
    assert "not attempted" not in {status for _, name, status in rows(book) if name == "03a"}


def test_an_answer_whose_worker_was_lost_is_tried_again_next_time(graded):
    book = graded({"ana/03.ipynb": PAGE_03}, Observer(Evidence(LOST)))
    mark = book.learners[0].marks[0]
    assert "was lost" in mark.evidence
    assert (mark.status, mark.points, mark.mistake) == (
        "held",
        0.0,
        "",
    )  # nobody knows what it does
    assert mark.answer == DONE
    again = Observer()
    assert graded({"ana/03.ipynb": PAGE_03}, again).learners[0].marks[0].mistake != "crashed"
    assert len(again.jobs) == 1


def test_what_reaches_inside_is_remarked_and_its_mark_stands(graded):
    observer = Observer(remarks=("line 1 calls C by ctypes",))
    book = graded({"ana/03.ipynb": PAGE_03, "ben/03.ipynb": page()}, observer)
    assert [one.marks[0].status for one in book.learners] == ["failed", "not attempted"]
    (remark,) = (one for one in book.learners[0].remarks if one.about == "reaches-inside")
    assert remark.path == "ana/03.ipynb"
    assert remark.text == "The page line 1 calls C by ctypes. The marks stand; look at it."
    again = graded({"ana/03.ipynb": PAGE_03}, Observer())  # from the ledger
    assert again.learners[0].remarks == book.learners[0].remarks
    assert not [one for one in book.learners[1].remarks if one.about == "reaches-inside"]


def test_a_page_that_shows_another_outcome_than_its_run_needs_a_person(graded):
    shown = {"application/vnd.rosbeat.outcome+json": {"exercise": "03a", "status": "passed"}}
    body = json.loads(PAGE_03)
    body["cells"][3]["outputs"] = [{"output_type": "display_data", "data": shown, "metadata": {}}]
    files = {"ana/03.ipynb": json.dumps(body), "ben/03.ipynb": PAGE_03}
    ana, ben = graded(files, Observer()).learners
    (mark,) = (one for one in ana.marks if one.differs)
    assert mark.differs.startswith("The page shows that it has passed; run from top to bottom, it")
    assert "division by zero" in mark.differs
    assert [replace(one, differs="") for one in ana.marks] == list(ben.marks)


def test_points_are_those_of_the_file_and_none_means_not_graded(graded):
    files = {"ana/03.ipynb": PAGE_03, "ana/04.ipynb": PAGE_04}
    book = graded(files, Observer(Evidence("ended")), Points({"03a": 10.0, "04a": 0.0}))
    (mark,) = book.learners[0].marks
    assert (mark.exercise, mark.out_of) == ("03a", 10.0)


def test_an_answer_that_no_cell_names_is_not_there(graded):
    gone = notebook(cell("# Write", "markdown"), cell("x = 1"), lesson="03_write")
    files = {"ben/03.ipynb": gone, "cy/notes.docx": "x"}
    missing = Evidence("ended", raised="NameError", text="name 'Beat' ...", is_missing=True)
    ben, cy = graded(files, Observer(missing)).learners
    mark, said = ben.marks[0], "No cell of the page defines it."
    assert (mark.status, mark.evidence, mark.cause) == ("not attempted", said, said)
    assert [one.about for one in cy.remarks] == ["left-out"]


PARTS = (Part("R1", "t", True), Part("R2", "t", False))


@pytest.mark.parametrize(
    ("outcome", "words"),
    [
        (Outcome("03a", "passed"), "It does what is asked."),
        (
            Outcome("13b", "passed", parts=PARTS),
            "It does what is required. Optional, and missing: R2",
        ),
        (Outcome("03a", "not attempted"), "Nothing was tried yet."),
        (Outcome("03a", "not attempted", "There is still a blank."), "There is still a blank."),
        (Outcome("03a", "failed", "One.\nTwo.", mistake="new-to-me"), "One."),
        (Outcome("03a", "failed", "One.", mistake="crashed"), "A process that crashed: One."),
        (Outcome("13b", "failed", "One.", parts=PARTS), "1 of 2 requirements are met."),
        (Outcome("03a", "failed", "a\x1b[31m\u202eb"), "a\\u001b[31m\\u202eb"),
    ],
)
def test_a_cause_is_one_sentence(outcome, words):
    assert words in cause_of(outcome)
    assert len(cause_of(outcome)) <= 400


# From evidence to an outcome.

EXERCISE = EXERCISES["03a"]
FAULT = Fault(0, "/humidity_sensor", "tick", "ZeroDivisionError", "division by zero", 3, "1 / 0")
RAISED = to_json(Observation(10**9, 1, faults=(FAULT,), subject="/humidity_sensor"))


def judged(how="ended", number=0, **more):
    return judge(EXERCISE, Evidence(how, number, **more))


@pytest.mark.parametrize(
    ("how", "number", "mistake", "words"),
    [
        ("deadline", 0, "too-long", "does not come to an end"),
        ("memory", 0, "too-much-memory", "too much memory"),
        ("output", 0, "too-much-output", "too much output"),
        ("result", 0, "too-much-output", "too much output"),
        ("signal", signal.SIGSEGV, "crashed", "SIGSEGV"),
        ("signal", signal.SIGKILL, "crashed", "SIGKILL"),
        ("signal", signal.SIGXCPU, "too-long", "does not come to an end"),
        ("signal", 127, "crashed", "signal 127"),
        ("exit", 7, "left-early", "exit code 7"),
        ("ended", 0, "left-early", "before anything could be seen"),
        (FORGED, 0, "evidence-unreadable", "no seal"),
        (LOST, 0, "crashed", "was lost"),
        ("some other word", 0, "left-early", "before anything could be seen"),
    ],
)
def test_each_ending_has_its_words(how, number, mistake, words):
    outcome = judged(how, number)
    assert (outcome.status, outcome.mistake) == ("failed", mistake)
    assert words in outcome.evidence
    assert outcome.hint
    assert (outcome.points, outcome.out_of) == (0, EXERCISE.points)
    assert mistake in MISTAKES
    if (how, number) != ("ended", 0) and how != "some other word":
        # Evidence counts only if the run came to its end.
        assert judged(how, number, seen=RAISED).mistake == mistake


@pytest.mark.parametrize(
    "seen",
    ["{", "{}", "[" * 100_000, "[" * 2_000_001, RAISED.replace('"seed":1', '"seed":"1"'),
     RAISED.replace("Observation", "Report"), RAISED.replace("1000000000", str(10**18))],
    ids=range(7),
)  # fmt: skip
def test_what_the_course_has_not_written_is_refused(seen):
    outcome = judged(seen=seen)
    assert (outcome.status, outcome.mistake) == ("failed", "evidence-unreadable")


@pytest.mark.parametrize(
    ("raised", "text", "mistake", "hint"),
    [
        ("NameError", "name '____' is not defined", "", ""),
        ("ZeroDivisionError", "division by zero", "division-by-zero", ""),
        ("<b>", "\x1b[31m\ud800", "new-to-me", ""),
        ("KeyboardInterrupt", "", "too-long", "Look for a loop"),
        ("SyntaxError", "expected ':'", "unreadable-cell", "a colon"),
        ("IndentationError", "unexpected indent", "unreadable-cell", "same column"),
        ("TabError", "inconsistent use of tabs", "unreadable-cell", "tab"),
        ("SyntaxError", "", "unreadable-cell", "a colon"),
    ],
)
def test_a_cell_that_cannot_be_run_is_told_why(raised, text, mistake, hint):
    outcome = judged(raised=raised, text=text, line=2, code="class A(Node)")
    assert (outcome.status, outcome.points) == ("failed" if mistake else "not attempted", 0)
    assert (outcome.mistake, outcome.out_of) == (mistake, EXERCISE.points)
    assert hint in outcome.hint
    if mistake == "unreadable-cell":
        assert f"Python says: {text or raised}. Line 2: `class A(Node)`." in outcome.evidence


# Two sorts of lines.

JOB = PageJob("03", (PageCell("class Beat: ...\n", 2, "03a"),), {"03a": "Beat"})


# Workers, whatever happens to any of them.


def job(word):
    return PageJob("03", (PageCell(word),), {"03a": "Beat"})


def only(evidence):
    """The evidence of the one exercise of a page."""
    return evidence.exercises["03a"]


def is_alive(pid):
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except (FileNotFoundError, ProcessLookupError):  # it may end while it is looked at
        return False


@pytest.fixture
def fakes(monkeypatch):
    """The sandboxes that workers have made, which do what the cell of a page says."""
    made = []

    def make(view, name, isolated, environment):
        made.append(FakeSandbox(isolated))
        return made[-1]

    monkeypatch.setattr(module, "Sandbox", make)
    return made


def done(pool, *words):
    return dict(pool.observe([(one, job(one))] for one in words))


def test_each_job_is_done_once_and_known_by_its_key(fakes):
    words = [f"job{number} \u00e9\ud800" for number in range(40)]
    with Pool(3) as pool:
        found = done(pool, *words)
    assert {key: only(seen).seen for key, seen in found.items()} == {one: one for one in words}
    assert sorted(word for fake in fakes for word in fake.words) == sorted(words)
    assert sum(fake.starts for fake in fakes) == 40  # two learners share nothing
    assert all(fake.isolated for fake in fakes)


def test_a_job_that_loses_two_sandboxes_is_given_up_and_the_others_go_on(fakes):
    """Two learners: the answers of one come in their order, whatever becomes of any of them."""
    words = ["die-once", "job1", "die", "job2", "forged", "job3"]
    with Pool(2, unsafe=True) as pool:
        found = dict(pool.observe([[(one, job(one)) for one in words], [("job4", job("job4"))]]))
        assert done(pool) == {}
    hows = {key: only(seen).how for key, seen in found.items()}
    assert hows == {**dict.fromkeys([*words, "job4"], "ended"), "die": LOST, "forged": FORGED}
    assert [one for one in found if one != "job4"] == words
    tried = [word for fake in fakes for word in fake.words]
    assert [tried.count(word) for word in ("die-once", "die", "job1")] == [2, 2, 1]
    assert not any(fake.isolated for fake in fakes)


def test_a_sandbox_that_cannot_start_or_be_made_is_no_fault_of_an_answer(fakes, says):
    with Pool(1) as pool, pytest.raises(GradingError) as caught:
        done(pool, "job", "refuse", "job2")
    says(caught.value, "No sandbox.", "Nothing was run.", "Try this.")
    assert fakes[0].words[:2] == ["job", "refuse"]
    with Pool(1) as pool:
        fakes[1].never_starts = True
        with pytest.raises(GradingError) as caught:
            done(pool, "job")
    says(caught.value, "does not start", "rosbeat doctor")
    assert fakes[1].words == []


def test_nothing_is_left_when_somebody_stops_in_the_middle(fakes, eventually):
    with Pool(2) as pool:
        found = pool.observe([(one, job(one))] for one in ("job", "silent", "silent", "job"))
        next(found)
        eventually(lambda: any("silent" in fake.words for fake in fakes))
    assert not pool.pids
    worker = Worker()
    assert [only(one).how for one in worker.observe([job("job")])] == ["ended"]
    worker.kill()
    assert list(worker.observe([job("job")])) == []


# What a worker gives answers, and what it believes of them.


OF_REHEARSAL = Fault(0, "/rehearsal", "__init__", "RCLError", "no type support", 5, "")
HEARD = LogRecord(1_000_000_000, "INFO", "rehearsal", "21.0", "hear", 12)


@pytest.mark.parametrize(
    ("seen", "said"),
    [
        (Evidence("signal", 9), "it ended with signal 9"),
        (Evidence("ended", text="no numpy"), "no numpy"),
        (
            Evidence("ended", seen=to_json(Observation(5, 0, faults=(OF_REHEARSAL,)))),
            "no type supp",
        ),
        (Evidence("ended", seen=to_json(Observation(5, 0))), "does not hear"),
        (Evidence("ended", seen=to_json(Observation(5, 0, logs=(HEARD,)))), ""),
    ],
    ids=["killed", "an import fails", "an exception", "silence", "a message"],
)
def test_a_rehearsal_that_fails_says_why_and_nobody_is_graded(seen, said):
    with pytest.raises(GradingError, match=said) if said else nullcontext():
        module._require_rehearsed(PageEvidence({"03a": seen}))


# For real.

CHECK = 'check("03a", HumiditySensor)'
IMPORTS = "import rclpy\nfrom rclpy.node import Node\nfrom std_msgs.msg import Float32"
RIGHT = """
class HumiditySensor(Node):
    def __init__(self):
        super().__init__("humidity_sensor")
        self.publisher = self.create_publisher(Float32, "humidity", 5)
        self.create_timer(0.5, self.tick)
        self.humidity = 45.0

    def tick(self):
        self.humidity += random.uniform(-0.5, 0.5)
        self.publisher.publish(Float32(data=self.humidity))
"""


def answer(text):
    imports = f"import random\n{IMPORTS}\nfrom rosbeat import check"
    cells = [PageCell(imports), PageCell(text, 1, "03a"), PageCell(CHECK, 2, checks=("03a",))]
    return PageJob("03", tuple(cells), {"03a": "HumiditySensor"})


@pytest.mark.ros
def test_what_is_prepared_is_all_that_an_answer_needs():
    program = (
        "from rosbeat.page_runs.worker import prepare\nprepare()\n"
        "import sys\nfrom rclpy.node import Node\nfrom std_msgs.msg import Float32\n"
        "from rosbeat.ros.scenario import observe\nknown = set(sys.modules)\n"
        "class Beat(Node):\n"
        "    def __init__(self):\n"
        "        super().__init__('beat')\n"
        "        self.out = self.create_publisher(Float32, '/beat', 5)\n"
        "        self.create_timer(0.5, self.tick)\n"
        "    def tick(self):\n"
        "        self.out.publish(Float32(data=1.0))\n"
        "        self.get_logger().info('tick')\n"
        "seen = observe(Beat, 2)\nprint(len(seen.logs), sorted(set(sys.modules) - known))"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert done.stdout.splitlines()[-1:] == ["4 []"], done.stderr


@pytest.fixture
def sleeping():
    """A worker that observes an answer that sleeps, and all of its processes."""
    text = "import subprocess, time\nsubprocess.Popen(['sleep', '600'])\ntime.sleep(600)"
    with Pool(1) as pool:
        found = pool.observe([[("a", answer("x = 1")), ("b", answer(text))]])
        next(found)
        (pid,) = pool.pids
        yield pool, found, psutil.Process(pid)
        found.close()


@pytest.mark.ros
def test_what_runs_in_a_sandbox_ends_with_it(sleeping, eventually):
    _, _, outermost = sleeping
    eventually(lambda: "sleep" in {one.name() for one in outermost.children(recursive=True)}, 30)
    all_of_them = outermost.children(recursive=True)
    assert len(all_of_them) == 3  # process 1, the page and what that has started
    outermost.kill()
    eventually(lambda: not any(is_alive(one.pid) for one in all_of_them), 20)


@pytest.mark.ros
def test_who_loses_its_sandbox_is_tried_once_more_and_given_up(sleeping, eventually):
    pool, found, _ = sleeping
    killed = set()
    for which in ("outermost", "process 1"):
        eventually(lambda: "sleep" in _names(pool), 60)
        (outermost,) = [psutil.Process(pid) for pid in pool.pids]
        (first,) = outermost.children()
        (outermost if which == "outermost" else first).kill()
        killed.add(outermost.pid)
        eventually(lambda gone=outermost.pid: not is_alive(gone), 30)
    assert only(dict(found)["b"]).how == LOST
    assert len(killed) == 2


def _names(pool):
    """The names of all processes that run in the sandboxes that are there now."""
    try:
        outermost = [psutil.Process(pid) for pid in pool.pids]
        return {one.name() for process in outermost for one in process.children(recursive=True)}
    except psutil.NoSuchProcess:
        return set()


@pytest.mark.ros
@pytest.mark.parametrize("unsafe", [False, True])
def test_it_ends_with_whoever_has_started_it(unsafe, eventually):
    program = (
        "import sys\nfrom rosbeat.page_runs.pool import Pool\n"
        "from rosbeat.page_runs.jobs import PageCell, PageJob\n"
        "sleeps = PageCell('import time\\ntime.sleep(600)', 1, '03a')\n"
        "pages = [PageJob('03', cells, {'03a': 'x'}) for cells in ((), (sleeps,))]\n"
        f"with Pool(1, {unsafe}) as pool:\n"
        "    for _ in pool.observe([list(enumerate(pages))]):\n"
        "        print(*pool.pids, flush=True)\n"
    )
    parent = subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE)
    outermost = psutil.Process(int(parent.stdout.readline()))
    eventually(lambda: outermost.children(recursive=True), 20)
    processes = [outermost, *outermost.children(recursive=True)]
    os.kill(parent.pid, signal.SIGKILL)
    parent.wait()
    parent.stdout.close()
    eventually(lambda: not any(is_alive(one.pid) for one in processes), 20)


# The workspace that a page of terminals starts from.


@pytest.fixture
def _afresh():
    files_before.cache_clear()
    yield
    files_before.cache_clear()


@pytest.mark.usefixtures("_afresh")
def test_pages_before_leave_their_folders_and_files_and_are_run_once(monkeypatch, says):
    calls = []

    def made(page, root):
        calls.append(page)
        (root / "src" / "deep").mkdir(parents=True)
        (root / "src" / "a.py").write_bytes(b"\xff\0")
        return Report(())

    monkeypatch.setattr(module, "catch_up", made)
    typed = PageJob("05", (PageCell("%%terminal a"),), {"05a": "x"}, needs_files=True)
    assert module.with_files(JOB) is JOB
    for _ in range(2):
        sent = module.with_files(typed)
        assert read_line(PageJob, to_line(sent)).files == {
            "src/": "",
            "src/a.py": "\xff\0",
            "src/deep/": "",
        }
    assert calls == ["05"]
    files_before.cache_clear()
    monkeypatch.setattr(module, "catch_up", lambda *_: Report((), ("colcon is not there.",)))
    with pytest.raises(GradingError) as caught:
        files_before("05")
    says(caught.value, "page 05", "colcon is not there.")
    monkeypatch.undo()
    files_before.cache_clear()
    assert not any("setup.py" in name for name in files_before("01"))
    assert "src/sensor_simulator/setup.py" in files_before("05")


@pytest.mark.ros
@pytest.mark.timeout(300)
def test_two_pages_of_one_learner_start_from_their_own_workspace():
    """The first makes the folder that the second is asked for, and is gone before that."""
    right = next(one for one in usable("01a") if one.status == "passed")
    wrong = next(one for one in usable("01a") if one.status == "failed")
    with Pool(1) as pool:
        seen = dict(pool.observe([[(one.status, page_of([one])) for one in (right, wrong)]]))
    found = {status: judge(EXERCISES["01a"], one.exercises["01a"]) for status, one in seen.items()}
    assert {status: one.status for status, one in found.items()} == {
        "passed": "passed",
        "failed": "failed",
    }, (found, seen)
    assert found["failed"].mistake in wrong.mistakes


@pytest.mark.ros
def test_what_does_not_end_is_ended_and_the_page_goes_on(monkeypatch):
    """A cell that no interrupt ends takes its process along; see `hostile.brief`."""
    be_brief(monkeypatch)
    idle = "__import__('time').sleep(0.01)"  # the processors are for other tests
    interrupted = f"while True:\n    {idle}"  # as a learner ends it
    goes_on = f"while True:\n    try:\n        {idle}\n    except BaseException:\n        pass"
    with Pool(1) as pool:
        texts = [interrupted, goes_on, f"import os\n{RIGHT}", f"{RIGHT}\nos._exit(3)"]
        seen = dict(pool.observe([[(n, answer(text)) for n, text in enumerate(texts)]]))
    found = [only(seen[n]) for n in range(4)]
    assert [one.how for one in found] == ["ended", "deadline", "ended", "ended"]
    assert [one.raised for one in found] == ["KeyboardInterrupt", "", "", ""]


# A page in a sandbox, and what of it goes on.

GOES_ON = [
    ("an exception", "1 / 0"),
    ("a syntax error", "class ("),
    ("exit", "exit()"),
    ("sys.exit", "import sys\nsys.exit(3)"),
    ("the end of the process", "import os\nos._exit(0)"),
    ("a crash", "import ctypes\nctypes.string_at(0)"),
    ("all descriptors closed", "import os\nos.closerange(3, 100)"),
    ("another check", "check = print"),
    ("a question", "name = input('Name?')"),
    ("a debugger", "breakpoint()"),
    ("a loop in a loop", "import asyncio\nasyncio.run(asyncio.sleep(0))"),
]


@pytest.mark.ros
@pytest.mark.parametrize("text", [text for _, text in GOES_ON], ids=[name for name, _ in GOES_ON])
def test_a_page_goes_on_after(text):
    job = answer(RIGHT)
    cells = (job.cells[0], PageCell(text, 1), *job.cells[1:])
    with Pool(1) as pool:
        ((_, seen),) = pool.observe([[(1, replace(job, cells=cells))]])
    outcome = judge(EXERCISES["03a"], only(seen))
    assert outcome.status == "passed", (outcome, only(seen))


@pytest.mark.ros
@pytest.mark.parametrize(
    ("text", "raised"),
    [
        ("name = input('Name?')", "StdinNotImplementedError"),
        ("import asyncio\nasyncio.run(asyncio.sleep(0))", "RuntimeError"),
        ("import asyncio\nawait asyncio.sleep(0)\n1 / 0", "ZeroDivisionError"),
    ],
)
def test_a_cell_raises_what_it_raises_in_a_kernel(text, raised):
    """The same texts, run by nbclient in a kernel: see `raised_in_a_kernel`."""
    job = answer(f"{text}\nclass HumiditySensor: ...")
    with Pool(1) as pool:
        ((_, seen),) = pool.observe([[(1, job)]])
    assert raised_in_a_kernel(text) == raised
    assert only(seen).raised == raised


def raised_in_a_kernel(text):
    """The name of the exception that a cell raises in a real kernel; empty if there is none."""
    body = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(text)])
    client = NotebookClient(body, allow_errors=True, kernel_name="python3")
    client.execute()
    outputs = body.cells[0].outputs
    return next((output.ename for output in outputs if output.output_type == "error"), "")
