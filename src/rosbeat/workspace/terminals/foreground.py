"""Which program has the terminal, and whether Ctrl+C can have reached it.

A loop of the shell starts one program after the other. Ctrl+C goes to the one that has the
terminal, and in the moment between two of them it goes to nobody: a person presses again. A program
that had its own way to end is on that way: pressed again, Ctrl+C would break it off.
"""

from __future__ import annotations

import os
import signal
import time
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

_BIT = 1 << (signal.SIGINT - 1)


@dataclass(frozen=True)
class Program:
    """A program that has a terminal, at one moment.

    Attributes:
        pid: Its process group, which is also the number of its first process; 0 for none.
        command: Its words, as Linux shows them; another program in the same process has others.
        is_defenceless: Whether an interrupt would end it for certain.
    """

    pid: int
    command: bytes = b""
    is_defenceless: bool = False

    def was_missed(self, before: Program) -> bool:
        """Tell whether Ctrl+C that was pressed has not reached this program.

        Python takes its handlers away at its very end: who was not defenceless and is so now is
        leaving, unless it has become another program meanwhile.

        Args:
            before: Who had the terminal when it was pressed.
        """
        if self.pid != before.pid:
            return True
        became = self.command != before.command
        return self.is_defenceless and (became or before.is_defenceless)


def program(pid: int) -> Program:
    """Return what can be seen of a program; one that is gone has no words."""
    try:
        command = Path(f"/proc/{pid}/cmdline").read_bytes()
    except OSError:
        command = b""
    return Program(pid, command, would_have_ended(pid))


def group(descriptor: int) -> int:
    """Return the process group in front of a terminal; 0 if there is none to be found."""
    with suppress(OSError):
        return os.tcgetpgrp(descriptor)
    return 0


def would_have_ended(pid: int) -> bool:
    """Tell whether an interrupt ends a process for certain: it neither handles nor ignores it.

    Args:
        pid: The process; one that cannot be looked at may handle it.
    """
    facts = _facts(pid)
    masks = [facts.get(name, "") for name in ("SigCgt", "SigIgn")]
    return all(masks) and not any(int(mask, 16) & _BIT for mask in masks)


def sleeps_within(pid: int, seconds: float) -> bool:
    """Wait until a process sleeps; return whether it does.

    Args:
        pid: The process; one that cannot be looked at is taken to sleep.
        seconds: How long to wait.
    """
    deadline = time.monotonic() + seconds
    while not _facts(pid).get("State", "S").startswith("S"):
        if time.monotonic() > deadline:
            return False
        time.sleep(0.001)
    return True


def _facts(pid: int) -> dict[str, str]:
    """Return what Linux says about a process; nothing elsewhere, or if it is gone."""
    try:
        status = Path(f"/proc/{pid}/status").read_text()
    except OSError:
        return {}
    return dict(line.split(":\t", 1) for line in status.splitlines() if ":\t" in line)
