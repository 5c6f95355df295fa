"""Wrap the few Linux system calls that Python does not provide, and filter those of a sandbox.

Every function that makes a call raises OSError if the kernel refuses. Libseccomp writes the filter;
Debian and Ubuntu have it always, as apt needs it.

Sources: the Linux manual pages pidfd_open(2), pidfd_send_signal(2), prctl(2), capset(2), clone(2),
and seccomp(2), and of libseccomp seccomp_rule_add(3), seccomp_attr_set(3), seccomp_export_bpf(3).
"""

from __future__ import annotations

import ctypes
import errno
import os
import signal
import socket
import struct
import tempfile
from collections.abc import Iterator
from contextlib import suppress
from functools import cache
from typing import Any

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

#: Calls that a sandbox refuses always: keys are kept by the kernel for a user, past all namespaces
#: (keyrings(7)); who lets itself be traced is held by whoever waits for it; memory of
#: `memfd_create`, of `shmget`, of queues of messages, and of what `vmsplice` puts into pipes,
#: belongs to no process that could be asked how much it uses, and queues and semaphores outlive the
#: processes that made them; in a new user namespace, anybody has all rights; the others widen what
#: of the kernel is in reach.
REFUSED = (
    *("unshare", "setns", "add_key", "request_key", "keyctl"),
    *("ptrace", "process_vm_readv", "process_vm_writev"),
    *("memfd_create", "memfd_secret", "shmget", "msgget", "semget", "mq_open", "vmsplice"),
    *("userfaultfd", "io_uring_setup", "io_uring_enter", "io_uring_register"),
    *("bpf", "perf_event_open"),
)
#: Calls that may be made for oneself only, with the places of the arguments that have to be 0:
#: process 1 may be of the same user, and without memory or time it would end, or be late.
_FOR_ONESELF = {"prlimit64": (0,), "setpriority": (0, 1)}
#: Calls that have an effect for oneself only; the middleware makes them for its own threads.
_SCHEDULING = ("sched_setparam", "sched_setscheduler", "sched_setaffinity", "sched_setattr")
#: Flags of `clone` that make namespaces: of mounts, cgroups, names, IPC, users, processes, network.
_NAMESPACES = (17, 25, 26, 27, 28, 29, 30)
#: Options of sockets that change the size of a buffer: SO_SNDBUF, SO_RCVBUF, and their `...FORCE`.
#: To set them has no effect, so that no more waits in a socket than the grader reckons with.
_SIZES = (7, 8, 32, 33)
#: F_SETLEASE: who owns a file, as an ordinary user owns Python's, would stop others who open it.
_LEASE = 1024
#: Address families of sockets. Netlink's first protocol lists interfaces, which DDS asks for.
_FAMILIES, _NETLINK = (socket.AF_UNIX, socket.AF_INET, socket.AF_INET6), 16
#: What the kernel does with a call: refuses it with an error of this number, or lets it be.
_ERROR, _ALLOW = 0x00050000, 0x7FFF0000
#: How an argument is compared: two of them with all 64 bits, the last after a mask.
_NOT_EQUAL, _GREATER, _MASKED = 1, 6, 7
#: What happens to calls of other machines, such as those of 32 bits.
_OTHER_MACHINES = 2


class _Comparison(ctypes.Structure):
    """Be libseccomp's `struct scmp_arg_cmp`: which argument is compared, how, and with what."""

    _fields_ = (
        ("place", ctypes.c_uint),
        ("how", ctypes.c_int),
        ("first", ctypes.c_uint64),
        ("second", ctypes.c_uint64),
    )


def _is(place: int, value: int, bits: int = 0xFFFFFFFF) -> _Comparison:
    """Compare those bits of an argument that the kernel looks at."""
    return _Comparison(place, _MASKED, bits, value)


@cache
def _libseccomp() -> ctypes.CDLL:
    library = ctypes.CDLL("libseccomp.so.2")
    library.seccomp_init.restype = ctypes.c_void_p
    return library


def number_of(call: str) -> int:
    """Return the number of a system call on this machine.

    Raises:
        OSError: If there is no libseccomp, or it does not know the call.
    """
    number: int = _libseccomp().seccomp_syscall_resolve_name(call.encode())
    if number == -1:
        raise OSError(errno.ENOSYS, f"libseccomp does not know {call}")
    return number


@cache
def filter_program() -> bytes:
    """Return the filter of a sandbox: it refuses `REFUSED`, new namespaces, and most sockets.

    Raises:
        OSError: If there is no libseccomp, or it is too old.
    """
    library = _libseccomp()
    context = ctypes.c_void_p(library.seccomp_init(_ALLOW))
    try:
        unknown = ctypes.c_uint32(_ERROR | errno.ENOSYS)
        _accepted(library.seccomp_attr_set(context, _OTHER_MACHINES, unknown))
        for call, error, *comparisons in _rules():
            array = (_Comparison * len(comparisons))(*comparisons)
            action, number = ctypes.c_uint32(_ERROR | error), number_of(call)
            _accepted(
                library.seccomp_rule_add_array(context, action, number, len(comparisons), array)
            )
        with tempfile.TemporaryFile() as file:
            _accepted(library.seccomp_export_bpf(context, file.fileno()))
            file.seek(0)
            return file.read()
    finally:
        library.seccomp_release(context)


def _accepted(result: int) -> None:
    if result < 0:
        raise OSError(-result, f"libseccomp: {os.strerror(-result)}")


def _rules() -> Iterator[tuple[Any, ...]]:
    """Give calls, the error that they end with, and for which arguments; 0 is no error."""
    for call in REFUSED:
        yield call, errno.EPERM
    # A filter cannot see what it is handed: it is said to be unknown, so that the C library uses
    # `clone`.
    yield "clone3", errno.ENOSYS
    for bit in _NAMESPACES:
        yield "clone", errno.EPERM, _is(0, 1 << bit, 1 << bit)
    for option in _SIZES:
        yield "setsockopt", 0, _is(1, socket.SOL_SOCKET), _is(2, option)
    yield "fcntl", errno.EPERM, _is(1, _LEASE)
    for call, places in _FOR_ONESELF.items():
        for place in places:
            yield call, errno.EPERM, _Comparison(place, _NOT_EQUAL, 0)
    for call in _SCHEDULING:
        yield call, 0, _Comparison(0, _NOT_EQUAL, 0)
    for call in ("socket", "socketpair"):
        for family in set(range(_NETLINK)) - set(_FAMILIES):
            yield call, errno.EAFNOSUPPORT, _is(0, family)
        yield call, errno.EAFNOSUPPORT, _Comparison(0, _GREATER, _NETLINK)
        yield call, errno.EAFNOSUPPORT, _is(0, _NETLINK), _Comparison(2, _NOT_EQUAL, 0)
