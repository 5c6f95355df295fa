"""`course test`: everything that must hold, step by step, with one verdict at the end."""

from __future__ import annotations

import subprocess
import tempfile
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree

from course_tool import prepare
from course_tool.layout import Layout
from course_tool.messages import say


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
    """Run every step, or only pytest when there are arguments for it."""
    environ = prepare.ready(layout, "test")
    if arguments:
        return subprocess.call([layout.python, "-m", "pytest", *arguments], env=environ)
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder) / "pytest.xml"
        verdicts = [_run(step, layout, environ) for step in steps(layout, report)]
        counts = read_counts(report)
    say(summary(verdicts, counts))
    return 0 if all(verdict.ok for verdict in verdicts) else 1


def steps(layout: Layout, report: Path) -> list[Step]:
    """Return what `course test` runs, in order."""
    python = str(layout.python)
    pytest = (python, "-m", "pytest", "-n", "2", "--dist", "loadfile", f"--junitxml={report}")
    tool = str(layout.environment / "course_tool")
    return [
        Step("lint", (python, "-m", "ruff", "check")),
        Step("format", (python, "-m", "ruff", "format", "--check")),
        Step("types", (python, "-m", "mypy")),
        Step(
            "types of the course tool", (python, "-m", "mypy", "--config-file=", "--strict", tool)
        ),
        Step("pages are what their sources say", (python, *_rosbeat(layout), "build", "--check")),
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


def _rosbeat(layout: Layout) -> tuple[str, ...]:
    return (str(layout.venv / "bin" / "rosbeat"),)


def _sum(suites: Sequence[ElementTree.Element], name: str) -> int:
    return sum(int(suite.get(name, "0")) for suite in suites)
