"""`course bench`: the measurements, on this machine."""

from __future__ import annotations

import subprocess
from collections.abc import Sequence

from course_tool import prepare
from course_tool.layout import Layout
from course_tool.messages import Problem


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
