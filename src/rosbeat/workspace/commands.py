"""Runs `ros2` and `colcon` of the course's own environment, as a terminal of a page would."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

from rosbeat import environment
from rosbeat.errors import WorkspaceError
from rosbeat.workspace.place import steady_home


def run_command(command: Sequence[str], folder: Path, seconds: float) -> tuple[int, str]:
    """Run a program of the course and wait for it.

    Args:
        command: Its name, `ros2` or `colcon`, and its arguments.
        folder: Where it runs.
        seconds: How long it may take.

    Returns:
        Its exit code, and everything that it wrote.

    Raises:
        WorkspaceError: If it is not installed, or takes longer.
    """
    place = Path(sys.prefix) / "bin" / command[0]
    try:
        done = subprocess.run(
            [str(place), *command[1:]], cwd=folder, env=surroundings(), timeout=seconds,
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
        )  # fmt: skip
    except FileNotFoundError:
        raise _not_installed(command[0]) from None
    except subprocess.TimeoutExpired:
        raise _too_slow(command, seconds) from None
    return done.returncode, done.stdout.decode("utf-8", "replace")


def surroundings() -> dict[str, str]:
    """Return the environment of such a program: ours, with the course's programs in front."""
    found = dict(os.environ)
    environment.apply(found)
    programs = str(Path(sys.prefix) / "bin")
    found["PATH"] = os.pathsep.join([programs, found.get("PATH", os.defpath)])
    home = steady_home()
    if home is not None:
        found.update(dict.fromkeys(("USER", "LOGNAME", "LNAME", "USERNAME"), "you"))
        for name in ("GIT_CONFIG_GLOBAL", "XDG_CONFIG_HOME"):
            found.pop(name, None)
        found.update(HOME=str(home), GIT_CONFIG_NOSYSTEM="1")
    return found


def _not_installed(program: str) -> WorkspaceError:
    return WorkspaceError(
        f"The program {program} is not installed beside this Python.",
        "It makes or builds packages, and this page needs one.",
        "Start the course with `./environment/course lab`; it installs what is missing.",
    )


def _too_slow(command: Sequence[str], seconds: float) -> WorkspaceError:
    return WorkspaceError(
        f"`{' '.join(command)}` was not done after {seconds:g} seconds and has been stopped.",
        "The computer is very busy, or the program waits for something.",
        "Run the cell again when the computer is less busy.",
    )
