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


def is_of_one(files: Sequence[File]) -> bool:
    """Return whether pages are directly in what was handed in, so that one learner has all of it.

    They are not if a platform has named any of them, or if there are folders with pages or zip
    files beside them: those are learners.
    """
    tried = [file for file in files if file.is_zip or _may_be_page(file.parts[-1])]
    platforms = platforms_of(files)
    return bool(tried) and not any(
        len(file.parts) > 1 or file.is_zip or _is_named(file.parts, platforms) for file in tried
    )


def with_one_owner(files: Sequence[File], learner: str) -> Owned:
    """Return that all files are one learner's; pages count that lie in the outermost folder."""
    pages = [file for file in files if file.parts[-1].lower().endswith(NOTEBOOKS[0])]
    level = min((len(file.parts) for file in pages), default=0)
    inner = [file for file in pages if len(file.parts) > level]
    text = "It is in a folder below the pages that were handed in, so it does not count."
    return Owned(
        tuple(
            (Owner(learner, learner, "/".join(file.parts), "folder"), file)
            for file in files
            if file not in inner
        ),
        tuple(Remark("left-out", file.path, text) for file in inner),
    )


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
    """Return how many folders around everything do not tell learners apart.

    A page directly in such a folder is its owner's, so the folder is a learner's; unless there are
    several folders with pages in the innermost one: then the page is beside the learners.
    """
    strict, level = None, 0
    while True:
        within = [path[level:] for path in paths if len(path) > level]
        folders = {path[0] for path in within if len(path) > 1}
        if len(folders) != 1 or _is_named((*folders,), platforms):
            break
        inside = [path[1:] for path in within if len(path) > 1]
        named = {path for path in inside if _is_named(path[:1], platforms)}
        if not named and not any(len(path) > 1 for path in inside):
            break
        loose = [path for path in (*within, *inside) if len(path) == 1 and path not in named]
        if strict is None and any(_may_be_page(path[-1]) for path in loose):
            strict = level
        level += 1
    tried = {path[0] for path in within if len(path) > 1 and _may_be_page(path[-1])}
    tried |= {path[0] for path in within if _is_named(path[:1], platforms)}
    return level if strict is None or len(tried) > 1 else strict


def _may_be_page(name: str) -> bool:
    """Return whether a file may be a page by its name; so may what a closed folder has in it."""
    return not name or name.lower().endswith(".ipynb")
