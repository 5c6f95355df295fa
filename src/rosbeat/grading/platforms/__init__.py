"""Know the learning platforms from which a class's submissions come, one module for each.

To add a platform, write a subclass of `base.Platform` and a line in `PLATFORMS`: reading a
download, matching a roster, and the files to upload follow from it.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Sequence
from typing import TYPE_CHECKING

from rosbeat.grading.platforms.base import Owner, Platform
from rosbeat.grading.platforms.blackboard import Blackboard
from rosbeat.grading.platforms.brightspace import Brightspace
from rosbeat.grading.platforms.canvas import Canvas
from rosbeat.grading.platforms.folder import Folder
from rosbeat.grading.platforms.gradescope import Gradescope
from rosbeat.grading.platforms.moodle import Moodle

if TYPE_CHECKING:
    from rosbeat.grading.archives import File

#: All platforms, in the order in which names are tried. The last one takes what nobody has named.
PLATFORMS: tuple[Platform, ...] = (
    Moodle(),
    Canvas(),
    Brightspace(),
    Blackboard(),
    Gradescope(),
    Folder(),
)


def platform_named(name: str) -> Platform:
    """Return the platform of a submission; an unknown one is as a folder."""
    return next((platform for platform in PLATFORMS if platform.name == name), PLATFORMS[-1])


def platforms_of(files: Sequence[File]) -> tuple[Platform, ...]:
    """Return all platforms as they are for one download, those that have named most files first.

    A learner may call a file as another platform would, so that one name has two meanings. What is
    in a folder that a platform has named is not counted, as its owner has named that.
    """
    opened = [platform.opened(files) for platform in PLATFORMS]
    named_by: dict[str, list[str]] = {}
    counts: Counter[str] = Counter()
    for file in files:
        for part in file.parts:
            if part not in named_by:
                named_by[part] = [platform.name for platform in opened if platform.owners((part,))]
            if named_by[part]:
                counts.update(named_by[part])
                break
    return tuple(sorted(opened, key=lambda platform: -counts[platform.name]))


def platform_of_roster(header: Collection[str]) -> Platform | None:
    """Return the platform that exports rosters with these columns, if there is one."""
    return next((platform for platform in PLATFORMS if platform.has_roster(header)), None)


def owners_of(
    parts: tuple[str, ...],
    platforms: Sequence[Platform] | None = None,
    deepest: int | None = None,
) -> tuple[Owner, ...]:
    """Return whose a file is; nobody, if its path does not tell.

    Args:
        parts: Its path, folder by folder.
        platforms: The platforms as they are for the download; by default, as they are in general.
        deepest: In how many parts a name that a platform made is looked for; by default in all.
            What is in a learner's own folder has names that the learner chose.
    """
    known = PLATFORMS if platforms is None else platforms
    named = [platform for platform in known if not platform.has_free_names]
    # The outermost name counts: what is in a folder, its owner has named.
    for place in range(len(parts[:deepest])):
        for platform in named:
            if owners := platform.owners(parts[place:]):
                return owners
    free = (platform.owners(parts) for platform in known if parts and platform.has_free_names)
    return next(filter(None, free), ())


def own_path(path: str) -> str:
    """Return a file's path as its learner knows it, without what the platform added."""
    owners = owners_of(tuple(path.split("/")))
    return (owners[0].file if owners else "") or path
