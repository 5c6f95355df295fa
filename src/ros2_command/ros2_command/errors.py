"""Define errors that end the command with a message instead of a traceback, and notes.

A note is what this command says and the original does not: advice, and the nearest valid name. It
begins with `#` and goes to stderr, so that everything else is what a robot prints.
"""

from __future__ import annotations

import os
import sys

#: The variable that leaves notes out: those that depend on the speed of the machine where it is
#: set, as pages do that compare outputs, and every one of them where it is `all`.
NO_NOTES = "ROS2_COMMAND_NO_NOTES"

#: The signals that this process was asked to end by. What a handler raises may come out of the
#: middleware's C++ as another exception, which knows nothing of it.
ENDED_BY: list[int] = []


def note(*texts: str) -> None:
    """Print texts as notes; empty ones are left out."""
    if os.environ.get(NO_NOTES) == "all" or sys.stderr is None:
        return
    for line in "\n".join(text for text in texts if text).splitlines():
        print(f"# {line}".rstrip(), file=sys.stderr)


class CommandError(Exception):
    """End the command with a message on stderr and an exit code.

    Args:
        message: What happened, as the original says it; empty where that is silent.
        *notes: What it means, and what to try.
        code: The exit code.
    """

    def __init__(self, message: str, *notes: str, code: int = 1) -> None:
        super().__init__("\n".join(line for line in (message, *notes) if line))
        self.message, self.notes, self.code = message, notes, code

    def show(self) -> None:
        """Print the message and the notes on stderr."""
        if self.message:
            print(self.message, file=sys.stderr)
        note(*self.notes)


class UsageError(Exception):
    """Refuse the value of an argument, with the verb's usage and exit code 2."""
