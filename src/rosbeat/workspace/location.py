"""Locate the learner's workspace.

It is a folder `ROS2_and_RL_Tutorials` in the learner's own folder `my_course`, beside the pages, so
that JupyterLab's file browser shows it. `rosbeat new`, which needs no checkout, makes the learner's
own folder under any name. The variable `ROSBEAT_WORKSPACE_IN` names another folder for it to lie
in. While pages are built or tested, `ROSBEAT_STEADY_HOME` names a folder that takes the
place of both the checkout and the user's home: such a run starts with an empty workspace of its
own, and what it prints names no machine and no person.
"""

from __future__ import annotations

import atexit
import os
import re
import shutil
import sys
import tempfile
from contextlib import suppress
from pathlib import Path
from typing import Any

from rosbeat.environment import learners_folder
from rosbeat.errors import called_as

#: The name that the tutorial gives to the workspace.
NAME = "ROS2_and_RL_Tutorials"
SETTING = "ROSBEAT_WORKSPACE_IN"
#: Holds the path of the workspace in every terminal, so that `cd "$ROS2_WORKSPACE"` leads there
#: from everywhere.
VARIABLE = "ROS2_WORKSPACE"
STEADY = "ROSBEAT_STEADY_HOME"
#: Holds the page's file in a kernel that Jupyter's server has started.
PAGE = "JPY_SESSION_NAME"
#: nbgrader says in it why it runs a page: `autograde` or `validate`
#: (`nbgrader/converters/autograde.py` and `nbgrader/validator.py`).
GRADED = "NBGRADER_EXECUTION"
_PAGE_NAME = re.compile(r"(\d\d)_[^/]*$")


def steady_home() -> Path | None:
    """Return the home of a run whose outputs must be the same every time; None for a learner."""
    value = os.environ.get(STEADY, "")
    return Path(value).resolve() if value else None


def course_root() -> Path | None:
    """Return the checkout that this package was installed from, or None if it was from a wheel."""
    root = Path(__file__).resolve().parents[3]
    return root if (root / "notebooks").is_dir() and (root / "src" / "rosbeat").is_dir() else None


def workspace_parent() -> Path:
    """Return the folder that holds the workspace; in it every terminal of a page starts."""
    steady = steady_home()
    if steady is not None:
        return steady
    chosen = os.environ.get(SETTING, "")
    if chosen:
        return Path(chosen).expanduser().resolve()
    return Path(learners_folder() or Path.cwd())


def search_path() -> str:
    """Return the PATH with the programs of this Python's environment in front, such as `ros2`."""
    own = str(Path(sys.prefix) / "bin")
    rest = (os.environ.get("PATH") or os.defpath).split(os.pathsep)
    return os.pathsep.join([own, *(folder for folder in rest if folder != own)])


def is_a_solution(page: Path) -> bool:
    """Return whether a page is one of the course's solutions, or the learner's copy of one.

    Args:
        page: The file of the page; it need not exist.
    """
    places = [Path(one) for one in (course_root(), learners_folder()) if one]
    return page.resolve().parent in [place / "solutions" for place in places]


def page_file() -> Path:
    """Return the file of the page that is open in this kernel; it need not exist.

    Jupyter's server names it in the environment of its kernel, and Visual Studio Code in its
    namespace. Without either, it is a file in the kernel's folder.
    """
    file = Path(_named_file() or "page.ipynb")
    with suppress(FileNotFoundError):  # the kernel's folder may be gone
        return file.absolute()
    return file


def page_number() -> str:
    """Return the number of the page in this kernel, such as `05`; empty if that cannot be told.

    Jupyter's server names the notebook in the environment of its kernel, and Visual Studio Code in
    its namespace. Elsewhere, as under nbgrader, it is the only page in the kernel's folder.
    """
    named = _named_file()
    if not named and _shell() is not None:
        pages = [one.name for one in Path().glob("[0-9][0-9]_*.ipynb")]
        named = pages[0] if len(pages) == 1 else ""
    found = _PAGE_NAME.search(named)
    return found[1] if found else ""


def _shell() -> Any:  # noqa: ANN401 - IPython carries no types
    ipython = sys.modules.get("IPython")
    return ipython.get_ipython() if ipython else None


def _named_file() -> str:
    """Return the notebook that somebody has named to this kernel, or an empty text."""
    shell = _shell()
    known = getattr(shell, "user_ns", {})
    return os.environ.get(PAGE) or str(known.get("__vsc_ipynb_file__") or "")


@called_as("workspace.folder()")
def workspace() -> Path:
    """Return the workspace, whether it exists or not."""
    return workspace_parent() / NAME


# A page that nbgrader runs.


def settle_in() -> None:
    """Give this process a home and one stream, if it is the kernel of a page that nbgrader runs.

    nbgrader runs one learner's pages after the other on the instructor's account. Without a home of
    its own, a page would find what the learner before has saved, and note its outcomes in the
    instructor's progress. And nbgrader takes anything on stderr for a failure (`nbgrader/utils.py`,
    `determine_grade`), in whichever cell it happens to arrive; ROS writes every log line there.
    """
    if not os.environ.get(GRADED) or os.environ.get(STEADY):
        return  # the kernel's own processes find it settled
    folder = tempfile.mkdtemp(prefix="rb-")
    os.environ[STEADY] = folder
    atexit.register(_remove, folder, os.getpid())
    # Both what Python writes and what C code writes.
    sys.stderr.flush()
    sys.stderr = sys.stdout
    os.dup2(1, 2)


def _remove(folder: str, owner: int) -> None:
    if os.getpid() == owner:  # a process that was forked ends long before the page does
        shutil.rmtree(folder, ignore_errors=True)
