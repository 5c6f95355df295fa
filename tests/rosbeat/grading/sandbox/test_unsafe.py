"""Without a sandbox there are limits still, a folder of its own, and nothing stays behind."""

import json
import subprocess
import sys

import pytest

#: A process of its own, because the work is forked, and a test process has threads.
PROGRAM = """
import json, os, sys, time
from pathlib import Path
from rosbeat.grading.sandbox.cage import Cage
from rosbeat.grading.sandbox.limits import Limits
from rosbeat.grading.sandbox.running import run_caged
from rosbeat.grading.sandbox.unsafe import Bare

def looks(result):
    os.write(result, json.dumps([os.getcwd(), dict(os.environ)]).encode())

def loops(_):
    while True: pass

def leaves(_):
    os._exit(113)

def stays_behind(result):
    told, tells = os.pipe()
    if os.fork() == 0:
        os.setsid()
        os.write(result, str(os.getpid()).encode())
        os.write(tells, b".")
        time.sleep(600)
    os.read(told, 1)

def eats(_):
    many = []
    while True: many.append(bytearray(10_000_000))

told = {}
for work in (looks, loops, leaves, stays_behind, eats):
    cage = Cage(environment={"A": "b"}, limits=Limits(wall=2.0, memory=200_000_000))
    seen = run_caged(work, cage, Bare())
    told[work.__name__] = [seen.how, seen.number, seen.result.decode()]
told["left"] = Path("/proc", told["stays_behind"][2]).exists()
told["here"] = os.getcwd()
told["folder"] = Path(json.loads(told["looks"][2])[0]).exists()
print(json.dumps(told))
"""


@pytest.fixture(scope="module")
def told():
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM], capture_output=True, text=True, timeout=60
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_it_has_a_folder_and_an_environment_of_its_own(told):
    folder, environment = json.loads(told["looks"][2])
    assert environment == {"A": "b", "HOME": folder, "TMPDIR": folder}
    assert folder != told["here"]
    assert not told["folder"]  # it is gone afterwards


def test_limits_hold(told):
    assert told["loops"][0] == "deadline"
    assert told["eats"][0] in ("memory", "exit")


def test_an_exit_code_is_no_refusal(told):
    assert told["leaves"][:2] == ["exit", 113]


def test_what_is_left_behind_is_ended(told):
    assert told["stays_behind"][0] == "ended"
    assert told["left"] is False
