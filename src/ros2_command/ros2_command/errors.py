"""Errors that end the command with a message instead of a traceback."""

from __future__ import annotations


class CommandError(Exception):
    """What to say on stderr, and the exit code.

    Args:
        *lines: What happened first, then what it means or what to try.
        code: The exit code.
    """

    def __init__(self, *lines: str, code: int = 1) -> None:
        super().__init__("\n".join(line for line in lines if line))
        self.code = code


class UsageError(Exception):
    """An argument has a value that cannot be used; reported with the verb's usage, exit code 2."""
