"""What runs without a sandbox, because somebody has said so: limits, and nothing else.

The work may read, change and send whatever its user may. All that is kept of the sandbox are the
limits, a folder and an environment of its own, and an end for the processes that it leaves behind.
"""

from __future__ import annotations

import os
import signal
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

from rosbeat.grading.sandbox import linux
from rosbeat.grading.sandbox.cage import Cage, Ends, become_work, wait_for


def become_bare(cage: Cage, root: str, ends: Ends, work: Callable[[int], None]) -> None:
    """Start the work, wait for it, and end what it leaves behind; never returns.

    Args:
        cage: Its environment and limits; the folders do not count.
        root: Its folder.
        ends: The pipes.
        work: What to run; it gets the descriptor for its result.
    """
    linux.prctl(linux.PR_SET_PDEATHSIG, signal.SIGKILL)
    linux.prctl(linux.PR_SET_CHILD_SUBREAPER, 1)
    os.setsid()
    child = os.fork()
    if child == 0:
        os.setsid()
        os.chdir(root)
        own = {**cage.environment, "HOME": root, "TMPDIR": root}
        become_work(Cage(environment=own, limits=cage.limits), ends, work)
    os.write(ends.control, f"{child}\n".encode())
    for end in (ends.result, ends.output, ends.control):
        os.close(end)
    code = wait_for(child)
    _end_orphans()
    os._exit(code & 0xFF)


def _end_orphans() -> None:
    """End whatever is left; whoever loses its parent becomes a child of this process."""
    while True:
        path = Path(f"/proc/self/task/{os.getpid()}/children")
        for child in path.read_text(encoding="ascii").split():
            with suppress(ProcessLookupError):
                os.kill(int(child), signal.SIGKILL)
        try:
            os.wait()
        except ChildProcessError:
            return
