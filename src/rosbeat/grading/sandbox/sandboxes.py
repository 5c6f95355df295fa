"""Sandboxes, as whoever runs something in them has them; see `cage` for what they are made of."""

from __future__ import annotations

import os
import select
import signal
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from contextlib import suppress
from functools import partial

from rosbeat.errors import GradingError
from rosbeat.grading.sandbox import linux
from rosbeat.grading.sandbox.cage import Cage, Ends, Work, become_work
from rosbeat.grading.sandbox.calls import forbid_calls
from rosbeat.grading.sandbox.namespaces import OWN, give_up_rights
from rosbeat.grading.sandbox.nursery import END, MAKE, TROUBLE, settings
from rosbeat.grading.sandbox.place import cannot_be_made
from rosbeat.grading.sandbox.processes import children

_NURSERY = "rosbeat.grading.sandbox.nursery"
#: Seconds between two looks at who has ended.
_LOOK = 0.02
#: `__WALL` of wait(2): also children that say nothing when they end.
_ALL = 0x40000000
_ENDED = "the process that makes sandboxes has ended"


class Sandboxes:
    """Sandboxes that are all furnished alike, one at a time; usable in a `with` block.

    Whoever has one can start other processes before the first work, and not afterwards.

    Args:
        cage: How they are furnished.

    Raises:
        GradingError: If none can be made on this machine.
    """

    def __init__(self, cage: Cage) -> None:
        self._process = subprocess.Popen(
            [sys.executable, "-m", _NURSERY],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            cwd="/",  # Python imports from there, and elsewhere there may be anything
            text=True,
            encoding="utf-8",
        )
        self._nursery = self._first = self._work = 0
        try:
            self._furnish(cage)
        except GradingError:
            self.close()
            raise

    def __enter__(self) -> Sandboxes:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _furnish(self, cage: Cage) -> None:
        with tempfile.TemporaryDirectory(prefix="rosbeat-") as root:
            os.chmod(root, 0o755)
            try:
                self._tell(settings(root, cage.readable, cage.hidden, cage.limits.scratch))
                self._heard()
                self._nursery = self._child_of(self._process.pid)
            except ConnectionError as error:
                raise cannot_be_made(str(error)) from error

    def start(self, cage: Cage, ends: Ends, work: Work) -> int:
        """Fork this process into a new sandbox.

        Args:
            cage: The work's environment and limits; the folders are those of the beginning.
            ends: The pipes.
            work: What to run.

        Returns:
            The number of the process.

        Raises:
            GradingError: If the sandbox cannot be made.
            ConnectionError: If what makes them has been ended by somebody.
        """
        self._tell(MAKE)
        self._heard()
        self._first = self._child_of(self._nursery)
        try:
            self._work = self._forked(cage, ends, work)
        except OSError as error:
            self._tell(END)
            self._heard()
            raise cannot_be_made(str(error)) from error
        return self._work

    def _forked(self, cage: Cage, ends: Ends, work: Work) -> int:
        """Fork into the process namespace; the child enters the others.

        This process itself stays where it is. To have its children there again takes rights that
        an ordinary user has not; so it can fork into sandboxes only, from here on.
        """
        first = linux.descriptor_of(self._first)
        try:
            linux.enter(first, linux.CLONE_NEWPID)
            child = os.fork()
            if child == 0:
                become_work(cage, ends, work, partial(_enter, first))
            return child
        finally:
            os.close(first)

    def inhabitants(self) -> Sequence[int]:
        """The work, and what adopts whatever loses its parent in there.

        A process may also make another one that is its sibling (clone(2), `CLONE_PARENT`).
        """
        return (*self._guests(), self._first)

    def _guests(self) -> list[int]:
        return [child for child in children(os.getpid()) if child != self._process.pid]

    def end(self) -> int:
        """End the sandbox that was started last, with all that runs in it.

        Returns:
            The exit code of the work, or less the number of the signal that has ended it.

        Raises:
            ConnectionError: If what makes them has been ended by somebody.
        """
        self._tell(END)
        # The first process is not gone before all others are, and some wait to be heard of here.
        code = self._code_of_work()
        self._clear_away()
        self._heard()
        return code

    def _code_of_work(self) -> int:
        while True:
            ended, status = os.waitpid(-1, _ALL)
            if ended == self._process.pid:
                raise ConnectionError(_ENDED)
            if ended == self._work and not os.WIFSTOPPED(status):
                return os.waitstatus_to_exitcode(status)

    def _clear_away(self) -> None:
        assert self._process.stdout is not None
        while not select.select([self._process.stdout], [], [], _LOOK)[0]:
            with suppress(ChildProcessError):
                os.waitpid(-1, os.WNOHANG | _ALL)

    def _tell(self, line: str) -> None:
        assert self._process.stdin is not None
        self._process.stdin.write(f"{line}\n")
        self._process.stdin.flush()

    def _heard(self) -> str:
        assert self._process.stdout is not None
        said = self._process.stdout.readline().rstrip("\n")
        if not said:
            raise ConnectionError(_ENDED)
        if said.startswith(TROUBLE):
            raise cannot_be_made(said.removeprefix(TROUBLE))
        return said

    @staticmethod
    def _child_of(process: int) -> int:
        """The only child of a process, by the number that it has here; in there it has another."""
        found = children(process)
        if not found:
            raise ConnectionError(_ENDED)
        return found[0]

    def close(self) -> None:
        """End what makes them."""
        for pipe in (self._process.stdin, self._process.stdout):
            with suppress(OSError):
                assert pipe is not None
                pipe.close()
        while self._process.poll() is None:
            for guest in self._guests():
                with suppress(ChildProcessError):
                    os.waitpid(guest, os.WNOHANG | _ALL)
            with suppress(subprocess.TimeoutExpired):
                self._process.wait(_LOOK)


def _enter(first: int) -> None:
    """Go where the first process is, as an ordinary user.

    Args:
        first: A descriptor of it.
    """
    os.setsid()
    linux.enter(first, OWN)
    os.chdir("/tmp")
    give_up_rights()
    # After that, for who changes its rights is forgotten by this.
    linux.prctl(linux.PR_SET_PDEATHSIG, signal.SIGKILL)
    forbid_calls()
