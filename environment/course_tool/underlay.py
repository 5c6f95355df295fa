"""Makes `.venv` an underlay: `source .venv/setup.bash` activates ROS, and workspaces build on it.

The files are the course's own. Those that ament's templates make put the packages of `.venv` on
PYTHONPATH, where every other Python would find them, and do not work in a folder with a space.
"""

from __future__ import annotations

import shlex
from collections.abc import Mapping
from pathlib import Path

from course_tool import running, surroundings
from course_tool.layout import Layout

_TEMPLATES = Path(__file__).with_name("underlay_files")
_COMPLETIONS = {
    "ros2": ("ros2", "completion", "bash"),
    "colcon": ("register-python-argcomplete", "colcon"),
}


def templates() -> list[Path]:
    """Return the files that the underlay is made from."""
    return sorted(_TEMPLATES.iterdir())


def write(layout: Layout, environ: Mapping[str, str]) -> None:
    """Write the setup files of the prefix, and the completion of its commands."""
    for template in templates():
        text = filled(template.read_text(encoding="utf-8"), layout)
        # Nothing lies under this underlay, so its setup.* have nothing to add to its local_setup.*.
        for name in (template.name, template.name.removeprefix("local_")):
            (layout.venv / name).write_text(text, encoding="utf-8", errors="surrogateescape")
    write_completions(layout, surroundings.inside(environ, layout))


def filled(template: str, layout: Layout) -> str:
    """Return a template with the places of a checkout in it."""
    places = {
        "@PREFIX@": layout.venv,
        "@PYTHON@": layout.python,
        "@ENVIRONMENT@": layout.root / "src" / "rosbeat" / "environment.py",
        "@COMPLETIONS@": layout.completions,
    }
    for mark, place in places.items():
        template = template.replace(mark, shlex.quote(str(place)))
    return template


def write_completions(layout: Layout, environ: Mapping[str, str]) -> None:
    """Ask each command once how bash completes it: at the start of a shell that takes too long."""
    layout.completions.mkdir(parents=True, exist_ok=True)
    for name, (program, *arguments) in _COMPLETIONS.items():
        answer = running.quiet([layout.venv / "bin" / program, *arguments], environ, timeout=60)
        if answer.ok:
            (layout.completions / name).write_text(answer.text, encoding="utf-8")
