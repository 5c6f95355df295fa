"""Where a learner's prints go while a check runs."""

from __future__ import annotations

import sys
import threading
from collections import deque
from io import TextIOBase
from pathlib import Path
from typing import Any

_OWN = str(Path(__file__).parents[1])


class Count:
    """How much was printed.

    Attributes:
        characters: By code that is not rosbeat's own, on both streams.
    """

    def __init__(self) -> None:
        self.characters = 0


class Sink(TextIOBase):
    """A stream that counts what is written and forgets it.

    Threads that were there before are none of the learner's node: what they print goes where it
    always goes.

    Args:
        real: The stream in whose place it stands.
        count: What is added to.
    """

    encoding = "utf-8"

    def __init__(self, real: Any, count: Count) -> None:  # noqa: ANN401 - whatever stdout is
        super().__init__()
        self._real, self._count = real, count
        here = threading.get_ident()
        self._strangers = {one.ident for one in threading.enumerate() if one.ident != here}

    def writable(self) -> bool:
        """Whether one can write to it: yes."""
        return True

    def write(self, text: str) -> int:
        """Count a text."""
        if threading.get_ident() in self._strangers:
            return int(self._real.write(text))
        if not sys._getframe(1).f_code.co_filename.startswith(_OWN):
            self._count.characters += len(text)
        return len(text)

    def outlive_threads(self) -> None:
        """Stay alive while a thread may still be printing here.

        `print` holds no reference to the stream that it writes to (CPython before 3.13): if the
        stream goes away meanwhile, the whole process does.
        """
        for thread in threading.enumerate():
            vars(thread).setdefault("_rosbeat_sinks", deque(maxlen=8)).append(self)
