"""How a sandbox is furnished, and how a forked process becomes the work in it.

::

    parent           a prepared worker: watches clock, memory and pipes; kills
      ├─ nursery     small; makes namespaces, from which the machine's disk cannot be seen
      │    └─ first  process 1 in there: when it dies, the kernel kills all others
      └─ work        a fork of the parent in the same namespaces, but for the user namespace, which
                     is its own; no capabilities, limits, empty environment

Whatever the work leaves behind (processes, shared memory, files) goes with the first process.
"""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import NoReturn

from rosbeat.grading.sandbox import linux
from rosbeat.grading.sandbox.limits import Limits

#: Exit code of a process in which the sandbox itself could not be made.
NOT_MADE = 113
#: What a process says on `Ends.control` when it has settled, and before it says what went wrong.
SETTLED, TROUBLE = b".", b"!"


@dataclass(frozen=True)
class Cage:
    """How a sandbox is furnished.

    Attributes:
        readable: Files and folders that the work may read, at their own paths.
        hidden: Folders in those that are empty for the work.
        environment: All of its environment.
        limits: What it may use.
    """

    readable: Sequence[str] = ()
    hidden: Sequence[str] = ()
    environment: Mapping[str, str] = field(default_factory=dict)
    limits: Limits = field(default_factory=Limits)


def python_folders() -> tuple[str, ...]:
    """The folders that Python and this package are read from, for `Cage.readable`."""
    package = Path(__file__).resolve().parents[2]
    return tuple({sys.prefix, sys.base_prefix, str(package)})


@dataclass(frozen=True)
class Ends:
    """The child's ends of the pipes.

    Attributes:
        result: Where the work writes its result.
        output: Where what it prints goes.
        control: Where it is written that the work has settled, or what went wrong.
    """

    result: int
    output: int
    control: int


#: What a job runs; it gets the descriptor for its result.
Work = Callable[[int], None]


def become_work(cage: Cage, ends: Ends, work: Work, enter: Callable[[], None]) -> NoReturn:
    """Be the work: its place, its pipes, its environment, its limits. For a forked child.

    Args:
        cage: Its environment and limits.
        ends: The pipes.
        work: What to run.
        enter: What brings this process to where the work runs.
    """
    try:
        enter()
        result = _settle(cage, ends)
    except BaseException as error:
        refuse(ends.control, error)
    code = 1
    try:
        work(result)
        code = 0
    except SystemExit as error:
        code = error.code if isinstance(error.code, int) else 1
    except BaseException as error:
        print(f"{type(error).__name__}: {error}", file=sys.stderr)
    finally:
        with suppress(BaseException):
            sys.stdout.flush()
            sys.stderr.flush()
        os._exit(code & 0xFF)


def _settle(cage: Cage, ends: Ends) -> int:
    """Keep nothing of what this process was, and give the descriptor of its result."""
    signal.signal(signal.SIGINT, signal.default_int_handler)
    null = os.open("/dev/null", os.O_RDONLY)
    os.dup2(null, 0)
    os.dup2(ends.output, 1)
    os.dup2(ends.output, 2)
    result = os.dup2(ends.result, 3, inheritable=False)
    os.closerange(4, ends.control)
    os.closerange(ends.control + 1, os.sysconf("SC_OPEN_MAX"))
    values = list(os.environ._data.values())  # type: ignore[attr-defined] # the bytes themselves
    os.environ.clear()
    linux.wipe_environment(values)
    os.environ.update(cage.environment)
    cage.limits.apply()
    # The last thing: from here on nothing in there can say that the sandbox was not made.
    os.write(ends.control, SETTLED)
    os.close(ends.control)
    return result


def refuse(control: int, error: BaseException) -> NoReturn:
    """Say that the sandbox could not be made, and end this process.

    Args:
        control: See `Ends`.
        error: Why.
    """
    with suppress(OSError):
        os.write(control, TROUBLE + f" {type(error).__name__}: {error}\n".encode())
    os._exit(NOT_MADE)
