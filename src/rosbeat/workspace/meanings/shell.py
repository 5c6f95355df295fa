"""Mistakes with the commands of the shell itself."""

from __future__ import annotations

import re
from glob import escape
from pathlib import Path

from rosbeat.workspace.locating import nearest
from rosbeat.workspace.meanings.situation import Situation

_KNOWN = (
    "ros2",
    "colcon",
    "source",
    "mkdir",
    "cd",
    "chmod",
    "ls",
    "pwd",
    "cat",
    "cp",
    "mv",
    "echo",
    "python3",
    "python",
    "pip",
    "touch",
    "tree",
    "clear",
    "exit",
)
_EDITORS = ("nano", "gedit", "vim", "vi", "code", "emacs")
_NOT_FOUND = re.compile(r"(?:^|[ :])(?P<word>[^\s:]+): command not found")
_MKDIR = re.compile(r"mkdir: cannot create directory '(?P<path>[^']+)': (?P<why>.+)")
_CD = re.compile(r"cd: (?P<path>.+): No such file or directory")
_CHMOD = re.compile(r"chmod: cannot access '(?P<path>[^']+)': No such file")
_SOURCE = re.compile(r"(?P<path>\S*setup\.\w+): No such file or directory")
_DENIED = re.compile(r"(?P<path>\S+\.py): Permission denied")
_NO_SCRIPT = re.compile(r"can't open file '(?P<path>[^']+)': \[Errno 2\]")


def command_not_found(seen: Situation) -> str | None:
    """A misspelt command, or an editor that is not installed."""
    found = _NOT_FOUND.search(seen.text)
    if not found:
        return None
    word = found["word"]
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
    place = seen.calls[-1].place if seen.calls else seen.folder
    if (place / word).is_file():
        return f"{word} is here, but the shell does not look here by itself: write ./{word}"
    meant = nearest(word, list(_KNOWN))
    return f"There is no command `{word}`. Did you mean `{meant}`?" if meant else None


def mkdir_failed(seen: Situation) -> str | None:
    """`mkdir` without the `~`, without a parent, or of what is there."""
    found = _MKDIR.search(seen.text)
    if not found:
        return None
    path, why = found["path"], found["why"]
    if "File exists" in why:
        return (
            f"{path} is there already, so there is nothing to do. "
            "With -p, `mkdir` says nothing about that."
        )
    if (
        path.startswith("/")
        and not path.startswith("/home/")
        and ("No such" in why or "den" in why)
    ):
        return (
            f"{path} starts with `/`, and that is the top of the whole disk, which is not yours. "
            f"Your own folder is called `~`: write  mkdir -p ~{path}"
        )
    if "No such file" in why:
        return (
            f"The folder in which {Path(path).name} should be made does not exist. "
            "With -p, `mkdir` makes it too."
        )
    return None


def cd_failed(seen: Situation) -> str | None:
    """`cd` to a folder that is not there."""
    found = _CD.search(seen.text)
    if not found:
        return None
    path = found["path"].strip()
    if path.startswith("/Documents"):
        return (
            f"{path} starts with `/`, and that is the top of the whole disk. "
            f"Your own folder is called `~`: write  cd ~{path}"
        )
    inside = path.rstrip("/").partition(seen.workspace.name)
    if inside[1] and seen.workspace.is_dir():
        return f"There is no folder {path}. Your workspace is here:  cd {_shown(seen)}{inside[2]}"
    meant = _near(seen, path)
    hint = f"Did you mean {meant}?" if meant else "`pwd` shows where you are, `ls` what is there."
    return f"There is no folder {path} where this terminal is. {hint}"


def chmod_failed(seen: Situation) -> str | None:
    """`chmod` of a file that is somewhere else."""
    found = _CHMOD.search(seen.text)
    if not found:
        return None
    return _elsewhere(seen, found["path"])


def script_missing(seen: Situation) -> str | None:
    """Python was asked to run a file that is somewhere else."""
    found = _NO_SCRIPT.search(seen.text)
    return _elsewhere(seen, Path(found["path"]).name) if found else None


def source_failed(seen: Situation) -> str | None:
    """`source install/setup.bash` where nothing is built."""
    found = _SOURCE.search(seen.text)
    call = seen.call("source") or seen.call(".")
    if not found or not call:
        return None
    if (seen.workspace / "install" / "setup.bash").is_file():
        return (
            f"{found['path']} is not where this terminal is. It lies in your workspace: "
            f"go there first, with  cd {_shown(seen)}"
        )
    return (
        f"{found['path']} does not exist yet: `colcon build` makes it. "
        "Build in the workspace first, then source."
    )


def not_executable(seen: Situation) -> str | None:
    """A script was started without the right to be."""
    found = _DENIED.search(seen.text)
    if not found:
        return None
    return (
        f"{found['path']} may not be started as a program. `chmod +x {found['path']}` allows it. "
        "`ros2 run` needs no such right: it uses the entry points in setup.py."
    )


def _elsewhere(seen: Situation, path: str) -> str:
    name = Path(path).name
    places = sorted(seen.workspace.glob(f"src/**/{escape(name)}"))
    if places:
        folder = places[0].parent.relative_to(seen.workspace)
        return (
            f"There is no {path} where this terminal is; it lies in {folder} of your workspace. "
            f"Go there first, with  cd {_shown(seen)}/{folder}"
        )
    meant = _near(seen, path)
    hint = f"Did you mean {meant}?" if meant else "`ls` shows what is there."
    return f"There is no {path} where this terminal is. {hint}"


def _near(seen: Situation, path: str) -> str | None:
    place = seen.calls[-1].place if seen.calls else seen.folder
    folder = place / Path(path).parent
    there = [one.name for one in folder.iterdir()] if folder.is_dir() else []
    meant = nearest(Path(path).name, there)
    return str(Path(path).parent / meant) if meant else None


def _shown(seen: Situation) -> str:
    """The workspace as it is typed: below the home folder with `~`."""
    home = str(seen.workspace.parent)
    own = str(Path.home())
    return str(seen.workspace).replace(own, "~", 1) if home.startswith(own) else str(seen.workspace)
