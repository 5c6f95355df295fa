"""Define errors that end the command with a message instead of a traceback."""

from __future__ import annotations


class CommandError(Exception):
    """End the command with a message on stderr and an exit code.

    Args:
        *lines: What happened first, then what it means or what to try.
        code: The exit code.
    """

    def __init__(self, *lines: str, code: int = 1) -> None:
        super().__init__("\n".join(line for line in lines if line))
        self.code = code


class UsageError(Exception):
    """Refuse the value of an argument, with the verb's usage and exit code 2."""
