"""Programs that paint a whole screen, and have no place in a page."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from contextlib import suppress
from pathlib import Path

_EDITORS = (
    "vi",
    "vim",
    "vim.basic",
    "vim.tiny",
    "nvim",
    "view",
    "vimdiff",
    "nano",
    "pico",
    "emacs",
)
_PAGERS = ("less", "more", "most", "lv")
_OTHERS = (
    "top",
    "htop",
    "btop",
    "atop",
    "iotop",
    "watch",
    "tmux",
    "screen",
    "mc",
    "ncdu",
    "ranger",
)
_KNOWN = frozenset((*_EDITORS, *_PAGERS, *_OTHERS))
# What they say when they see by themselves that this is not a screen.
_COMPLAINT = re.compile(
    r"terminal does not support|not powerful enough|opening terminal|unsuitable terminal"
    r"|unknown terminal|open terminal failed|terminal .{0,40}(missing|unsupported|lacks)"
)
_ELSEWHERE = "JupyterLab has a terminal of its own that can do that: File, New, Terminal."
_INSTEAD = {
    **dict.fromkeys(_EDITORS, "To edit a file, double-click it in JupyterLab's file browser."),
    **dict.fromkeys(_PAGERS, "`cat FILE` prints a whole file into the page."),
    "top": "`top -b -n 1` prints the list once.",
}


def painter(group: int) -> str:
    """Return the program of a process group that is known to paint a whole screen, or nothing.

    Args:
        group: The process group, which has the terminal and wants single keys.
    """
    return next((name for name in _names(group) if name in _KNOWN), "")


def refused(command: str, output: Sequence[str]) -> str:
    """Return the program that has ended because this is not a whole screen, or nothing.

    Args:
        command: A command that has failed.
        output: What it printed.
    """
    name = Path((command.split() or [""])[0]).name
    complains = any(_COMPLAINT.search(line) for line in output[:20])
    return name if name in _KNOWN and complains else ""


def words(name: str, fate: str) -> str:
    """Say where a program belongs.

    Args:
        name: The program.
        fate: What has become of it here, such as "was stopped".
    """
    why = "it needs a whole screen, and a page has none."
    return f"`{name}` {fate}: {why} {_ELSEWHERE} {_INSTEAD.get(name, '')}".rstrip()


def _names(group: int) -> Iterator[str]:
    """Yield the names of a group's programs: in `cat FILE | less`, its leader is `cat`."""
    for folder in Path("/proc").glob("[0-9]*"):
        with suppress(OSError, ValueError, IndexError):
            name, _, rest = (folder / "stat").read_text(errors="replace").rpartition(") ")
            if int(rest.split()[2]) == group:
                yield name.partition("(")[2]
