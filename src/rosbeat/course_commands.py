"""`rosbeat new` and `rosbeat doctor`: what the course's own tool does, typed in any folder.

`rosbeat new` makes a folder with the course's pages, for a learner who has no checkout.
A wheel brings the pages, and the tool that makes `my_course` in a checkout, in its folder `course`
(`pyproject.toml`). The same tool makes the learner's folder here, so that both are the same.
"""

from __future__ import annotations

import os
import shlex
import shutil
import sys
import tempfile
from collections.abc import Sequence
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from types import SimpleNamespace

from rosbeat.environment import learners_folder
from rosbeat.errors import RosbeatError

__all__ = ["doctor", "lay_out", "next_steps"]

#: What a wheel brings of the course for learners; a checkout has no such folder.
_COURSE = Path(__file__).resolve().with_name("course")
_RCLPY = Path("share", "ament_index", "resource_index", "packages", "rclpy")
#: Of what the extra `course` brings: without these, no page opens, or none gets far.
_OF_THE_EXTRA = ("jupyterlab", "matplotlib", "msgspec")
_NOTHING_DONE = "The pages are laid out in a folder of their own. Nothing was changed."


def lay_out(folder: Path, pages: Sequence[str] = ()) -> None:
    """Make the learner's folder, or add to it what this version of the course has new.

    The environment that rosbeat is installed in becomes an underlay, as `.venv` of a checkout is:
    colcon, `ros2` and JupyterLab's terminals find ROS in it.

    Args:
        folder: The folder; the work in a folder that was made before is kept.
        pages: Pages that somebody has worked in, of which to take the new version.

    Raises:
        RosbeatError: If this is a checkout, if ROS or the extra is not installed, or if the folder
            belongs to something else or cannot be written to.
    """
    _require_wheel()
    _require_ros(Path(sys.prefix))
    _require_extra()
    target = folder.expanduser().absolute()
    is_new = _require_place(target)
    tool = _course_tool(_COURSE)
    layout = tool.layout.Layout(_COURSE, prefix=Path(sys.prefix), own=target)
    try:
        tool.folder.make(layout)
        if not is_new:
            tool.folder.update(layout, pages)
        tool.installing.write_ours(layout, os.environ)
    except tool.problems.Problem as problem:
        raise RosbeatError(problem.happened, problem.means, problem.cure) from None


def next_steps(folder: Path) -> str:
    """Return what to type to open the pages, one command in each line.

    Args:
        folder: The learner's folder.
    """
    lines = [f"cd {shlex.quote(str(folder))}", "jupyter lab home.ipynb"]
    binaries = Path(sys.prefix, "bin")
    found = shutil.which("jupyter")
    if (not found or Path(found).parent != binaries) and (binaries / "activate").exists():
        lines.insert(0, f"source {shlex.quote(str(binaries / 'activate'))}")
    said = ["Open them:", *(f"    {line}" for line in lines)]
    if not Path(sys.prefix, _course_tool(_COURSE).installing.KERNEL_CONFIG).exists():
        said.append("On each page, run `import rosbeat` first: this environment can't be changed.")
    return "\n".join(said)


def doctor() -> int:
    """Print what works here, with the cure for what does not; return 1 if something needs one.

    Raises:
        RosbeatError: If nothing of the course but its Python package is installed.
    """
    checkout = Path(__file__).resolve().parents[2]
    if _COURSE.is_dir():
        tool = _course_tool(_COURSE)
        own = Path(learners_folder() or Path.cwd())
        layout = tool.layout.Layout(_COURSE, prefix=Path(sys.prefix), own=own)
    elif (checkout / "environment" / "course_tool").is_dir():
        tool = _course_tool(checkout)
        layout = tool.layout.of_this_checkout()
    else:
        raise RosbeatError(
            f"Nothing of the course but the package {Path(__file__).parent} is here.",
            "That is enough for tests of your own nodes; the doctor looks at the rest.",
            'Install the course:  pip install "rosbeat[course,ros]"',
        )
    return int(tool.doctor.doctor(layout, ()))


def _require_wheel() -> None:
    if not _COURSE.is_dir():
        raise RosbeatError(
            "This rosbeat belongs to a checkout of the course, which has a folder for your pages.",
            "`rosbeat new` is for an installation with pip. Nothing was changed.",
            "Type in the checkout:  ./environment/course lab",
        )


def _require_ros(prefix: Path) -> None:
    if not (prefix / _RCLPY).exists():
        raise RosbeatError(
            f"There is no ROS 2 in the Python environment {prefix}.",
            "Every page runs ROS 2 nodes, so no page would work. Nothing was changed.",
            "Install it in an environment of its own:\n"
            "    python3 -m venv rosbeat-venv\n"
            "    source rosbeat-venv/bin/activate\n"
            '    pip install "rosbeat[course,ros]"',
        )


def _require_extra() -> None:
    missing = [name for name in _OF_THE_EXTRA if find_spec(name) is None]
    if missing:
        raise RosbeatError(
            f"This Python environment has no {missing[0]}.",
            "The pages need it, and the extra `course` of rosbeat brings it. Nothing was changed.",
            'Install the extra:  pip install "rosbeat[course]"',
        )


def _require_place(folder: Path) -> bool:
    """Refuse a folder that is not the course's; return whether it is new."""
    if (folder / ".rosbeat" / "shipped").is_dir():
        return False
    if os.path.lexists(folder) and not folder.is_dir():
        raise RosbeatError(
            f"{folder} is not a folder: it is a file, or a link that leads nowhere.",
            _NOTHING_DONE,
            "Choose a name that is free:  rosbeat new my_course_2",
        )
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            pass
        entries = any(folder.iterdir())
    except OSError as error:
        raise RosbeatError(
            f"Nothing can be written in {folder} ({error.strerror or error}).",
            "You save your pages there, and the course keeps your progress beside them.",
            "Choose a folder of your own, below your home for example:  rosbeat new ~/my_course",
        ) from None
    if entries:
        raise RosbeatError(
            f"{folder} is not empty, and `rosbeat new` has not made it.",
            _NOTHING_DONE,
            "Choose a name that is free:  rosbeat new my_course_2",
        )
    return True


def _course_tool(course: Path) -> SimpleNamespace:
    """Return the modules of the tool, which in a checkout runs before anything is installed.

    Args:
        course: The checkout, or what a wheel brings of it.
    """
    environment = str(course / "environment")
    if environment not in sys.path:
        sys.path.insert(0, environment)
    names = ("doctor", "folder", "installing", "layout", "problems")
    return SimpleNamespace(**{name: import_module(f"course_tool.{name}") for name in names})
