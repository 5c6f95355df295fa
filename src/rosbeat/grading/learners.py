"""Whose a file is, from where it lies: one folder per learner, Moodle's downloads, and Canvas's.

Sources of the forms: Moodle's "Download all submissions", with and without folders
(`mod/assign/locallib.php`, `download_submissions`), and Canvas's "Download Submissions"
(`app/models/content_zipper.rb`).
"""

from __future__ import annotations

import re
from dataclasses import dataclass

#: `Ana Muster_4711_assignsubmission_file_`, and behind it the file's name if there are no folders.
_MOODLE = re.compile(r"(?s)(?P<name>.+)_(?P<id>\d+)_assignsubmission_[a-z]+(?:_(?P<file>.*))?")
#: `musterana_LATE_4711_998877_page-1.ipynb`; the number before the suffix counts attempts.
_CANVAS = re.compile(
    r"(?s)(?P<name>[^_]+)_(?P<late>LATE_)?(?P<id>\d+)_(?P<submission>\d+)_(?P<file>.+)"
)
_ATTEMPT = re.compile(r"(?s)(?P<stem>.+)-(?P<number>\d{1,3})(?P<suffix>\.\w+)")


@dataclass(frozen=True)
class Whose:
    """Whose a file is.

    Attributes:
        id: What tells a learner from others: the number that the system gave, or the folder's name.
        name: What the learner is called.
        file: The file's own name, path included, without what the system has added.
        system: `moodle`, `canvas` or `folder`.
        late: Whether the system has marked it as late.
        attempt: Which attempt it is, if the system counts them; else 0.
    """

    id: str
    name: str
    file: str
    system: str
    late: bool = False
    attempt: int = 0


def whose(parts: tuple[str, ...]) -> Whose | None:
    """Say whose a file is, or None if its path does not tell.

    Args:
        parts: Its path, folder by folder.
    """
    return _of_moodle(parts) or _of_canvas(parts) or _of_folder(parts)


def _of_moodle(parts: tuple[str, ...]) -> Whose | None:
    for place, part in enumerate(parts):
        found = _MOODLE.fullmatch(part)
        if found:
            rest = [found["file"] or "", *parts[place + 1 :]]
            file = "/".join(one for one in rest if one)
            return Whose(found["id"], found["name"].strip(), file, "moodle")
    return None


def _of_canvas(parts: tuple[str, ...]) -> Whose | None:
    for place, part in enumerate(parts):
        found = _CANVAS.fullmatch(part)
        if not found:
            continue
        rest = "/".join((found["file"], *parts[place + 1 :]))
        again = _ATTEMPT.fullmatch(rest)
        file = again["stem"] + again["suffix"] if again else rest
        attempt = int(again["number"]) if again else 0
        late = bool(found["late"])
        return Whose(found["id"], found["name"].strip(), file, "canvas", late, attempt)
    return None


def _of_folder(parts: tuple[str, ...]) -> Whose | None:
    if len(parts) < 2:
        return None
    return Whose(parts[0], parts[0], "/".join(parts[1:]), "folder")


def own_path(path: str) -> str:
    """A file as its learner knows it, without what the system has added, for where that is short.

    Args:
        path: Where it was found, with slashes; if it does not tell whose it is, it stays.
    """
    owner = whose(tuple(path.split("/")))
    return (owner.file if owner else "") or path


def without_wrapper(paths: list[tuple[str, ...]]) -> int:
    """How many folders around everything do not tell learners apart.

    A download is often one folder with all others in it.

    Args:
        paths: The paths of all files.

    Returns:
        How many parts at the beginning of each path to leave out.
    """
    level = 0
    while paths and all(len(path) > level + 2 for path in paths):
        names = {path[level] for path in paths}
        if len(names) != 1 or _belongs_to_one(names.pop()):
            break
        level += 1
    return level


def _belongs_to_one(name: str) -> bool:
    return bool(_MOODLE.fullmatch(name) or _CANVAS.fullmatch(name))
