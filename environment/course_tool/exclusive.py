"""One command at a time in a checkout."""

from __future__ import annotations

import fcntl
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from course_tool.messages import say


@contextmanager
def exclusive(folder: Path) -> Iterator[None]:
    """Hold a folder for this process; wait, and say so, while another command holds it.

    The lock is on the folder itself, so it leaves no file and ends with the process.
    """
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        _acquire(descriptor)
        yield
    finally:
        os.close(descriptor)


def _acquire(descriptor: int) -> None:
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        say(
            "Another ./environment/course is at work in this checkout; waiting until it is done ..."
        )
        fcntl.flock(descriptor, fcntl.LOCK_EX)
    except OSError:
        return  # a file system without such locks (some network drives): go on without
