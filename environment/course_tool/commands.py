"""The short commands: a shell, the measurements, and the locks for maintainers."""

from __future__ import annotations

import os
import re
import shlex
import subprocess
import tempfile
from collections.abc import Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import NoReturn

from course_tool import installing, prepare, running
from course_tool.layout import COURSE_ROS, LEVELS, Layout
from course_tool.problems import Problem, say

#: The locks in the order in which they are made, and what constrains their versions. Tests run on
#: the very versions that learners get, and the hub shares their `.venv`. On another distribution
#: only the packages of ROS differ, so that a test that fails there alone shows what ROS changed.
_TEST_WITHOUT_ROS = "test.lock without ROS"
_LOCKS = {
    "bootstrap": None,
    "build": None,
    "course": None,
    "test": "course.lock",
    "site": None,
    "hub": "course.lock",
    "messages": "course.lock",
    "cmake": None,
    "compiler": None,
    **{level: _TEST_WITHOUT_ROS for ros in LEVELS if ros != COURSE_ROS for level in LEVELS[ros]},
}
_SHELL = ["bash", "--rcfile", str(Path(__file__).with_name("shellrc.bash"))]


def shell(layout: Layout, arguments: Sequence[str]) -> NoReturn:
    """Become a bash with the environment active; arguments are bash's own (`-c "command"`)."""
    environ = running.with_ros(prepare.ready(layout, "course"), layout)
    running.lease_domain(environ, layout)
    with suppress(OSError):  # the folder of the workspace, before `course lab` has filled it
        layout.learner.mkdir(parents=True, exist_ok=True)
    command = ["bash", *arguments] if arguments else interactive_shell()
    os.execvpe("bash", command, for_shells(environ, layout))


def interactive_shell() -> list[str]:
    """Return the command of a bash to type in; its environment comes from `for_shells`."""
    return list(_SHELL)


def for_shells(environ: Mapping[str, str], layout: Layout) -> dict[str, str]:
    """Return an environment in which the start file of our shells finds this tool."""
    return {**environ, "ROSBEAT_COURSE": str(layout.environment / "course")}


def variables(layout: Layout, arguments: Sequence[str]) -> int:
    """Print the shell lines that put this process's environment right.

    The user's own start file may source another ROS or put another Python first, so the shell asks
    for this after it.
    """
    clean = running.cleaned(os.environ, layout).environ
    wanted = running.with_ros(running.inside(clean, layout), layout)
    print("\n".join(shell_lines(os.environ, wanted)))
    return 0


def shell_lines(now: Mapping[str, str], wanted: Mapping[str, str]) -> list[str]:
    """Return the shell lines that turn one environment into another."""
    changed = {name: value for name, value in sorted(wanted.items()) if now.get(name) != value}
    return [
        *(f"unset {name}" for name in sorted(now) if name not in wanted),
        *(f"export {name}={shlex.quote(value)}" for name, value in changed.items()),
    ]


def bench(layout: Layout, arguments: Sequence[str]) -> int:
    """Run the benchmarks."""
    script = layout.root / "tests" / "benchmarks" / "run.py"
    if not script.exists():
        raise Problem(
            f"{script.relative_to(layout.root)} is not in this checkout.",
            "The benchmarks are files of the course, and this copy of it does not have them.",
            "Get the whole repository:  git status  shows what is missing.",
        )
    environ = prepare.ready(layout, "test")
    return subprocess.call([layout.python, script, *arguments], env=environ, cwd=layout.root)


def site(layout: Layout, arguments: Sequence[str]) -> int:
    """Build the site of the course; `docs/site/build.py` says what the arguments mean.

    Sphinx and its theme come from a lock of their own, into an environment of uv's: neither a
    learner's `.venv` nor the tests grow by them. What the site is built from, the course's own
    Python lays out: it knows the lessons.
    """
    environ = installing.for_installers(layout, prepare.ready(layout, "course"))
    here = layout.root / "docs" / "site"
    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder) / "source"
        code = subprocess.call([layout.python, here / "stage.py", source], env=environ)
        if code:
            return code
        command: list[str | Path] = [
            *(layout.uv, "run", "--quiet", "--isolated", "--no-project", "--python", layout.python),
            *("--with-requirements", layout.lock("site"), here / "build.py", "--source", source),
        ]
        return subprocess.call([*command, *arguments], env=environ)


def lock(layout: Layout, options: Sequence[str]) -> int:
    """Remake every lock; versions stay unless `--upgrade` is among the options."""
    environ = installing.for_installers(layout, prepare.ready(layout, "course"))
    with tempfile.TemporaryDirectory() as folder:
        without_ros = Path(folder) / "test-without-ros.txt"
        for name, constraint in _LOCKS.items():
            say(f"  {name}.in -> {name}.lock")
            if constraint == _TEST_WITHOUT_ROS:
                without_ros.write_text(pins_without_ros(layout), encoding="utf-8")
                constraint = str(without_ros)
            command = compile_command(layout, name, options, constraint)
            installing.install(
                command, environ, installing.install_log(layout), cwd=layout.environment
            )
    return 0


def compile_command(
    layout: Layout, name: str, options: Sequence[str], constraint: str | None = None
) -> list[str | Path]:
    """Return the command that makes one lock, valid for every Python of the course.

    Args:
        layout: The checkout.
        name: The lock.
        options: More options of `uv pip compile`.
        constraint: A file with versions that packages have if they are needed.
    """
    return [
        *(layout.uv, "pip", "compile", "--universal", "--generate-hashes", "--quiet"),
        *("--python-version", "3.10", "--no-emit-index-url", "--no-emit-find-links"),
        *("--no-annotate", "--custom-compile-command", "./environment/course lock"),
        *("--override", "override.in", *(("--constraint", constraint) if constraint else ())),
        *(*options, f"{name}.in", "--output-file", f"{name}.lock"),
    ]


def pins_without_ros(layout: Layout) -> str:
    """Return the locked versions of the tests, without the packages of ROS."""
    text = layout.lock("test").read_text(encoding="utf-8")
    pins = re.findall(r"^[\w.-]+==[^\\\n]*", text, re.MULTILINE)
    return "".join(f"{pin}\n" for pin in pins if not pin.startswith("ros-"))
