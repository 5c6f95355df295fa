"""Let one `rosbeat grade` at a time into a folder of results; the next one waits and says for whom.

Two at once would write each other's files. The lock is advisory, `flock` on the folder itself: it
ends with its process, however that ends, and leaves nothing behind.
"""

from __future__ import annotations

import fcntl
import getpass
import os
import socket
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from datetime import datetime
from pathlib import Path

from rosbeat.grading.files import printable

#: Says who is in the folder; it is there only as long as somebody is.
FILE = ".grading"


@contextmanager
def alone_in(folder: Path, tell: Callable[[str], None]) -> Iterator[None]:
    """Wait until nobody else grades into a folder, and keep others waiting meanwhile.

    Args:
        folder: The folder of results; it is made if it is not there.
        tell: Is told one sentence, if somebody is in the folder.
    """
    with ExitStack() as stack:
        # A folder that cannot be made or locked is no reason to wait: the first file says why.
        with suppress(OSError):
            folder.mkdir(parents=True, exist_ok=True)
            handle = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
            stack.callback(os.close, handle)
            _wait(handle, folder, tell)
            (folder / FILE).write_text(_myself(), encoding="utf-8")
            stack.callback((folder / FILE).unlink, missing_ok=True)
        yield


def _wait(handle: int, folder: Path, tell: Callable[[str], None]) -> None:
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        who = "Another rosbeat grade"
        with suppress(OSError, ValueError):
            who = (folder / FILE).read_text(encoding="utf-8") or who
        name = printable(str(folder), 1000)
        tell(f"{printable(who, 300)} is grading into {name}; this one goes on when it is done.")
        fcntl.flock(handle, fcntl.LOCK_EX)


def _myself() -> str:
    """Return who this process is, as the beginning of a sentence."""
    name = "Somebody"
    with suppress(KeyError, OSError, ImportError):  # an account without a name
        name = getpass.getuser()
    since = f"{datetime.now():%Y-%m-%d %H:%M}"
    return f"{name} on {socket.gethostname()} (process {os.getpid()}, since {since})"
