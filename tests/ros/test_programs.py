"""Programs in processes of their own: started, watched, and ended with Ctrl+C."""

import os
import time
from pathlib import Path
from tempfile import TemporaryDirectory
from threading import Timer

import pytest

from rosbeat.domains import PRIVATE_IDS, lease_domain
from rosbeat.ros.programs import Program, private_domain, program_environment


def bash(text):
    return ["bash", "-c", text]


def alive(mark):
    """The processes with a mark in their command line."""
    found = []
    for pid in filter(str.isdigit, os.listdir("/proc")):
        try:
            found += [pid] if mark.encode() in Path(f"/proc/{pid}/cmdline").read_bytes() else []
        except OSError:
            continue
    return found


def run(command, until=bool, seconds=60):
    """Run a program until its output is as wanted, then press Ctrl+C."""
    with TemporaryDirectory() as folder, private_domain() as domain:
        home = Path(folder)
        with Program(command, program_environment(home, domain), home) as program:
            program.wait(until, seconds)
            return program.finish()


def test_a_program_that_ends_by_itself():
    done = run(bash("echo out; echo err >&2; exit 3"), lambda _: False)
    assert (done.exit_code, done.ended_early, done.output) == (3, True, "out\nerr\n")


def test_a_program_that_ignores_ctrl_c_is_killed_with_its_children(tmp_path):
    mark = f"98765.{os.getpid()}"
    words = bash(f"trap '' INT TERM HUP; sleep {mark} & echo go; sleep {mark}")
    with Program(words, dict(os.environ), tmp_path) as program:
        assert program.wait(lambda out: "go" in out, 60)
        run = program.finish(grace=0.2)
    assert run.exit_code is None
    deadline = time.monotonic() + 60
    while alive(mark):
        assert time.monotonic() < deadline
        time.sleep(0.01)


def test_it_has_a_home_and_a_domain_of_its_own():
    words = bash("echo $HOME $ROS_DOMAIN_ID $PYTEST_CURRENT_TEST; pwd")
    done = run(words, lambda _: False)
    home, domain, place = done.output.split()
    assert home == place
    assert not Path(home).exists()
    assert int(domain) in PRIVATE_IDS
    lease_domain(range(int(domain), int(domain) + 1)).release()  # it was given back


def test_our_own_interrupt_leaves_nothing_behind():
    mark = f"87654.{os.getpid()}"
    press = Timer(0.3, os.kill, (os.getpid(), 2))
    press.start()
    with pytest.raises(KeyboardInterrupt):
        run(bash(f"sleep {mark}; true"), lambda _: False, 1000)
    assert not alive(mark)


def test_its_log_lines_carry_the_time_at_which_they_were_read():
    text = "echo '[INFO] [a.b]: one 1'; echo no log line; until [ -e go ]; do sleep 0.01; done; "
    text += "echo '[WARN] [a]: two'; printf '[INFO] [a]: not yet a line'; sleep 60"
    with TemporaryDirectory() as folder, private_domain() as domain:
        before, home = time.time_ns(), Path(folder)
        with Program(bash(text), program_environment(home, domain), home) as program:
            assert program.wait(lambda out: "no log line" in out, 60)
            between = time.time_ns()
            (home / "go").touch()
            assert program.wait(lambda out: "not yet a line" in out, 60)
            logs = program.logs()
            later = program.logs(program.output.index("[WARN]"))
    assert [(log.level, log.name, log.text) for log in logs] == [
        ("INFO", "a.b", "one 1"),
        ("WARN", "a", "two"),
    ]
    assert before <= logs[0].time_ns <= between <= logs[1].time_ns <= time.time_ns()
    assert later == logs[1:]
