"""The environment variables of a terminal in a page."""

from __future__ import annotations

import os
import sys
from pathlib import Path

from rosbeat.workspace.place import VARIABLE as WORKSPACE
from rosbeat.workspace.place import steady_home, workspace
from rosbeat.workspace.terminals.reaper import VARIABLE
from rosbeat.workspace.terminals.steadiness import USER

STARTUP = Path(__file__).with_name("startup.bash")
# What a kernel and its tests set for themselves, and what would change what programs print.
_DROPPED = (
    *("MPLBACKEND", "CLICOLOR", "CLICOLOR_FORCE", "FORCE_COLOR", "COLORTERM", "LS_COLORS"),
    *(
        "COLUMNS",
        "LINES",
        "OLDPWD",
        "BASH_ENV",
        "ENV",
        "HISTFILE",
        "PROMPT_COMMAND",
        "PS0",
        "PS1",
        "PS2",
    ),
    *("PS4", "BASHOPTS", "SHELLOPTS", "TMOUT", "PYTHONSTARTUP", "PYTHONINSPECT", "INPUTRC"),
    "PYTHONDONTWRITEBYTECODE",  # colcon would warn of it in every build
    *("JPY_PARENT_PID", "JPY_SESSION_NAME", "PYTEST_CURRENT_TEST", "PYTEST_XDIST_WORKER"),
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
    "GIT_CONFIG_GLOBAL",  # the steady home has none, and git may make one there
)
_STEADY = {
    "USER": USER,
    "LOGNAME": USER,
    "TZ": "UTC",
    "LC_ALL": "C.UTF-8",
    "GIT_CONFIG_NOSYSTEM": "1",
    "RCUTILS_CONSOLE_OUTPUT_FORMAT": "[{severity}] [{name}]: {message}",
}


def surroundings(token: str) -> dict[str, str]:
    """Return what a terminal finds in its environment: the kernel's, made plain.

    Args:
        token: The mark of the terminal, by which its processes are found again.
    """
    environ = {name: value for name, value in os.environ.items() if name not in _DROPPED}
    environ.update(_PLAIN)
    environ["PATH"] = _path(environ)
    if sys.prefix != sys.base_prefix:
        environ["VIRTUAL_ENV"] = sys.prefix
    environ.update(_language(environ))
    _make_steady(environ)
    environ[WORKSPACE] = str(workspace())
    environ[VARIABLE] = token
    environ["PROMPT_COMMAND"] = f". {_quoted(str(STARTUP))}"
    return environ


def _path(environ: dict[str, str]) -> str:
    """Return the search path with the course's own programs first."""
    own = str(Path(sys.prefix) / "bin")
    given = environ.get("PATH") or os.defpath
    rest = [entry for entry in given.split(os.pathsep) if entry != own]
    return os.pathsep.join([own, *rest])


def _language(environ: dict[str, str]) -> dict[str, str]:
    names = ("LC_ALL", "LC_CTYPE", "LANG")
    chosen = next((environ[name] for name in names if environ.get(name)), "")
    return {} if "utf" in chosen.lower() else {"LC_ALL": "C.UTF-8"}


def _make_steady(environ: dict[str, str]) -> None:
    home = steady_home()
    if home is not None:
        for name in _PERSONAL:
            environ.pop(name, None)
        environ.update(_STEADY, HOME=str(home))


def _quoted(text: str) -> str:
    return "'" + text.replace("'", "'\\''") + "'"
