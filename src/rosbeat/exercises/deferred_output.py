"""Hold back a cell's output until its prediction is made.

The cell runs to its end, so the cells below it have what they need. What it prints with Python and
what it displays is kept, in order, and goes to the cell's output when the prediction is made. A
cell that raises, or that does not end with its prediction, shows everything at once.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Mapping
from functools import partial
from typing import Any, TextIO

from IPython.display import display

_DISPLAYED = ("display_data", "update_display_data")


class Withheld:
    """Keep back what a cell shows, from now on.

    Args:
        shell: The kernel's shell.
    """

    def __init__(self, shell: Any) -> None:  # noqa: ANN401 - IPython carries no types
        self._shell = shell
        self._parent = shell.get_parent()
        self._publisher = shell.display_pub
        self._streams: Mapping[str, TextIO] = {"stdout": sys.stdout, "stderr": sys.stderr}
        self._kept: list[tuple[str, Any]] = []
        self._is_keeping = True
        self._is_shown = False
        self._publisher.register_hook(self._keep)
        sys.stdout, sys.stderr = (
            _Keeper(stream, partial(self._keep_text, name))
            for name, stream in self._streams.items()
        )

    def ask(self) -> bool:
        """End the keeping where the prediction is; return whether it is the first of the cell."""
        is_first = self._is_keeping
        self._end_keeping()
        return is_first

    def shown(self) -> None:
        """Note that the question is on the page, so that what is kept stays kept."""
        self._is_shown = True

    def end_of_cell(self) -> None:
        """Show everything unless the question is on the page."""
        self._end_keeping()
        if not self._is_shown:
            self.release()

    def release(self, *more: object) -> None:
        """Show what was kept in the output of the cell, and something more below it.

        Args:
            more: What to display.
        """
        kept, self._kept = self._kept, []
        before = self._shell.get_parent()
        self._set_parent(self._parent)
        try:
            for name, what in kept:
                if name in self._streams:
                    self._streams[name].write(what)
                    self._streams[name].flush()
                else:
                    self._publisher.publish(**what, update=name == "update_display_data")
            for one in more:
                display(one)
        finally:
            self._set_parent(before)

    def _set_parent(self, parent: Any) -> None:  # noqa: ANN401 - a message of Jupyter's
        """Let what is shown from now on belong to the cell of a message."""
        self._shell.set_parent(parent)
        for stream in self._streams.values():  # the shell has told those that are in place now
            if hasattr(stream, "set_parent"):
                stream.set_parent(parent)

    def _end_keeping(self) -> None:
        if self._is_keeping:
            self._is_keeping = False
            sys.stdout, sys.stderr = self._streams["stdout"], self._streams["stderr"]
            self._publisher.unregister_hook(self._keep)

    def _keep_text(self, name: str, text: str) -> int:
        """Take a text for a stream; give it to the stream once nothing is kept any more."""
        if not self._is_keeping:
            return self._streams[name].write(text)
        self._kept.append((name, text))
        return len(text)

    def _keep(self, message: Mapping[str, Any]) -> Mapping[str, Any] | None:
        """Take a message that would be displayed (a hook of ipykernel's display publisher)."""
        kind, content = message["header"]["msg_type"], message["content"]
        if kind not in _DISPLAYED:
            return message
        known = ("data", "metadata", "transient")
        self._kept.append((kind, {name: content[name] for name in known if name in content}))
        return None


class _Keeper:
    """Keep what is written to a stream; for all else it is the stream.

    A logger or a `redirect_stdout` may hold it for longer than the cell runs.
    """

    def __init__(self, stream: TextIO, write: Callable[[str], int]) -> None:
        self._stream, self.write = stream, write

    def writelines(self, lines: Iterable[str]) -> None:
        for line in lines:
            self.write(line)

    def __getattr__(self, name: str) -> Any:  # noqa: ANN401 - whatever the stream has
        return getattr(self._stream, name)
