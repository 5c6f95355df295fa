"""Mistakes with programs and files on the command line."""

from __future__ import annotations

import re
import shlex
from glob import escape
from pathlib import Path

from rosbeat.diagnosis.mistakes import Diagnosis
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
_SETUP_DENIED = re.compile(
    rf"{_BASH}(?P<path>\S*install/(?:local_)?setup\.\w+): Permission denied", re.M
)
_OPTION = re.compile(r"^mkdir: (?:invalid|unrecognized) option (?:-- )?'(?P<letter>[^']+)'", re.M)
_HELP = "`mkdir --help` lists what it takes."
_CHMOD_MODE = re.compile(r"^chmod: invalid mode: ", re.M)
_RM = re.compile(r"^rm: cannot remove '(?P<path>[^']+)': Is a directory", re.M)
_NO_SCRIPT = re.compile(r"can't open file '(?P<path>[^']+)': \[Errno 2\]")


def command_not_found(seen: Situation) -> Diagnosis | None:
    """A misspelt command, or a program that is not installed."""
    found = _NOT_FOUND.search(seen.text)
    call = seen.program(re.escape(found["word"])) if found else None
    if not found or not call:
        return None
    word = found["word"]
    if (call.place / word).is_file():
        return Diagnosis(
            "dot-slash-missing",
            f"{word} is here, but the shell does not look here by itself:",
            f"write ./{word}",
        )
    return _prompt(word) or _not_installed(word) or _misspelt(word)


def _prompt(word: str) -> Diagnosis | None:
    if word not in ("$", "#", "%"):
        return None
    return Diagnosis(
        "prompt-typed",
        f"`{word}` is the sign with which a terminal waits for you, and no command.",
        "Type only what stands behind it.",
    )


def _not_installed(word: str) -> Diagnosis | None:
    if word in _EDITORS:
        return Diagnosis(
            "not-installed",
            f"The editor {word} is not installed here.",
            "Open the file in JupyterLab's file browser with a double click, or write it with a "
            "`%%save` cell.",
        )
    if word in ("ros2", "colcon"):
        return Diagnosis(
            "environment-inactive",
            f"This terminal does not know {word}: the environment of the course is not active "
            "in it.",
            "Open the terminal from the course, or start with `./environment/course shell`.",
        )
    return _from_elsewhere(word)


def _from_elsewhere(word: str) -> Diagnosis | None:
    if word in _ROS_1:
        return Diagnosis(
            "ros-1-command",
            f"`{word}` is not installed here:",
            "it belongs to ROS 1, and ROS 2 does without it.",
        )
    if word not in _NOT_HERE:
        return None
    return Diagnosis(
        "not-installed",
        f"The program `{word}` is not installed here.",
        "The course does without it.",
    )


def _misspelt(word: str) -> Diagnosis | None:
    meant = nearest(word, [one for one in _KNOWN if one != word], _ALIKE)
    if not meant:
        return None
    return Diagnosis(
        "command-misspelled", f"There is no command `{word}`.", f"Did you mean `{meant}`?"
    )


def chmod_failed(seen: Situation) -> Diagnosis | None:
    """`chmod` of a file that is somewhere else."""
    found = _CHMOD.search(seen.text)
    call = seen.call("chmod")
    return _elsewhere(seen, call.place, found["path"]) if found and call else None


def script_missing(seen: Situation) -> Diagnosis | None:
    """Python was asked to run a file that is somewhere else."""
    found = _NO_SCRIPT.search(seen.text)
    call = seen.program(r"python[\d.]*")
    return _elsewhere(seen, call.place, Path(found["path"]).name) if found and call else None


def source_failed(seen: Situation) -> Diagnosis | None:
    """`source install/setup.bash` where nothing is built, or of a ROS that is not there."""
    found = _SOURCE.search(seen.text)
    if not found or not (seen.call("source") or seen.call(".")):
        return None
    path = found["path"]
    if path.startswith("/opt/ros/"):
        return Diagnosis(
            "ros-elsewhere",
            "That file comes with an installed ROS.",
            "In this course every terminal has ROS already; leave the line out.",
        )
    return _no_build_here(seen, path) if _SETUP.fullmatch(path) else None


def _no_build_here(seen: Situation, path: str) -> Diagnosis | None:
    if not (seen.workspace / "install" / "setup.bash").is_file():
        return Diagnosis(
            "not-built",
            f"{path} does not exist yet: `colcon build` makes it.",
            "Build in the workspace first, then source.",
        )
    if not (seen.workspace / "install" / Path(path).name).is_file():
        return None
    where = "does not exist" if path.startswith("/") else "is not where this terminal is"
    return Diagnosis(
        "wrong-folder",
        f"{path} {where}.",
        f"It lies in your workspace: go there first, with  {way_to()}",
    )


def not_executable(seen: Situation) -> Diagnosis | None:
    """A script was started without the right to be."""
    found = _DENIED.search(seen.text)
    if not found or not seen.program(rf"\S*{re.escape(Path(found['path']).name)}"):
        return None
    path = shlex.quote(found["path"])
    return Diagnosis(
        "not-executable",
        f"{path} may not be started as a program.",
        f"`chmod +x {path}` allows it. "
        "`ros2 run` needs no such right: it uses the entry points in setup.py.",
    )


def setup_run(seen: Situation) -> Diagnosis | None:
    """`install/setup.bash` without `source` in front."""
    found = _SETUP_DENIED.search(seen.text)
    if not found or not seen.program(re.escape(found["path"])):
        return None
    return Diagnosis(
        "not-sourced",
        f"{found['path']} is not to be started: it tells something to this terminal, and a "
        "program of its own could not.",
        f"Put `source` and a blank before it: source {found['path']}",
    )


def mkdir_misused(seen: Situation) -> Diagnosis | None:
    """An option that `mkdir` does not have, or nothing to make."""
    if not seen.call("mkdir"):
        return None
    option = _OPTION.search(seen.text)
    if option:
        hint = "The option is a small letter: -p" if option["letter"] == "P" else _HELP
        said = f"`mkdir` has no option -{option['letter']}, so it made nothing."
        return Diagnosis("option-misspelled", said, hint)
    if "mkdir: missing operand" not in seen.text:
        return None
    return Diagnosis(
        "word-missing",
        "`mkdir` was not told which folder to make.",
        "Its name, or a path to it, comes behind a blank.",
    )


def chmod_misused(seen: Situation) -> Diagnosis | None:
    """`chmod x a.py`: the plus sign is missing; or no file is named."""
    if not seen.call("chmod"):
        return None
    if _CHMOD_MODE.search(seen.text):
        return Diagnosis(
            "word-misspelled",
            "`chmod` cannot read its first word.",
            "A plus sign adds a permission: `+x` adds the one to execute.",
        )
    if "chmod: missing operand" not in seen.text:
        return None
    return Diagnosis(
        "word-missing",
        "`chmod` needs two words: what to change, and the file.",
        "As in  chmod +x temperature_publisher.py",
    )


def rm_of_a_folder(seen: Situation) -> Diagnosis | None:
    """`rm` of a folder without `-r`."""
    found = _RM.search(seen.text)
    if not found or not seen.call("rm"):
        return None
    return Diagnosis(
        "is-a-folder",
        f"{found['path']} is a folder, and `rm` alone removes files.",
        "`rm -r` removes a folder with all that is in it, and there is no bin: read the line "
        "twice.",
    )


def _elsewhere(seen: Situation, place: Path, path: str) -> Diagnosis:
    name = Path(path).name
    where = "" if path.startswith("/") else " where this terminal is"
    files = (one for one in sorted(seen.workspace.glob(f"src/**/{escape(name)}")) if one.is_file())
    file = next(files, None)
    if file:
        folder = file.parent.relative_to(seen.workspace).as_posix()
        return Diagnosis(
            "wrong-folder",
            f"There is no {path}{where}; it lies in {folder} of your workspace.",
            f"Go there first, with  {way_to(folder)}",
        )
    meant = near(place, path)
    hint = f"Did you mean {shlex.quote(meant)}?" if meant else "`ls` shows what is there."
    return Diagnosis("file-not-found", f"There is no {path}{where}.", hint)
