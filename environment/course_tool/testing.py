"""`course test`: everything that must hold, step by step, with one verdict at the end."""

from __future__ import annotations

import os
import subprocess
import tempfile
import time
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from xml.etree import ElementTree

from course_tool import prepare
from course_tool.layout import Layout
from course_tool.messages import Problem, say
from course_tool.running import quiet

#: Steps that run at a time, before the tests.
_AT_ONCE = 2
#: Each test process may hold several of the 51 domain ids for private sessions.
_MOST_WORKERS = 6


@dataclass(frozen=True)
class Step:
    """One thing to run."""

    name: str
    command: tuple[str, ...]


@dataclass(frozen=True)
class Verdict:
    """How a step ended."""

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

    `--thorough` alone runs every step, and the tests that take minutes as well.
    """
    if not (layout.root / "tests").is_dir():
        raise Problem(
            "There are no tests in this folder.",
            "It holds what learners get, and the tests are for those who work on the course.",
            "./environment/course doctor  looks at what works here.",
        )
    environ = prepare.ready(layout, "test")
    thorough = list(arguments) == ["--thorough"]
    if arguments and not thorough:
        return subprocess.call([layout.python, "-m", "pytest", *arguments], env=environ)
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder) / "pytest.xml"
        *short, tests = steps(layout, report, thorough)
        verdicts = [*_side_by_side(short, layout, environ), _run(tests, layout, environ)]
        counts = read_counts(report)
    say(summary(verdicts, counts))
    return 0 if all(verdict.ok for verdict in verdicts) else 1


def workers(cores: int | None) -> int:
    """Return how many processes share the tests: one more than cores, for each waits at times.

    Args:
        cores: How many cores there are; None if nobody knows.
    """
    return min(max(cores or 1, 2) + 1, _MOST_WORKERS)


def steps(layout: Layout, report: Path, thorough: bool = False) -> list[Step]:
    """Return what `course test` runs, in order; the tests are the last."""
    python = str(layout.python)
    # The order of the files is that of conftest.py, where the longest come first.
    shared = ("--dist", "loadfile", "--no-loadscope-reorder")
    number = str(workers(os.cpu_count()))
    more = ("--thorough",) if thorough else ()
    pytest = (python, "-m", "pytest", "-n", number, *shared, f"--junitxml={report}", *more)
    tool = str(layout.environment / "course_tool")
    # Solution pages are run once, by pytest, which compares them as `build --check` would.
    unrun = ("build", "--check", "--no-run")
    return [
        Step("lint", (python, "-m", "ruff", "check")),
        Step("format", (python, "-m", "ruff", "format", "--check")),
        Step("types", (python, "-m", "mypy")),
        Step(
            "types of the course tool", (python, "-m", "mypy", "--config-file=", "--strict", tool)
        ),
        Step("pages are what their sources say", (python, *_rosbeat(layout), *unrun)),
        Step("tests: units, ROS, pages", pytest),
    ]


def read_counts(report: Path) -> Counts:
    """Return the numbers in pytest's report; no report counts as one failure."""
    try:
        suites = list(ElementTree.parse(report).getroot().iter("testsuite"))
    except (OSError, ElementTree.ParseError):
        return Counts(0, 1, 0)
    total, skipped = _sum(suites, "tests"), _sum(suites, "skipped")
    failed = _sum(suites, "failures") + _sum(suites, "errors")
    return Counts(max(0, total - failed - skipped), failed, skipped)


def summary(verdicts: Sequence[Verdict], counts: Counts) -> str:
    """Return the table of steps and the closing line, in which every other step counts as one."""
    table = [
        f"  {'passed' if verdict.ok else 'FAILED'}  {verdict.seconds:6.1f} s  {verdict.name}"
        for verdict in verdicts
    ]
    others, tests = verdicts[:-1], verdicts[-1]
    passed = counts.passed + sum(verdict.ok for verdict in others)
    failed = counts.failed + sum(not verdict.ok for verdict in others)
    if not tests.ok and not counts.failed:
        failed += 1  # pytest itself ended badly: nothing collected, or a crash
    closing = f"{passed} passed, {failed} failed, {counts.skipped} skipped"
    return "\n".join(["", "=== summary", *table, "", closing])


def _run(step: Step, layout: Layout, environ: Mapping[str, str]) -> Verdict:
    say(f"\n=== {step.name}")
    started = time.monotonic()
    code = subprocess.call(step.command, env=environ, cwd=layout.root)
    return Verdict(step.name, code == 0, time.monotonic() - started)


def _side_by_side(
    steps: Sequence[Step], layout: Layout, environ: Mapping[str, str]
) -> Iterator[Verdict]:
    """Run steps that use one core each; what they print comes in their order."""
    with ThreadPoolExecutor(_AT_ONCE) as pool:
        ends = pool.map(partial(_captured, layout=layout, environ=environ), steps)
        for step, (verdict, text) in zip(steps, ends, strict=True):
            say(f"\n=== {step.name}\n{text.rstrip()}")
            yield verdict


def _captured(step: Step, layout: Layout, environ: Mapping[str, str]) -> tuple[Verdict, str]:
    started = time.monotonic()
    done = quiet(step.command, environ, cwd=layout.root)
    return Verdict(step.name, done.ok, time.monotonic() - started), done.text


def _rosbeat(layout: Layout) -> tuple[str, ...]:
    return (str(layout.venv / "bin" / "rosbeat"),)


def _sum(suites: Sequence[ElementTree.Element], name: str) -> int:
    return sum(int(suite.get(name, "0")) for suite in suites)
