"""Mistakes with folders: `cd` and `mkdir`, and a terminal whose folder has gone."""

from __future__ import annotations

import re
import shlex
from pathlib import Path, PurePosixPath

from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.workspace.locating import nearest
from rosbeat.workspace.meanings.situation import Situation, home
from rosbeat.workspace.place import VARIABLE

_MKDIR = re.compile(r"^mkdir: cannot create directory '(?P<path>[^']+)': (?P<why>.+)", re.M)
_CD = re.compile(r"^bash: (?:line \d+: )?cd: (?P<path>.+): No such file or directory", re.M)
_CD_FILE = re.compile(r"^bash: (?:line \d+: )?cd: (?P<path>.+): Not a directory", re.M)
_CD_WORDS = re.compile(r"^bash: (?:line \d+: )?cd: too many arguments", re.M)
_GLUED = re.compile(r"^bash: (?:line \d+: )?cd(?P<path>[.~/][^:]*): ", re.M)
_TOP = "starts with `/`, and that is the top of the whole disk"


def way_to(relative: str = "") -> str:
    """Return the `cd` that leads into the workspace from everywhere.

    Args:
        relative: A folder of the workspace; by default the workspace itself.
    """
    rest = f"/{shlex.quote(relative)}" if relative not in ("", ".") else ""
    return f'cd "${VARIABLE}"{rest}'


def near(base: Path, typed: str, folders: bool = False) -> str | None:
    """Return the path that was probably meant, written like the one that was typed, or None.

    Args:
        base: The folder from which the path counts.
        typed: A path that does not exist.
        folders: Whether only a folder will do.
    """
    path = Path(typed)
    above = base / path.parent
    there = [one.name for one in above.iterdir()
             if one.is_dir() or not folders] if above.is_dir() else []  # fmt: skip
    meant = nearest(path.name, there)
    return str(path.parent / meant) if meant else None


def folder_gone(seen: Situation) -> Diagnosis | None:
    """The folder of the terminal was removed, perhaps by another terminal."""
    failed = seen.code or ": error: " in seen.text
    if not failed or not seen.calls or not _is_gone(seen):
        return None
    way = way_to() if seen.workspace.is_dir() else "cd"
    return Diagnosis(
        "folder-gone",
        "The folder that this terminal is in does not exist any more.",
        f"Go to another: `{way}`",
    )


def _is_gone(seen: Situation) -> bool:
    if not seen.calls[-1].place.exists():
        return True
    # A new folder has the name of the old one: only the programs notice.
    return "os.getcwd()" in seen.text and "FileNotFoundError: [Errno 2]" in seen.text


def mkdir_failed(seen: Situation) -> Diagnosis | None:
    """`mkdir` without the `~`, without a parent, or of what is there."""
    found = _MKDIR.search(seen.text)
    if not found or not seen.call("mkdir"):
        return None
    path, why = found["path"], found["why"]
    if "File exists" in why:
        return Diagnosis(
            "folder-exists",
            f"{path} is there already, so there is nothing to do.",
            "With -p, `mkdir` says nothing about that.",
        )
    if _nothing_at_the_top(path) and ("No such" in why or "den" in why):
        return _top_of_the_disk(path)
    return _no_parent(path) if "No such file" in why else None


def _top_of_the_disk(path: str) -> Diagnosis:
    return Diagnosis(
        "tilde-missing",
        f"{path} {_TOP}, which is not yours.",
        f"Your own folder is called `~`: write  mkdir -p ~/{shlex.quote(path.lstrip('/'))}",
    )


def _no_parent(path: str) -> Diagnosis:
    return Diagnosis(
        "parents-missing",
        f"The folder in which {Path(path).name} should be made does not exist.",
        "With -p, `mkdir` makes it too.",
    )


def _nothing_at_the_top(path: str) -> bool:
    """Whether a path begins at `/` with a name that is not there, as `/Documents` is not."""
    parts = PurePosixPath(path).parts
    return (
        len(parts) > 1 and parts[0] == "/" and parts[1] != "home" and not Path(*parts[:2]).exists()
    )


def cd_without_a_blank(seen: Situation) -> Diagnosis | None:
    """`cd..` is one word, and no command."""
    found = _GLUED.search(seen.text)
    if not found or not seen.program(rf"cd{re.escape(found['path'])}"):
        return None
    return Diagnosis(
        "space-missing", "A blank is missing after `cd`:", f"write  cd {found['path']}"
    )


def cd_with_a_blank_too_many(seen: Situation) -> Diagnosis | None:
    """`cd .. src` is two folders, and `cd` goes to one."""
    call = seen.call("cd")
    if not call or not _CD_WORDS.search(seen.text):
        return None
    return Diagnosis(
        "space-too-many",
        f"`cd` goes to one folder, and {len(call.words) - 1} words follow it.",
        "A path has no blank in it: `/` joins its parts. "
        "If a name has one, put quotes around the whole path.",
    )


def cd_with_backslashes(seen: Situation) -> Diagnosis | None:
    r"""`cd ..\src`, as it is written on Windows."""
    lines = re.findall(r"^\s*cd\s+(\S*\\[^\s\\].*)$", seen.command, re.M)
    if not lines or not _CD.search(seen.text) or r"\ " in lines[-1]:
        return None
    return Diagnosis(
        "path-separator",
        r"There is a `\` in the path, and bash takes it away.",
        "On Linux `/` stands between the parts of a path.",
    )


def cd_to_a_file(seen: Situation) -> Diagnosis | None:
    """`cd` to a file: it leads into folders only."""
    found = _CD_FILE.search(seen.text)
    if not found or not seen.call("cd"):
        return None
    return Diagnosis(
        "not-a-folder",
        f"{found['path'].strip()} is a file, and `cd` goes into folders.",
        "`cat` shows what is in a file.",
    )


def cd_failed(seen: Situation) -> Diagnosis | None:
    """`cd` to a folder that is not there."""
    found = _CD.search(seen.text)
    call = seen.call("cd")
    if not found or not call:
        return None
    path = found["path"].strip()
    return _in_the_workspace(seen, path) or _at_the_top(path) or _not_here(call.place, path)


def _in_the_workspace(seen: Situation, path: str) -> Diagnosis | None:
    """Something of the workspace, which lies elsewhere than it was looked for."""
    parts = PurePosixPath(path).parts
    if seen.workspace.name not in parts or not seen.workspace.is_dir():
        return None
    rest = str(PurePosixPath(*parts[parts.index(seen.workspace.name) + 1 :]))
    here = rest if (seen.workspace / rest).is_dir() else ""
    meant = None if here else near(seen.workspace, rest, folders=True)
    if not meant:
        return _absent(f"{path}.", f"Your workspace is here:  {way_to(here)}")
    return _absent(f"{rest} in your workspace.", f"Did you mean  {way_to(meant)}")


def _at_the_top(path: str) -> Diagnosis | None:
    if not _nothing_at_the_top(path):
        return None
    rest = path.strip("/")
    there = (home() / rest).is_dir()
    hint = f": write  cd ~/{shlex.quote(rest)}" if there else ", and `ls ~` shows what is there."
    return Diagnosis("tilde-missing", f"{path} {_TOP}.", f"Your own folder is called `~`{hint}")


def _not_here(place: Path, path: str) -> Diagnosis:
    meant = near(place, path, folders=True)
    where = "" if path.startswith("/") else " where this terminal is"
    if meant:
        return _absent(f"{path}{where}.", f"Did you mean {shlex.quote(meant)}?")
    return _absent(f"{path}{where}.", "`pwd` shows where you are, `ls` what is there.")


def _absent(what: str, hint: str) -> Diagnosis:
    return Diagnosis("folder-not-found", f"There is no folder {what}", hint)
