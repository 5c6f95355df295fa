"""Starts a worker: `python -m rosbeat.grading.start_worker`, with its jobs on standard input.

A right to make sandboxes can be had only while a process has one thread, and importing ROS starts
more. So here nothing of ROS is imported before that is done.
"""

from __future__ import annotations

import signal
import sys
from collections.abc import Sequence
from contextlib import suppress
from importlib import import_module

from rosbeat.grading.sandbox import linux
from rosbeat.grading.sandbox.namespaces import become_able

#: What makes a worker run without a sandbox.
UNSAFE = "--unsafe-no-sandbox"


def main(options: Sequence[str]) -> None:
    """Answer jobs until there are no more.

    Args:
        options: `UNSAFE`, or nothing.
    """
    settle(options)
    try:
        import_module("rosbeat.grading.worker").main(unsafe=UNSAFE in options)
    except ConnectionError as error:
        sys.exit(f"A worker ends: {error}. What it was doing is done by another one.")


def settle(options: Sequence[str]) -> None:
    """Do what has to be done first.

    Args:
        options: As of `main`.
    """
    if UNSAFE not in options:
        # If it is refused, the sandbox says so to whoever wants it.
        with suppress(OSError):
            become_able()
    # Whoever grades may be killed in the middle; nothing of a submission runs on after that.
    linux.prctl(linux.PR_SET_PDEATHSIG, signal.SIGKILL)


if __name__ == "__main__":
    main(sys.argv[1:])
