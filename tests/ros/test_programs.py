import os
import sys
import time
from pathlib import Path
from threading import Timer

import pytest

from rosbeat.domains import lease_domain
from rosbeat.ros.programs import MOST_OUTPUT, Program, log_lines, main_of, run_program

NODES = Path(__file__).parents[2] / "solutions" / "sensor_simulator" / "sensor_simulator"


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


@pytest.mark.ros
def test_main_of_a_node_runs_until_ctrl_c():
    run = run_program(NODES / "temperature_publisher.py", lambda out: "Publishing" in out, 60)
    assert (run.program, run.exit_code, run.ended_early) == ("temperature_publisher", 0, False)
    first = run.logs[0]
    assert (first.level, first.name) == ("INFO", "temperature_sensor")
    assert first.text == "Temperature Sensor Node Started"


def test_a_program_that_ends_by_itself():
    run = run_program(bash("echo out; echo err >&2; exit 3"), lambda _: False, 60)
    assert (run.exit_code, run.ended_early, run.output) == (3, True, "out\nerr\n")


def test_a_file_without_main_says_so(tmp_path):
    (tmp_path / "talk.py").write_text("print('loaded', __name__)\n")
    run = run_program(tmp_path / "talk.py", lambda _: False, 60)
    assert (run.program, run.exit_code) == ("talk", 1)
    assert "loaded talk" in run.output
    assert "no attribute 'main'" in run.output


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


def test_what_it_prints_without_end_is_bounded():
    run = run_program(["yes"], lambda out: len(out) > 1000, 60)
    assert run.exit_code == -2
    assert len(run.output) < MOST_OUTPUT + 100_000


def test_it_has_a_home_and_a_domain_of_its_own():
    words = bash("echo $HOME $ROS_DOMAIN_ID $PYTEST_CURRENT_TEST $TOLD; pwd")
    run = run_program(words, lambda _: False, 60, env={"TOLD": "yes"})
    home, domain, told, place = run.output.split()
    assert home == place
    assert not Path(home).exists()
    assert 51 <= int(domain) <= 101
    assert told == "yes"
    lease_domain(range(int(domain), int(domain) + 1)).release()  # it was given back


def test_our_own_interrupt_leaves_nothing_behind():
    mark = f"87654.{os.getpid()}"
    press = Timer(0.3, os.kill, (os.getpid(), 2))
    press.start()
    with pytest.raises(KeyboardInterrupt):
        run_program(bash(f"sleep {mark}; true"), lambda _: False, 1000)
    assert not alive(mark)


def test_a_program_that_does_not_exist():
    with pytest.raises(OSError, match="nothing-like-this"):
        run_program(["nothing-like-this"])


def test_the_command_of_a_main():
    assert main_of(Path("/a/b.py"))[0] == sys.executable


def test_log_lines_are_those_of_ros():
    text = "x\n[INFO] [a.b]: one: two\n[WARN] [c]: \n[INFO] no\n"
    assert [(log.level, log.name, log.text) for log in log_lines(text)] == [
        ("INFO", "a.b", "one: two"),
        ("WARN", "c", ""),
    ]
