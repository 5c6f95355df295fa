"""Wrap the few Linux system calls that Python does not provide, and filter those of a sandbox.

Every function that makes a call raises OSError if the kernel refuses.

Sources: the Linux manual pages pidfd_open(2), pidfd_send_signal(2), prctl(2), capset(2), clone(2),
seccomp(2), and linux/filter.h for the few instructions of a filter; numbers that differ between
architectures are in `_NUMBERS`.
"""

from __future__ import annotations

import ctypes
import errno
import os
import platform
import signal
import socket
import struct
from contextlib import suppress

PR_SET_PDEATHSIG, PR_SET_DUMPABLE, PR_SET_CHILD_SUBREAPER = 1, 4, 36
_PR_CAPBSET_DROP, _CAPSET_VERSION = 24, 0x20080522
#: The same on all machines, as are all numbers of calls from 424 on.
_PIDFD_SEND_SIGNAL, _PIDFD_OPEN = 424, 434

_libc = ctypes.CDLL(None, use_errno=True)


def pidfd_open(process: int) -> int:
    """Return a descriptor of a process, which can be read from when that has ended.

    As `os.pidfd_open`, which not every build of Python has.

    Raises:
        OSError: If the kernel refuses, or is older than 5.3.
    """
    descriptor: int = _libc.syscall(_PIDFD_OPEN, process, 0)
    _checked(min(descriptor, 0), "pidfd_open")
    return descriptor


def pidfd_kill(descriptor: int) -> None:
    """End the process of a descriptor, which no other process can be taken for."""
    with suppress(ProcessLookupError):
        result = _libc.syscall(_PIDFD_SEND_SIGNAL, descriptor, int(signal.SIGKILL), None, 0)
        _checked(result, "pidfd_send_signal")


def prctl(option: int, value: int) -> None:
    """Change something about this process."""
    words = [ctypes.c_ulong(word) for word in (value, 0, 0, 0)]
    _checked(_libc.prctl(option, *words), f"prctl {option}")


def become(user: int) -> None:
    """Be an ordinary user instead of root, for good: without groups and without any capability."""
    with suppress(OSError):  # the kernel knows no more of them
        for number in range(64):
            prctl(_PR_CAPBSET_DROP, number)
    os.setgroups([])
    os.setresgid(user, user, user)
    os.setresuid(user, user, user)
    _checked(_libc.capset(struct.pack("Ii", _CAPSET_VERSION, 0), bytes(24)), "capset")


def _checked(result: int, what: str) -> None:
    if result != 0:
        number = ctypes.get_errno()
        raise OSError(number, f"{what}: {os.strerror(number)}")


# The filter of system calls.

#: Numbers of calls on x86_64 and on aarch64. `REFUSED` are those that a sandbox refuses always:
#: keys are kept by the kernel for a user, past all namespaces (keyrings(7)); who lets itself be
#: traced is held by whoever waits for it; memory of `memfd_create`, of `shmget`, of queues of
#: messages, and of what `vmsplice` puts into pipes, belongs to no process that could be asked how
#: much it uses, and queues and semaphores outlive the processes that made them; in a new user
#: namespace, anybody has all rights; the others widen what of the kernel is in reach.
_NUMBERS = {
    "unshare": (272, 97),
    "setns": (308, 268),
    "add_key": (248, 217),
    "request_key": (249, 218),
    "keyctl": (250, 219),
    "ptrace": (101, 117),
    "process_vm_readv": (310, 270),
    "process_vm_writev": (311, 271),
    "memfd_create": (319, 279),
    "memfd_secret": (447, 447),
    "shmget": (29, 194),
    "msgget": (68, 186),
    "semget": (64, 190),
    "mq_open": (240, 180),
    "vmsplice": (278, 75),
    "userfaultfd": (323, 282),
    "io_uring_setup": (425, 425),
    "io_uring_enter": (426, 426),
    "io_uring_register": (427, 427),
    "bpf": (321, 280),
    "perf_event_open": (298, 241),
    "clone": (56, 220),
    "clone3": (435, 435),
    "socket": (41, 198),
    "socketpair": (53, 199),
    "setsockopt": (54, 208),
    "fcntl": (72, 25),
    "prlimit64": (302, 261),
    "setpriority": (141, 140),
    "sched_setparam": (142, 118),
    "sched_setscheduler": (144, 119),
    "sched_setaffinity": (203, 122),
    "sched_setattr": (314, 274),
}
_SOCKETS = ("socket", "socketpair")
#: Calls that may be made for oneself only, with the places of the arguments that have to be 0: init
#: is of the same user, and without memory or time it would end, or be late.
_FOR_ONESELF = {"prlimit64": (0,), "setpriority": (0, 1)}
#: Calls that have an effect for oneself only; the middleware makes them for its own threads.
_SCHEDULING = ("sched_setparam", "sched_setscheduler", "sched_setaffinity", "sched_setattr")
#: The names of all calls that a sandbox judges by what they are handed. What `clone3` is handed, a
#: filter cannot see: it is said to be unknown, so that the C library uses `clone`.
_JUDGED = (*_SOCKETS, *_FOR_ONESELF, *_SCHEDULING, "setsockopt", "fcntl", "clone", "clone3")
#: The names of all calls that a sandbox refuses, whatever they are handed.
REFUSED = tuple(name for name in _NUMBERS if name not in _JUDGED)
#: Flags of `clone` that make namespaces: of mounts, cgroups, names, IPC, users, processes, network.
_NAMESPACES = (
    0x00020000 | 0x02000000 | 0x04000000 | 0x08000000 | 0x10000000 | 0x20000000 | 0x40000000
)
#: Options of sockets that change the size of a buffer: SO_SNDBUF, SO_RCVBUF, and their `...FORCE`.
#: To set them has no effect, so that no more waits in a socket than the grader reckons with.
_SIZES = (7, 8, 32, 33)
#: F_SETLEASE: who owns a file, as an ordinary user owns Python's, would stop others who open it.
_LEASE = 1024
#: Address families of sockets. Netlink's first protocol lists interfaces, which DDS asks for.
_FAMILIES, _NETLINK = (socket.AF_UNIX, socket.AF_INET, socket.AF_INET6), 16
#: Numbers of machines in linux/audit.h.
_MACHINES = {"x86_64": 0xC000003E, "aarch64": 0xC00000B7}
_LOAD, _IF_EQUAL, _IF_AT_LEAST, _IF_ANY, _RETURN = 0x20, 0x15, 0x35, 0x45, 0x06
_ALLOW, _REFUSE = 0x7FFF0000, 0x00050000
#: Where in `struct seccomp_data` the call's number, the machine and its arguments are.
_CALL, _MACHINE, _FIRST, _SECOND, _THIRD = 0, 4, 16, 24, 32
#: From here on, numbers of x86_64 are those of another way to call (x32).
_X32 = 0x40000000


def number_of(call: str) -> int:
    """Return the number of a system call on this machine.

    Raises:
        OSError: If this machine's numbers are not known here.
    """
    if platform.machine() not in _MACHINES:
        raise OSError(errno.ENOSYS, f"{call} is not known on {platform.machine()}")
    return _NUMBERS[call][list(_MACHINES).index(platform.machine())]


def filter_program() -> bytes:
    """Return the filter of a sandbox: it refuses `REFUSED`, new namespaces, and most sockets.

    Raises:
        OSError: If the numbers for this machine are not known here.
    """
    return b"".join(_steps())


def _steps() -> list[bytes]:
    """Return the filter: other machines' calls are not there, those named are not permitted."""
    unknown, refused = _REFUSE | errno.ENOSYS, _REFUSE | errno.EPERM
    machine = _MACHINES.get(platform.machine(), 0)
    sockets = [number_of(name) for name in _SOCKETS]
    return [
        *(_step(_LOAD, _MACHINE), _step(_IF_EQUAL, machine, 1, 0), _step(_RETURN, unknown)),
        *(_step(_LOAD, _CALL), _step(_IF_AT_LEAST, _X32, 0, 1), _step(_RETURN, unknown)),
        *(one for name in REFUSED for one in _returned(number_of(name), refused)),
        *_returned(number_of("clone3"), unknown),
        *_if_called("clone", [_step(_LOAD, _FIRST), *_of_flags(_NAMESPACES, refused)]),
        *_if_called("setsockopt", _of_options()),
        *_if_called("fcntl", [_step(_LOAD, _SECOND), *_returned(_LEASE, refused)]),
        *(
            one
            for name, places in _FOR_ONESELF.items()
            for one in _if_called(name, _of_oneself(places, refused))
        ),
        *(one for name in _SCHEDULING for one in _if_called(name, _of_oneself((0,), _REFUSE))),
        *(_step(_IF_EQUAL, sockets[0], 2, 0), _step(_IF_EQUAL, sockets[1], 1, 0)),
        *(_step(_RETURN, _ALLOW), _step(_LOAD, _FIRST)),
        *(one for family in _FAMILIES for one in _returned(family, _ALLOW)),
        *(_step(_IF_EQUAL, _NETLINK, 0, 3), _step(_LOAD, _THIRD), *_returned(0, _ALLOW)),
        _step(_RETURN, _REFUSE | errno.EAFNOSUPPORT),
    ]


def _if_called(name: str, steps: list[bytes]) -> list[bytes]:
    """Return steps for one call, which is allowed if they come to their end."""
    return [_step(_IF_EQUAL, number_of(name), 0, len(steps) + 1), *steps, _step(_RETURN, _ALLOW)]


def _of_options() -> list[bytes]:
    """Return what is done with `setsockopt`: sizes of buffers are taken for set, and are not."""
    return [
        *(_step(_LOAD, _SECOND), _step(_IF_EQUAL, socket.SOL_SOCKET, 1, 0)),
        *(_step(_RETURN, _ALLOW), _step(_LOAD, _THIRD)),
        *(one for option in _SIZES for one in _returned(option, _REFUSE)),
    ]


def _of_flags(flags: int, verdict: int) -> tuple[bytes, bytes]:
    """Return two steps: a verdict if what was loaded has one of the flags; else what comes next."""
    return _step(_IF_ANY, flags, 0, 1), _step(_RETURN, verdict)


def _of_oneself(places: tuple[int, ...], verdict: int) -> list[bytes]:
    """Return the steps with a verdict on a call for any other process or thread."""
    each = [
        (_step(_LOAD, _FIRST + 8 * place), _step(_IF_EQUAL, 0, 1, 0), _step(_RETURN, verdict))
        for place in places
    ]
    return [one for some in each for one in some]


def _returned(value: int, verdict: int) -> tuple[bytes, bytes]:
    """Return two steps: a verdict if what was loaded is a value; else what comes next."""
    return _step(_IF_EQUAL, value, 0, 1), _step(_RETURN, verdict)


def _step(code: int, value: int, if_so: int = 0, if_not: int = 0) -> bytes:
    return struct.pack("HBBI", code, if_so, if_not, value)
