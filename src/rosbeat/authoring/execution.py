"""Running a page from top to bottom in a fresh kernel."""

from __future__ import annotations

import asyncio
import logging
import signal
import time
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from jupyter_client.manager import AsyncKernelManager
from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError, CellTimeoutError, DeadKernelError
from nbformat import NotebookNode

from rosbeat.authoring.kernel import KernelPlace, kernel_place
from rosbeat.errors import LessonError

# RuntimeError is what jupyter_client raises when a kernel does not answer its first question.
_FAILURES = (
    CellExecutionError,
    CellTimeoutError,
    DeadKernelError,
    RuntimeError,
)
EXPECTED = "raises-exception"
# What a thread, a finalizer or a callback prints when it dies where nobody catches it.
BACKGROUND = ("Exception in thread ", "Exception ignored in", "Task exception was never retrieved")


@dataclass(frozen=True)
class Deadlines:
    """How long a page may take, in seconds of wall time.

    Attributes:
        cell: For one cell.
        page: For the whole page, the start of its kernel included.
    """

    cell: float = 60.0
    page: float = 240.0


def run_page(page: NotebookNode, folder: Path, deadlines: Deadlines | None = None) -> None:
    """Run every code cell of a page and store the outputs in it.

    Args:
        page: The page; its cells get outputs and execution counts.
        folder: The kernel's current directory.
        deadlines: How long it may take.

    Raises:
        LessonError: A cell failed, did not fail although it was to, or took too long.
    """
    run = _Run(page, deadlines or Deadlines())
    with kernel_place() as place:
        try:
            asyncio.run(run.through(folder, place))
        except (asyncio.CancelledError, *_FAILURES) as error:
            if run.interrupted:
                raise KeyboardInterrupt from None
            raise run.explain(error, place) from error
    for cell in page.cells:
        _require_honest_end(page, cell)


class _Run:
    """One run of one page: where it is, and how much time is left."""

    def __init__(self, page: NotebookNode, limits: Deadlines) -> None:
        self._page = page
        self._limits = limits
        self._end = time.monotonic() + limits.page
        self._started: list[int] = []
        self.interrupted = False

    async def through(self, folder: Path, place: KernelPlace) -> None:
        self._heed_ctrl_c()
        manager = AsyncKernelManager(**place.options())
        client = self._client(manager)
        with place.log.open("wb") as log:
            await client.async_start_new_kernel(cwd=str(folder), env=place.environment, stderr=log)
        succeeded = False
        try:
            await client.async_start_new_kernel_client()
            await self._cells(client)
            succeeded = True
        finally:
            if client.kc is not None:
                client.kc.stop_channels()
            # A page that ran well ends politely, so that ROS may tidy up after itself.
            await manager.shutdown_kernel(now=not succeeded)

    async def _cells(self, client: NotebookClient) -> None:
        for index, cell in enumerate(self._page.cells):
            await client.async_execute_cell(cell, index, client.code_cells_executed + 1)

    def _heed_ctrl_c(self) -> None:
        # Left to itself, an interrupt reaches nbclient as a kernel that died, or tears the event
        # loop down around a running kernel; which one depends on the version of Python.
        task = asyncio.current_task()
        with suppress(RuntimeError, ValueError):  # not in the main thread
            asyncio.get_running_loop().add_signal_handler(signal.SIGINT, self._interrupt, task)

    def _interrupt(self, task: asyncio.Task[Any] | None) -> None:
        self.interrupted = True
        if task is not None:
            task.cancel()

    def _client(self, manager: AsyncKernelManager) -> NotebookClient:
        # The history option is in the kernel's own command line; it refuses to get it twice.
        client = NotebookClient(self._page, manager, ipython_hist_file="")
        client.timeout_func = self._seconds_for
        client.on_cell_execute = lambda cell, cell_index: self._started.append(cell_index)
        # What goes wrong is said once, in the error; nbclient's own logger belongs to everybody.
        client.log = logging.Logger("rosbeat.authoring", logging.CRITICAL)
        return client

    def _seconds_for(self, _cell: object) -> float:
        # Not zero, which nbclient takes for "no limit".
        return max(0.1, min(self._limits.cell, self._end - time.monotonic()))

    def explain(self, error: BaseException, place: KernelPlace) -> LessonError:
        if not self._started:
            last = place.last_words().rsplit("\n", 1)[-1]
            return LessonError(f"{_name(self._page)}: the kernel did not start: {error}.", last)
        cell = self._page.cells[self._started[-1]]
        return _failure(self._page, cell, self._happened(error))

    def _happened(self, error: BaseException) -> str:
        if isinstance(error, CellExecutionError):
            return f"raised {error.ename}: {error.evalue}"
        if isinstance(error, DeadKernelError):
            return "ended the kernel"
        if not isinstance(error, CellTimeoutError):
            return f"could not be run: {error}"
        if time.monotonic() >= self._end:
            return f"was still running when the page's {self._limits.page:g} s were over"
        return f"did not end within {self._limits.cell:g} s"


def _require_honest_end(page: NotebookNode, cell: Any) -> None:  # noqa: ANN401 - untyped library
    if cell.cell_type != "code":
        return
    raised = any(output.output_type == "error" for output in cell.outputs)
    if EXPECTED in cell.metadata.get("tags", ()) and not raised:
        raise _failure(page, cell, f"is tagged {EXPECTED} but raised nothing")
    if any(mark in text_of(cell.outputs) for mark in BACKGROUND):
        raise _failure(page, cell, "left an exception in the background")


def text_of(outputs: Any) -> str:  # noqa: ANN401 - untyped library
    """Join what outputs printed on either stream."""
    return "".join(output.text for output in outputs if output.output_type == "stream")


def _failure(page: NotebookNode, cell: Any, happened: str) -> LessonError:  # noqa: ANN401
    return LessonError(
        f"{_name(page)}: the cell at line {cell.metadata.get('line', '?')} {happened}.",
        f"The page does not run to the bottom.\n{_exhibit(cell)}",
        "Mend the cell in src/lessons and build again; "
        f"if it is to fail, give it tags=[{EXPECTED!r}].",
    )


def _exhibit(cell: Any) -> str:  # noqa: ANN401 - untyped library
    rows = ["    cell    | " + line for line in cell.source.splitlines()]
    rows += ["    printed | " + line for line in text_of(cell.outputs).splitlines()[-20:]]
    return "\n".join(rows)


def _name(page: NotebookNode) -> str:
    return f"{page.metadata.rosbeat.lesson}.py"
