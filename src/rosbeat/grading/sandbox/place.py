"""What a place is where work runs: sandboxes, or nothing but limits."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from rosbeat.errors import GradingError
from rosbeat.grading.sandbox.cage import Cage, Ends, Work


class Place(Protocol):
    """Where work runs, one after the other; see `sandboxes.Sandboxes` and `unsafe.Bare`."""

    def start(self, cage: Cage, ends: Ends, work: Work) -> int:
        """Fork a process that runs the work, or one that waits for it, and give its number.

        Raises:
            GradingError: If there is no such place on this machine.
        """
        ...

    def inhabitants(self) -> Sequence[int]:
        """Processes that run there, with all of their descendants."""
        ...

    def end(self) -> int:
        """End everything there; the exit code of the work, or less a signal's number."""
        ...


def cannot_be_made(why: str) -> GradingError:
    """The error for a machine on which no sandbox can be made.

    Args:
        why: What the kernel said.
    """
    return GradingError(
        f"This machine does not let the sandbox be made: {why}.",
        "Other people's code would run here with all that you may do, so nothing was run.",
        "Allow user namespaces (`sudo sysctl kernel.unprivileged_userns_clone=1`, on Ubuntu 24.04 "
        "also `kernel.apparmor_restrict_unprivileged_userns=0`), or grade as root or in a "
        "virtual machine. The kernel has to be Linux 5.8 or newer (`uname -r`).",
    )
