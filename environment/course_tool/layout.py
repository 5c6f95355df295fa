"""Where things are in a checkout."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path

LEVELS = ("course", "test")
"""What an environment is for; each level contains the one before it."""


@dataclass(frozen=True)
class Layout:
    """The paths of one checkout."""

    root: Path

    @property
    def environment(self) -> Path:
        """The folder of the launcher and the locks."""
        return self.root / "environment"

    @property
    def venv(self) -> Path:
        """The virtual environment."""
        return self.root / ".venv"

    @property
    def python(self) -> Path:
        """The Python of the virtual environment."""
        return self.venv / "bin" / "python"

    @property
    def uv_home(self) -> Path:
        """A place of uv's own, so that installing from the lock does not remove it."""
        return self.venv / ".uv"

    @property
    def uv(self) -> Path:
        """The installer."""
        return self.uv_home / "bin" / "uv"

    @property
    def stamp(self) -> Path:
        """What says that the environment is complete; written last."""
        return self.venv / "rosbeat-stamp.json"

    @property
    def site_packages(self) -> Path:
        """Where the packages go."""
        version = "{}.{}".format(*sys.version_info[:2])
        return self.venv / "lib" / f"python{version}" / "site-packages"

    @property
    def own_packages(self) -> tuple[Path, ...]:
        """What is installed from the checkout itself: rosbeat, and the command `ros2`."""
        return (self.root, self.root / "src" / "ros2_command")

    @property
    def completions(self) -> Path:
        """Where bash finds how to complete the commands of the environment."""
        return self.venv / "share" / "bash-completion" / "completions"

    def lock(self, level: str) -> Path:
        """The locked versions of a level, or another lock (`bootstrap`, `build`) by name."""
        return self.environment / f"{level}.lock"


def of_this_checkout() -> Layout:
    """Return the layout of the checkout that this file is in."""
    return Layout(Path(__file__).resolve().parents[2])
