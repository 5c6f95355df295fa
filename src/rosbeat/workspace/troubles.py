"""What the file system says, in three parts."""

from __future__ import annotations

import errno
import os

from rosbeat.errors import WorkspaceError

_SPACE = (
    "The disk is full, or your share of it is.",
    "Make room (empty the trash, remove downloads) and run the cell again. Nothing was changed.",
)
_MAY_NOT = (
    "You may not write there: the file or its folder is read-only.",
    "Give yourself the right with `chmod u+w` on it, or save under another name.",
)
_FILE_FOLDER = (
    "A file is in the way where a folder has to be, or the other way round.",
    "Rename what is in the way, then run the cell again.",
)
_MEANINGS = {
    **dict.fromkeys((errno.ENOSPC, errno.EDQUOT), _SPACE),
    **dict.fromkeys((errno.EACCES, errno.EPERM, errno.EROFS), _MAY_NOT),
    **dict.fromkeys((errno.ENOTDIR, errno.EISDIR, errno.EEXIST), _FILE_FOLDER),
    errno.ENAMETOOLONG: (
        "The name is longer than this file system allows.",
        "Choose a shorter name.",
    ),
}


def trouble(doing: str, error: OSError) -> WorkspaceError:
    """Return an error for a person, from one of the operating system.

    Args:
        doing: What was not done, as in `src/a.py cannot be saved`.
        error: What the system said.
    """
    code = error.errno or 0
    reason = os.strerror(code) if code else str(error)
    means, to_try = _MEANINGS.get(
        code, ("The operating system refused.", "Mend the cause, then run the cell again.")
    )
    return WorkspaceError(f"{doing}: {reason}.", means, to_try)
