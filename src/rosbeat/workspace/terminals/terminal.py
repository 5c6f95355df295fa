"""One terminal of a page, with everything that can be done to it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from rosbeat.records import LogRecord
from rosbeat.workspace.terminals.commands import Commands
from rosbeat.workspace.terminals.history import Line
from rosbeat.workspace.terminals.log_lines import log_records
from rosbeat.workspace.terminals.reaper import end_marked
from rosbeat.workspace.terminals.shell import BUSY, ENDED, Shell
from rosbeat.workspace.terminals.steadiness import polisher
from rosbeat.workspace.terminals.watching import FOUND, Goal, Watch

Show = Callable[[str], None]


class Terminal:
    """A bash that lives as long as the kernel does, or until it is closed.

    What it prints is read all the time, whether anybody watches or not.

    Args:
        name: What it is called on the page.
        token: Its mark, in the environment of all its processes.
        parent: The folder that it starts in, from which its prompt names folders.

    Raises:
        TerminalError: If it cannot start.
    """

    def __init__(self, name: str, token: str, parent: Path) -> None:
        self._name, self._token = name, token
        self._shell = Shell(parent, token, polisher())
        self._commands = Commands(name, self._shell, parent)

    def __repr__(self) -> str:
        return f"<terminal {self._name}: {self.state}>"

    @property
    def name(self) -> str:
        """What the terminal is called on the page."""
        return self._name

    @property
    def text(self) -> str:
        """Everything it has shown, typed lines included; of very much, the newest."""
        return self._shell.text()

    @property
    def state(self) -> str:
        """What it does, in a few words."""
        return self._commands.state_words()

    @property
    def busy(self) -> bool:
        """Whether a command runs in it."""
        return self._shell.state == BUSY

    @property
    def ended(self) -> bool:
        """Whether its shell is gone."""
        return self._shell.state == ENDED

    @property
    def exit_code(self) -> int | None:
        """The exit code of the last command that has ended; None before there was one."""
        return self._shell.code

    @property
    def folder(self) -> Path:
        """The folder in which its next command runs."""
        return self._shell.folder

    @property
    def command(self) -> str:
        """The last command that was typed, whether it runs or has ended."""
        return self._commands.command

    def type(
        self,
        text: str,
        *,
        until: str | None = None,
        lines: int = 1,
        seconds: float | None = None,
        timeout: float | None = None,
        show: Show = print,
    ) -> None:
        """Type commands, line by line, and show what they print until the last one has ended.

        Args:
            text: One command or more, as in a cell.
            until: Watch the last command only until this text appears; it goes on running.
            lines: In how many lines the text has to appear.
            seconds: Watch the last command for so long; it goes on running.
            timeout: Seconds after which watching a command ends; by default 60, and 300 for colcon.
            show: Takes each line that is shown.

        Raises:
            TerminalError: If another command runs, a command is not finished, or `until` does not
                appear in time.
            KeyboardInterrupt: If the cell is interrupted; the command goes on running.
        """
        self._commands.run(text, Goal(until, lines, seconds, timeout), show)

    def answer(
        self,
        text: str,
        *,
        until: str | None = None,
        lines: int = 1,
        seconds: float | None = None,
        timeout: float | None = None,
        show: Show = print,
    ) -> None:
        """Type into the program that runs, and show what it says until it falls silent.

        The arguments are those of `type`.

        Raises:
            TerminalError: If no program runs, a line is too long for a terminal, or `until` does
                not appear in time.
        """
        quiet = until is None and seconds is None
        self._commands.answer(text, Goal(until, lines, seconds, timeout, quiet), show)

    def look(
        self,
        *,
        until: str | None = None,
        lines: int = 1,
        seconds: float | None = None,
        timeout: float | None = None,
        show: Show = print,
    ) -> None:
        """Show what came since the last look, and watch on if there is something to wait for.

        The arguments are those of `type`.

        Raises:
            TerminalError: If `until` does not appear in time.
        """
        self._commands.look(Goal(until, lines, seconds, timeout), show)

    def ctrl_c(self, *, timeout: float = 10.0, show: Show = print) -> int | None:
        """Press Ctrl+C, show how the program ends, and return its exit code.

        Lines like those that the program printed before are not shown again.

        Args:
            timeout: Seconds that the program has.
            show: Takes each line that is shown.

        Raises:
            TerminalError: If the program still runs then.
        """
        return self._commands.ctrl_c(timeout, show)

    def ctrl_d(self, *, timeout: float = 10.0, show: Show = print) -> int | None:
        """Press Ctrl+D, which tells the program that its input is over; as `ctrl_c`.

        Args:
            timeout: Seconds that the program has.
            show: Takes each line that is shown.

        Raises:
            TerminalError: If the program still runs then.
        """
        return self._commands.ctrl_d(timeout, show)

    def kill(self, *, timeout: float = 10.0, show: Show = print) -> int | None:
        """Kill the program that runs, show that it ended, and return its exit code.

        Args:
            timeout: Seconds until the shell has to say so.
            show: Takes each line that is shown.

        Raises:
            TerminalError: If the program still runs then.
        """
        return self._commands.kill(timeout, show)

    def wait_for(self, text: str, lines: int = 1, timeout: float = 10.0) -> tuple[str, ...]:
        """Wait until a text has appeared since the last command was typed; show nothing.

        Args:
            text: What to look for.
            lines: In how many lines it has to appear.
            timeout: Seconds to wait.

        Returns:
            The lines with the text.

        Raises:
            TerminalError: If it does not appear in time.
        """
        found: list[Line] = []
        goal = Goal(text, lines)
        watch = Watch(self._shell, goal, found.append, self._commands.begin, timeout)
        if watch.run() != FOUND:
            raise self._commands.not_seen(goal, timeout)
        return tuple(line.text for line in found if text in line.text and not line.typed)

    def logs(self) -> tuple[LogRecord, ...]:
        """Return the lines that ROS nodes have logged here, as far back as they are kept.

        `time_ns` is a line's own stamp, or the moment at which it was read, in nanoseconds since
        the epoch; `function` is empty and `line` is 0, for a terminal does not show them.
        """
        return log_records(self._shell.glance(0).lines)

    def close(self) -> None:
        """End the terminal and every process that was started in it."""
        if not self.ended:
            end_marked(self._token)
            self._shell.hang_up()
