"""The course's own remarks among what a terminal prints: `# ` stands before each of their lines.

That is how a comment looks in a shell, so whoever copies one along with a command types nothing.
"""

from __future__ import annotations

import re
import textwrap
from collections.abc import Callable, Iterator

MARKER = "# "
#: Columns, with the marker; the lines of programs are never wrapped.
WIDTH = 100
_QUOTED = re.compile(r"`[^`\n]*`")
# `textwrap` breaks lines at blanks only: what is to be typed stays in one piece.
_HELD = "\u00a0"


def remark(text: str) -> Iterator[str]:
    """Yield the lines of a remark as a terminal of a page shows them.

    Args:
        text: One line or more; what stands between backquotes is never broken.
    """
    for line in text.splitlines():
        for part in _wrapped(line):
            yield f"{MARKER}{part}".rstrip()


def say(show: Callable[[str], None], text: str) -> None:
    """Show a remark.

    Args:
        show: Takes one line.
        text: What to say.
    """
    for line in remark(text):
        show(line)


def _wrapped(line: str) -> list[str]:
    indent = line[: len(line) - len(line.lstrip())]
    held = _QUOTED.sub(lambda quoted: quoted[0].replace(" ", _HELD), line)
    parts = textwrap.wrap(
        held,
        WIDTH - len(MARKER),
        subsequent_indent=indent,
        break_long_words=False,
        break_on_hyphens=False,
    )
    return [part.replace(_HELD, " ") for part in parts] or [""]
