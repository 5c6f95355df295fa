"""A real kernel in a process of its own, watched closely."""

from __future__ import annotations

import os
import queue
import re
import signal
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from jupyter_client.blocking import BlockingKernelClient
from jupyter_client.connect import write_connection_file

TESTS = Path(__file__).parents[1]
DEADLINE = 30.0
#: Whether everything is tried, and often: `ROSBEAT_TORTURE=full`.
FULL = os.environ.get("ROSBEAT_TORTURE") == "full"
_COLOUR = re.compile(r"\x1b\[[0-9;]*m")


@dataclass(frozen=True)
class Reply:
    """How a cell ended.

    Attributes:
        error: The exception's class name, or an empty string.
        text: What the cell printed, standard error included, without its colours.
        trace: What a page shows of the exception, without colours.
        seconds: From the interrupt, or else from the beginning, to the end of the cell.
        raw: What the cell printed, with the control sequences of its colours.
    """

    error: str
    text: str
    seconds: float
    trace: str = ""
    raw: str = ""


class Kernel:
    """Starts an ipykernel; use it in a `with` block, which kills what is left of it."""

    def __enter__(self) -> Kernel:
        self._folder = tempfile.TemporaryDirectory(prefix="k")
        file = str(Path(self._folder.name) / "c.json")
        # Sockets in a folder: TCP ports are taken by somebody else now and then.
        write_connection_file(file, transport="ipc", ip=str(Path(self._folder.name) / "s"))
        self._log = (Path(self._folder.name) / "log").open("w+")
        command = [sys.executable, "-m", "ipykernel_launcher", "-f", file]
        self.process = subprocess.Popen(
            command, env=_environ(), stdout=self._log, stderr=self._log, start_new_session=True
        )
        self._client = BlockingKernelClient(connection_file=file)
        self._client.load_connection_file()
        self._client.start_channels()
        try:
            self._wait_until_ready()
        except BaseException:
            self.__exit__()  # nobody else would end the process
            raise
        return self

    def __exit__(self, *_: object) -> None:
        self._client.stop_channels()
        if self.process.poll() is None:
            self.process.kill()
        self.process.wait()
        self._log.close()
        self._folder.cleanup()

    def run(self, code: str, sent: dict[str, object] | None = None) -> Reply:
        """Run a cell to its end.

        Args:
            code: The cell.
            sent: What a front end sends beside it, such as the cell's id (`cellId`).
        """
        begin = time.monotonic()
        content = {"code": code, "silent": False, "store_history": True, "allow_stdin": False}
        message = self._client.session.msg("execute_request", content, metadata=sent)
        self._client.shell_channel.send(message)
        return self._finish(str(message["header"]["msg_id"]), [], begin)

    def interrupt(self, code: str, after: float) -> Reply:
        """Run a cell that prints `go`; interrupt it so many seconds later."""
        message, printed = self._client.execute(code), []
        deadline = time.monotonic() + DEADLINE
        while "go" not in "".join(printed):
            assert time.monotonic() < deadline, "the cell did not begin"
            assert self._listen(message, printed, deadline) is None, f"it ended: {printed}"
        time.sleep(after)
        self.process.send_signal(signal.SIGINT)
        return self._finish(message, printed, time.monotonic())

    def shared_memory(self) -> set[str]:
        """Files in shared memory that the kernel has mapped."""
        maps = Path(f"/proc/{self.process.pid}/maps").read_text()
        return {line.split()[-1] for line in maps.splitlines() if "/dev/shm/" in line}

    def exit(self, code: str = "") -> int:
        """Ask the kernel to end, or let a cell end it; return the exit code."""
        # Not a shutdown request, which may wait for ever in ipykernel: see notebooks/kernel.py.
        self._client.execute(code or "get_ipython().ask_exit()")
        return self.process.wait(timeout=DEADLINE)

    def log(self) -> str:
        """What the kernel wrote to its own standard output and error."""
        self._log.flush()
        return Path(self._log.name).read_text()

    def _wait_until_ready(self) -> None:
        deadline = time.monotonic() + DEADLINE
        while True:
            try:
                self._client.wait_for_ready(timeout=DEADLINE)
                return
            except RuntimeError:
                # It takes a second without a heartbeat for death; on a busy machine a kernel needs
                # longer than that to begin. The process itself knows.
                if self.process.poll() is not None or time.monotonic() > deadline:
                    raise

    def _finish(self, message: str, printed: list[str], begin: float) -> Reply:
        ended = None
        while ended is None:
            ended = self._listen(message, printed, begin + DEADLINE)
        trace = _COLOUR.sub("", "\n".join(ended.get("traceback", ())))
        raw = "".join(printed)
        seconds = time.monotonic() - begin
        return Reply(str(ended.get("ename", "")), _COLOUR.sub("", raw), seconds, trace, raw)

    def _listen(self, message: str, printed: list[str], deadline: float) -> dict[str, Any] | None:
        """Take one message; return the kernel's reply when the cell has ended."""
        try:
            heard = self._client.get_iopub_msg(timeout=max(0.01, deadline - time.monotonic()))
        except queue.Empty:
            raise AssertionError(f"the kernel hangs; printed: {''.join(printed)}") from None
        if heard["parent_header"].get("msg_id") != message:
            return None
        content = heard["content"]
        if heard["msg_type"] == "stream":
            printed.append(content["text"])
        if heard["msg_type"] == "status" and content["execution_state"] == "idle":
            reply = self._client.get_shell_msg(timeout=DEADLINE)
            while reply["parent_header"].get("msg_id") != message:
                reply = self._client.get_shell_msg(timeout=DEADLINE)
            return dict(reply["content"])
        return None


def _environ() -> dict[str, str]:
    path = os.pathsep.join([str(TESTS), *filter(None, sys.path)])
    environ = {**os.environ, "PYTHONPATH": path, "PYTHONFAULTHANDLER": "1"}
    environ.pop("PYTEST_CURRENT_TEST", None)  # ipykernel would not capture file descriptor 2
    return environ
