"""Wrap Linux system calls that Python does not provide, with names and errors in Python's style.

Every function that makes a call raises OSError if the kernel refuses.

Sources: the Linux manual pages unshare(2), pidfd_open(2), mount(2), umount2(2), pivot_root(2),
prctl(2), capset(2), seccomp(2), netdevice(7), and linux/filter.h for the few instructions of a
filter; numbers that differ between architectures are in `_NUMBERS`.
"""

from __future__ import annotations

import ctypes
import errno
import fcntl
import os
import platform
import socket
import struct
from contextlib import suppress
from pathlib import Path

CLONE_NEWNS, CLONE_NEWUTS, CLONE_NEWIPC = 0x00020000, 0x04000000, 0x08000000
CLONE_NEWUSER, CLONE_NEWPID, CLONE_NEWNET = 0x10000000, 0x20000000, 0x40000000

MS_RDONLY, MS_NOSUID, MS_NODEV, MS_NOEXEC = 0x1, 0x2, 0x4, 0x8
MS_REMOUNT, MS_BIND, MS_MOVE, MS_REC, MS_PRIVATE = 0x20, 0x1000, 0x2000, 0x4000, 0x40000
MS_NOATIME, MS_NODIRATIME, MS_RELATIME = 0x400, 0x800, 0x200000
_MNT_DETACH = 2

PR_SET_PDEATHSIG, PR_SET_DUMPABLE, PR_SET_CHILD_SUBREAPER = 1, 4, 36
_PR_CAPBSET_DROP, _PR_SET_NO_NEW_PRIVS, _PR_SET_SECCOMP = 24, 38, 22
#: The same on all machines, as are all numbers of calls from 424 on.
_PIDFD_OPEN = 434
_CAPSET_VERSION = 0x20080522
_SIOCGIFFLAGS, _SIOCSIFFLAGS, _IFF_UP = 0x8913, 0x8914, 0x1

_libc = ctypes.CDLL(None, use_errno=True)


def unshare(flags: int) -> None:
    """Leave namespaces and begin new ones."""
    _checked(_libc.unshare(flags), "unshare")


def pidfd_open(process: int) -> int:
    """Return a descriptor of a process, which can be read from when that has ended.

    As `os.pidfd_open`, which not every build of Python has.

    Raises:
        OSError: If the kernel refuses, or is older than 5.3.
    """
    found: int = _libc.syscall(_PIDFD_OPEN, process, 0)
    _checked(min(found, 0), "pidfd_open")
    return found


def mount(source: str, target: str, kind: str = "", flags: int = 0, options: str = "") -> None:
    """Mount a file system.

    Args:
        source: What to mount.
        target: Where.
        kind: The file system's name, such as `tmpfs`; empty for binds and remounts.
        flags: Of `MS_...`.
        options: What that file system takes, such as `size=1m`.
    """
    texts = [os.fsencode(one) if one else None for one in (source, target, kind)]
    result = _libc.mount(*texts, ctypes.c_ulong(flags), os.fsencode(options) or None)
    _checked(result, f"mount {target}")


def unmount(target: str) -> None:
    """Take a mount and all below it away, as soon as nobody uses it."""
    _checked(_libc.umount2(os.fsencode(target), _MNT_DETACH), f"umount {target}")


def pivot_root(new: str, old: str) -> None:
    """Make a mount the root, and put the root of before elsewhere.

    Raises:
        OSError: If the kernel refuses, or its number of this call is not known here.
    """
    _checked(
        _libc.syscall(number_of("pivot_root"), os.fsencode(new), os.fsencode(old)), "pivot_root"
    )


def prctl(option: int, value: int, further: int = 0) -> None:
    """Change something about this process."""
    words = [ctypes.c_ulong(one) for one in (value, further, 0, 0)]
    _checked(_libc.prctl(option, *words), f"prctl {option}")


def drop_capabilities() -> None:
    """Give up every capability, for good: no program that is started gets one back."""
    for number in range(64):
        try:
            prctl(_PR_CAPBSET_DROP, number)
        except OSError:
            break  # the kernel knows no more of them
    prctl(_PR_SET_NO_NEW_PRIVS, 1)
    header = struct.pack("Ii", _CAPSET_VERSION, 0)
    _checked(_libc.capset(header, bytes(24)), "capset")


def loopback_up() -> None:
    """Switch on the loopback interface of a new network namespace."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sock:
        request = struct.pack("16sH14s", b"lo", 0, b"")
        (flags,) = struct.unpack("16xH14x", fcntl.ioctl(sock, _SIOCGIFFLAGS, request))
        fcntl.ioctl(sock, _SIOCSIFFLAGS, struct.pack("16sH14s", b"lo", flags | _IFF_UP, b""))


def limit_tcp(most: int) -> None:
    """Limit what the kernel keeps for each end of a TCP connection in a new network namespace.

    The usual limits grow with a connection to several MB, which no process is charged for. The
    setting is left as it is where it may not be written, as in some containers.

    Args:
        most: Bytes of each of its two buffers.
    """
    for name in ("tcp_rmem", "tcp_wmem"):
        with suppress(OSError):
            Path("/proc/sys/net/ipv4", name).write_text(f"4096 16384 {most}", encoding="ascii")


def _checked(result: int, what: str) -> None:
    if result != 0:
        number = ctypes.get_errno()
        raise OSError(number, f"{what}: {os.strerror(number)}")


# The filter of system calls.

#: Numbers of calls on x86_64 and on aarch64. `REFUSED` are those that a sandbox refuses always:
#: keys are kept by the kernel for a user, past all namespaces (keyrings(7)); who lets itself be
#: traced is held by whoever waits for it; memory of `memfd_create`, of `shmget`, of queues of
#: messages, and of what `vmsplice` puts into pipes, belongs to no process that could be asked how
#: much it uses, and queues and semaphores outlive the processes that made them; the others widen
#: what of the kernel is in reach.
_NUMBERS = {
    "pivot_root": (155, 41),
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
#: The names of all calls that a sandbox judges by what they are handed.
_JUDGED = (*_SOCKETS, *_FOR_ONESELF, *_SCHEDULING, "setsockopt", "fcntl")
#: The names of all calls that a sandbox refuses, whatever they are handed; `pivot_root` takes a
#: right that nobody in there has.
REFUSED = tuple(name for name in _NUMBERS if name not in ("pivot_root", *_JUDGED))
#: Options of sockets that change the size of a buffer: SO_SNDBUF, SO_RCVBUF, and their `...FORCE`.
#: To set them has no effect, so that no more waits in a socket than the keeper reckons with.
_SIZES = (7, 8, 32, 33)
#: F_SETLEASE: who owns a file, as an ordinary user owns Python's, would stop others who open it.
_LEASE = 1024
#: Address families of sockets. Netlink's first protocol lists interfaces, which DDS asks for.
_FAMILIES, _NETLINK = (socket.AF_UNIX, socket.AF_INET, socket.AF_INET6), 16
#: Numbers of machines in linux/audit.h.
_MACHINES = {"x86_64": 0xC000003E, "aarch64": 0xC00000B7}
_LOAD, _IF_EQUAL, _IF_AT_LEAST, _RETURN = 0x20, 0x15, 0x35, 0x06
_ALLOW, _REFUSE = 0x7FFF0000, 0x00050000
#: Where in `struct seccomp_data` the call's number, the machine and its arguments are.
_CALL, _MACHINE, _FIRST, _SECOND, _THIRD = 0, 4, 16, 24, 32
#: From here on, numbers of x86_64 are those of another way to call (x32).
_X32 = 0x40000000
_FILTER = 2


def number_of(call: str) -> int:
    """Return the number of a system call on this machine.

    Raises:
        OSError: If this machine's numbers are not known here.
    """
    if platform.machine() not in _MACHINES:
        raise OSError(errno.ENOSYS, f"{call} is not known on {platform.machine()}")
    return _NUMBERS[call][list(_MACHINES).index(platform.machine())]


def forbid_calls() -> None:
    """Refuse `REFUSED` and sockets that reach further to this process and all that it starts.

    It is for good, and needs `PR_SET_NO_NEW_PRIVS`, which `drop_capabilities` sets.

    Raises:
        OSError: If the kernel refuses, or the numbers for this machine are not known here.
    """
    steps = _steps()
    code = ctypes.create_string_buffer(b"".join(steps), 8 * len(steps))
    program = struct.pack("HxxxxxxQ", len(steps), ctypes.addressof(code))
    filter_ = ctypes.create_string_buffer(program)
    prctl(_PR_SET_SECCOMP, _FILTER, ctypes.addressof(filter_))


def _steps() -> list[bytes]:
    """Return the filter: other machines' calls are not there, those named are not permitted."""
    unknown, refused = _REFUSE | errno.ENOSYS, _REFUSE | errno.EPERM
    machine = _MACHINES.get(platform.machine(), 0)
    sockets = [number_of(name) for name in _SOCKETS]
    return [
        *(_step(_LOAD, _MACHINE), _step(_IF_EQUAL, machine, 1, 0), _step(_RETURN, unknown)),
        *(_step(_LOAD, _CALL), _step(_IF_AT_LEAST, _X32, 0, 1), _step(_RETURN, unknown)),
        *(one for name in REFUSED for one in _returned(number_of(name), refused)),
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
