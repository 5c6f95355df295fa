"""Mistakes with programs and files on the command line."""

from __future__ import annotations

import re
import shlex
from glob import escape
from pathlib import Path

from rosbeat.workspace.locating import nearest
from rosbeat.workspace.meanings.folders import near, way_to
from rosbeat.workspace.meanings.situation import Situation

_KNOWN = (
    *("ros2", "colcon", "source", "mkdir", "cd", "chmod", "ls", "pwd", "cat", "cp", "mv"),
    *("echo", "python3", "python", "pip", "touch", "clear", "exit"),
)
_EDITORS = ("nano", "gedit", "vim", "vi", "code", "emacs")
_ROS_1 = ("roscore", "rosrun", "rosnode", "rostopic", "roslaunch", "catkin_make")
_NOT_HERE = (
    *("tree", "screen", "tmux", "git", "sudo", "apt", "apt-get", "gnome-terminal", "terminator"),
    *("rviz2", "rqt", "rqt_graph", "rosdep", "htop", "wget", "curl", "pip", "python", "conda"),
)
#: Short words are easily alike: `screen` is not `tree`.
_ALIKE = 0.75
_BASH = r"^bash: (?:line \d+: )?"
_NOT_FOUND = re.compile(rf"{_BASH}(?P<word>[^\s:]+): command not found", re.M)
_CHMOD = re.compile(r"^chmod: cannot access '(?P<path>[^']+)': No such file", re.M)
_SOURCE = re.compile(rf"{_BASH}(?P<path>\S+): No such file or directory", re.M)
_SETUP = re.compile(r"(.*/)?install/(local_)?setup\.\w+")
_DENIED = re.compile(rf"{_BASH}(?P<path>\S+\.py): Permission denied", re.M)
_NO_SCRIPT = re.compile(r"can't open file '(?P<path>[^']+)': \[Errno 2\]")


def command_not_found(seen: Situation) -> str | None:
    """A misspelt command, or a program that is not installed."""
    found = _NOT_FOUND.search(seen.text)
    call = seen.program(re.escape(found["word"])) if found else None
    if not found or not call:
        return None
    word = found["word"]
    if (call.place / word).is_file():
        return f"{word} is here, but the shell does not look here by itself: write ./{word}"
    return _not_installed(word) or _misspelt(word)


def _not_installed(word: str) -> str | None:
    if word in _EDITORS:
        return (
            f"The editor {word} is not installed here. Open the file in JupyterLab's file "
            "browser with a double click, or write it with a `%%save` cell."
        )
    if word in ("ros2", "colcon"):
        return (
            f"This terminal does not know {word}: the environment of the course is not active "
            "in it. Open the terminal from the course, or start with "
            "`./environment/course shell`."
        )
    if word in _ROS_1:
        return f"`{word}` is not installed here: it belongs to ROS 1, and ROS 2 does without it."
    return f"The program `{word}` is not installed here." if word in _NOT_HERE else None


def _misspelt(word: str) -> str | None:
    meant = nearest(word, [one for one in _KNOWN if one != word], _ALIKE)
    return f"There is no command `{word}`. Did you mean `{meant}`?" if meant else None


def chmod_failed(seen: Situation) -> str | None:
    """`chmod` of a file that is somewhere else."""
    found = _CHMOD.search(seen.text)
    call = seen.call("chmod")
    return _elsewhere(seen, call.place, found["path"]) if found and call else None


def script_missing(seen: Situation) -> str | None:
    """Python was asked to run a file that is somewhere else."""
    found = _NO_SCRIPT.search(seen.text)
    call = seen.program(r"python[\d.]*")
    return _elsewhere(seen, call.place, Path(found["path"]).name) if found and call else None


def source_failed(seen: Situation) -> str | None:
    """`source install/setup.bash` where nothing is built, or of a ROS that is not there."""
    found = _SOURCE.search(seen.text)
    if not found or not (seen.call("source") or seen.call(".")):
        return None
    path = found["path"]
    if path.startswith("/opt/ros/"):
        return (
            "That file comes with an installed ROS. In this course every terminal has ROS "
            "already; leave the line out."
        )
    return _no_build_here(seen, path) if _SETUP.fullmatch(path) else None


def _no_build_here(seen: Situation, path: str) -> str | None:
    if not (seen.workspace / "install" / "setup.bash").is_file():
        return (
            f"{path} does not exist yet: `colcon build` makes it. "
            "Build in the workspace first, then source."
        )
    if not (seen.workspace / "install" / Path(path).name).is_file():
        return None
    where = "does not exist" if path.startswith("/") else "is not where this terminal is"
    return f"{path} {where}. It lies in your workspace: go there first, with  {way_to()}"


def not_executable(seen: Situation) -> str | None:
    """A script was started without the right to be."""
    found = _DENIED.search(seen.text)
    if not found or not seen.program(rf"\S*{re.escape(Path(found['path']).name)}"):
        return None
    path = shlex.quote(found["path"])
    return (
        f"{path} may not be started as a program. `chmod +x {path}` allows it. "
        "`ros2 run` needs no such right: it uses the entry points in setup.py."
    )


def _elsewhere(seen: Situation, place: Path, path: str) -> str:
    name = Path(path).name
    where = "" if path.startswith("/") else " where this terminal is"
    files = (one for one in sorted(seen.workspace.glob(f"src/**/{escape(name)}")) if one.is_file())
    file = next(files, None)
    if file:
        folder = file.parent.relative_to(seen.workspace).as_posix()
        return (
            f"There is no {path}{where}; it lies in {folder} of your workspace. "
            f"Go there first, with  {way_to(folder)}"
        )
    meant = near(place, path)
    hint = f"Did you mean {shlex.quote(meant)}?" if meant else "`ls` shows what is there."
    return f"There is no {path}{where}. {hint}"
