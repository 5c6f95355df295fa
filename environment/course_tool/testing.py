"""`course test`: everything that must hold, step by step, with one verdict at the end."""

from __future__ import annotations

import os
import subprocess
import tempfile
import time
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from difflib import get_close_matches
from pathlib import Path
from xml.etree import ElementTree

from course_tool import prepare
from course_tool.layout import COURSE_ROS, LEVELS, Layout
from course_tool.problems import Problem, say
from course_tool.running import quiet

#: Steps that run at a time, before the tests.
_AT_ONCE = 2
#: Each test process may lease several of the 51 domain ids for programs.
_MOST_WORKERS = 6
_TESTS = "tests: units, ROS, pages"
#: What must hold on every distribution: the engine, beside real rclpy, with the answers to all
#: exercises, and in the fixture. Pages and the `ros2` command are for that of the course.
_ON_EVERY_ROS = ("tests/ros", "tests/conformance", "tests/bank", "tests/rosbeat/test_testing.py")


@dataclass(frozen=True)
class Verdict:
    """How a step ended, and how long it took."""

    name: str
    ok: bool
    seconds: float


@dataclass(frozen=True)
class Counts:
    """Numbers of tests."""

    passed: int
    failed: int
    skipped: int


def test(layout: Layout, arguments: Sequence[str]) -> int:
    """Run every step, or only pytest when there are arguments for it.

    `--thorough` alone runs every step, and the tests that take minutes as well. `--ros kilted` runs
    tests on another distribution than that of the course, in an environment of its own.
    """
    if not (layout.root / "tests").is_dir():
        raise Problem(
            "There are no tests in this folder.",
            "It holds what learners get, and the tests are for those who work on the course.",
            "./environment/course doctor  looks at what works here.",
        )
    ros, arguments = distribution(arguments)
    layout = replace(layout, ros=ros)
    environ = prepare.ready(layout, layout.levels[-1])
    thorough = list(arguments) == ["--thorough"]
    if arguments and not thorough:
        return subprocess.call([layout.python, "-m", "pytest", *arguments], env=environ)
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder) / "pytest.xml"
        commands = steps(layout, report, thorough)
        tests = commands.pop(_TESTS)
        verdicts = _side_by_side(commands, layout, environ)
        say(f"\n=== {_TESTS}")
        started = time.monotonic()
        code = subprocess.call(tests, env=environ, cwd=layout.root)
        verdicts.append(Verdict(_TESTS, code == 0, time.monotonic() - started))
        counts = read_counts(report)
    say(summary(verdicts, counts))
    return 0 if all(verdict.ok for verdict in verdicts) else 1


def distribution(arguments: Sequence[str]) -> tuple[str, list[str]]:
    """Return the distribution that `--ros` names, that of the course by default, and the rest.

    Raises:
        Problem: If there is no such distribution.
    """
    name, rest, words = COURSE_ROS, [], iter(arguments)
    for word in words:
        if word == "--ros":
            name = next(words, "")
        elif word.startswith("--ros="):
            name = word.removeprefix("--ros=")
        else:
            rest.append(word)
    if name not in LEVELS:
        known = " and ".join(LEVELS)
        near = get_close_matches(name.lower(), LEVELS, n=1) or [*LEVELS][-1:]
        raise Problem(
            f"There is no ROS distribution '{name}' here." if name else "--ros names nothing.",
            f"The tests run on {known}: for each there is a list of versions in environment/.",
            f"./environment/course test --ros {near[0]}\n"
            "docs/distributions.md says how to take up another one.",
        )
    return name, rest


def workers(cores: int | None) -> int:
    """Return how many processes share the tests: one more than cores, for each waits at times.

    Args:
        cores: How many cores there are; None if nobody knows.
    """
    return min(max(cores or 1, 2) + 1, _MOST_WORKERS)


def steps(layout: Layout, report: Path, thorough: bool = False) -> dict[str, list[str]]:
    """Return the commands that `course test` runs, by name and in order; tests are the last.

    On another distribution than that of the course these are tests only, and not all of them.

    Args:
        layout: The checkout, with the environment of the distribution.
        report: Where pytest writes what it counted.
        thorough: Whether to run the tests that take minutes as well.
    """
    python, rosbeat = str(layout.python), str(layout.venv / "bin" / "rosbeat")
    mypy = [python, "-m", "mypy"]
    # The order of the files is that of conftest.py, where the longest come first.
    shared = ("-n", str(workers(os.cpu_count())), "--dist", "loadfile", "--no-loadscope-reorder")
    more = ("--thorough",) if thorough else ()
    tests = [python, "-m", "pytest", *shared, f"--junitxml={report}", *more]
    if layout.ros != COURSE_ROS:
        return {_TESTS: [*tests, *_ON_EVERY_ROS]}
    tool = str(layout.environment / "course_tool")
    return {
        "lint": [python, "-m", "ruff", "check"],
        "format": [python, "-m", "ruff", "format", "--check"],
        "types": mypy,
        "types of the course tool": [*mypy, "--config-file=", "--strict", tool],
        # Solution pages are run once, by pytest, which compares them as `build --check` would.
        "pages are what their sources say": [python, rosbeat, "build", "--check", "--no-run"],
        _TESTS: tests,
    }


def read_counts(report: Path) -> Counts:
    """Return the numbers in pytest's report; no report counts as one failure."""
    try:
        suites = list(ElementTree.parse(report).getroot().iter("testsuite"))
    except (OSError, ElementTree.ParseError):
        return Counts(0, 1, 0)
    total, skipped, failures, errors = (
        sum(int(suite.get(name, "0")) for suite in suites)
        for name in ("tests", "skipped", "failures", "errors")
    )
    failed = failures + errors
    return Counts(max(0, total - failed - skipped), failed, skipped)


def summary(verdicts: Sequence[Verdict], counts: Counts) -> str:
    """Return the table of steps and the closing line, in which every other step counts as one."""
    table = [
        f"  {'passed' if verdict.ok else 'FAILED'}  {verdict.seconds:6.1f} s  {verdict.name}"
        for verdict in verdicts
    ]
    *others, tests = verdicts
    good = sum(verdict.ok for verdict in others)
    failed = counts.failed + len(others) - good
    if not tests.ok and not counts.failed:
        failed += 1  # pytest itself ended badly: nothing collected, or a crash
    closing = f"{counts.passed + good} passed, {failed} failed, {counts.skipped} skipped"
    return "\n".join(["", "=== summary", *table, "", closing])


def _side_by_side(
    commands: Mapping[str, list[str]], layout: Layout, environ: Mapping[str, str]
) -> list[Verdict]:
    """Run steps that use one core each; what they print comes in their order."""

    def run(name: str) -> tuple[Verdict, str]:
        started = time.monotonic()
        done = quiet(commands[name], environ, cwd=layout.root)
        return Verdict(name, done.ok, time.monotonic() - started), done.text

    verdicts = []
    with ThreadPoolExecutor(_AT_ONCE) as pool:
        for verdict, text in pool.map(run, commands):
            say(f"\n=== {verdict.name}\n{text.rstrip()}")
            verdicts.append(verdict)
    return verdicts
