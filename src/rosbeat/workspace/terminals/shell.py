"""A bash at the other end of a pseudo-terminal, and a thread that reads what it says."""

from __future__ import annotations

import codecs
import os
import re
import select
import signal
import threading
import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from rosbeat.errors import TerminalError
from rosbeat.workspace.terminals.foreground import Program, group, program, sleeps_within
from rosbeat.workspace.terminals.history import History, Line
from rosbeat.workspace.terminals.lines import LineBuilder
from rosbeat.workspace.terminals.marks import PROMPT, RUN, Mark, MarkScanner
from rosbeat.workspace.terminals.modes import Modes, modes_of
from rosbeat.workspace.terminals.pty_process import (
    alive,
    close_quietly,
    exit_code,
    start_bash,
    wait_for_event,
)
from rosbeat.workspace.terminals.steadiness import Polish
from rosbeat.workspace.terminals.surroundings import STARTUP
from rosbeat.workspace.terminals.whole_screen import painter

#: What a shell does: it waits for a command, waits for more of one, runs one, has ended.
READY, UNFINISHED, BUSY, ENDED = "ready", "unfinished", "busy", "ended"
_STARTS_WITHIN = 20.0
_TAKES_WITHIN = 20.0
# Seconds between two looks whether the shell still lives.
_LOOK_EVERY = 0.25
_ASLEEP_WITHIN, _AGAIN_AFTER = 2.0, 5.0
_ON_ITS_WAY = 0.1
# A program that wants one key has it within so many seconds; and how often to look.
_TAKEN_WITHIN, _MOMENT = 1.0, 0.005
# After `set -v` bash shows its start-up, too.
_OURS = "{ PS1=$__rosbeat_ps1"
_FOREIGN_PROMPT = re.compile(r"[$#%>] ?$")
# A program that prints without end is slowed down, so that it leaves the page some of the machine.
_FLOOD, _PAUSE = 65_536, 0.01


@dataclass(frozen=True)
class Glance:
    """What there is to see at one moment.

    Attributes:
        lines: The complete lines since the last glance.
        partial: The line that is not complete yet.
        state: What the shell does.
        moment: Changes whenever something comes.
    """

    lines: list[Line]
    partial: str
    state: str
    moment: int


class Shell:
    """One bash. Its output is read all the time, so it never waits for a reader.

    Args:
        folder: Where it starts.
        token: Its mark.
        polish: What each line goes through.

    Attributes:
        state: `READY`, `UNFINISHED`, `BUSY` or `ENDED`.
        code: The exit code of the last command; None before there was one.
        folder: Where the shell was at its last prompt.
        begun: Whether bash has read what was typed last.

    Raises:
        TerminalError: If it cannot start.
    """

    def __init__(self, folder: Path, token: str, polish: Polish) -> None:
        self._polish = polish
        self._history, self._builder = History(), LineBuilder()
        self._scanner = MarkScanner(token)
        self._decoder = codecs.getincrementaldecoder("utf-8")("replace")
        self._changed = threading.Condition()
        self._moment = self._asked_at = 0
        self.state, self.folder = BUSY, folder
        self.begun = True
        self._hidden = False
        self.code: int | None = None
        self._process = start_bash(folder, token)
        os.set_blocking(self._process.fd, False)
        threading.Thread(target=self._read, name=f"terminal {token}", daemon=True).start()
        if not self.wait(lambda: self.state == READY, _STARTS_WITHIN):
            raise self._stillborn()
        self.code = None

    def _stillborn(self) -> TerminalError:
        self.hang_up()
        return TerminalError(
            "The terminal did not start.",
            f"bash did not come to its first prompt. It said: {self.text() or 'nothing'}",
            "Run the cell again. A very busy computer may need a moment.",
        )

    # What is seen.

    def glance(self, since: int) -> Glance:
        """Return what came since a line, and what the shell does, of one and the same moment."""
        with self._changed:
            lines, partial = self._history.since(since), self._builder.partial
            return Glance(lines, self._polish(partial), self.state, self._moment)

    def text(self) -> str:
        """Return everything that is remembered, the unfinished line included."""
        with self._changed:
            partial = self._polish(self._builder.partial)
            return "\n".join(filter(None, [self._history.text(), partial]))

    @property
    def end(self) -> int:
        """The number of the next line."""
        with self._changed:
            return self._history.end

    def wait_after(self, moment: int, seconds: float) -> bool:
        """Wait until something comes after a moment; return whether it did."""
        return self.wait(lambda: self._moment != moment, seconds)

    def wait(self, predicate: Callable[[], bool], seconds: float) -> bool:
        """Wait until something is true of the shell; return whether it is."""
        with self._changed:
            return self._changed.wait_for(predicate, max(0.0, seconds))

    # What is typed.

    def enter(self, line: str, shown: str) -> None:
        """Type a line at the prompt.

        Args:
            line: What is typed.
            shown: How the terminal shows it.

        Raises:
            TerminalError: If bash takes no more.
        """
        with self._changed:
            self._history.add(self._polish(shown), time.time_ns(), typed=True)
            self.state, self.begun = BUSY, False
        self.write(line + "\n")

    def enter_unseen(self, line: str) -> None:
        """Type a line of our own at the prompt, and wait until it is done."""
        code = self.code
        with self._changed:
            self.state, self._hidden = BUSY, True
        self.write(f" {line}\n")
        self.wait(lambda: self.state != BUSY, _TAKES_WITHIN)
        self.code = code

    def answer(self, keys: str, shown: str) -> None:
        """Type into the running program; what it asks is completed by what is typed."""
        self.note(shown)
        line, asked = keys.removesuffix("\n"), self._modes
        if line != keys and asked.may_want_no_enter(line):
            self.write(line)
            keys = "" if self._went_on(asked, _TAKEN_WITHIN) else "\n"
        self.write(keys)

    def _went_on(self, asked: Modes, seconds: float) -> bool:
        """Wait until the program that asked for a key asks no more; Enter would go to the next."""
        deadline = time.monotonic() + seconds
        while self.state == BUSY and self._modes == asked:
            if time.monotonic() > deadline:
                return False
            self.wait(lambda: self.state != BUSY, _MOMENT)
        return True

    def note(self, shown: str) -> None:
        """Show what is typed into the running program, behind what it asks."""
        with self._changed:
            line = (self._builder.finish() or self._question()) + shown
            self._history.add(self._polish(line), time.time_ns(), typed=True)

    def leave_unfinished(self) -> None:
        """Press Ctrl+C in the middle of a command.

        A signal that comes between bash's prompt and its first look at the keyboard is noted and
        then forgotten until the next one, so bash has to be asleep before, waiting for a key.
        """
        deadline = time.monotonic() + _TAKES_WITHIN
        while self.state == UNFINISHED and time.monotonic() < deadline:
            sleeps_within(self._process.pid, _ASLEEP_WITHIN)
            self.interrupt()
            self.wait(lambda: self.state != UNFINISHED, _AGAIN_AFTER)

    def break_line(self) -> None:
        """Take the beginning of a line for a line of its own."""
        with self._changed:
            self._end_line()
            self._asked_at = self._history.end

    def _question(self) -> str:
        """Return what was taken for a line of its own, if nothing has come since."""
        asked = self._history.since(self._asked_at - 1) if self._asked_at else []
        return asked[0].text if len(asked) == 1 else ""

    def write(self, text: str) -> None:
        """Send characters to the terminal, as fast as it takes them.

        Raises:
            TerminalError: If it does not take them.
        """
        rest = text.encode("utf-8", "surrogateescape")
        deadline = time.monotonic() + _TAKES_WITHIN
        while rest and self.state != ENDED:
            rest = rest[self._write_some(rest) :]
            if rest and time.monotonic() > deadline:
                raise TerminalError(
                    "The terminal takes no more input.",
                    "The program that runs in it does not read what is typed.",
                    "Stop it with Ctrl+C, then try again.",
                )

    def _write_some(self, data: bytes) -> int:
        wait_for_event(self._process.fd, select.POLLOUT, 0.5)
        with self._changed:
            try:
                return os.write(self._process.fd, data[:2048]) if self.state != ENDED else 0
            except BlockingIOError:
                return 0
            except OSError:  # it has ended, and the reader is about to say so
                self._changed.wait_for(lambda: self.state == ENDED, _TAKES_WITHIN)
                return 0

    # What runs in it.

    def reads_lines(self) -> bool:
        """Tell whether the terminal collects what is typed into lines of limited length."""
        return self._modes.reads_lines

    def in_front(self) -> Program:
        """Return the program that has the terminal; of number 0 if unknown."""
        return program(group(self._process.fd))

    def missed(self, before: Program) -> Program | None:
        """Return the program that Ctrl+C has not reached and is to be pressed for again, if any.

        It is never bash: with its prompt on its way, that would change the exit code. `before` is
        who had the terminal when it was pressed.
        """
        now = self.in_front()
        runs = self.state == BUSY and now.pid > 0 and now.pid != self._process.pid
        return now if runs and now.was_missed(before) else None

    def interrupt(self, group: int = 0) -> None:
        """Do what Ctrl+C does.

        The key itself makes the terminal throw away what is on its way, after the signal: output
        would be lost now and then, our mark among it. Only a program that wants keys gets the key.
        `group` is the process group that is meant; by default the one in front.
        """
        if self._modes.obeys_ctrl_c:
            self._signal(signal.SIGINT, group)
        else:
            self.write("\x03")

    def painter(self) -> str:
        """Return the program in front if it is known to paint a whole screen, or nothing."""
        front = group(self._process.fd)
        if self.state != BUSY or front <= 0 or not self._modes.wants_keys:
            return ""
        name = painter(front)
        # Bash wants keys, too, until it has read the command: only now are these its modes.
        return name if name and self._modes.wants_keys else ""

    def terminate(self) -> None:
        """Ask the program in the foreground to end; bash itself would not listen."""
        self._signal(signal.SIGTERM)

    def kill(self) -> None:
        """Kill the program in the foreground; the shell itself if it is that."""
        self._signal(signal.SIGKILL)

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

    def bring_prompt_back(self) -> bool:
        """Put our prompt back if bash waits at a prompt that we cannot see; return whether so."""
        # Our own prompt may just be on its way.
        if not self._waits_in_bash() or self.wait(lambda: self.state != BUSY, _ON_ITS_WAY):
            return False
        if not self._waits_in_bash():
            return False
        with self._changed:
            if _FOREIGN_PROMPT.search(self._builder.partial):
                self._builder.finish()
            self._hidden = True
        self.write(f" . '{STARTUP}'\n")
        return True

    def _waits_in_bash(self) -> bool:
        try:
            running = os.path.basename(os.readlink(f"/proc/{self._process.pid}/exe"))
        except OSError:
            return False
        in_front = self.state == BUSY and group(self._process.fd) == self._process.pid
        return in_front and running.startswith("bash") and self._modes.edits_lines

    @property
    def _modes(self) -> Modes:
        return modes_of(self._process.fd)

    # The reading thread.

    def _read(self) -> None:
        come = 0
        while True:
            data = self._read_some()
            if not data:
                break
            self._take(self._decoder.decode(data))
            come += len(data)
            if come > _FLOOD:
                come = 0
                time.sleep(_PAUSE)
        self._end()

    def _read_some(self) -> bytes:
        """Return what has come; nothing when the shell has ended."""
        while True:
            # Programs in the background may keep the terminal open when the shell has gone.
            lives = alive(self._process)
            try:
                return os.read(self._process.fd, 65_536)
            except BlockingIOError:
                if not lives:
                    return b""
            except OSError:
                return b""
            wait_for_event(self._process.fd, select.POLLIN, _LOOK_EVERY)

    def _take(self, text: str) -> None:
        with self._changed:
            for part in self._scanner.feed(text):
                if isinstance(part, Mark):
                    self._obey(part)
                elif not self._hidden:
                    self._add(self._builder.feed(part))
            self._tell()

    def _obey(self, mark: Mark) -> None:
        self.begun = True
        if mark.kind == RUN:
            return
        self._end_line()
        if mark.kind == PROMPT:
            self.code, self.folder = mark.code, Path(mark.folder or "/")
            self._hidden = False
        self.state = READY if mark.kind == PROMPT else UNFINISHED

    def _end(self) -> None:
        code = exit_code(self._process)
        with self._changed:
            self._end_line()
            self.code = code
            close_quietly(self._process)
            self.state = ENDED
            self._tell()

    def _end_line(self) -> None:
        line = self._builder.finish()
        if line:
            self._add([line])

    def _add(self, lines: list[str]) -> None:
        now = time.time_ns()
        for line in lines:
            if _OURS not in line:
                self._history.add(self._polish(line), now)

    def _tell(self) -> None:
        self._moment += 1
        self._changed.notify_all()
