"""Run a launch on this machine: processes of the operating system, the clock, and signals."""

from __future__ import annotations

import asyncio
import errno
import logging
import os
import pty
import signal
import termios
import time
from collections.abc import Callable, MutableMapping
from contextlib import suppress
from typing import TYPE_CHECKING, TextIO

from ros2_command.errors import note
from ros2_command.verbs.run import GroupWatch

from launch.host import Order, Watcher
from launch.logging import launch_config, logging_to

if TYPE_CHECKING:
    from launch.launch_service import Engine

#: Seconds to go on reading what an ended process has printed; a child of it may hold the pipe.
_REST = 0.2
_CHUNK = 65536
_SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGQUIT, signal.SIGHUP)


class RealHost:
    """Run a launch on this machine.

    Args:
        debug: Whether to log more.
    """

    def __init__(self, debug: bool = False) -> None:
        self.environment: MutableMapping[str, str] = os.environ
        launch_config.level = logging.DEBUG if debug else logging.INFO
        self._loop = asyncio.new_event_loop()
        self._engine: Engine | None = None
        self._done: asyncio.Future[None] | None = None
        self._woken = self._interrupted = self._deaf = False
        self._watch: GroupWatch | None = None
        self._processes: set[_RealProcess] = set()
        self._tasks: set[asyncio.Task[None]] = set()
        self._files: dict[str, TextIO] = {}

    # What a launch needs.

    def wake(self) -> None:
        """Let the launch look soon at what there is to do."""
        if self._engine is not None and not self._woken:
            self._woken = True
            self._loop.call_soon_threadsafe(self._work)

    def call_later(self, seconds: float, call: Callable[[], None]) -> Callable[[], None]:
        """Call something after some seconds, and return what cancels that."""
        return self._loop.call_later(seconds, call).cancel

    def start(self, order: Order, watcher: Watcher) -> None:
        """Start a process, and tell the watcher what becomes of it."""
        task = self._loop.create_task(self._run_process(order, watcher))
        self._tasks.add(task)
        task.add_done_callback(self._forget)

    def _forget(self, task: asyncio.Task[None]) -> None:
        self._tasks.discard(task)
        error = task.exception()
        if error is not None and self._done is not None and not self._done.done():
            self._done.set_exception(error)  # a fault of ours must not leave the launch waiting

    def log(self, level: int, name: str, text: str) -> None:
        """Log a line of the launch itself, on the screen and in `launch.log`."""
        if level < launch_config.level:
            return
        known = {
            **{"levelname": logging.getLevelName(level), "name": name, "msg": text},
            "created": time.time(),
        }
        self._print(launch_config.screen_format.format(**known))
        self._keep("launch.log", launch_config.file_format.format(**known))

    def note(self, *lines: str) -> None:
        """Show what the original does not say, among the errors."""
        with suppress(OSError):
            note(*lines)

    def write(self, line: str, process: str, stream: str, places: frozenset[str]) -> None:
        """Show or keep a line that a process has printed."""
        if "screen" in places:
            self._print(line)
        if "log" in places:
            self._keep("launch.log", f"{time.time():.7f} {line}")
        if "own_log" in places:
            self._keep(f"{process}-{stream}.log", line)
            self._keep(f"{process}.log", line)

    def log_folder(self) -> str:
        """Return the folder of this launch's log files."""
        return launch_config.log_dir

    def _print(self, line: str) -> None:
        if self._deaf:
            return
        try:
            print(line, flush=True)
        except OSError:  # nobody reads any more, as behind `| head`
            self._deaf = True
            if self._engine is not None:
                self._engine.shut_down("nobody reads the output")

    def _keep(self, name: str, line: str) -> None:
        if name not in self._files:
            path = os.path.join(launch_config.log_dir, name)
            self._files[name] = open(path, "a", encoding="utf-8", errors="replace")  # noqa: SIM115 - closed at the end
        print(line, file=self._files[name], flush=True)

    # The launch as a whole.

    def run(self, engine: Engine) -> int:
        """Run a launch to its end, and return its exit code."""
        # The watch blocks these signals for good, and this process until it can answer them.
        before = signal.pthread_sigmask(signal.SIG_BLOCK, _SIGNALS)
        with GroupWatch() as self._watch:
            for number in _SIGNALS:
                handle = self._on_sigint if number == signal.SIGINT else self._on_sigterm
                self._loop.add_signal_handler(number, handle, number)
            signal.pthread_sigmask(signal.SIG_SETMASK, before)
            return self._run(engine)

    def _run(self, engine: Engine) -> int:
        self._engine = engine
        loop = self._loop
        asyncio.set_event_loop(loop)
        self._done = loop.create_future()
        try:
            with logging_to(self):
                self.log(
                    logging.INFO, "launch", f"All log files can be found below {self.log_folder()}"
                )
                level = logging.getLevelName(launch_config.level)
                self.log(logging.INFO, "launch", f"Default logging verbosity is set to {level}")
                self.wake()
                loop.run_until_complete(self._done)
                loop.run_until_complete(asyncio.gather(*self._tasks))
        finally:
            for process in self._processes:
                process.send_signal(signal.SIGKILL)
            for file in self._files.values():
                file.close()
            loop.close()
            asyncio.set_event_loop(None)
        return engine.return_code

    def _work(self) -> None:
        self._woken = False
        assert self._engine is not None
        assert self._done is not None
        self._engine.work()
        if self._engine.finished and not self._done.done():
            self._done.set_result(None)

    def _on_sigint(self, number: int) -> None:
        assert self._engine is not None
        text = "user interrupted with ctrl-c (SIGINT)"
        if self._interrupted:
            self.log(logging.WARNING, "launch", f"{text} again, ignoring...")
            return
        self._interrupted = True
        self.log(logging.WARNING, "launch", text)
        if self._engine.context.noninteractive and self._reached_group(number):
            self._engine.context.noninteractive = False
        self._engine.shut_down("ctrl-c (SIGINT)", due_to_sigint=True)

    def _on_sigterm(self, number: int) -> None:
        assert self._engine is not None
        name = signal.Signals(number).name
        self.log(logging.ERROR, "launch", f"user interrupted with ctrl-\\ ({name}), terminating...")
        self._engine.return_code = 1
        reached = self._reached_group(number)
        self._engine.context.noninteractive &= not reached
        self._engine.shut_down(name, due_to_sigint=reached)

    def _reached_group(self, number: int) -> bool:
        """Return whether the processes have got the signal as well, as from `timeout`.

        A second one would break the good end of a node that has begun to end.
        """
        return self._watch is not None and self._watch.has_seen(number)

    # Processes.

    async def _run_process(self, order: Order, watcher: Watcher) -> None:
        ends = [_Stream.open(order.with_terminal) for _ in range(2)]
        try:
            transport, protocol = await self._spawn(order, ends)
        except OSError as error:
            for stream in ends:
                stream.close()
            watcher.failed(error)
            return
        finally:
            for stream in ends:
                os.close(stream.writing)
        running = _RealProcess(transport)
        self._processes.add(running)
        watcher.started(running)
        for fd, stream in enumerate(ends, 1):
            stream.read_into(self._loop, lambda data, fd=fd: watcher.printed(fd, data))  # type: ignore[misc]
        returncode = await protocol.returncode
        await asyncio.wait([stream.ended for stream in ends], timeout=_REST)
        for stream in ends:
            stream.close()
        transport.close()
        self._processes.discard(running)
        watcher.ended(returncode)

    async def _spawn(
        self, order: Order, ends: list[_Stream]
    ) -> tuple[asyncio.SubprocessTransport, _Protocol]:
        out, err = (stream.writing for stream in ends)
        begin = self._loop.subprocess_shell if order.in_shell else self._loop.subprocess_exec
        words = [" ".join(order.words)] if order.in_shell else order.words
        return await begin(
            _Protocol, *words, stdin=asyncio.subprocess.PIPE, stdout=out, stderr=err,
            cwd=order.folder, env=order.environment,
        )  # fmt: skip


class _Protocol(asyncio.SubprocessProtocol):
    """Hear the end of a process; `Process.wait` also waits for children that hold its input."""

    def __init__(self) -> None:
        self.returncode: asyncio.Future[int] = asyncio.get_running_loop().create_future()
        self._transport: asyncio.SubprocessTransport | None = None

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        assert isinstance(transport, asyncio.SubprocessTransport)
        self._transport = transport

    def process_exited(self) -> None:
        assert self._transport is not None
        code = self._transport.get_returncode()
        assert code is not None
        self.returncode.set_result(code)


class _RealProcess:
    def __init__(self, transport: asyncio.SubprocessTransport) -> None:
        self._transport = transport
        self.pid = transport.get_pid()

    def send_signal(self, number: int) -> None:
        """Send it a signal; one that has ended gets none."""
        with suppress(ProcessLookupError):
            self._transport.send_signal(number)


class _Stream:
    """Read what a process prints, from a pipe or a terminal."""

    def __init__(self, reading: int, writing: int) -> None:
        self._reading, self.writing = reading, writing
        self._loop: asyncio.AbstractEventLoop | None = None
        self.ended: asyncio.Future[None]

    @classmethod
    def open(cls, terminal: bool) -> _Stream:
        """Make one."""
        if not terminal:
            return cls(*os.pipe())
        reading, writing = pty.openpty()
        settings = termios.tcgetattr(writing)
        settings[1] &= ~termios.ONLCR  # a line ends as in a pipe
        termios.tcsetattr(writing, termios.TCSANOW, settings)
        return cls(reading, writing)

    def read_into(self, loop: asyncio.AbstractEventLoop, take: Callable[[bytes], None]) -> None:
        """Give what is read to a function, until the end."""
        self.ended = loop.create_future()
        self._loop = loop
        loop.add_reader(self._reading, self._read, take)

    def _read(self, take: Callable[[bytes], None]) -> None:
        try:
            data = os.read(self._reading, _CHUNK)
        except OSError as error:
            if error.errno != errno.EIO:  # what a terminal says at its end
                raise
            data = b""
        if data:
            take(data)
        else:
            self._stop()

    def _stop(self) -> None:
        if self._loop is not None and not self.ended.done():
            self._loop.remove_reader(self._reading)
            self.ended.set_result(None)

    def close(self) -> None:
        """Read no more."""
        self._stop()
        os.close(self._reading)
