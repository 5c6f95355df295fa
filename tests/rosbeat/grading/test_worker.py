"""A prepared process: what it reads, what it says, and what of a sandbox it believes."""

import io
import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from grading_files import DONE
from rosbeat.errors import GradingError
from rosbeat.exercises.evidence import to_json
from rosbeat.exercises.registry import EXERCISES
from rosbeat.grading import worker as module
from rosbeat.grading.jobs import FORGED, READY, Job, Observed, read_observed, write_line
from rosbeat.grading.judging import judge
from rosbeat.grading.pool import Pool
from rosbeat.grading.sandbox.cage import Cage
from rosbeat.grading.sandbox.running import Ending
from rosbeat.grading.sandbox.unsafe import Bare
from rosbeat.grading.worker import furnished, limits_of, main
from rosbeat.records import Fault, LogRecord, Observation

JOB = Job("03a", "Beat", DONE)
SEAL = "5ea1"


def read(result, how="ended", output=b""):
    return module._read(Ending(how, 0, result, output, 0.12345), SEAL)


def sealed(**said):
    return (SEAL + json.dumps(said)).encode()


def test_what_bears_the_seal_is_believed():
    seen = read(sealed(evidence="{}", changed=["a.b"]), output=b"hello\xff")
    assert (seen.how, seen.evidence, seen.changed) == ("ended", "{}", ("a.b",))
    assert seen.output.startswith("hello")
    assert seen.seconds == pytest.approx(0.123)


@pytest.mark.parametrize(
    "result",
    [b'{"evidence": "{}"}', b"5ea1", b"5ea1[]", b"5ea1{", b"5ea", b"x5ea1{}", b"\xff\0",
     sealed(evidence="{}") + sealed(evidence="x"), b"x" + sealed(evidence="{}"),
     b"5ea1" + b"[" * 100_000],
    ids=range(10),
)  # fmt: skip
def test_anything_else_is_forged(result):
    seen = read(result)
    assert (seen.how, seen.evidence) == (FORGED, "")


def test_nothing_is_nothing():
    assert (read(b"").how, read(b"", "deadline").how) == ("ended", "deadline")


def test_fields_of_other_types_are_left_out():
    seen = read(sealed(evidence=5, raised=["x"], text={}, line="7", code=None, changed="abc"))
    assert (seen.evidence, seen.raised, seen.text, seen.line, seen.code) == ("", "", "", 0, "")
    assert seen.changed == ()
    read_observed(write_line(seen))


def test_no_more_is_believed_than_the_course_writes():
    long = "x" * 100_000
    seen = read(sealed(evidence=long, raised=long, text=long, code=long, changed=[long] * 99))
    assert seen.evidence == long  # how long it may be is decided where it is read
    assert {len(one) for one in (seen.raised, seen.text, seen.code, *seen.changed)} == {2_000}
    assert len(seen.changed) == 5


@pytest.mark.parametrize(("line", "wanted"), [(7, 7), (True, 0), (10**30, 0), (1.5, 0)])
def test_a_line_is_the_number_of_a_line(line, wanted):
    assert read(sealed(raised="x", line=line)).line == wanted


def test_output_is_cut():
    assert len(read(b"", output=b"x" * 64_000).output) == 2_000


def test_a_page_gets_more_than_an_answer():
    answer, page = limits_of(JOB), limits_of(Job("01a", "x", "y", replay=("y",)))
    assert page.wall > answer.wall
    assert page.processes > answer.processes


def test_the_sandbox_has_no_answers_in_it_and_nothing_of_this_environment(monkeypatch):
    monkeypatch.setenv("MY_SECRET", "x")
    monkeypatch.setenv("HOME", "/somewhere")
    cage = furnished()
    hidden = {Path(one).name for one in cage.hidden}
    assert hidden >= {"solved", "clinic", "grading", "authoring", "finished"}
    assert all(Path(one).is_dir() for one in cage.hidden)
    assert "MY_SECRET" not in cage.environment
    assert cage.environment["HOME"] == "/tmp"
    assert {"PATH", "HOME"} <= set(cage.environment)


@pytest.fixture
def told(monkeypatch):
    """What a worker answers to lines, when sandboxes are made up."""
    monkeypatch.setattr(module, "prepare", tuple)
    monkeypatch.setattr(module, "furnished", Cage)
    monkeypatch.setattr(module, "Sandboxes", lambda _: Bare())

    def tell(*lines, run=None):
        def caged(work, cage, place):
            return (run or (lambda: Ending("ended", 0, b"", b"", 0.0)))()

        monkeypatch.setattr(module, "run_caged", caged)
        monkeypatch.setattr(module, "rehearse", lambda *_: None)
        answers = io.StringIO()
        main(io.StringIO("".join(f"{line}\n" for line in lines)), answers)
        return answers.getvalue().splitlines()

    return tell


def test_each_line_gets_one_line_after_it_is_ready(told):
    said = told(write_line(JOB), write_line(JOB))
    assert said[0] == READY
    assert [read_observed(line).how for line in said[1:]] == ["ended", "ended"]


def test_a_line_that_is_no_job_is_refused_and_the_next_is_done(told):
    _, refused, seen = told("no job", write_line(JOB))
    assert len(json.loads(refused)["refused"]) == 3
    assert read_observed(seen).how == "ended"


def test_a_sandbox_that_cannot_be_made_is_told_in_three_parts(told):
    def fails():
        raise module.GradingError("a", "b", "c")

    assert json.loads(told(write_line(JOB), run=fails)[1]) == {"refused": ["a", "b", "c"]}


# For real.

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


def job(text):
    return Job("03a", "HumiditySensor", text, imports=f"import random\n{IMPORTS}")


@pytest.mark.ros
def test_an_answer_is_observed_and_whatever_it_does_costs_no_other():
    texts = {
        "right": RIGHT,
        "leaves": "import os\nos._exit(0)",
        "leaves with the code of a sandbox that was not made": "import os\nos._exit(113)",
        "kills itself": "import os\nos.kill(os.getpid(), 9)",
        "kills all": "import os\nos.kill(-1, 9)",
        "ends the cell": f"{RIGHT}\nraise SystemExit(3)",
        "raises": "1 / 0",
        "writes a result": f"import os\nos.write(3, b'{{}}')\n{RIGHT}",
        "right again": RIGHT + "\n",
    }
    with Pool(1) as pool:
        seen = dict(pool.observe((name, job(text)) for name, text in texts.items()))
    outcomes = {name: judge(EXERCISES["03a"], one) for name, one in seen.items()}
    passed = {name for name, one in outcomes.items() if one.status == "passed"}
    assert passed == {"right", "right again", "ends the cell"}, outcomes
    mistakes = {name: one.mistake for name, one in outcomes.items() if name not in passed}
    assert mistakes == {
        "leaves": "left-early",
        "leaves with the code of a sandbox that was not made": "left-early",
        "kills itself": "crashed",
        "kills all": mistakes["kills all"],
        "raises": "division-by-zero",
        "writes a result": "evidence-unreadable",
    }
    assert mistakes["kills all"] in ("crashed", "left-early", "new-to-me")


@pytest.mark.ros
def test_what_is_prepared_is_all_that_an_answer_needs():
    program = (
        "from rosbeat.grading.worker import prepare\nprepare()\n"
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


@pytest.mark.ros
def test_it_ends_with_whoever_has_started_it(eventually):
    program = (
        "import sys, time\nfrom rosbeat.grading.pool import Worker\n"
        "print(Worker().pid, flush=True)\ntime.sleep(600)"
    )
    parent = subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE)
    worker = int(parent.stdout.readline())
    os.kill(parent.pid, signal.SIGKILL)
    parent.wait()
    parent.stdout.close()
    eventually(lambda: not is_alive(worker), 20)


def is_alive(pid):
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


FAULT = Fault(0, "/rehearsal", "__init__", "RCLError", "no type support", 5, "")
HEARD = LogRecord(1_000_000_000, "INFO", "rehearsal", "21.0", "hear", 12)


@pytest.mark.parametrize(
    ("seen", "said"),
    [
        (Observed("signal", 9), "it ended with signal 9"),
        (Observed("ended", text="no numpy"), "no numpy"),
        (Observed("ended", evidence=to_json(Observation(5, 0, faults=(FAULT,)))), "no type supp"),
        (Observed("ended", evidence=to_json(Observation(5, 0))), "does not hear"),
    ],
    ids=["killed", "an import fails", "an exception", "silence"],
)
def test_a_rehearsal_that_fails_says_why_and_nobody_is_graded(seen, said, monkeypatch):
    monkeypatch.setattr(module, "observed", lambda *_: seen)
    with pytest.raises(GradingError, match=said):
        module.rehearse(Cage(), (), Bare())


def test_a_rehearsal_in_which_a_message_arrives_is_one(monkeypatch):
    seen = Observed("ended", evidence=to_json(Observation(5, 0, logs=(HEARD,))))
    monkeypatch.setattr(module, "observed", lambda *_: seen)
    module.rehearse(Cage(), (), Bare())
