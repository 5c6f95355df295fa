"""The environment variables of the course's programs and terminals, and how folders are shown.

Where pages are built or tested, a steady home is set (`rosbeat.workspace.location`). Then programs
find no setting of a person's, and what is shown is the same on every machine.
"""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Callable
from pathlib import Path

from rosbeat.workspace.location import VARIABLE as WORKSPACE
from rosbeat.workspace.location import course_root, search_path, steady_home, workspace
from rosbeat.workspace.terminals.reaper import VARIABLE

Polish = Callable[[str], str]

#: Run by bash before its first prompt.
STARTUP = Path(__file__).with_name("startup.bash")
#: What a steady run calls its home and its user.
HOME, USER = "/home/you", "you"
_COURSE = f"{HOME}/rosbeat"
# What a kernel and its tests set for themselves, and what would change what programs print.
_DROPPED = frozenset(
    {
        *("MPLBACKEND", "CLICOLOR", "CLICOLOR_FORCE", "FORCE_COLOR", "COLORTERM", "LS_COLORS"),
        *("COLUMNS", "LINES", "OLDPWD", "BASH_ENV", "ENV", "HISTFILE", "PROMPT_COMMAND", "PS0"),
        *("PS1", "PS2", "PS4", "BASHOPTS", "SHELLOPTS", "TMOUT", "INPUTRC", "PYTHONSTARTUP"),
        *("PYTHONINSPECT", "JPY_PARENT_PID", "JPY_SESSION_NAME", "PYTEST_CURRENT_TEST"),
        "PYTEST_XDIST_WORKER",
        "PYTHONDONTWRITEBYTECODE",  # colcon would warn of it in every build
    }
)
_PLAIN = {
    "TERM": "dumb",
    "NO_COLOR": "1",
    "RCUTILS_COLORIZED_OUTPUT": "0",
    "PAGER": "cat",
    "GIT_PAGER": "cat",
    "MANPAGER": "cat",
    "INPUTRC": os.devnull,  # until the start-up is through: a person may use the keys of vi
}
# Settings of a person, which would show in what a page prints.
_PERSONAL = (
    *("XDG_CONFIG_HOME", "XDG_DATA_HOME", "XDG_CACHE_HOME", "COLCON_HOME", "ROS_LOG_DIR"),
    *("GIT_CONFIG_GLOBAL", "LNAME", "USERNAME"),
)
_STEADY = {
    "USER": USER,
    "LOGNAME": USER,
    "TZ": "UTC",
    "LC_ALL": "C.UTF-8",
    "GIT_CONFIG_NOSYSTEM": "1",
    "RCUTILS_CONSOLE_OUTPUT_FORMAT": "[{severity}] [{name}]: {message}",
    "ROS2_COMMAND_NO_NOTES": "1",  # whether `ros2` says that it waits depends on the machine
}
_DIFFERENCES = [
    (r"\[(?:\d+min )?\d+(?:\.\d+)?s\]", "[0.00s]"),  # colcon
    (r"(?<=in )\d+\.\d\ds\b", "0.00s"),  # pytest
    (r"\bpython3\.\d+(?=/|$)", "python3.12"),  # of Ubuntu 24.04, which ROS 2 Jazzy is made for
    (r"^(\[\d+\]) \d+$", r"\1 1234"),  # a job in the background
    (r"(\[(?:INFO|WARN|ERROR|DEBUG|FATAL)\]) \[\d+\.\d+\]", r"\1"),
]


def program_environment() -> dict[str, str]:
    """Return the environment of the course's programs: the kernel's, made plain."""
    environ = {name: value for name, value in os.environ.items() if name not in _DROPPED} | _PLAIN
    environ["PATH"] = search_path()
    if sys.prefix != sys.base_prefix:
        environ["VIRTUAL_ENV"] = sys.prefix
    locale = next((environ[one] for one in ("LC_ALL", "LC_CTYPE", "LANG") if environ.get(one)), "")
    if "utf" not in locale.lower():
        environ["LC_ALL"] = "C.UTF-8"
    home = steady_home()
    if home is not None:
        environ = {name: value for name, value in environ.items() if name not in _PERSONAL}
        environ |= _STEADY | {"HOME": str(home)}
    environ[WORKSPACE] = str(workspace())
    return environ


def terminal_environment(token: str) -> dict[str, str]:
    """Return the environment of a terminal's bash.

    Args:
        token: The mark of the terminal, by which its processes are found again.
    """
    startup = str(STARTUP).replace("'", "'\\''")
    return {**program_environment(), VARIABLE: token, "PROMPT_COMMAND": f". '{startup}'"}


def prompt(folder: Path, parent: Path) -> str:
    """Return the short prompt that a page shows before a command.

    Args:
        folder: The folder of the shell.
        parent: The folder that holds the workspace; what is below it is named from there.
    """
    home = steady_home() or Path.home()
    if folder == home:
        return "~$ "
    if folder == parent:
        return f"{parent.name or '/'}$ "
    if parent in folder.parents:
        return f"{folder.relative_to(parent)}$ "
    return f"~/{folder.relative_to(home)}$ " if home in folder.parents else f"{folder}$ "


def polisher() -> Polish:
    """Return a function that makes a line the same on every machine; a learner sees the real one.

    Folders of the machine, process numbers and timings are replaced.
    """
    steady = steady_home()
    if steady is None:
        return str
    swaps = [(re.compile(one), text) for one, text in [*_folders(steady), *_DIFFERENCES]]

    def polish(line: str) -> str:
        for pattern, text in swaps:
            line = pattern.sub(text, line)
        return line

    return polish


def _folders(steady: Path) -> list[tuple[str, str]]:
    """Return patterns for the folders of this machine and their names, the deepest first."""
    places = {str(steady): HOME, str(Path(sys.prefix)): f"{_COURSE}/.venv"}
    root = course_root()
    if root is not None:
        places.setdefault(str(root), _COURSE)
    deepest = sorted(places, key=len, reverse=True)
    return [
        (rf"{re.escape(place)}(?![\w-]|\.\w)", places[place]) for place in deepest if place != "/"
    ]
