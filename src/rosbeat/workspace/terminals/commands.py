"""Typing commands into a shell and following what becomes of them."""

from __future__ import annotations

import re
import time
from collections.abc import Callable
from pathlib import Path

from rosbeat.errors import TerminalError
from rosbeat.workspace.place import steady_home, workspace
from rosbeat.workspace.terminals import outside, refusals, whole_screen
from rosbeat.workspace.terminals.after_keys import NewOnly, shapes
from rosbeat.workspace.terminals.cells import line_with_blank, lines_of
from rosbeat.workspace.terminals.interrupted import told
from rosbeat.workspace.terminals.prompt import CONTINUED, prompt
from rosbeat.workspace.terminals.remarks import say
from rosbeat.workspace.terminals.report import meaning
from rosbeat.workspace.terminals.shell import BUSY, ENDED, READY, UNFINISHED, Shell
from rosbeat.workspace.terminals.showing import Display
from rosbeat.workspace.terminals.unfinished import unfinished
from rosbeat.workspace.terminals.watching import (
    FINISHED,
    FOUND,
    PAINTS,
    QUIET,
    TIME_UP,
    TOO_LONG,
    Goal,
    Watch,
)

Show = Callable[[str], None]

#: Seconds for which a cell follows a command by itself. Builds take long on a small computer.
PATIENCE, BUILD_PATIENCE = 60.0, 300.0
# A command whose last line was waited for may need a moment to end.
_ENDS_SOON = 2.0
_STOPS_WITHIN = 10.0
_BEGINS_WITHIN = 5.0
_AGAIN_AFTER, _ASKED = 0.5, 10
_LAST_LINES = 5
_TOUCHES_PROMPT = re.compile(r"PS[12]|PROMPT_COMMAND|\b(exec|source|eval|unset)\b|(^|[;&|\s])\.\s")
_TOUCHES_ECHO = re.compile(r"\b(stty|reset|tset)\b")
_LONGEST_LINE = 4095


class Commands:
    """What is typed into one terminal, one command after the other.

    Args:
        name: The terminal.
        shell: Its shell.
        parent: The folder from which the prompt names folders.

    Attributes:
        command: The command that runs, or the last one that ran.
        begin: The number of its first line.
    """

    def __init__(self, name: str, shell: Shell, parent: Path) -> None:
        self._name, self._shell, self._parent = name, shell, parent
        self.command, self.begin = "", shell.end
        self._cell = ""
        self._place = shell.end
        self._folder = shell.folder
        self._open = False

    def state_words(self) -> str:
        """Say in a few words what the terminal does."""
        if self._shell.state == ENDED:
            return "ended"
        if self._shell.state == READY:
            return f"waits at {self._prompt().rstrip()}"
        return f"runs `{refusals.short(self.command)}`"

    # What can be asked for.

    def run(self, cell: str, goal: Goal, show: Show) -> None:
        """Type the lines of a cell; see `Terminal.type`."""
        if self._shell.state == ENDED:
            raise refusals.ended(self._name)
        lines = lines_of(cell)
        blank = line_with_blank(lines)
        if blank:
            say(show, f"nothing was typed: there is still a blank, ____, in line {blank}")
            return
        self._make_way(cell, show)
        self._cell = cell
        with told(self._interrupted):
            self._run_lines(lines, goal, show)

    def answer(self, text: str, goal: Goal, show: Show) -> None:
        """Type into the program that runs; see `Terminal.answer`."""
        if self._shell.state != BUSY:
            raise refusals.nothing_to_answer(self._name)
        lines = lines_of(text)
        self._shell.wait(lambda: self._shell.begun, _BEGINS_WITHIN)
        if self._shell.reads_lines() and any(len(x.encode()) > _LONGEST_LINE for x in lines):
            raise refusals.too_long()
        with told(self._interrupted):
            self._answer_lines(lines, goal, show)

    def look(self, goal: Goal, show: Show) -> None:
        """Show what came since the last look; see `Terminal.look`."""
        if goal.until is None and goal.seconds is None:
            goal = Goal(seconds=0.0)
        with told(self._interrupted):
            ending = self._follow(goal, Display(show), self._place)
            self._conclude(ending, goal, show, looking=True)

    def ctrl_c(self, timeout: float, show: Show) -> int | None:
        """Press Ctrl+C; see `Terminal.ctrl_c`."""

        def act() -> None:
            self._shell.wait(lambda: self._shell.begun, _BEGINS_WITHIN)
            self._shell.note("^C")
            self._shell.interrupt()

        return self._end_program(act, "^C", timeout, show)

    def ctrl_d(self, timeout: float, show: Show) -> int | None:
        """Press Ctrl+D; see `Terminal.ctrl_d`."""
        return self._end_program(lambda: self._shell.answer("\x04", "^D"), "^D", timeout, show)

    def kill(self, timeout: float, show: Show) -> int | None:
        """Kill the program; see `Terminal.kill`."""
        return self._end_program(self._shell.kill, "", timeout, show)

    def not_seen(self, goal: Goal, seconds: float | None) -> TerminalError:
        """Return the error for a text that has not come."""
        lines = [line.text for line in self._shell.glance(self.begin).lines if not line.typed]
        return refusals.not_seen(goal.until or "", goal.lines, seconds, lines[-_LAST_LINES:])

    # Commands.

    def _make_way(self, cell: str, show: Show) -> None:
        """Wait for the end of what is about to end; stop the same cell's command."""
        again = cell == self._cell
        if self._shell.wait(lambda: self._shell.state != BUSY, 0.0 if again else _ENDS_SOON):
            return
        if self._repaired():
            return
        if not again:
            raise refusals.busy(self._name, self.command)
        say(show, f"`{refusals.short(self.command)}` of this cell still runs, and is stopped first")
        self.ctrl_c(_STOPS_WITHIN, lambda _: None)

    def _repaired(self) -> bool:
        """Put the prompt back if the last command took it away after nobody watched any more."""
        lost = self._touches_prompt() and self._shell.bring_prompt_back()
        return lost and self._shell.wait(lambda: self._shell.state != BUSY, _BEGINS_WITHIN)

    def _run_lines(self, lines: list[str], goal: Goal, show: Show) -> None:
        display = Display(show)
        for number, line in enumerate(lines):
            begins = self._shell.state == READY
            if begins and not line.strip():
                continue
            if begins and self._is_outside(line, show):
                self._say_rest(len(lines) - number - 1, show)
                return
            display = Display(show) if begins else display
            wanted = goal if number == len(lines) - 1 else goal.end_only()
            ending = self._type(line, wanted, display)
            self._conclude(ending, wanted, show)
            if ending != FINISHED or self._shell.state == ENDED:
                self._say_rest(len(lines) - number - 1, show)
                return
        if self._shell.state == UNFINISHED:
            display.end()
            self._drop()
            raise unfinished(self.command)

    def _is_outside(self, line: str, show: Show) -> bool:
        """Refuse a build that would read folders which are nobody's workspace."""
        if not outside.builds_outside(line, self._shell.folder, workspace()):
            return False
        here = self._prompt().removesuffix("$ ")
        say(show, outside.words(here, workspace().is_dir()))
        return True

    def _type(self, line: str, goal: Goal, display: Display) -> str:
        place = self._shell.end
        if self._shell.state == READY:
            self.command, self.begin, self._folder = line, place, self._shell.folder
            before = self._prompt()
        else:
            self.command, before = f"{self.command}\n{line}", CONTINUED
        self._open = True
        self._shell.enter(line, before + line)
        return self._follow(goal, display, place)

    def _touches_prompt(self) -> bool:
        return bool(_TOUCHES_PROMPT.search(self.command))

    def _follow(self, goal: Goal, display: Display, place: int, for_page: bool = True) -> str:
        touched, patience = self._touches_prompt(), self._patience(goal)
        watch = Watch(self._shell, goal, display.add, place, patience, touched, for_page)
        try:
            ending = watch.run()
        finally:
            self._place = watch.place
        if self._shell.state != UNFINISHED or ending != FINISHED:
            display.end()
        return ending

    def _conclude(self, ending: str, goal: Goal, show: Show, looking: bool = False) -> None:
        """Say how the command ended, or that it did not."""
        if ending == FINISHED:
            self._finish(show)
            # A command that failed has said so; who waits for more of it is told as well.
            said_so = bool(self._shell.code) and not looking
            if goal.until is not None and self._shell.state != UNFINISHED and not said_so:
                raise self.not_seen(goal, None)
            return
        if ending == PAINTS:
            self._stop_painting(show)
            return
        partial = self._shell.glance(self._shell.end).partial
        if partial and ending != FOUND:
            show(partial)
        if ending == TOO_LONG and goal.until is not None:
            raise self.not_seen(goal, self._patience(goal))
        if ending == TOO_LONG or (ending == TIME_UP and not looking):
            say(show, self._goes_on(ending, goal))
        if not looking:
            self._explain(0, show)

    def _stop_painting(self, show: Show) -> None:
        """Stop a program that paints a whole screen; it has just begun, so nothing is lost."""
        name = self._shell.painter() or self.command.split()[0]
        for _ in range(_ASKED):
            self._shell.terminate()
            if self._shell.wait(lambda: self._shell.state != BUSY, _AGAIN_AFTER):
                break
        self._place, self._open = self._shell.end, self._shell.state == BUSY
        goes_on = f"does not stop, and `%terminal {self._name} --close` ends it"
        say(show, whole_screen.words(name, goes_on if self._open else "was stopped"))
        self._say_ended(show)

    def _finish(self, show: Show, always: bool = False) -> None:
        """Say how the command ended, once."""
        state, code = self._shell.state, self._shell.code
        if not self._open or state == UNFINISHED:
            return
        self._open = False
        if _TOUCHES_ECHO.search(self.command) and state == READY:
            self._shell.enter_unseen("stty -echo")
        if (code and not self.command.lstrip().startswith("#")) or always:
            say(show, f"exit code {code}")
        self._explain(code or 0, show)
        self._say_ended(show)

    def _say_ended(self, show: Show) -> None:
        if self._shell.state == ENDED:
            say(show, f"the terminal `{self._name}` has ended; its next use opens a new one")

    def _explain(self, code: int, show: Show) -> None:
        output = [line.text for line in self._shell.glance(self.begin).lines if not line.typed]
        said = meaning(self.command, output, code, self._folder)
        if said:
            say(show, said)
        painter = whole_screen.refused(self.command, output) if code else ""
        if painter:
            say(show, whole_screen.words(painter, "did not start"))

    # Answers and keys.

    def _answer_lines(self, lines: list[str], goal: Goal, show: Show) -> None:
        display = Display(show)
        for number, line in enumerate(lines):
            last = number == len(lines) - 1
            wanted = goal if last else Goal(until_quiet=True)
            place = self._shell.end
            self._shell.answer(line + "\n", line)
            ending = self._follow(wanted, display, place)
            if ending in (FINISHED, PAINTS) or last:
                self._conclude(ending, goal, show, looking=ending == QUIET)
                self._say_rest(len(lines) - number - 1, show)
                return

    def _end_program(
        self, act: Callable[[], None], key: str, timeout: float, show: Show
    ) -> int | None:
        if self._shell.state != BUSY:
            say(show, f"nothing runs in the terminal `{self._name}`")
            return self._shell.code
        known = shapes(self._shell.glance(self.begin).lines)
        with told(self._interrupted):
            if not self._ends(act, key, Display(NewOnly(known, show)), timeout):
                raise refusals.does_not_stop(self._name, self.command, key, timeout)
        self._finish(show, always=True)
        return self._shell.code

    def _ends(self, act: Callable[[], None], key: str, display: Display, timeout: float) -> bool:
        """End the program; press Ctrl+C again if it has reached nobody; return whether it ends."""
        self._place, deadline = self._shell.end, time.monotonic() + timeout
        before = self._shell.in_front()
        act()
        while True:
            left = deadline - time.monotonic()
            goal = Goal(timeout=min(_AGAIN_AFTER, left))
            if self._follow(goal, display, self._place, for_page=False) == FINISHED:
                return True
            if left <= 0:
                return False
            missed = self._shell.missed(before) if key == "^C" else None
            if missed:
                before = missed
                self._shell.interrupt(missed.pid)

    def _drop(self) -> None:
        """Leave an unfinished command."""
        if self._shell.state == UNFINISHED:
            self._shell.leave_unfinished()

    # Words.

    def _say_rest(self, count: int, show: Show) -> None:
        if count:
            lines = "1 more line" if count == 1 else f"{count} more lines"
            say(show, f"{lines} in the cell, not typed")

    def _goes_on(self, ending: str, goal: Goal) -> str:
        command = refusals.short(self.command)
        if ending == TIME_UP:
            return f"`{command}` goes on running in the terminal `{self._name}`"
        return (
            f"`{command}` still runs after {self._patience(goal):g} s, and goes on; "
            f"`%terminal {self._name}` shows what comes, `--ctrl-c` stops it"
        )

    def _interrupted(self) -> str:
        """Tidy up after an interrupt, and say what goes on."""
        self._drop()
        if self._shell.state == BUSY:
            command = refusals.short(self.command)
            return f"`{command}` goes on running in the terminal `{self._name}`."
        return f"the terminal `{self._name}` waits for the next command."

    def _prompt(self) -> str:
        return prompt(self._shell.folder, self._parent, steady_home() or Path.home())

    def _patience(self, goal: Goal) -> float:
        if goal.timeout is not None:
            return goal.timeout
        return BUILD_PATIENCE if self.command.split()[:1] == ["colcon"] else PATIENCE
