"""The commands, and how whatever goes wrong in them is said."""

import errno
import os
import subprocess
import sys
from pathlib import Path

import pytest

from course_tool import cli, commands, prepare, testing
from course_tool.problems import Problem
from course_tool.testing import Counts, Verdict

ENVIRONMENT = Path(__file__).parents[2] / "environment"


def run(monkeypatch, error):
    def command(layout, arguments):
        raise error

    monkeypatch.setitem(cli._COMMANDS, "doctor", command)
    return cli.main(["doctor"])


@pytest.mark.parametrize("arguments", [[], ["help"], ["--help"], ["-h"]])
def test_help(arguments, capsys):
    assert cli.main(arguments) == 0
    out = capsys.readouterr().out
    for name in ("lab", "reset", "update", "shell", "doctor", "test", "bench", "lock"):
        assert f"\n  {name} " in out


@pytest.mark.parametrize(
    ("typed", "meant"), [("lap", "lab"), ("tests", "test"), ("docter", "doctor")]
)
def test_a_slip_is_understood(typed, meant, capsys):
    assert cli.main([typed]) == 1
    assert f"Did you mean:  ./environment/course {meant}\n" in capsys.readouterr().err


def test_an_unknown_word_gets_the_list(capsys):
    assert cli.main(["xyzzy"]) == 1
    err = capsys.readouterr().err
    assert (
        "lab, reset, update, shell, add, remove, doctor, test, bench, site, hub, lock and help"
        in err
    )
    assert "variables" not in err


@pytest.mark.parametrize(
    ("error", "code", "words"),
    [
        (Problem("a", "b", "c,\nor d", "first\nlast\n"), 1,
         "\nWhat happened:       a\nWhat it means here:  b\nWhat to try:         c,\n"
         "                     or d\n\nIts last words:\n    first\n    last\n\n"),
        (OSError(errno.ENOSPC, "full", "/file"), 1, "/file cannot be read or written (full)."),
        (OSError(errno.EACCES, "no", "/some/file"), 1, 'sudo chown -R "$USER" '),
        (OSError(errno.EIO, "no", "/some/file"), 1, "does not know"),
        (RuntimeError("oh"), 1, "RuntimeError: oh"),  # and never a bare traceback
        (KeyboardInterrupt(), 130, ""),
    ],
)  # fmt: skip
def test_whatever_goes_wrong_is_said_in_three_parts(monkeypatch, capsys, error, code, words):
    assert run(monkeypatch, error) == code
    out, err = capsys.readouterr()
    assert words in err
    assert ("What happened:" in err) == ("What to try:" in err) == bool(words)
    assert bool(out) != bool(err)


def test_a_reader_that_has_read_enough_is_no_fault_of_the_course():
    reads, writes = os.pipe()
    os.close(reads)
    command = [sys.executable, "-I", ENVIRONMENT / "course_tool", "help"]
    try:
        done = subprocess.run(command, stdout=writes, stderr=subprocess.PIPE, timeout=100)
    finally:
        os.close(writes)
    assert (done.returncode, done.stderr) == (1, b"")


PYTEST_REPORT = """<?xml version="1.0" encoding="utf-8"?>
<testsuites name="pytest tests"><testsuite name="pytest" errors="1" failures="2" skipped="3"
tests="20" time="1.0"></testsuite></testsuites>"""


@pytest.mark.parametrize(("cores", "number"), [(None, 3), (1, 3), (2, 3), (4, 5), (64, 6)])
def test_one_more_process_than_cores_shares_the_tests(cores, number):
    assert testing.workers(cores) == number


def test_pytests_report_is_read(tmp_path):
    (tmp_path / "report.xml").write_text(PYTEST_REPORT)
    assert testing.read_counts(tmp_path / "report.xml") == Counts(14, 3, 3)


@pytest.mark.parametrize("text", [None, "", "<cut off"])
def test_no_report_is_a_failure(tmp_path, text):
    if text is not None:
        (tmp_path / "report.xml").write_text(text)
    assert testing.read_counts(tmp_path / "report.xml") == Counts(0, 1, 0)


def closing(ok, counts):
    verdicts = [Verdict("lint", ok[0], 0.1), Verdict("tests", ok[1], 2.0)]
    return testing.summary(verdicts, counts).splitlines()[-1]


def test_the_closing_line_counts_everything():
    assert closing((True, True), Counts(14, 0, 3)) == "15 passed, 0 failed, 3 skipped"
    assert closing((False, True), Counts(14, 0, 0)) == "14 passed, 1 failed, 0 skipped"
    assert closing((True, False), Counts(14, 2, 0)) == "15 passed, 2 failed, 0 skipped"
    # A crash of pytest itself.
    assert closing((True, False), Counts(0, 0, 0)) == "1 passed, 1 failed, 0 skipped"


def test_every_step_runs_and_one_failure_is_enough(layout, monkeypatch, capsys):
    ran = []
    (layout.root / "tests").mkdir()

    def call(command, env, cwd):
        ran.append(command)
        return 0

    def run(command, **_):
        ran.append(command)
        bad = "ruff" in command
        return subprocess.CompletedProcess(command, int(bad), f"what {command[2]} says\n")

    monkeypatch.setattr(prepare, "ready", lambda layout, level: {"LEVEL": level})
    monkeypatch.setattr(testing.subprocess, "call", call)
    monkeypatch.setattr(testing.subprocess, "run", run)
    assert testing.test(layout, []) == 1
    assert len(ran) == 6
    out = capsys.readouterr().out
    assert "FAILED" in out
    assert "=== lint\nwhat ruff says\n\n=== format\nwhat ruff says\n\n=== types\n" in out
    assert out.splitlines()[-1] == "3 passed, 3 failed, 0 skipped"


def test_arguments_go_to_pytest_alone(layout, monkeypatch):
    ran = []
    (layout.root / "tests").mkdir()
    monkeypatch.setattr(prepare, "ready", lambda layout, level: {})
    monkeypatch.setattr(testing.subprocess, "call", lambda command, env: ran.append(command) or 5)
    assert testing.test(layout, ["-k", "clock"]) == 5
    assert ran == [[layout.python, "-m", "pytest", "-k", "clock"]]


@pytest.fixture
def ran(layout, monkeypatch):
    """What `course test` runs, and in which environment."""
    ran = []
    (layout.root / "tests").mkdir()

    def call(command, env, cwd=None):
        ran.append((env["VENV"], [str(word) for word in command]))
        return 0

    def ready(layout, level):
        return {"VENV": f"{layout.venv.name} {level}"}

    monkeypatch.setattr(prepare, "ready", ready)
    monkeypatch.setattr(testing.subprocess, "call", call)
    return ran


@pytest.mark.parametrize("words", [["--ros", "kilted"], ["--ros=kilted"]])
def test_on_another_distribution_the_tests_of_the_engine_run_alone(layout, ran, words, capsys):
    assert testing.test(layout, [*words, "--thorough"]) == 0
    ((venv, command),) = ran
    assert venv == ".venv-kilted kilted"
    assert command[:3] == [str(layout.root / ".venv-kilted" / "bin" / "python"), "-m", "pytest"]
    where = command.index("--thorough") + 1
    assert {"tests/ros", "tests/conformance", "tests/bank"} < set(command[where:])
    root = ENVIRONMENT.parent
    assert all((root / place).exists() for place in command[where:])
    assert "=== summary" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("words", "venv"),
    [
        (["-k", "clock", "--ros", "kilted"], ".venv-kilted kilted"),
        (["--ros", "kilted", "-k", "clock"], ".venv-kilted kilted"),
        (["--ros", "jazzy", "-k", "clock"], ".venv test"),
    ],
)
def test_further_arguments_go_to_pytest_alone_there_too(layout, ran, words, venv):
    assert testing.test(layout, words) == 0
    ((environment, command),) = ran
    assert (environment, command[1:]) == (venv, ["-m", "pytest", "-k", "clock"])


@pytest.mark.parametrize(
    ("words", "happened", "cure"),
    [
        (["--ros", "kitled"], "There is no ROS distribution 'kitled' here.", "--ros kilted"),
        (["--ros=Jazzy"], "There is no ROS distribution 'Jazzy' here.", "--ros jazzy"),
        (["--ros", "lyrical"], "There is no ROS distribution 'lyrical' here.", "--ros kilted"),
        (["-q", "--ros"], "--ros names nothing.", "--ros kilted"),
    ],
)
def test_an_unknown_distribution_is_said_in_three_parts(layout, ran, words, happened, cure):
    with pytest.raises(Problem) as caught:
        testing.test(layout, words)
    assert caught.value.happened == happened
    assert "jazzy and kilted" in caught.value.means
    assert cure in caught.value.cure
    assert ran == []


def test_without_tests_nothing_is_installed(layout):
    with pytest.raises(Problem, match="no tests in this folder"):
        testing.test(layout, [])


def test_the_shell_is_told_only_what_differs():
    now = {"A": "1", "GONE": "x", "PATH": "/bin"}
    wanted = {"A": "1", "NEW": "two words; and $more", "PATH": "/venv/bin:/bin"}
    assert commands.shell_lines(now, wanted) == [
        "unset GONE",
        "export NEW='two words; and $more'",
        "export PATH=/venv/bin:/bin",
    ]


def test_bench_says_when_its_files_are_missing(layout):
    with pytest.raises(Problem, match="not in this checkout"):
        commands.bench(layout, [])
