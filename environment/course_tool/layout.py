"""Where things are in a checkout, or in an installed wheel."""

from __future__ import annotations

import os
import shlex
import sys
from dataclasses import dataclass
from pathlib import Path

COURSE_ROS = "jazzy"
"""The ROS distribution that the course is made for."""
LEVELS = {COURSE_ROS: ("course", "test"), "kilted": ("kilted",)}
"""What an environment of each distribution is for; each level contains the one before it."""
WORKSPACE = "ROS2_and_RL_Tutorials"
"""The name of the learner's workspace."""
WORKSPACE_IN = "ROSBEAT_WORKSPACE_IN"
"""The variable that names another folder for the workspace to lie in."""
LEARNERS_FOLDER = "ROSBEAT_MY_COURSE"
"""The variable that names a learner's own folder where many share one checkout, as on a hub."""


@dataclass(frozen=True)
class Layout:
    """The paths of one checkout, or of what a wheel brings for learners (`rosbeat new`).

    Attributes:
        root: The checkout; of a wheel, the folder `course` in the package `rosbeat`.
        prefix: The environment that the wheel is installed in; in a checkout, it is `.venv`.
        own: The learner's own folder, which is not in the wheel.
        ros: The distribution in the virtual environment; each has an environment of its own.
    """

    root: Path
    prefix: Path | None = None
    own: Path | None = None
    ros: str = COURSE_ROS

    @property
    def environment(self) -> Path:
        """Return the folder of the launcher and the locks."""
        return self.root / "environment"

    @property
    def hub(self) -> Path:
        """Return the folder of what JupyterHub is configured with."""
        return self.environment / "jupyterhub"

    @property
    def venv(self) -> Path:
        """Return the virtual environment."""
        name = ".venv" if self.ros == COURSE_ROS else f".venv-{self.ros}"
        return self.prefix or self.root / name

    @property
    def levels(self) -> tuple[str, ...]:
        """Return what the virtual environment can be for; each level contains the one before it."""
        return LEVELS[self.ros]

    @property
    def python(self) -> Path:
        """Return the Python of the virtual environment."""
        return self.venv / "bin" / "python"

    @property
    def uv(self) -> Path:
        """Return the installer."""
        return self.venv / "bin" / "uv"

    @property
    def stamp(self) -> Path:
        """Return the file that says that the environment is complete; it is written last."""
        return self.venv / "rosbeat-stamp.json"

    @property
    def site_packages(self) -> Path:
        """Return the folder where packages go."""
        version = "{}.{}".format(*sys.version_info[:2])
        return self.venv / "lib" / f"python{version}" / "site-packages"

    @property
    def is_release(self) -> bool:
        """Tell whether this is what an instructor gives to a class (`rosbeat release`).

        Where many share it, each learner has a folder with copies of its pages.
        """
        return (self.root / ".rosbeat-release.json").is_file() and not self.is_shared

    @property
    def is_shared(self) -> bool:
        """Tell whether this learner's folder is outside the checkout, which many share."""
        return bool(os.environ.get(LEARNERS_FOLDER))

    @property
    def shipped(self) -> Path:
        """Return the folder of the pages as they are shipped."""
        return self.root / "notebooks"

    @property
    def learner(self) -> Path:
        """Return the learner's own folder; in a release, its pages are the learner's own."""
        if self.own:
            return self.own
        if self.is_shared:
            return Path(os.environ[LEARNERS_FOLDER]).expanduser().absolute()
        return self.shipped if self.is_release else self.root / "my_course"

    @property
    def notes(self) -> Path:
        """Return the hidden folder in the learner's own that holds progress and the lab's log."""
        return self.learner / ".rosbeat"

    @property
    def settings(self) -> Path:
        """Return the module that sets what nodes need in the environment."""
        package = self.root.parent if self.prefix else self.root / "src" / "rosbeat"
        return package / "environment.py"

    @property
    def own_packages(self) -> tuple[Path, ...]:
        """Return what is installed from the checkout: rosbeat, the command `ros2`, and Rosie."""
        packages = ("ros2_command", "rosie")
        return (self.root, *(self.root / "src" / name for name in packages))

    @property
    def completions(self) -> Path:
        """Return the folder in which bash finds how to complete the environment's commands."""
        return self.venv / "share" / "bash-completion" / "completions"

    def update_command(self, page: str) -> str:
        """Return what to type for the new version of a page that somebody has worked in."""
        if self.prefix:
            return f"rosbeat new {shlex.quote(str(self.learner))} --update {page}"
        return f"./environment/course update {page}"

    def lock(self, name: str) -> Path:
        """Return the locked versions of a level, or another lock (`bootstrap`, `build`)."""
        return self.environment / f"{name}.lock"


def of_this_checkout() -> Layout:
    """Return the layout of the checkout that this file is in."""
    return Layout(Path(__file__).resolve().parents[2])
