"""A small process that makes the namespaces of sandboxes: `python -m ...nursery`.

A prepared worker is large: a fork of it costs milliseconds, however little the fork does. What has
to be done in processes of their own before an answer runs is done by forks of this one instead.

It reads lines and answers each with one: first the folders, as JSON (see `settings`), then `make`
and `end` in turns. When whoever started it is gone, so is it, and every sandbox with it.
"""

from __future__ import annotations

import json
import os
import signal
import socket
import sys
from collections.abc import Iterable, Mapping
from contextlib import suppress
from typing import Any, NoReturn, TextIO

from rosbeat.grading.sandbox import linux
from rosbeat.grading.sandbox.namespaces import OWN, give_up_rights
from rosbeat.grading.sandbox.view import furnish, make_root, outermost

#: What it answers; after `TROUBLE` stands what went wrong.
READY, MADE, ENDED, TROUBLE = "ready", "made", "ended", "! "
MAKE, END = "make", "end"


def settings(root: str, readable: Iterable[str], hidden: Iterable[str], scratch: int) -> str:
    """The first line that it reads.

    Args:
        root: An empty folder, which it needs until it is ready.
        readable: Folders that sandboxes may read.
        hidden: Folders in those that are empty in sandboxes.
        scratch: Bytes of `/tmp` of a sandbox, and of its `/dev/shm`.
    """
    paths = ("/" + os.path.abspath(path).lstrip("/") for path in readable)
    folders = {"readable": list(outermost(paths)), "hidden": list(hidden)}
    return json.dumps({"root": root, "scratch": scratch, **folders})


def main(lines: TextIO = sys.stdin, answers: TextIO = sys.stdout) -> None:
    """Make and end sandboxes, one at a time, until there are no more lines.

    Args:
        lines: Where it is told what to do.
        answers: Where it says what came of it.
    """
    linux.prctl(linux.PR_SET_PDEATHSIG, signal.SIGKILL)
    told: dict[str, Any] = {}
    first: First | None = None
    for line in lines:
        try:
            if line.strip() == MAKE:
                first = First(told["scratch"], told["readable"])
                said = MADE
            elif line.strip() == END:
                assert first is not None
                first.end()
                said = ENDED
            else:
                told = json.loads(line)
                _settle(told)
                said = READY
        except OSError as error:
            said = f"{TROUBLE}{error}"
        print(said, file=answers, flush=True)


def _settle(told: Mapping[str, Any]) -> None:
    """Fork into a process namespace and a mount namespace of one's own, with a root of its own.

    From there on new process namespaces can be made and left again. Whoever has called this is in
    them afterwards; the process that it was waits for it, and ends when it does.
    """
    linux.unshare(linux.CLONE_NEWNS | linux.CLONE_NEWPID)
    inner = os.fork()
    if inner:
        os.closerange(0, 2)
        os.waitpid(inner, 0)
        os._exit(0)
    linux.prctl(linux.PR_SET_PDEATHSIG, signal.SIGKILL)
    make_root(told["root"], told["readable"], told["hidden"])


class First:
    """Process 1 of a sandbox: when it dies, the kernel kills all others in there.

    It waits in a process namespace that is new, in all other namespaces of the sandbox, and lives
    as long as somebody holds the other end of its pipe.

    Args:
        scratch: See `settings`.
        readable: See `settings`.

    Raises:
        OSError: If the kernel refuses something.
    """

    def __init__(self, scratch: int, readable: Iterable[str]) -> None:
        says, tells = os.pipe()
        lives, self._holds = os.pipe()
        try:
            linux.unshare(linux.CLONE_NEWPID)
            self._pid = os.fork()
            if self._pid == 0:
                _be_first(tells, lives, scratch, readable)
        finally:
            _come_back()
            os.close(tells)
            os.close(lives)
        with open(says, encoding="utf-8") as file:
            said = file.read()
        if said != READY:
            self.end()
            raise OSError(said or "it ended early")

    def end(self) -> None:
        """Kill it, and with it everything in there; to be waited for until all have ended.

        Whoever has put a process in there has to wait for that one at the same time.
        """
        os.kill(self._pid, signal.SIGKILL)
        os.waitpid(self._pid, 0)
        os.close(self._holds)


def _come_back() -> None:
    """Let further children be in this process's own process namespace again."""
    own = linux.descriptor_of(os.getpid())
    linux.enter(own, linux.CLONE_NEWPID)
    os.close(own)


def _be_first(tells: int, lives: int, scratch: int, readable: Iterable[str]) -> NoReturn:
    try:
        os.setsid()
        _close_all_but(tells, lives)
        linux.unshare(OWN)
        furnish(scratch, readable)
        linux.loopback_up()
        socket.sethostname("sandbox")
        give_up_rights()
        # After that, for who changes its rights is forgotten by this.
        linux.prctl(linux.PR_SET_PDEATHSIG, signal.SIGKILL)
        # Nobody in there may look into this process, which could end the others.
        linux.prctl(linux.PR_SET_DUMPABLE, 0)
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        # Whatever loses its parent in there becomes its child, and is cleared away when it ends.
        signal.signal(signal.SIGCHLD, signal.SIG_IGN)
        os.write(tells, READY.encode())
        os.close(tells)
        os.read(lives, 1)
    except BaseException as error:
        with suppress(OSError):
            os.write(tells, f"{error}".encode())
    finally:
        os._exit(0)


def _close_all_but(one: int, other: int) -> None:
    low, high = sorted((one, other))
    for begin, end in ((0, low), (low + 1, high), (high + 1, os.sysconf("SC_OPEN_MAX"))):
        os.closerange(begin, end)


if __name__ == "__main__":
    main()
