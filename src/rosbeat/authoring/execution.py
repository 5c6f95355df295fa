"""Run a page from top to bottom in a kernel of its own.

The kernel uses this Python interpreter, and sockets in a folder instead of ports: Jupyter chooses
TCP ports before the kernel binds them, and occasionally another process takes one first. Nobody
else can take sockets in our own folder, so builds and tests may run side by side.
"""

from __future__ import annotations

import asyncio
import logging
import os
import signal
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from jupyter_client.kernelspec import KernelSpec, KernelSpecManager
from jupyter_client.manager import AsyncKernelManager
from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError, CellTimeoutError, DeadKernelError
from nbformat import NotebookNode

from rosbeat.domains import lease_domain
from rosbeat.environment import CHOSEN, DOMAIN
from rosbeat.errors import LessonError

KERNEL_NAME = "python3"
DISPLAY_NAME = "Python 3 (ipykernel)"
#: Names the folder of a page's own workspace (`rosbeat.workspace.location` reads it).
STEADY_HOME = "ROSBEAT_STEADY_HOME"
#: Names the page in its kernel, as Jupyter's server does (`rosbeat.workspace.location` reads it).
PAGE = "JPY_SESSION_NAME"
#: Seconds of wall time that one cell may take.
CELL_SECONDS = 60.0
EXPECTED = "raises-exception"
# What a thread, a finalizer or a callback prints when it dies where nobody catches it.
BACKGROUND = ("Exception in thread ", "Exception ignored in", "Task exception was never retrieved")

# RuntimeError is what jupyter_client raises when a kernel does not answer its first question.
_FAILURES = (CellExecutionError, CellTimeoutError, DeadKernelError, RuntimeError)
# The kernel's address is `<folder>/s-<n>`, and a socket's path ends at 107 bytes.
_LONGEST_FOLDER = 90
# pytest's variable makes ipykernel leave file descriptor 2 alone, and what C code logs is lost;
# the others would change what a page prints from one person's terminal to the next.
_DROPPED = (
    *("PYTEST_CURRENT_TEST", "PYTHONSTARTUP", "PYTHONINSPECT", "FORCE_COLOR", "COLUMNS"),
    CHOSEN,  # the page's domain is no default of the course, which a kernel may change
)


class OwnInterpreter(KernelSpecManager):
    """Resolve every kernel name to the running interpreter.

    Otherwise a `python3` kernel that is registered for another installation would take precedence.
    """

    def get_kernel_spec(self, kernel_name: str) -> KernelSpec:
        """Describe how to start ipykernel with this interpreter."""
        # No history file: the database would be shared with every other kernel of the user.
        # And the names of the course, also where no configuration of the environment brings them.
        options = ["-f", "{connection_file}", "--HistoryManager.hist_file=:memory:"]
        options.append("--ext=rosbeat")
        argv = [sys.executable, "-m", "ipykernel_launcher", *options]
        return KernelSpec(argv=argv, display_name=DISPLAY_NAME, language="python")


@dataclass(frozen=True)
class KernelPlace:
    """Say where a kernel's files are, and what it finds in its environment.

    Attributes:
        folder: Holds the sockets, the connection file and IPython's settings.
        environment: The environment variables of the kernel.
    """

    folder: Path
    environment: dict[str, str]

    @property
    def log(self) -> Path:
        """Return the file for what the kernel's process itself writes, which no cell shows."""
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
def kernel_place(page: str = "") -> Iterator[KernelPlace]:
    """Make the folder and the environment of one kernel, and remove the folder afterwards.

    The page gets an empty workspace of its own, and its terminals a ROS domain of their own, so
    that pages which run at the same time do not meet.

    Args:
        page: The name of the page's file, such as `05_set_the_entry_points.ipynb`.

    Raises:
        DomainsExhaustedError: Every domain id for checks and builds is in use on this machine.
    """
    usual = tempfile.gettempdir()
    is_short = len(os.fsencode(usual)) < _LONGEST_FOLDER - len("/rb-12345678")
    # A process that a page's terminal started may write once more while it is being ended.
    with tempfile.TemporaryDirectory(
        prefix="rb-", dir=None if is_short else "/tmp", ignore_cleanup_errors=True
    ) as name:
        lease = lease_domain()
        try:
            yield KernelPlace(Path(name), _environment(Path(name), lease.domain_id, page))
        finally:
            lease.release()


def _environment(folder: Path, domain_id: int, page: str) -> dict[str, str]:
    environment = {k: v for k, v in os.environ.items() if k not in _DROPPED}
    environment[PAGE] = page
    # A user's own IPython start-up files would run in every page.
    environment["IPYTHONDIR"] = str(folder / "ipython")
    (folder / "home").mkdir()
    environment[STEADY_HOME] = str(folder / "home")
    environment[DOMAIN] = str(domain_id)
    return environment


def run_page(page: NotebookNode, folder: Path) -> None:
    """Run every code cell of a page and store the outputs in it.

    Args:
        page: The page; its cells get outputs and execution counts.
        folder: The kernel's current directory; it is made if it does not exist.

    Raises:
        LessonError: A cell failed, did not fail although it was to, or took too long.
    """
    folder.mkdir(parents=True, exist_ok=True)
    run = _Run(page)
    with kernel_place(f"{page.metadata.rosbeat.lesson}.ipynb") as place:
        try:
            asyncio.run(run.through(folder, place))
        except (asyncio.CancelledError, *_FAILURES) as error:
            if run.interrupted:
                raise KeyboardInterrupt from None
            raise run.explain(error, place) from error
    for cell in page.cells:
        if cell.cell_type == "code":
            _require_honest_end(page, cell)


class _Run:
    """One run of one page, and how far it came."""

    def __init__(self, page: NotebookNode) -> None:
        self._page = page
        self._running: Any = None
        self.interrupted = False

    async def through(self, folder: Path, place: KernelPlace) -> None:
        # Left to itself, an interrupt reaches nbclient as a kernel that died, or tears the event
        # loop down around a running kernel; which one depends on the version of Python.
        task = asyncio.current_task()
        with suppress(RuntimeError, ValueError):  # not in the main thread
            asyncio.get_running_loop().add_signal_handler(signal.SIGINT, self._interrupt, task)
        manager = AsyncKernelManager(**place.options())
        # The history option is in the kernel's own command line; it refuses to get it twice.
        client = NotebookClient(self._page, manager, ipython_hist_file="", timeout=CELL_SECONDS)
        # What goes wrong is said once, in the error; nbclient's own logger belongs to everybody.
        client.log = logging.Logger("rosbeat.authoring", logging.CRITICAL)
        with place.log.open("wb") as log:
            await client.async_start_new_kernel(cwd=str(folder), env=place.environment, stderr=log)
        succeeded = False
        try:
            await client.async_start_new_kernel_client()
            for index, cell in enumerate(self._page.cells):
                self._running = cell
                await client.async_execute_cell(cell, index, client.code_cells_executed + 1)
            succeeded = True
        finally:
            if client.kc is not None:
                client.kc.stop_channels()
            # A page that ran well ends politely, so that ROS may tidy up after itself.
            await manager.shutdown_kernel(now=not succeeded)

    def _interrupt(self, task: asyncio.Task[Any] | None) -> None:
        self.interrupted = True
        if task is not None:
            task.cancel()

    def explain(self, error: BaseException, place: KernelPlace) -> LessonError:
        if self._running is None:
            last = place.last_words().rsplit("\n", 1)[-1]
            return LessonError(f"{_name(self._page)}: the kernel did not start: {error}.", last)
        return _failure(self._page, self._running, _happened(error))


def _happened(error: BaseException) -> str:
    if isinstance(error, CellExecutionError):
        return f"raised {error.ename}: {error.evalue}"
    if isinstance(error, DeadKernelError):
        return "ended the kernel"
    if isinstance(error, CellTimeoutError):
        return f"did not end within {CELL_SECONDS:g} s"
    return f"could not be run: {error}"


def _require_honest_end(page: NotebookNode, cell: Any) -> None:  # noqa: ANN401 - untyped library
    raised = any(output.output_type == "error" for output in cell.outputs)
    if EXPECTED in cell.metadata.get("tags", ()) and not raised:
        raise _failure(page, cell, f"is tagged {EXPECTED} but raised nothing")
    if any(mark in _printed(cell) for mark in BACKGROUND):
        raise _failure(page, cell, "left an exception in the background")


def _failure(page: NotebookNode, cell: Any, happened: str) -> LessonError:  # noqa: ANN401 - untyped
    rows = ["    cell    | " + line for line in cell.source.splitlines()]
    rows += ["    printed | " + line for line in _printed(cell).splitlines()[-20:]]
    return LessonError(
        f"{_name(page)}: the cell at line {cell.metadata.get('line', '?')} {happened}.",
        "\n".join(["The page does not run to the bottom.", *rows]),
        "Mend the cell in src/lessons and build again; "
        f"if it is to fail, give it tags=[{EXPECTED!r}].",
    )


def _printed(cell: Any) -> str:  # noqa: ANN401 - untyped library
    return "".join(output.text for output in cell.outputs if output.output_type == "stream")


def _name(page: NotebookNode) -> str:
    return f"{page.metadata.rosbeat.lesson}.py"
