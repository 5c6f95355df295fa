"""Know the learning platforms from which a class's submissions come, one module for each.

To add a platform, write a subclass of `base.Platform` and a line in `PLATFORMS`: reading a
download, matching a roster, and the files to upload follow from it.
"""

from __future__ import annotations

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
    """Return all platforms as they are for one download."""
    return tuple(platform.opened(files) for platform in PLATFORMS)


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
    for platform in PLATFORMS if platforms is None else platforms:
        for place in range(len(parts[:deepest])):
            owners = platform.owners(parts[place:])
            if owners:
                return owners
    return ()


def own_path(path: str) -> str:
    """Return a file's path as its learner knows it, without what the platform added."""
    owners = owners_of(tuple(path.split("/")))
    return (owners[0].file if owners else "") or path
