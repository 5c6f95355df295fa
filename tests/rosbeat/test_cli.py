from __future__ import annotations

import dataclasses
import subprocess
import sys

import pytest

from rosbeat import __version__, cli
from rosbeat.errors import RosbeatError, StoppedError


@pytest.fixture
def course(tmp_path, monkeypatch):
    (tmp_path / "src" / "lessons").mkdir(parents=True)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def command(work):
    return cli.Command("work", "does it", lambda parser: None, work)


@pytest.mark.parametrize(
    ("typed", "module", "expected"),
    [
        (["progress"], "msgspec", 'pip install "rosbeat[course]"'),
        (["grade", "x", "--out", "y"], "jinja2.utils", 'pip install "rosbeat[class]"'),
        (["explain", "count"], "rclpy", 'pip install "rosbeat[course,ros]"'),
        (["explain", "count"], "std_msgs.msg", "Source your ROS 2"),
    ],
)
def test_a_package_that_is_missing_is_told_with_its_extra(
    monkeypatch, capsys, typed, module, expected
):
    def work(options):
        raise ModuleNotFoundError(f"No module named {module!r}", name=module)

    commands = [dataclasses.replace(known, run=work) for known in cli.COMMANDS]
    monkeypatch.setattr(cli, "COMMANDS", tuple(commands))
    assert cli.main(typed) == cli.FAILED
    said = capsys.readouterr().err
    assert module.partition(".")[0] in said
    assert expected in said
    assert all(part in said for part in ("What it means:", "What to try:"))


def test_a_module_of_ours_that_is_missing_is_our_mistake(monkeypatch, capsys):
    def work(options):
        raise ModuleNotFoundError("No module named 'rosbeat.cellar'", name="rosbeat.cellar")

    monkeypatch.setattr(cli, "COMMANDS", (command(work),))
    assert cli.main(["work"]) == cli.FAILED
    assert "a mistake in rosbeat" in capsys.readouterr().err


def test_help_names_every_command(capsys):
    assert cli.main([]) == 0
    text = capsys.readouterr().out
    assert all(f"\n  {one.name} " in text and one.help in text for one in cli.COMMANDS)
    for_whom = ["for learners:", "doctor", "for instructors:", "for authors of pages:", "lint"]
    assert sorted(for_whom, key=text.index) == for_whom


def test_the_doctor_answers_in_any_folder(monkeypatch, tmp_path, capsys):
    monkeypatch.chdir(tmp_path)
    cli.main(["doctor"])
    said = capsys.readouterr().out
    assert "message heard" in said
    # What it advises can be typed here.
    assert " ./environment/course" not in said


def test_version_is_the_packages(capsys):
    with pytest.raises(SystemExit):
        cli.main(["--version"])
    assert capsys.readouterr().out.strip() == f"rosbeat {__version__}"


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        (["biuld"], "Did you mean `rosbeat build`?"),
        (["xyzzy"], "The commands are: progress, "),
        (["build", "--wrong"], "--help"),
    ],
)
def test_misuse_says_what_to_try_and_ends_with_2(arguments, expected, capsys):
    assert cli.main(arguments) == cli.MISUSED
    said = capsys.readouterr().err
    assert expected in said
    assert "Traceback" not in said
    assert all(part in said for part in ("What it means:", "What to try:"))


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        (["release"], "The following arguments are required: DIR."),
        (["grade", "x", "--out", "y", "--points"], "Argument --points: expected one argument."),
        (["grade", "x", "--out", "y", "--workers", "x"], "'x' is not a whole number from 1 on."),
        (["grade", "x", "--out", "y", "--missing", "x"], "Argument --missing: invalid choice"),
    ],
)
def test_an_argument_that_is_missing_or_wrong_is_told_in_three_parts(arguments, expected, capsys):
    assert cli.main(arguments) == cli.MISUSED
    said = capsys.readouterr().err
    assert all(part in said for part in (expected, "What it means:", "What to try:"))
    assert f"\n{' ' * 17}rosbeat {arguments[0]} " in said
    assert max(map(len, said.splitlines())) <= 100


def test_an_empty_course_builds_and_lints(course, capsys):
    assert cli.main(["build", "--check"]) == 0
    assert cli.main(["lint"]) == 0
    assert "0 lessons, 0 findings" in capsys.readouterr().out


def test_findings_are_printed_and_end_with_1(course, capsys):
    (course / "src" / "lessons" / "00_hear_it.py").write_text(
        "# ---\n# title: Hear it\n# minutes: 1\n# needs: []\n# summary: x\n# ---\n# %%\n1\n"
    )
    assert cli.main(["lint"]) == cli.FAILED
    assert "src/lessons/00_hear_it.py:1: title:" in capsys.readouterr().out


def test_an_error_of_ours_has_three_parts(course, capsys):
    (course / "src" / "lessons" / "hear.py").write_text("")
    assert cli.main(["build"]) == cli.FAILED
    said = capsys.readouterr().err
    assert all(part in said for part in ("NN_slug", "What it means:", "What to try:"))


@pytest.mark.parametrize(
    ("error", "code", "expected"),
    [
        (RosbeatError("no.", "means", "try"), cli.FAILED, "What to try:   try"),
        (PermissionError(13, "Permission denied", "x.ipynb"), cli.FAILED, "(x.ipynb)"),
        (KeyError("lost"), cli.FAILED, "a mistake in rosbeat"),
        (KeyboardInterrupt(), cli.INTERRUPTED, "What it means: You stopped the command"),
        (StoppedError("stopped.", "kept", "again"), cli.INTERRUPTED, "What to try:   again"),
    ],
)
def test_no_error_ends_in_a_traceback(error, code, expected, capsys, monkeypatch):
    def work(options):
        raise error

    monkeypatch.setattr(cli, "COMMANDS", (command(work),))
    assert cli.main(["work"]) == code
    assert expected in capsys.readouterr().err


def test_a_mistake_of_ours_can_be_traced(monkeypatch):
    def work(options):
        raise KeyError("lost")

    monkeypatch.setattr(cli, "COMMANDS", (command(work),))
    with pytest.raises(KeyError):
        cli.main(["work", "--traceback"])


def test_python_m_rosbeat_is_rosbeat_and_needs_neither_ros_nor_jupyter():
    code = (
        "import sys; from rosbeat.cli import main; main([]); "
        "print({'rclpy', 'nbclient', 'jupytext', 'matplotlib'} & set(sys.modules))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip().endswith("set()")
    done = subprocess.run(
        [sys.executable, "-m", "rosbeat", "biuld"], capture_output=True, text=True, check=False
    )
    assert done.returncode == cli.MISUSED


def test_sigterm_ends_a_command_with_a_sentence_and_130():
    code = (
        "import os, signal, sys, time\n"
        "from rosbeat import cli\n"
        "def work(options):\n"
        "    os.kill(os.getpid(), signal.SIGTERM)\n"
        "    time.sleep(60)\n"
        "cli.COMMANDS = (cli.Command('work', 'x', lambda parser: None, work),)\n"
        "sys.exit(cli.main(['work']))\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == cli.INTERRUPTED
    assert "You stopped the command before it was done" in done.stderr
