"""How a terminal treats the keyboard, which says who listens to it: a shell, a program, a question.

Source: the manual page termios(3).
"""

from __future__ import annotations

import termios
from dataclasses import dataclass


@dataclass(frozen=True)
class Modes:
    """The modes of one moment; none of a terminal that has ended.

    Attributes:
        input: The flags for what is typed (`c_iflag`).
        local: The flags for who gets it, and when (`c_lflag`).
    """

    input: int = 0
    local: int = 0

    @property
    def reads_lines(self) -> bool:
        """Whether what is typed is collected into lines of limited length."""
        return bool(self.local & termios.ICANON)

    @property
    def wants_keys(self) -> bool:
        """Whether a program gets each key as it is pressed."""
        return self.local != 0 and not self.reads_lines

    @property
    def edits_lines(self) -> bool:
        """Whether readline has the terminal: unlike `read -n 1` it tells CR from newline."""
        return not self.reads_lines and not self.input & termios.ICRNL

    @property
    def obeys_ctrl_c(self) -> bool:
        """Whether Ctrl+C is a signal here, and not a key like others."""
        return bool(self.local & termios.ISIG)

    def may_want_no_enter(self, line: str) -> bool:
        """Tell whether a program may have all that it wants before Enter is pressed.

        Args:
            line: What is typed. A program that edits lines itself wants Enter; but who asks for
                one key may look the same.
        """
        return self.wants_keys and (len(line) == 1 or (bool(line) and not self.edits_lines))


def modes_of(descriptor: int) -> Modes:
    """Return the modes of a terminal.

    Args:
        descriptor: One that is open on it, or was.
    """
    try:
        found = termios.tcgetattr(descriptor)
    except (termios.error, OSError, ValueError):
        return Modes()
    return Modes(int(found[0]), int(found[3]))
