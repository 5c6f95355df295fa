"""The terminals of a kernel, by name."""

from __future__ import annotations

import atexit
import os
import secrets
import subprocess
import sys
from collections.abc import Callable, Iterator
from importlib import import_module
from pathlib import Path
from typing import Any

from rosbeat.errors import TerminalError, called_as
from rosbeat.workspace.place import page_number, workspace_parent
from rosbeat.workspace.terminals import reaper
from rosbeat.workspace.terminals.terminal import Terminal

_HELD_AS = "_rosbeat_terminals"


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
        import_module("rosbeat.workspace.catching_up").catch_up_on(page)


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
