"""Lines of a shell, run by a real bash in a workspace of their own."""

import subprocess
from dataclasses import dataclass
from pathlib import Path

from rosbeat.workspace.terminals.environment import program_environment

_RUN = r"""
for line in "$@"; do
    printf '%s$ %s\n' "${PWD/#$HOME/\~}" "$line"
    eval "$line"
    code=$?
done
printf '\036%s\036%s' "$code" "$PWD"
"""


@dataclass(frozen=True)
class Terminal:
    """What a check reads of a terminal.

    Attributes:
        folder: Where it is.
        text: All that it shows.
        exit_code: Of the last command that ended; None while one runs.
    """

    folder: Path
    text: str
    exit_code: int | None = 0


def typed(lines: str, root: Path, start: str = ".") -> Terminal:
    """Type lines into a new bash, and say where that has led.

    Args:
        lines: What is typed, each line on its own.
        root: The workspace; the folder that holds it is the home.
        start: Where the bash starts, relative to the workspace.
    """
    env = {
        **program_environment(),
        "HOME": str(root.parent),
        "ROS2_WORKSPACE": str(root),
        "LC_ALL": "C",
    }
    done = subprocess.run(
        ["bash", "--norc", "-c", _RUN, "bash", *lines.strip("\n").splitlines()],
        cwd=root / start,
        env=env,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        timeout=100,
        check=True,
    )
    text, code, folder = done.stdout.decode().rsplit("\x1e", 2)
    return Terminal(Path(folder), text, int(code))
