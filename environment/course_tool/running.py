"""Runs other programs: visibly, and with their last words kept for when they fail."""

from __future__ import annotations

import subprocess
from collections import deque
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from course_tool.problems import say


@dataclass(frozen=True)
class Result:
    """How a program ended.

    Attributes:
        code: Its exit code; 124 if it did not end in time, 127 if it could not be started.
        text: What it printed, errors too.
    """

    code: int
    text: str

    @property
    def ok(self) -> bool:
        """Tell whether it ended well."""
        return self.code == 0

    @property
    def last_line(self) -> str:
        """Return the last line that it printed, or its exit code."""
        return (self.text.strip().splitlines() or [f"exit code {self.code}"])[-1]


def stream(
    command: Sequence[str | Path],
    env: Mapping[str, str],
    shown: Callable[[str], object],
    cwd: Path | None = None,
) -> Result:
    """Run a program, print the lines that are to be shown as they come, and keep the last 40."""
    last_words: deque[str] = deque(maxlen=40)
    with subprocess.Popen(
        [str(part) for part in command],
        env=dict(env),
        cwd=cwd,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        errors="replace",
    ) as process:
        for line in process.stdout or ():
            last_words.append(line)
            if shown(line):
                say("      " + line.rstrip())
    return Result(process.returncode, "".join(last_words))


def quiet(
    command: Sequence[str | Path],
    env: Mapping[str, str],
    timeout: float | None = None,
    cwd: Path | None = None,
) -> Result:
    """Run a program without showing anything; one that takes longer than `timeout` s failed."""
    try:
        done = subprocess.run(
            [str(part) for part in command],
            env=dict(env),
            cwd=cwd,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            errors="replace",
            timeout=timeout,
            check=False,
        )
    except subprocess.TimeoutExpired as error:
        return Result(124, f"It did not end within {error.timeout:.0f} s.")
    except OSError as error:
        return Result(127, str(error))
    return Result(done.returncode, done.stdout)
