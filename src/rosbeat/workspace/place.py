"""Where the learner's workspace is.

It is a folder `ROS2_and_RL_Tutorials` in the checkout of the course, beside `notebooks`, so that
JupyterLab's file browser shows it. The variable `ROSBEAT_WORKSPACE_IN` names another folder for it
to lie in. While pages are built or tested, `ROSBEAT_STEADY_HOME` names a folder that takes the
place of both the checkout and the user's home: such a run starts with an empty workspace of its
own, and what it prints names no machine and no person.
"""

from __future__ import annotations

import os
from pathlib import Path

from rosbeat.errors import called_as

#: The name that the tutorial gives to the workspace.
NAME = "ROS2_and_RL_Tutorials"
SETTING = "ROSBEAT_WORKSPACE_IN"
#: Holds the path of the workspace in every terminal, so that `cd "$ROS2_WORKSPACE"` leads there
#: from everywhere.
VARIABLE = "ROS2_WORKSPACE"
STEADY = "ROSBEAT_STEADY_HOME"


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
    return course_root() or Path.cwd()


@called_as("workspace.folder()")
def workspace() -> Path:
    """Return the workspace, whether it exists or not."""
    return workspace_parent() / NAME
