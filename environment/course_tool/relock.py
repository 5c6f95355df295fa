"""`course lock`, for maintainers: remakes the locks from the `.in` files."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from course_tool import failures, prepare, running
from course_tool.layout import Layout
from course_tool.messages import say

_NAMES = ("bootstrap", "build", "course", "test")


def relock(layout: Layout, options: Sequence[str]) -> int:
    """Remake every lock; versions stay unless `--upgrade` is among the options."""
    environ = prepare.ready(layout, "course")
    for name in _NAMES:
        say(f"  {name}.in -> {name}.lock")
        command = compile_command(layout, name, options)
        result = running.stream(
            command, environ, lambda line: line.startswith("error"), cwd=layout.environment
        )
        if not result.ok:
            raise failures.installing(result.text, layout.environment)
    return 0


def compile_command(layout: Layout, name: str, options: Sequence[str]) -> list[str | Path]:
    """Return the command that makes one lock, valid for every Python of the course."""
    # The tests run on the very versions that learners get.
    same_versions = ["--constraint", "course.lock"] if name == "test" else []
    return [
        *(layout.uv, "pip", "compile", "--universal", "--generate-hashes", "--quiet"),
        *("--python-version", "3.10", "--no-emit-index-url", "--no-emit-find-links"),
        *("--no-annotate", "--custom-compile-command", "./environment/course lock"),
        *("--override", "override.in"),
        *(*same_versions, *options, f"{name}.in", "--output-file", f"{name}.lock"),
    ]
