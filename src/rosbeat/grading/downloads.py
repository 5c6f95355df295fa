"""Tell whose each file of a download is, whatever folders are around everything.

A download often is one folder with all others in it, and an instructor may have put something
beside the learners: a roster, a spreadsheet, notes. Neither makes a learner, and neither hides one.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from rosbeat.grading.archives import EMPTY_FOLDER, File
from rosbeat.grading.platforms import owners_of, platforms_of
from rosbeat.grading.platforms.base import NOTEBOOKS, Owner, Platform
from rosbeat.grading.remarks import Remark

_Paths = Sequence[tuple[str, ...]]


@dataclass(frozen=True)
class Owned:
    """Hold the files of a download with their owners.

    Attributes:
        files: Each file once for each of its owners, learner by learner.
        remarks: About files that are nobody's.
    """

    files: tuple[tuple[Owner, File], ...]
    remarks: tuple[Remark, ...]


def with_owners(files: Sequence[File]) -> Owned:
    """Find out whose the files of a download are."""
    platforms = platforms_of(files)
    level = _wrappers([_as_folder(file) for file in files], platforms)
    deepest = _deepest([file.parts[level:] for file in files if file.parts[level:]], platforms)
    remarks: list[Remark] = []
    owned: list[tuple[Owner, File]] = []
    for file in files:
        owners = owners_of(file.parts[level:], platforms, deepest)
        owned += [(owner, file) for owner in owners]
        is_known = any(platform.is_own_file(file.parts[-1]) for platform in platforms)
        if not owners and not is_known and file.problem != EMPTY_FOLDER:
            text = "It is in no learner's folder, and its name names no learner."
            remarks.append(Remark("left-out", file.path, file.problem or text))
    owned.sort(key=lambda pair: (pair[0].id, pair[1].parts))
    return Owned(tuple(owned), tuple(remarks))


def _is_named(parts: tuple[str, ...], platforms: Sequence[Platform]) -> bool:
    """Return whether a platform made a name in a path."""
    named = [platform for platform in platforms if not platform.has_free_names]
    return bool(owners_of(parts, named))


def _deepest(paths: _Paths, platforms: Sequence[Platform]) -> int | None:
    """Return in how many parts of a path a name that a platform made is looked for.

    It may be anywhere, as in several downloads beside each other, unless there are folders without
    any: those are learners' own, and then only a folder's own name tells whose it is.
    """
    tried = [path for path in paths if path[-1].lower().endswith((*NOTEBOOKS, ".zip"))]
    named = {path[0] for path in tried if _is_named(path, platforms)}
    return None if named >= {path[0] for path in tried if len(path) > 1} else 1


def _as_folder(file: File) -> tuple[str, ...]:
    return (*file.parts[:-1], file.parts[-1][: -len(".zip")], "") if file.is_zip else file.parts


def _wrappers(paths: _Paths, platforms: Sequence[Platform]) -> int:
    """Return how many folders around everything do not tell learners apart."""
    level = 0
    while _is_wrapped([path[level:] for path in paths], platforms):
        # What is beside the folder is not in it, and says nothing about what is.
        paths = [path for path in paths if len(path) > level + 1]
        level += 1
    return level


def _is_wrapped(paths: _Paths, platforms: Sequence[Platform]) -> bool:
    """Return whether the one folder that there is has the learners in it, and is none itself.

    Beside the folder, and beside the learners in it, may be files that are no page. A page directly
    in the folder is its owner's, unless there are several folders with pages as well.
    """
    folders = {path[0] for path in paths if len(path) > 1}
    if len(folders) != 1 or _is_named((*folders,), platforms):
        return False
    inside = [path[1:] for path in paths if len(path) > 1]
    within = {path[0] for path in inside if len(path) > 1}
    tried = {path[0] for path in inside if len(path) > 1 and _may_be_page(path[-1])}
    loose = [path[-1] for path in (*paths, *inside) if len(path) == 1]
    return bool(within) and (len(tried) > 1 or not any(map(_may_be_page, loose)))


def _may_be_page(name: str) -> bool:
    """Return whether a file may be a page by its name; so may what a closed folder has in it."""
    return not name or name.lower().endswith(".ipynb")
