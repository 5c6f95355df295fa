"""A kernel of our own: this interpreter, local sockets instead of ports, a clean environment.

Jupyter chooses TCP ports before the kernel binds them, and now and then another process is
faster. Sockets in a folder of our own cannot be taken, so builds and tests may run side by side.
"""

from __future__ import annotations

import os
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from jupyter_client.kernelspec import KernelSpec, KernelSpecManager

from rosbeat.domains import lease_domain

KERNEL_NAME = "python3"
DISPLAY_NAME = "Python 3 (ipykernel)"
#: Names the folder of a page's own workspace (`rosbeat.workspace.place` reads it).
STEADY_HOME = "ROSBEAT_STEADY_HOME"
# The kernel's address is `<folder>/s-<n>`, and a socket's path ends at 107 bytes.
_LONGEST_FOLDER = 90
# pytest's variable makes ipykernel leave file descriptor 2 alone, and what C code logs is lost;
# the others would change what a page prints from one person's terminal to the next.
_DROPPED = ("PYTEST_CURRENT_TEST", "PYTHONSTARTUP", "PYTHONINSPECT", "FORCE_COLOR", "COLUMNS")


class OwnInterpreter(KernelSpecManager):
    """Answers every kernel name with the running interpreter.

    A `python3` kernel that somebody registered for another installation would otherwise come first.
    """

    def get_kernel_spec(self, kernel_name: str) -> KernelSpec:
        """Describe how to start ipykernel with this interpreter."""
        # No history file: the database would be shared with every other kernel of the user.
        options = ["-f", "{connection_file}", "--HistoryManager.hist_file=:memory:"]
        argv = [sys.executable, "-m", "ipykernel_launcher", *options]
        return KernelSpec(argv=argv, display_name=DISPLAY_NAME, language="python")


@dataclass(frozen=True)
class KernelPlace:
    """Where a kernel's files are, and what it finds in its environment.

    Attributes:
        folder: Holds the sockets, the connection file and IPython's settings.
        environment: The environment variables of the kernel.
    """

    folder: Path
    environment: dict[str, str]

    @property
    def log(self) -> Path:
        """Where to send what the kernel's process itself writes, which no cell shows."""
        return self.folder / "stderr"

    def last_words(self) -> str:
        """Return the end of what the kernel's process itself wrote, outside of every cell."""
        return self.log.read_text(errors="replace").strip()[-2000:] if self.log.exists() else ""

    def options(self) -> dict[str, object]:
        """Return the keyword arguments for a kernel manager of jupyter_client."""
        return {
            "kernel_name": KERNEL_NAME,
            "kernel_spec_manager": OwnInterpreter(),
            "transport": "ipc",
            "ip": str(self.folder / "s"),
            "connection_file": str(self.folder / "kernel.json"),
        }


@contextmanager
def kernel_place() -> Iterator[KernelPlace]:
    """Make a place for one kernel, and remove it afterwards.

    The page gets an empty workspace of its own, and its terminals a ROS domain of their own, so
    that pages which run at the same time do not meet.

    Raises:
        DomainsExhaustedError: Every private domain id of this machine is taken.
    """
    with _temporary_folder() as name:
        lease = lease_domain()
        try:
            yield KernelPlace(Path(name), _environment(Path(name), lease.domain_id))
        finally:
            lease.release()


def _temporary_folder() -> tempfile.TemporaryDirectory[str]:
    # A process that a page's terminal started may write once more while it is being ended.
    return tempfile.TemporaryDirectory(
        prefix="rb-", dir=_short_folder(), ignore_cleanup_errors=True
    )


def _environment(folder: Path, domain_id: int) -> dict[str, str]:
    environment = {k: v for k, v in os.environ.items() if k not in _DROPPED}
    # A user's own IPython start-up files would run in every page.
    environment["IPYTHONDIR"] = str(folder / "ipython")
    (folder / "home").mkdir()
    environment[STEADY_HOME] = str(folder / "home")
    environment["ROS_DOMAIN_ID"] = str(domain_id)
    return environment


def _short_folder() -> str | None:
    usual = tempfile.gettempdir()
    return None if len(os.fsencode(usual)) < _LONGEST_FOLDER - len("/rb-12345678") else "/tmp"
