"""Watching a terminal until a command has ended, a text has come, or the time is up."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field, replace

from rosbeat.workspace.terminals.history import Line
from rosbeat.workspace.terminals.shell import BUSY, Glance, Shell

#: How watching ends: the command has ended; the text has come; the time that was asked for is
#: over; patience is; the program waits for an answer; it paints a whole screen.
FINISHED, FOUND, TIME_UP, TOO_LONG, QUIET = "finished", "found", "time up", "too long", "quiet"
PAINTS = "paints"
#: After so many seconds of silence the beginning of a line is taken for a question.
SILENCE = 0.5


@dataclass(frozen=True)
class Goal:
    """What is waited for.

    Attributes:
        until: A text; None to wait for the end of the command.
        lines: In how many lines it has to come.
        seconds: How long to watch; None for as long as it takes.
        timeout: Seconds after which to give up; None for the usual.
        until_quiet: Whether a program that has fallen silent is enough.
    """

    until: str | None = None
    lines: int = 1
    seconds: float | None = None
    timeout: float | None = None
    until_quiet: bool = False

    def end_only(self) -> Goal:
        """Return the same without what concerns a running program: for all but the last line."""
        return replace(self, until=None, seconds=None)


@dataclass
class Watch:
    """Follows the output of a shell.

    Attributes:
        shell: The shell.
        goal: What is waited for.
        see: Gets each line.
        place: The number of the next line to look at.
        patience: Seconds after which watching ends, if the goal does not say how long.
        may_repair: Whether the command may have taken the shell's prompt away.
        for_page: Whether watching ends at a program that paints a whole screen.
        begin: When the watch began, as `time.monotonic()` counts.
    """

    shell: Shell
    goal: Goal
    see: Callable[[Line], None]
    place: int
    patience: float
    may_repair: bool = False
    for_page: bool = False
    begin: float = field(default_factory=time.monotonic)
    _found: int = 0

    def run(self) -> str:
        """Show what comes, and return how it ended.

        Returns:
            `FINISHED`, `FOUND`, `TIME_UP`, `TOO_LONG`, `QUIET` or `PAINTS`.
        """
        while True:
            glance = self.shell.glance(self.place)
            ending = self._paints(glance) or self._see(glance) or self._over(glance)
            if ending:
                return ending
            if not self.shell.wait_after(glance.moment, self._slice()):
                silent = self._silent(glance)
                if silent:
                    return silent

    def _paints(self, glance: Glance) -> str:
        """Look whether a whole screen is painted; nothing but what was typed is shown of it."""
        # Such a program asks for single keys first, and paints then.
        if not self.for_page or glance.state != BUSY or not self.shell.painter():
            return ""
        for line in glance.lines:
            if line.typed:
                self.see(line)
        return PAINTS

    def _see(self, glance: Glance) -> str:
        for line in glance.lines:
            self.place = line.number + 1
            self.see(line)
            if self._is_last(line):
                return FOUND
        return ""

    def _is_last(self, line: Line) -> bool:
        if self.goal.until is None or line.typed or self.goal.until not in line.text:
            return False
        self._found += 1
        return self._found >= self.goal.lines

    def _over(self, glance: Glance) -> str:
        if glance.state != BUSY:
            return FINISHED
        if self._left() > 0:
            return ""
        return TOO_LONG if self.goal.seconds is None else TIME_UP

    def _left(self) -> float:
        allowed = self.patience if self.goal.seconds is None else self.goal.seconds
        return self.begin + allowed - time.monotonic()

    def _slice(self) -> float:
        return min(SILENCE, max(0.001, self._left()))

    def _silent(self, glance: Glance) -> str:
        """Look closer at a program from which nothing comes."""
        if self.may_repair:
            # A `.bashrc` may take its time: until bash waits there is nothing to repair.
            self.may_repair = not self.shell.bring_prompt_back()
        if self._left() <= 0:
            return ""
        if self.goal.until is not None and self.goal.until in glance.partial:
            self.shell.break_line()
            return self._see(self.shell.glance(self.place))
        return QUIET if self.goal.until_quiet else ""
