"""Which program has the terminal, and whether Ctrl+C can have reached it.

A loop of the shell starts one program after the other. Ctrl+C goes to the one that has the
terminal, and in the moment between two of them it goes to nobody: a person presses again.
"""

from __future__ import annotations

import os
import signal
from contextlib import suppress
from pathlib import Path

_BIT = 1 << (signal.SIGINT - 1)


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
    try:
        status = Path(f"/proc/{pid}/status").read_text()
        masks = dict(line.split(":\t", 1) for line in status.splitlines() if ":\t" in line)
        return not any(int(masks[name], 16) & _BIT for name in ("SigCgt", "SigIgn"))
    except (OSError, KeyError, ValueError):
        return False
