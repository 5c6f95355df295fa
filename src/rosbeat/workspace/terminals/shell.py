"""A bash at the other end of a pseudo-terminal, and a thread that reads what it says.

bash says by escape sequences in its prompts, which `startup.bash` sets, when it waits for a
command, with which exit code and in which folder; nothing is guessed from the output. A library
such as pexpect reads only while somebody expects something, and a node that runs on would be held
up by a full buffer; here a thread reads all the time.
"""

from __future__ import annotations

import codecs
import os
import re
import select
import shutil
import signal
import threading
import time
import warnings
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from ptyprocess import PtyProcess, PtyProcessError

from rosbeat.errors import TerminalError
from rosbeat.workspace.terminals.environment import Polish, terminal_environment
from rosbeat.workspace.terminals.output import History, Line, LineBuilder

#: The states of a shell: it waits for a command, waits for more of one, runs one, has ended.
READY, UNFINISHED, BUSY, ENDED = "ready", "unfinished", "busy", "ended"
# Lines are never wrapped, whatever the width. But programs ask for it, `ls` for its columns.
_ROWS, _COLUMNS = 40, 120
_SIGNALS = ("SIGINT", "SIGQUIT", "SIGTERM", "SIGHUP", "SIGPIPE", "SIGTSTP", "SIGTTIN", "SIGTTOU")
# Seconds: for bash to start, for a terminal to take input, and between two looks whether it lives.
_STARTS_WITHIN, _TAKES_WITHIN, _LOOK_EVERY = 20.0, 20.0, 0.25
_AGAIN_AFTER = 2.0
# A program that prints without end is slowed down, so that it leaves the page some of the machine.
_FLOOD, _PAUSE = 65_536, 0.01
# A mark: an operating system command with a number that no terminal uses. The kinds: bash waits
# for a command, or for more of one; it runs one.
_HEAD = "\x1b]7771;"
_PROMPT, _MORE, _RUN = "P", "M", "R"
_LONGEST_MARK = 8192


@dataclass(frozen=True)
class Glance:
    """Hold what there is to see at one moment.

    Attributes:
        lines: The complete lines since the last glance.
        partial: The line that is not complete yet.
        state: `READY`, `UNFINISHED`, `BUSY` or `ENDED`.
        moment: Changes whenever something comes.
    """

    lines: list[Line]
    partial: str
    state: str
    moment: int


class Shell:
    """Run one bash, and read its output all the time.

    Args:
        folder: The folder it starts in.
        token: Its mark, in the environment of all its processes and in its escape sequences.
        polish: A function that each line goes through.

    Attributes:
        state: `READY`, `UNFINISHED`, `BUSY` or `ENDED`.
        code: The exit code of the last command; None before there was one.
        folder: The folder of the shell at its last prompt.
        begun: Whether bash has read the command that was typed last.

    Raises:
        TerminalError: If it cannot start.
    """

    def __init__(self, folder: Path, token: str, polish: Polish) -> None:
        self._polish = polish
        self._history, self._builder = History(), LineBuilder()
        self._mark = re.compile(rf"\x1b\]7771;{re.escape(token)};([PMR]);(\d*);([^\x07]*)\x07")
        self._held = ""
        self._decoder = codecs.getincrementaldecoder("utf-8")("replace")
        self._changed = threading.Condition()
        self._moment = 0
        self.state, self.folder, self.begun = BUSY, folder, True
        self.code: int | None = None
        self._process = _start_bash(folder, token)
        os.set_blocking(self._process.fd, False)
        threading.Thread(target=self._read, name=f"terminal {token}", daemon=True).start()
        if not self.wait(lambda: self.state == READY, _STARTS_WITHIN):
            self.hang_up()
            raise TerminalError(
                "The terminal did not start.",
                f"bash did not show its first prompt. Its output: {self.text() or 'nothing'}",
                "Run the cell again. A very busy computer may need a moment.",
            )
        self.code = None

    # Output.

    def glance(self, since: int) -> Glance:
        """Return the lines from a number on, and the state, of one and the same moment."""
        with self._changed:
            lines, partial = self._history.since(since), self._builder.partial
            return Glance(lines, self._polish(partial), self.state, self._moment)

    def text(self) -> str:
        """Return everything that is remembered, the incomplete line included."""
        with self._changed:
            partial = self._polish(self._builder.partial)
            return "\n".join(filter(None, [self._history.text(), partial]))

    @property
    def end(self) -> int:
        """Return the number of the next line."""
        with self._changed:
            return self._history.end

    def wait_after(self, moment: int, seconds: float) -> bool:
        """Wait until something comes after a moment; return whether it did."""
        return self.wait(lambda: self._moment != moment, seconds)

    def wait(self, predicate: Callable[[], bool], seconds: float) -> bool:
        """Wait until something is true of the shell; return whether it is."""
        with self._changed:
            return self._changed.wait_for(predicate, max(0.0, seconds))

    # Input.

    def enter(self, line: str, shown: str) -> None:
        """Type a line at the prompt.

        Args:
            line: The line, without its end.
            shown: The line as the terminal shows it.

        Raises:
            TerminalError: If bash takes no more input.
        """
        with self._changed:
            self._history.add(self._polish(shown), time.time_ns(), typed=True)
            self.state, self.begun = BUSY, False
        self._write(line + "\n")

    def answer(self, line: str) -> None:
        """Type a line into the running program."""
        self.note(line)
        self._write(line + "\n")

    def end_of_input(self) -> None:
        """Press Ctrl+D."""
        self.note("^D")
        self._write("\x04")

    def note(self, shown: str) -> None:
        """Show what is typed into the running program, behind what it asks."""
        with self._changed:
            line = self._builder.finish() + shown
            self._history.add(self._polish(line), time.time_ns(), typed=True)

    def leave_unfinished(self) -> None:
        """Press Ctrl+C in the middle of a command.

        A signal that comes between bash's prompt and its first look at the keyboard is noted, and
        then forgotten until the next one.
        """
        deadline = time.monotonic() + _TAKES_WITHIN
        while self.state == UNFINISHED and time.monotonic() < deadline:
            self.interrupt()
            self.wait(lambda: self.state != UNFINISHED, _AGAIN_AFTER)

    def _write(self, text: str) -> None:
        rest = text.encode("utf-8", "surrogateescape")
        deadline = time.monotonic() + _TAKES_WITHIN
        while rest and self.state != ENDED:
            rest = rest[self._write_some(rest) :]
            if rest and time.monotonic() > deadline:
                raise TerminalError(
                    "The terminal accepts no more input.",
                    "The program that runs in the terminal does not read its input.",
                    "Stop it with Ctrl+C, then try again.",
                )

    def _write_some(self, data: bytes) -> int:
        _wait_for_event(self._process.fd, select.POLLOUT, 0.5)
        with self._changed:
            try:
                return os.write(self._process.fd, data[:2048]) if self.state != ENDED else 0
            except BlockingIOError:
                return 0
            except OSError:  # it has ended, and the reader is about to say so
                self._changed.wait_for(lambda: self.state == ENDED, _TAKES_WITHIN)
                return 0

    # The running program.

    def foreground(self) -> int:
        """Return the process group that has the terminal; 0 if there is none, or if it is bash."""
        group = 0
        with suppress(OSError):
            group = os.tcgetpgrp(self._process.fd)
        return 0 if self.state != BUSY or group == self._process.pid else group

    def interrupt(self, group: int = 0) -> None:
        """Do what Ctrl+C does.

        The key itself makes the terminal throw away what is on its way, after the signal: output
        would be lost now and then, our mark among it.

        Args:
            group: The process group that is meant, by default the one in front.
        """
        self._signal(signal.SIGINT, group)

    def kill(self) -> None:
        """Kill the program in the foreground; if that is bash itself, interrupt what it does."""
        self._signal(signal.SIGKILL if self.foreground() else signal.SIGINT)

    def break_loop(self) -> None:
        """Interrupt bash, and kill the program that it waits for: it starts no further one."""
        with self._changed, suppress(OSError):
            if self.state == BUSY:
                os.kill(self._process.pid, signal.SIGINT)
        self.kill()

    def _signal(self, number: int, group: int = 0) -> None:
        with self._changed, suppress(OSError):
            if self.state != ENDED:
                os.killpg(group or os.tcgetpgrp(self._process.fd), number)

    def hang_up(self) -> None:
        """Kill the shell, whose programs are expected to be gone, and wait for its end."""
        with self._changed, suppress(OSError):
            if self.state != ENDED:
                os.kill(self._process.pid, signal.SIGKILL)
        self.wait(lambda: self.state == ENDED, _TAKES_WITHIN)

    # The reading thread.

    def _read(self) -> None:
        come = 0
        while data := self._read_some():
            self._take(self._held + self._decoder.decode(data))
            come += len(data)
            if come > _FLOOD:
                come = 0
                time.sleep(_PAUSE)
        code = _exit_code(self._process)
        with self._changed:
            self._end_line()
            self.code = code
            _close(self._process)
            self.state = ENDED
            self._tell()

    def _read_some(self) -> bytes:
        """Return what has come; nothing when the shell has ended."""
        while True:
            # Programs in the background may keep the terminal open when the shell has gone.
            lives = _is_alive(self._process)
            try:
                return os.read(self._process.fd, 65_536)
            except BlockingIOError:
                if not lives:
                    return b""
            except OSError:
                return b""
            _wait_for_event(self._process.fd, select.POLLIN, _LOOK_EVERY)

    def _take(self, text: str) -> None:
        """Take text and marks in their order; what may be the beginning of a mark is held back."""
        with self._changed:
            begin = 0
            for mark in self._mark.finditer(text):
                self._add(self._builder.feed(text[begin : mark.start()]))
                self._obey(mark[1], int(mark[2] or 0), mark[3])
                begin = mark.end()
            end = _beginning_of_mark(text, begin)
            self._add(self._builder.feed(text[begin:end]))
            self._held = text[end:]
            self._tell()

    def _obey(self, kind: str, code: int, folder: str) -> None:
        self.begun = True
        if kind == _RUN:
            return
        self._end_line()
        self.state = UNFINISHED
        if kind == _PROMPT:
            self.state, self.code, self.folder = READY, code, Path(folder or "/")

    def _end_line(self) -> None:
        line = self._builder.finish()
        if line:
            self._add([line])

    def _add(self, lines: list[str]) -> None:
        now = time.time_ns()
        for line in lines:
            self._history.add(self._polish(line), now)

    def _tell(self) -> None:
        self._moment += 1
        self._changed.notify_all()


def _beginning_of_mark(text: str, begin: int) -> int:
    """Return where an unfinished mark begins, or the text's end."""
    start = text.rfind("\x1b", begin)
    tail = text[start:] if start >= 0 else ""
    is_ours = tail.startswith(_HEAD) or _HEAD.startswith(tail)
    held = tail and is_ours and "\x07" not in tail and len(tail) <= _LONGEST_MARK
    return start if held else len(text)


# The pseudo-terminal and its processes.


def _start_bash(folder: Path, token: str) -> PtyProcess:
    """Start a bash without anybody's start-up files."""
    command = shutil.which("bash")
    if command is None:
        raise TerminalError(
            "This computer has no bash.",
            "A terminal of a page is a real bash, but the program bash is not on the search path.",
            "Install it (`sudo apt install bash`), then restart the kernel.",
        )
    # PWD keeps bash from finding its own idea of where it is.
    environ = {**terminal_environment(token), "PWD": str(folder)}
    try:
        if not folder.is_dir():
            raise NotADirectoryError("there is no such folder")
        with warnings.catch_warnings():
            # Python 3.12 warns whenever a process with threads forks. Here `exec` follows at once.
            warnings.simplefilter("ignore", DeprecationWarning)
            return PtyProcess.spawn(
                [command, "--norc", "--noprofile", "-i"], cwd=str(folder), env=environ, echo=False,
                preexec_fn=_usual_signals, dimensions=(_ROWS, _COLUMNS),
            )  # fmt: skip
    except (OSError, RuntimeError) as error:
        raise TerminalError(
            f"A terminal cannot start in {folder}: {error}.",
            "The operating system refused.",
            "Check whether the folder exists, and whether the computer is low on memory.",
        ) from error


def _usual_signals() -> None:
    """Take back what a kernel, or whoever started it, has ignored: Ctrl+C is to work."""
    for name in _SIGNALS:
        signal.signal(getattr(signal, name), signal.SIG_DFL)
    signal.pthread_sigmask(signal.SIG_SETMASK, [])


def _is_alive(process: PtyProcess) -> bool:
    try:
        return bool(process.isalive())
    except PtyProcessError:  # somebody else has waited for it
        return False


def _exit_code(process: PtyProcess) -> int | None:
    """Wait for a process that has hung up; return its exit code as a shell counts, if known."""
    try:
        process.wait()
    except PtyProcessError:
        return None
    number = process.signalstatus
    return int(process.exitstatus) if number is None else 128 + int(number)


def _close(process: PtyProcess) -> None:
    """Give the pseudo-terminal back, without the waits of `PtyProcess.close`."""
    if not process.closed:
        process.closed = True
        process.fileobj.close()
        process.fd = -1


def _wait_for_event(descriptor: int, event: int, seconds: float) -> None:
    """Wait until a descriptor is ready; `select` would refuse those above 1023."""
    poll = select.poll()
    with suppress(OSError, ValueError):
        poll.register(descriptor, event)
        poll.poll(seconds * 1000)
