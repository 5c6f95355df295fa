"""What runs without a sandbox, because somebody has said so: limits, and nothing else.

The work may read, change and send whatever its user may. All that is kept of the sandbox are the
limits, a folder and an environment of its own, and an end for the processes that it leaves behind.
"""

from __future__ import annotations

import os
import signal
import tempfile
from collections.abc import Sequence
from contextlib import suppress
from functools import partial
from typing import NoReturn

from rosbeat.grading.sandbox import linux
from rosbeat.grading.sandbox.cage import Cage, Ends, Work, become_work
from rosbeat.grading.sandbox.processes import children


class Bare:
    """Where work runs with limits only, one after the other; see `place.Place`."""

    def __init__(self) -> None:
        self._keeper = 0
        self._folder: tempfile.TemporaryDirectory[str] | None = None

    def start(self, cage: Cage, ends: Ends, work: Work) -> int:
        """Fork this process, and again in there.

        Args:
            cage: The work's environment and limits.
            ends: The pipes.
            work: What to run.

        Returns:
            The number of the process that waits for the work.
        """
        self._folder = tempfile.TemporaryDirectory(prefix="rosbeat-", ignore_cleanup_errors=True)
        self._keeper = os.fork()
        if self._keeper == 0:
            _keep(cage, self._folder.name, ends, work)
        return self._keeper

    def inhabitants(self) -> Sequence[int]:
        """The process that waits for the work; it adopts whatever loses its parent."""
        return (self._keeper,)

    def end(self) -> int:
        """End the work and what it has left behind.

        Returns:
            The exit code of the work, or less the number of the signal that has ended it.
        """
        for child in children(self._keeper):
            with suppress(ProcessLookupError):
                os.kill(child, signal.SIGKILL)
        _, status = os.waitpid(self._keeper, 0)
        assert self._folder is not None
        self._folder.cleanup()
        code = os.waitstatus_to_exitcode(status)
        return 128 - code if code > 128 else code


def _keep(cage: Cage, folder: str, ends: Ends, work: Work) -> NoReturn:
    """Start the work, wait for it, and end what it leaves behind."""
    linux.prctl(linux.PR_SET_PDEATHSIG, signal.SIGKILL)
    linux.prctl(linux.PR_SET_CHILD_SUBREAPER, 1)
    os.setsid()
    child = os.fork()
    if child == 0:
        own = {**cage.environment, "HOME": folder, "TMPDIR": folder}
        settled = Cage(environment=own, limits=cage.limits)
        become_work(settled, ends, work, partial(_enter, folder))
    for end in (ends.result, ends.output, ends.control):
        os.close(end)
    code = _wait_for(child)
    _end_orphans()
    os._exit(code & 0xFF)


def _enter(folder: str) -> None:
    os.setsid()
    os.chdir(folder)


def _wait_for(child: int) -> int:
    """Clear away whatever ends, until the work does; 128 and more say which signal ended it."""
    while True:
        ended, status = os.wait()
        if ended == child:
            code = os.waitstatus_to_exitcode(status)
            return code if code >= 0 else 128 - code


def _end_orphans() -> None:
    """End whatever is left; whoever loses its parent becomes a child of this process."""
    while True:
        for child in children(os.getpid()):
            with suppress(ProcessLookupError):
                os.kill(child, signal.SIGKILL)
        try:
            os.wait()
        except ChildProcessError:
            return
