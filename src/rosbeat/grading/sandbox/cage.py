"""One run in a sandbox: a forked child in namespaces of its own.

::

    parent            watches clock, memory and pipes; kills
      └─ gate         new mount, process, network, IPC and UTS namespaces; waits for the next
           └─ first   process 1 in there: when it dies, the kernel kills all others
                └─ work   own user namespace, no capabilities, limits, empty environment

Whatever the work leaves behind (processes, shared memory, files) goes with the first process.
"""

from __future__ import annotations

import os
import signal
import socket
import sys
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path

from rosbeat.grading.sandbox import linux
from rosbeat.grading.sandbox.limits import Limits
from rosbeat.grading.sandbox.view import enter_root, make_root

#: Exit code of a process in which the sandbox itself could not be made.
NOT_MADE = 113
_NOBODY = 65534
#: Who the work believes to be.
_INSIDE = 1000
_NEW = (
    linux.CLONE_NEWNS | linux.CLONE_NEWPID | linux.CLONE_NEWNET | linux.CLONE_NEWIPC
    | linux.CLONE_NEWUTS
)  # fmt: skip


@dataclass(frozen=True)
class Cage:
    """How a sandbox is furnished.

    Attributes:
        readable: Folders that the work may read, at their own paths.
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
        control: Where the gate writes the first process's id, and what went wrong.
    """

    result: int
    output: int
    control: int


def become_gate(cage: Cage, root: str, ends: Ends, work: Callable[[int], None]) -> None:
    """Be the gate; never returns. To be called in a forked child.

    Args:
        cage: How the sandbox is furnished.
        root: An empty folder for its root.
        ends: The pipes.
        work: What to run; it gets the descriptor for its result.
    """
    try:
        linux.prctl(linux.PR_SET_PDEATHSIG, signal.SIGKILL)
        os.setsid()
        _new_namespaces()
        make_root(root, cage.readable, cage.hidden, cage.limits.scratch)
        first = os.fork()
    except BaseException as error:
        _refuse(ends.control, error)
    if first == 0:
        _become_first(cage, root, ends, work)
    os.write(ends.control, f"{first}\n".encode())
    for end in (ends.result, ends.output, ends.control):
        os.close(end)
    _, status = os.waitpid(first, 0)
    os._exit(os.waitstatus_to_exitcode(status) & 0xFF)


def _new_namespaces() -> None:
    """A user namespace is what gives an ordinary user the right to make the others."""
    if os.getuid() == 0:
        linux.unshare(_NEW)
        return
    user, group = os.getuid(), os.getgid()
    linux.unshare(linux.CLONE_NEWUSER | _NEW)
    _map_ids(0, user, 0, group)


def _map_ids(inside: int, user: int, inside_group: int, group: int) -> None:
    _write("/proc/self/setgroups", "deny")
    _write("/proc/self/uid_map", f"{inside} {user} 1")
    _write("/proc/self/gid_map", f"{inside_group} {group} 1")


def _write(path: str, text: str) -> None:
    handle = os.open(path, os.O_WRONLY)
    try:
        os.write(handle, text.encode())
    finally:
        os.close(handle)


def _become_first(cage: Cage, root: str, ends: Ends, work: Callable[[int], None]) -> None:
    try:
        linux.prctl(linux.PR_SET_PDEATHSIG, signal.SIGKILL)
        enter_root(root)
        linux.loopback_up()
        socket.sethostname("sandbox")
        _give_up_rights()
        child = os.fork()
    except BaseException as error:
        _refuse(ends.control, error)
    if child == 0:
        become_work(cage, ends, work)
    # Nobody in there may look into this process, which could end the others.
    linux.prctl(linux.PR_SET_DUMPABLE, 0)
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    for end in (ends.result, ends.output, ends.control):
        os.close(end)
    os._exit(wait_for(child))


def wait_for(child: int) -> int:
    """Clear away whatever ends, until the work does; 128 and more say which signal ended it."""
    while True:
        ended, status = os.wait()
        if ended == child:
            code = os.waitstatus_to_exitcode(status)
            return code if code >= 0 else 128 - code


def _give_up_rights() -> None:
    if os.getuid() == 0 and not _is_mapped():
        os.setgroups([])
        os.setresgid(_NOBODY, _NOBODY, _NOBODY)
        os.setresuid(_NOBODY, _NOBODY, _NOBODY)
        # Who has changed its user may not look into /proc/self until this is said.
        linux.prctl(linux.PR_SET_DUMPABLE, 1)
    user, group = os.getuid(), os.getgid()
    if os.path.exists("/proc/self/uid_map"):
        linux.unshare(linux.CLONE_NEWUSER)
        _map_ids(_INSIDE, user, _INSIDE, group)
        with suppress(OSError):
            _write("/proc/sys/user/max_user_namespaces", "0")
    linux.drop_capabilities()


def _is_mapped() -> bool:
    """Whether this user 0 is an ordinary user outside."""
    with suppress(OSError), open("/proc/self/uid_map", encoding="ascii") as file:
        return file.read().split()[:2] != ["0", "0"]
    return os.getuid() != 0


def become_work(cage: Cage, ends: Ends, work: Callable[[int], None]) -> None:
    """Be the work: its pipes, its environment, its limits; never returns."""
    try:
        result = _settle(cage, ends)
    except BaseException as error:
        _refuse(ends.control, error)
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
    os.environ.clear()
    linux.wipe_environment()
    os.environ.update(cage.environment)
    cage.limits.apply()
    # The last thing: from here on nothing in there can say that the sandbox was not made.
    os.close(ends.control)
    return result


def _refuse(control: int, error: BaseException) -> None:
    with suppress(OSError):
        os.write(control, f"! {type(error).__name__}: {error}\n".encode())
    os._exit(NOT_MADE)
