"""nbval's kernel, started in peace and watched while it works."""

from __future__ import annotations

import time
from contextlib import ExitStack
from queue import Empty
from typing import Any

from jupyter_client.manager import KernelManager
from nbval.kernel import RunningKernel

from rosbeat.authoring.execution import kernel_place

_LOOK_EVERY = 0.5
_LEAVE_WITHIN = 20.0


class KernelDiedError(Exception):
    """The kernel's process ended while a cell was running."""


class WatchedKernel(RunningKernel):
    """A kernel of this interpreter that is missed as soon as it dies.

    Attributes:
        reply: What it said at the end of the last cell.
        asked: The id of the message that made it run the last cell.
    """

    def __init__(self, cwd: str, startup_timeout: float, page: str = "") -> None:
        self.reply: dict[str, Any] = {}
        self.asked = ""
        self._stack = ExitStack()
        # PYTEST_CURRENT_TEST stays behind, and sockets are files: see rosbeat.authoring.execution.
        self.place = self._stack.enter_context(kernel_place(page))
        log = self._stack.enter_context(self.place.log.open("wb"))
        self.km = KernelManager(**self.place.options())
        try:
            self.km.start_kernel(cwd=cwd, env=self.place.environment, stderr=log)
            self.kc = self.km.client()
            self.kc.start_channels()
            self.kc.wait_for_ready(timeout=startup_timeout)
            self._ensure_iopub_up()
        except BaseException:
            self.stop()
            raise

    def execute_cell_input(self, cell_input: str, allow_stdin: bool | None = None) -> str:
        # With history, as in JupyterLab: without it a trailing `;` silences nothing.
        self.asked = self.kc.execute(
            cell_input, store_history=True, allow_stdin=allow_stdin, stop_on_error=False
        )
        return self.asked

    def await_reply(self, msg_id: str, timeout: float | None = None) -> None:
        deadline = time.monotonic() + (timeout or 0)
        while True:
            try:
                message = self.get_message("shell", timeout=_LOOK_EVERY)
            except Empty:
                self._require_life()
                if timeout is not None and time.monotonic() > deadline:
                    raise
                continue
            if message["parent_header"].get("msg_id") == msg_id:
                self.reply = message["content"]
                return

    def _require_life(self) -> None:
        if not self.km.is_alive():
            raise KernelDiedError(f"The kernel died in this cell. {self.last_words()}")

    def last_words(self) -> str:
        """What the process itself wrote last, outside of every cell."""
        return self.place.last_words()

    def leave(self) -> int | None:
        """Ask the kernel to end by itself, and return its exit code."""
        process = self.km.provisioner.process
        # Not a shutdown request: ipykernel's control thread flushes once more after it, and waits
        # for ever if the thread that publishes has ended first (1 time in 60 on a busy machine).
        self.kc.execute("get_ipython().ask_exit()", store_history=False)
        deadline = time.monotonic() + _LEAVE_WITHIN
        while process.poll() is None and time.monotonic() < deadline:
            time.sleep(0.02)
        return process.poll()

    def stop(self) -> None:
        if not hasattr(self, "km"):
            return
        if hasattr(self, "kc"):
            self.kc.stop_channels()
        self.km.shutdown_kernel(now=True)
        del self.km
        self._stack.close()
