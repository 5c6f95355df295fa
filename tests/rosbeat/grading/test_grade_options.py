"""What is typed after `rosbeat grade`."""

import argparse
import subprocess
import sys
from pathlib import Path

import pytest

from rosbeat.grading.grade_options import arguments


def parsed(*words):
    parser = argparse.ArgumentParser()
    arguments(parser)
    return parser.parse_args(words)


def test_two_folders_are_enough():
    options = parsed("class", "--out", "grades")
    assert (options.submissions, options.out) == (Path("class"), Path("grades"))
    assert (options.lessons, options.points, options.due, options.workers) == ((), None, None, None)
    assert not options.unsafe_no_sandbox


def test_everything_can_be_said():
    options = parsed("class.zip", "--out", "g", "--lessons", "03", "04", "--points", "p.csv",
                     "--due", "2026-11-30", "--workers", "3", "--unsafe-no-sandbox")  # fmt: skip
    assert list(options.lessons) == ["03", "04"]
    assert (options.points, options.due) == (Path("p.csv"), "2026-11-30")
    assert (options.workers, options.unsafe_no_sandbox) == (3, True)


@pytest.mark.parametrize(
    "words", [("--workers", "0"), ("--workers", "x"), ("--workers", "-1"), ("--workers", "1.5")]
)
def test_a_number_that_makes_no_sense_is_refused(words, capsys):
    with pytest.raises(SystemExit):
        parsed("class", "--out", "g", *words)
    assert f"'{words[1]}' is no whole number from" in capsys.readouterr().err


def test_help_says_when_a_day_ends_and_that_late_costs_nothing():
    parser = argparse.ArgumentParser()
    arguments(parser)
    said = " ".join(parser.format_help().split())
    assert "2026-11-30 for the end of that day; takes no points" in said


@pytest.mark.parametrize("words", [(), ("class",), ("--out", "g"), ("a", "--out", "g", "--wrong")])
def test_what_is_missing_or_unknown_is_refused(words, capsys):
    with pytest.raises(SystemExit):
        parsed(*words)
    assert "usage" in capsys.readouterr().err


def test_reading_them_imports_nothing_of_ros():
    program = (
        "import sys, argparse\nfrom rosbeat.grading.grade_options import arguments\n"
        "arguments(argparse.ArgumentParser())\nprint('rclpy' in sys.modules)"
    )
    done = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True
    )
    assert done.stdout == "False\n"
