"""Notices when the machine itself stands still, as one that others use does.

On each processor a small process sleeps 10 ms again and again, and writes down by how much it
overslept. A measurement of something else at that time says little.

Run as a program, with a file and a processor, it is one of these processes.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

#: What a machine without load oversleeps, and more.
_USUAL = 0.003


class Watch:
    """Watches the machine until its `with` block ends.

    Args:
        file: Where it writes.
    """

    def __init__(self, file: Path) -> None:
        self._file = file
        self._watchers: list[subprocess.Popen[bytes]] = []

    def __enter__(self) -> Watch:
        self._file.touch()
        for processor in os.sched_getaffinity(0):
            # Isolated, so that it starts at once.
            command = [sys.executable, "-I", "-S", __file__, str(self._file), str(processor)]
            self._watchers.append(subprocess.Popen(command))
        return self

    def __exit__(self, *_: object) -> None:
        for watcher in self._watchers:
            watcher.kill()
            watcher.wait()

    def lag(self, began: float, ended: float) -> float:
        """Return for how long it stood still at most, between two times of the monotonic clock."""
        late = [late for start, late in read_lines(self._file) if began <= start <= ended]
        return max(late, default=0.0)


def read_lines(path: Path) -> list[Any]:
    """Return the complete lines of a file of JSON lines that another process still writes."""
    text = path.read_bytes()
    return [json.loads(line) for line in text[: text.rfind(b"\n") + 1].splitlines()]


def _watch(file: str, processor: int) -> None:
    os.sched_setaffinity(0, {processor})
    output = os.open(file, os.O_WRONLY | os.O_APPEND)
    parent = os.getppid()
    while os.getppid() == parent:
        began = time.monotonic()
        time.sleep(0.01)
        late = time.monotonic() - began - 0.01
        if late > _USUAL:
            os.write(output, json.dumps([began, late]).encode() + b"\n")


if __name__ == "__main__":
    _watch(sys.argv[1], int(sys.argv[2]))
