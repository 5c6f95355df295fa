"""Type commands into the terminals of a page, and follow and show what they do."""

from __future__ import annotations

import atexit
import os
import secrets
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, replace
from importlib import import_module
from pathlib import Path
from typing import Any

from rosbeat.errors import TerminalError, called_as, explain_interrupt
from rosbeat.records import LogRecord
from rosbeat.workspace import commands
from rosbeat.workspace.busy_notice import LONG, Note
from rosbeat.workspace.location import page_number, workspace, workspace_parent
from rosbeat.workspace.terminals import reaper
from rosbeat.workspace.terminals.environment import polisher, prompt
from rosbeat.workspace.terminals.output import (
    Display,
    Line,
    Show,
    log_records,
    new_only,
    print_line,
    say,
)
from rosbeat.workspace.terminals.shell import BUSY, ENDED, READY, UNFINISHED, Shell

# How watching a command ends: it has ended; the text has come; it has come as a question, in a line
# without an end; the time that was asked for is over; patience is; the program waits for an answer.
_FINISHED, _FOUND, _ASKED, _TIME_UP, _TOO_LONG, _QUIET = range(6)
# Seconds for which a cell follows a command by itself. Builds take long on a small computer.
_PATIENCE, _BUILD_PATIENCE = 60.0, 300.0
# After so many seconds of silence the beginning of a line is taken for a question.
_SILENCE = 0.5
# A command whose last line was waited for may need a moment to end.
_ENDS_SOON, _STOPS_WITHIN, _BEGINS_WITHIN = 2.0, 10.0, 5.0
# Seconds after which Ctrl+C is pressed again if it has reached nobody.
_AGAIN_AFTER = 0.2
# Looks at a bash that is to end a loop, and tries to make it.
_TRIES = 5
_LAST_LINES = 5
_HELD_AS = "_rosbeat_terminals"
# What is looked at to explain a failure: so many lines, and characters of each.
_LINES_TO_EXPLAIN, _LONGEST_TO_EXPLAIN = 2000, 1000


@dataclass(frozen=True)
class Watching:
    """Hold how a command is watched.

    Attributes:
        until: Watch only until this text appears; None to wait for the end of the command.
        lines: In how many lines the text has to appear.
        seconds: How long to watch; None for as long as it takes.
        timeout: Seconds after which to give up; None for 60, or 300 for colcon.
        until_quiet: Whether a program that has fallen silent is enough.
    """

    until: str | None = None
    lines: int = 1
    seconds: float | None = None
    timeout: float | None = None
    until_quiet: bool = False


class Terminal:
    """Run a bash that lives as long as the kernel does, or until it is closed.

    What it prints is read all the time, whether anybody watches or not.

    Args:
        name: The name of the terminal on the page.
        token: Its mark, in the environment of all its processes.
        parent: The folder that it starts in, from which its prompt names folders.

    Attributes:
        name: The name of the terminal on the page.
        command: The last command that was typed, whether it runs or has ended.

    Raises:
        TerminalError: If it cannot start.
    """

    def __init__(self, name: str, token: str, parent: Path) -> None:
        self.name, self.command = name, ""
        self._token, self._parent = token, parent
        self._shell = Shell(parent, token, polisher())
        self._cell = ""
        self._begin = self._place = self._shell.end  # of the command; of what was not shown yet
        self._folder = self._shell.folder
        self._is_open = False  # whether the end of the command is still to be told

    def __repr__(self) -> str:
        return f"<terminal {self.name}: {self.state}>"

    @property
    def text(self) -> str:
        """Return everything it has shown, typed lines included; of very much, the newest."""
        return self._shell.text()

    @property
    def state(self) -> str:
        """Return in a few words whether it waits, runs a command or has ended."""
        if self.ended:
            return "ended"
        if self._shell.state == READY:
            return f"waits at {self._prompt().rstrip()}"
        return f"runs `{commands.short(self.command)}`"

    @property
    def busy(self) -> bool:
        """Return whether a command runs in it."""
        return self._shell.state == BUSY

    @property
    def ended(self) -> bool:
        """Return whether its shell is gone."""
        return self._shell.state == ENDED

    @property
    def exit_code(self) -> int | None:
        """Return the exit code of the last command that has ended; None before there was one."""
        return self._shell.code

    @property
    def folder(self) -> Path:
        """Return the folder in which its next command runs."""
        return self._shell.folder

    def type(self, text: str, *, show: Show = print_line, **watching: Any) -> None:  # noqa: ANN401 - fields of Watching
        """Type commands, line by line, and show what they print until the last one has ended.

        Args:
            text: One command or more, as in a cell.
            show: Takes each line that is shown.
            **watching: The fields of `Watching`, by which the last command is watched; it goes on
                running if that ends first.

        Raises:
            TerminalError: If the terminal has ended, is busy, is given an unfinished command, or
                `until` does not appear in time.
            KeyboardInterrupt: If the cell is interrupted; the command goes on running.
        """
        if self.ended:
            raise TerminalError(
                f"The terminal `{self.name}` has ended.",
                "Its shell no longer exists, and neither do the variables that were set in it.",
                f'`%%terminal {self.name}` and `workspace.terminal("{self.name}")` open a new '
                "terminal with this name.",
            )
        typed = commands.lines_of(text)
        if blank := commands.blank_in(typed):
            say(show, f"nothing was typed: {blank}")
            return
        commands.refuse_unfinished(typed)
        self._make_way(text, show)
        self._cell = text
        with self._told():
            self._type_lines(typed, Watching(**watching), show)

    def answer(self, text: str, *, show: Show = print_line, **watching: Any) -> None:  # noqa: ANN401 - as type
        """Type into the program that runs, and show what it says until it falls silent.

        The arguments are those of `type`.

        Raises:
            TerminalError: If no program runs, or `until` does not appear in time.
        """
        if not self.busy:
            raise TerminalError(
                f"No program is running in the terminal `{self.name}`, so `--answer` has no "
                "program to type into.",
                "`--answer` types into a running program, but here bash is waiting for a command.",
                "To type a command, leave out `--answer`.",
            )
        goal = Watching(**watching)
        if goal.until is None and goal.seconds is None:
            goal = replace(goal, until_quiet=True)
        typed = commands.lines_of(text)
        self._shell.wait(lambda: self._shell.begun, _BEGINS_WITHIN)
        with self._told():
            self._answer_lines(typed, goal, show)

    def look(self, *, show: Show = print_line, **watching: Any) -> None:  # noqa: ANN401 - as type
        """Show what came since the last look, and watch on if there is something to wait for.

        The arguments are those of `type`.

        Raises:
            TerminalError: If `until` does not appear in time.
        """
        goal = Watching(**watching)
        if goal.until is None and goal.seconds is None:
            goal = replace(goal, seconds=0.0)
        with self._told():
            self._conclude(self._follow(goal, Display(show), self._place), goal, show, looking=True)

    def ctrl_c(self, *, timeout: float = 10.0, show: Show = print_line) -> int | None:
        """Press Ctrl+C, show how the program ends, and return its exit code.

        Lines like those that the program printed before are not shown again.

        Args:
            timeout: Seconds that the program has.
            show: Takes each line that is shown.

        Raises:
            TerminalError: If the program still runs then.
        """

        def press() -> None:
            self._shell.wait(lambda: self._shell.begun, _BEGINS_WITHIN)
            self._shell.note("^C")
            self._shell.interrupt()

        return self._end(press, "^C", timeout, show)

    def ctrl_d(self, *, timeout: float = 10.0, show: Show = print_line) -> int | None:
        """Press Ctrl+D, which tells the program that its input is over; as `ctrl_c`.

        Args:
            timeout: Seconds that the program has.
            show: Takes each line that is shown.

        Raises:
            TerminalError: If the program still runs then.
        """
        return self._end(self._shell.end_of_input, "^D", timeout, show)

    def kill(self, *, timeout: float = 10.0, show: Show = print_line) -> int | None:
        """Kill the program that runs, show that it ended, and return its exit code.

        Args:
            timeout: Seconds until the shell has to say so.
            show: Takes each line that is shown.

        Raises:
            TerminalError: If the program still runs then.
        """
        return self._end(self._shell.kill, "", timeout, show)

    def logs(self) -> tuple[LogRecord, ...]:
        """Return the lines that ROS nodes have logged here, as far back as they are kept.

        `time_ns` is a line's own stamp, or the moment at which it was read, in nanoseconds since
        the epoch; `function` is empty and `line` is 0, for a terminal does not show them.
        """
        return log_records(self._shell.glance(0).lines)

    def close(self) -> None:
        """End the terminal and every process that was started in it."""
        if not self.ended:
            reaper.end_marked(self._token)
            self._shell.hang_up()

    # Typing.

    def _make_way(self, cell: str, show: Show) -> None:
        """Wait for the end of what is about to end; stop the command of the same cell."""
        again = cell == self._cell
        if self._shell.wait(lambda: not self.busy, 0.0 if again else _ENDS_SOON):
            return
        if not again:
            raise self._busy()
        say(show, f"`{commands.short(self.command)}` of this cell still runs, and is stopped first")
        self.ctrl_c(timeout=_STOPS_WITHIN, show=lambda _: None)

    def _type_lines(self, lines: list[str], goal: Watching, show: Show) -> None:
        display = Display(show)
        for number, line in enumerate(lines, 1):
            begins = self._shell.state == READY
            if begins and not line.strip():
                continue
            if begins and (reason := self._refusal(line)):
                say(show, f"nothing was typed: {reason}")
                self._say_rest(lines[number:], show)
                return
            display = Display(show) if begins else display
            is_last = number == len(lines)
            wanted = goal if is_last else replace(goal, until=None, seconds=None)
            ending = self._type_line(line, wanted, display)
            self._conclude(ending, wanted, show)
            if ending != _FINISHED or self.ended:
                self._say_rest(lines[number:], show)
                return
        if self._shell.state == UNFINISHED:  # for aliases and options, `bash -n` cannot know it
            display.end()
            self._shell.leave_unfinished()
            say(show, "the last command is not finished, and was dropped")

    def _refusal(self, line: str) -> str:
        here = self._prompt().removesuffix("$ ")
        outside = commands.build_outside(line, self._shell.folder, workspace(), here)
        return outside or commands.full_screen(line)

    def _type_line(self, line: str, goal: Watching, display: Display) -> int:
        place = self._shell.end
        if self._shell.state == READY:
            self.command, self._begin, self._folder = line, place, self._shell.folder
            before = self._prompt()
        else:
            self.command, before = f"{self.command}\n{line}", "> "
        self._is_open = True
        self._shell.enter(line, before + line)
        return self._follow(goal, display, place)

    def _answer_lines(self, lines: list[str], goal: Watching, show: Show) -> None:
        display = Display(show)
        for number, line in enumerate(lines, 1):
            is_last = number == len(lines)
            place = self._shell.end
            self._shell.answer(line)
            ending = self._follow(goal if is_last else Watching(until_quiet=True), display, place)
            if ending == _FINISHED or is_last:
                self._conclude(ending, goal, show, looking=ending == _QUIET)
                self._say_rest(lines[number:], show)
                return

    # Following.

    def _follow(self, goal: Watching, display: Display, place: int) -> int:
        """Show what comes until the goal is reached; return how that ended."""
        ending = self._watch(goal, display.add, place)
        if self._shell.state != UNFINISHED or ending != _FINISHED:
            display.end()
        return ending

    def _watch(self, goal: Watching, see: Callable[[Line], None], place: int) -> int:
        allowed = self._patience(goal) if goal.seconds is None else goal.seconds
        self._place = place
        note = Note()
        try:
            return self._watch_until(goal, see, time.monotonic() + allowed, note)
        finally:
            note.clear()

    def _watch_until(
        self, goal: Watching, see: Callable[[Line], None], deadline: float, note: Note
    ) -> int:
        found, spoke = 0, time.monotonic()
        while True:
            glance = self._shell.glance(self._place)
            if glance.lines:
                spoke = time.monotonic()
                note.clear()
            elif glance.state == BUSY and time.monotonic() - spoke >= LONG:
                note.say(self._waits_for(goal, time.monotonic() - spoke))
            for line in glance.lines:
                self._place = line.number + 1
                see(line)
                found += goal.until is not None and not line.typed and goal.until in line.text
                if found and found >= goal.lines:
                    return _FOUND
            if glance.state != BUSY:
                return _FINISHED
            left = deadline - time.monotonic()
            if left <= 0:
                return _TOO_LONG if goal.seconds is None else _TIME_UP
            if self._shell.wait_after(glance.moment, min(_SILENCE, max(0.001, left))):
                continue
            if time.monotonic() >= deadline:
                continue
            if goal.until is not None and goal.until in glance.partial and found + 1 >= goal.lines:
                return _ASKED
            if goal.until_quiet:
                return _QUIET

    def _waits_for(self, goal: Watching, seconds: float) -> str:
        """Say why nothing comes: what is waited for, and how to end that."""
        goal_is = f"until `{goal.until}` appears" if goal.until else "until it ends"
        if goal.seconds is not None and goal.until is None:
            goal_is = f"for {goal.seconds:g} s"
        return (
            f"`{commands.short(self.command)}` runs (nothing came for {seconds:.0f} s); this cell "
            f"watches {goal_is}. If it waits for input, interrupt the cell, and then:\n"
            f"  %%terminal {self.name} --answer  with lines below types them into it,\n"
            f"  %terminal {self.name} --ctrl-d   says that there is no more input,\n"
            f"  %terminal {self.name} --ctrl-c   stops it."
        )

    def _conclude(self, ending: int, goal: Watching, show: Show, looking: bool = False) -> None:
        """Say how the command ended, or that it did not."""
        if ending == _FINISHED:
            self._finish(show)
            # A command that failed has said so; who waits for more of it is told as well.
            said_so = bool(self._shell.code) and not looking
            if goal.until is not None and self._shell.state != UNFINISHED and not said_so:
                raise self._not_seen(goal, "before the command ended")
            return
        partial = self._shell.glance(self._shell.end).partial
        if partial and ending != _FOUND:
            show(partial)
        command = commands.short(self.command)
        if ending == _TOO_LONG:
            if goal.until is not None:
                raise self._not_seen(goal, f"within {self._patience(goal):g} s")
            say(
                show,
                f"`{command}` still runs after {self._patience(goal):g} s, and goes on; "
                f"`%terminal {self.name}` shows what comes, `--ctrl-c` stops it",
            )
        if looking:
            return
        if ending == _TIME_UP:
            say(show, f"`{command}` goes on running in the terminal `{self.name}`")
        self._explain(0, show)

    def _finish(self, show: Show, always: bool = False) -> None:
        """Say how the command ended, once."""
        if not self._is_open or self._shell.state == UNFINISHED:
            return
        self._is_open = False
        code = self._shell.code
        if (code and not self.command.lstrip().startswith("#")) or always:
            say(show, f"exit code {code}")
        self._explain(code or 0, show)
        if self.ended:
            say(show, f"the terminal `{self.name}` has ended; its next use opens a new one")

    def _explain(self, code: int, show: Show) -> None:
        lines = (line[:_LONGEST_TO_EXPLAIN] for line in self._printed()[-_LINES_TO_EXPLAIN:])
        said = commands.explain(self.command, "\n".join(lines), code, self._folder, workspace())
        if said:
            say(show, "\n".join(map(polisher(), said.splitlines())))

    def _end(self, act: Callable[[], None], key: str, timeout: float, show: Show) -> int | None:
        """End the program; press Ctrl+C again for one that it has not reached.

        A program that is killed does not end the loop of bash that it is part of, so bash is
        interrupted then; if it ignores that, nothing is left but to end it.
        """
        if not self.busy:
            say(show, f"nothing runs in the terminal `{self.name}`")
            return self._shell.code
        display = Display(new_only(self._shell.glance(self._begin).lines, show))
        before, self._place = self._shell.foreground(), self._shell.end
        deadline = time.monotonic() + timeout
        idle = tries = 0  # looks at which bash itself was busy; loops that were broken
        with self._told():
            act()
            while self._follow(self._next_look(deadline), display, self._place) != _FINISHED:
                if time.monotonic() >= deadline:
                    raise self._does_not_stop(key, timeout)
                # A loop of the shell may have gone on to its next program meanwhile. One that was
                # reached is left to end in its own way: pressed again, Ctrl+C would break that off.
                now = self._shell.foreground()
                if key == "^C" and now not in (0, before):
                    before = now
                    self._shell.interrupt(now)
                # Bash itself is in front while it writes its prompt, too: that is not disturbed.
                idle = 0 if now else idle + 1
                if not key and (now not in (0, before) or idle >= _TRIES):
                    tries, idle = tries + 1, 0
                    if tries > _TRIES:
                        self.close()
                    else:
                        self._shell.break_loop()
        self._finish(show, always=True)
        return self._shell.code

    def _next_look(self, deadline: float) -> Watching:
        return Watching(timeout=min(_AGAIN_AFTER, deadline - time.monotonic()))

    # Words.

    def _printed(self) -> list[str]:
        return [line.text for line in self._shell.glance(self._begin).lines if not line.typed]

    def _busy(self) -> TerminalError:
        other = {"sensor": "monitor", "monitor": "sensor"}.get(self.name, f"{self.name}2")
        return TerminalError(
            f"The terminal `{self.name}` is busy: `{commands.short(self.command)}` runs in it.",
            "A terminal runs one command at a time, and this command has not finished.",
            f"Stop it with `%terminal {self.name} --ctrl-c`, or use another terminal: "
            f"`%%terminal {other}`. To type into the program, add `--answer`.",
        )

    def _does_not_stop(self, key: str, seconds: float) -> TerminalError:
        after = {"^C": "Ctrl+C", "^D": "Ctrl+D"}.get(key, "it was killed")
        end = f"`%terminal {self.name} --kill`" if key else f"`%terminal {self.name} --close`"
        return TerminalError(
            f"`{commands.short(self.command)}` is still running {seconds:g} s after {after}.",
            "The program ignores the request, needs more time to shut down, or keeps starting "
            "other programs.",
            f"Wait a little and check with `%terminal {self.name}`, or end it immediately with "
            f"{end}.",
        )

    def _not_seen(self, goal: Watching, when: str) -> TerminalError:
        often = f" in {goal.lines} lines" if goal.lines > 1 else ""
        last = "".join(f"\n    {line}" for line in self._printed()[-_LAST_LINES:]) or " none."
        return TerminalError(
            f"`{goal.until}` did not appear{often} {when}.",
            f"The terminal printed something else. Its last lines:{last}",
            "Compare the text with the command's output. A slow computer may need a longer "
            "`--timeout`.",
        )

    def _say_rest(self, rest: list[str], show: Show) -> None:
        if rest:
            lines = "1 more line" if len(rest) == 1 else f"{len(rest)} more lines"
            say(show, f"{lines} in the cell, not typed")

    @contextmanager
    def _told(self) -> Iterator[None]:
        """Let an interrupt of the page pass, with one line instead of a stack."""
        try:
            yield
        except KeyboardInterrupt as interrupt:
            if self._shell.state == UNFINISHED:
                self._shell.leave_unfinished()
            said = f"the terminal `{self.name}` waits for the next command."
            if self.busy:
                command = commands.short(self.command)
                said = f"`{command}` goes on running in the terminal `{self.name}`."
            explain_interrupt(interrupt, said, *self._ways_on())
            raise

    def _ways_on(self) -> tuple[str, ...]:
        """Return what it means that a program goes on, and how to end it; nothing if none does."""
        if not self.busy:
            return ()
        return (
            "Interrupt stops the cell that watches, and not the program in the terminal.",
            f"`%terminal {self.name} --ctrl-c` in a cell of its own stops it. If it waits for "
            f"input, `%%terminal {self.name} --answer` types the lines below it, and `%terminal "
            f"{self.name} --ctrl-d` says that there are no more.",
        )

    def _prompt(self) -> str:
        return prompt(self._shell.folder, self._parent)

    def _patience(self, goal: Watching) -> float:
        if goal.timeout is not None:
            return goal.timeout
        return _BUILD_PATIENCE if self.command.split()[:1] == ["colcon"] else _PATIENCE


# All terminals of a kernel.


class Terminals:
    """Keep a set of terminals, closed together; usable in a `with` block.

    Args:
        parent: The folder in which they start, by default the one that holds the workspace.
        prepare: Called once, before the first of them opens.
    """

    def __init__(
        self, parent: Path | None = None, prepare: Callable[[], None] | None = None
    ) -> None:
        self._parent = parent
        self._prepare = prepare
        self._open: dict[str, Terminal] = {}
        self._mark = f"{secrets.token_hex(8)}."
        self._count = 0
        self._watcher: subprocess.Popen[bytes] | None = None
        self._pid = os.getpid()

    def __enter__(self) -> Terminals:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __iter__(self) -> Iterator[Terminal]:
        return iter([one for one in self._open.values() if not one.ended])

    @property
    def alien(self) -> bool:
        """Return whether they belong to the process that this one was forked from."""
        return self._pid != os.getpid()

    def get(self, name: str) -> Terminal:
        """Return the terminal of a name; open it if there is none, or if it has ended.

        Args:
            name: Letters, digits, `-` and `_`.

        Raises:
            TerminalError: If it cannot start.
        """
        terminal = self.find(name)
        if terminal is None:
            prepare, self._prepare = self._prepare, None
            if prepare is not None:
                prepare()
            self._watch_over()
            self._count += 1
            token = f"{self._mark}{self._count}."
            if self._parent is None:
                with suppress(OSError):  # nobody has opened the course here yet
                    workspace_parent().mkdir(exist_ok=True)
            terminal = Terminal(name, token, self._parent or workspace_parent())
            self._open[name] = terminal
        return terminal

    def find(self, name: str) -> Terminal | None:
        """Return the terminal of a name if it is open."""
        terminal = self._open.get(name)
        return None if terminal is None or terminal.ended else terminal

    def close(self) -> None:
        """End every terminal and every process that was started in one."""
        if self._watcher is None or self.alien:
            return
        atexit.unregister(self.close)
        reaper.end_marked(self._mark)
        for terminal in self._open.values():
            terminal.close()
        self._open.clear()
        self._dismiss(self._watcher)
        self._watcher = None

    def _watch_over(self) -> None:
        """Start what ends our processes if this one cannot do it itself."""
        if self._watcher is None:
            command = [sys.executable, "-I", "-S", str(Path(reaper.__file__))]
            self._watcher = subprocess.Popen(
                [*command, self._mark, str(os.getpid())],
                stdin=subprocess.PIPE,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                cwd="/",
                start_new_session=True,
            )
            atexit.register(self.close)

    def _dismiss(self, watcher: subprocess.Popen[bytes]) -> None:
        watcher.kill()
        if watcher.stdin:
            watcher.stdin.close()
        watcher.wait()


def terminals_of(shell: Any) -> Terminals:  # noqa: ANN401 - IPython carries no types
    """Return the terminals of a kernel, which its shell holds.

    Before the first one opens on a page, what earlier pages leave in the workspace is made.
    """
    held = getattr(shell, _HELD_AS, None)
    if held is None or held.alien:
        held = Terminals(prepare=_catch_up)
        setattr(shell, _HELD_AS, held)
    return held


def _catch_up() -> None:
    # Where answers are observed, no page is open, and what makes a workspace is not there.
    page = page_number()
    if page:
        import_module("rosbeat.workspace.prerequisites").catch_up_on(page)


@called_as('workspace.terminal("sensor")')
def terminal(name: str) -> Terminal:
    """Return a terminal of this kernel; it opens if it is not there.

    Args:
        name: What it is called in `%%terminal`.

    Raises:
        TerminalError: If this is not a page, or the terminal cannot start.
    """
    from IPython import get_ipython

    shell = get_ipython()
    if shell is None:
        raise TerminalError(
            "This program is not a page, so it has no terminals.",
            "Terminals belong to the kernel of a page.",
            "In a program, use `with Terminals() as terminals: terminals.get(name)`.",
        )
    return terminals_of(shell).get(name)
