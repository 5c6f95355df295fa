"""System calls that Python has no function for, with names and errors as Python has them.

Sources: the Linux manual pages unshare(2), setns(2), pidfd_open(2), mount(2), umount2(2),
pivot_root(2), prctl(2), capset(2), netdevice(7); the numbers are those of the kernel's headers, the
same on all machines.
"""

from __future__ import annotations

import ctypes
import fcntl
import os
import platform
import socket
import struct
from collections.abc import Iterable

CLONE_NEWNS, CLONE_NEWUTS, CLONE_NEWIPC = 0x00020000, 0x04000000, 0x08000000
CLONE_NEWUSER, CLONE_NEWPID, CLONE_NEWNET = 0x10000000, 0x20000000, 0x40000000

MS_RDONLY, MS_NOSUID, MS_NODEV, MS_NOEXEC = 0x1, 0x2, 0x4, 0x8
MS_REMOUNT, MS_BIND, MS_MOVE, MS_REC, MS_PRIVATE = 0x20, 0x1000, 0x2000, 0x4000, 0x40000
MS_NOATIME, MS_NODIRATIME, MS_RELATIME = 0x400, 0x800, 0x200000
MNT_DETACH = 2

PR_SET_PDEATHSIG, PR_SET_DUMPABLE, PR_CAPBSET_DROP, PR_SET_NO_NEW_PRIVS = 1, 4, 24, 38
PR_SET_CHILD_SUBREAPER = 36
#: The same on all machines, as are all numbers of calls from 424 on.
_PIDFD_OPEN = 434
_PIVOT_ROOT = {"x86_64": 155, "aarch64": 41}
_CAPSET_VERSION = 0x20080522
_SIOCGIFFLAGS, _SIOCSIFFLAGS, _IFF_UP = 0x8913, 0x8914, 0x1

_libc = ctypes.CDLL(None, use_errno=True)


def unshare(flags: int) -> None:
    """Leave namespaces and begin new ones.

    Args:
        flags: Which, of `CLONE_NEW...`.

    Raises:
        OSError: If the kernel refuses.
    """
    _checked(_libc.unshare(flags), "unshare")


def descriptor_of(process: int) -> int:
    """A descriptor of a process, which can be read from when that has ended.

    As `os.pidfd_open`, which not every build of Python has.

    Args:
        process: Its number.

    Raises:
        OSError: If the kernel refuses, or is older than 5.3.
    """
    found: int = _libc.syscall(_PIDFD_OPEN, process, 0)
    _checked(min(found, 0), "pidfd_open")
    return found


def enter(process: int, flags: int) -> None:
    """Go where another process is; into its process namespace go only children made afterwards.

    Args:
        process: What `descriptor_of` gives.
        flags: Which namespaces, of `CLONE_NEW...`.

    Raises:
        OSError: If the kernel refuses, or is older than 5.8.
    """
    _checked(_libc.setns(process, flags), "setns")


def mount(source: str, target: str, kind: str = "", flags: int = 0, options: str = "") -> None:
    """Mount a file system.

    Args:
        source: What to mount.
        target: Where.
        kind: The file system's name, such as `tmpfs`; empty for binds and remounts.
        flags: Of `MS_...`.
        options: What that file system takes, such as `size=1m`.

    Raises:
        OSError: If the kernel refuses.
    """
    texts = [os.fsencode(one) if one else None for one in (source, target, kind)]
    result = _libc.mount(*texts, ctypes.c_ulong(flags), os.fsencode(options) or None)
    _checked(result, f"mount {target}")


def unmount(target: str) -> None:
    """Take a mount and all below it away, as soon as nobody uses it.

    Raises:
        OSError: If the kernel refuses.
    """
    _checked(_libc.umount2(os.fsencode(target), MNT_DETACH), f"umount {target}")


def pivot_root(new: str, old: str) -> None:
    """Make a mount the root, and put the root of before elsewhere.

    Raises:
        OSError: If the kernel refuses, or its number of this call is not known here.
    """
    number = _PIVOT_ROOT.get(platform.machine())
    if number is None:
        raise OSError(38, f"pivot_root is not known on {platform.machine()}")
    _checked(_libc.syscall(number, os.fsencode(new), os.fsencode(old)), "pivot_root")


def prctl(option: int, value: int, further: int = 0) -> None:
    """Change something about this process.

    Args:
        option: What, of `PR_...`.
        value: What it becomes.
        further: A second value, for the options that take one.

    Raises:
        OSError: If the kernel refuses.
    """
    words = [ctypes.c_ulong(one) for one in (value, further, 0, 0)]
    _checked(_libc.prctl(option, *words), f"prctl {option}")


def drop_capabilities() -> None:
    """Give up every capability, for good: no program that is started gets one back.

    Raises:
        OSError: If the kernel refuses.
    """
    for number in range(64):
        try:
            prctl(PR_CAPBSET_DROP, number)
        except OSError:
            break  # the kernel knows no more of them
    prctl(PR_SET_NO_NEW_PRIVS, 1)
    header = struct.pack("Ii", _CAPSET_VERSION, 0)
    _checked(_libc.capset(header, bytes(24)), "capset")


def wipe_environment(values: Iterable[bytes]) -> None:
    """Overwrite what this process was started with: `/proc/self/environ` shows it for ever.

    Args:
        values: Python's own copies of its values, which nobody uses any more; overwritten, too.

    To be called when the environment is empty, for then nothing points there any more. Fields 50
    and 51 of `/proc/self/stat` say where it is (proc(5)); where there is no `/proc`, there is
    nothing to be seen.
    """
    for value in values:
        if len(value) > 1:  # Python has each shorter one only once, for everybody
            ctypes.memset(id(value) + bytes.__basicsize__ - 1, 0, len(value))
    try:
        with open("/proc/self/stat", encoding="utf-8", errors="replace") as file:
            fields = file.read().rpartition(")")[2].split()
    except OSError:
        return
    start, end = int(fields[47]), int(fields[48])
    if 0 < start < end:
        ctypes.memset(start, 0, end - start)


def loopback_up() -> None:
    """Switch on the loopback interface of a new network namespace.

    Raises:
        OSError: If the kernel refuses.
    """
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sock:
        request = struct.pack("16sH14s", b"lo", 0, b"")
        (flags,) = struct.unpack("16xH14x", fcntl.ioctl(sock, _SIOCGIFFLAGS, request))
        fcntl.ioctl(sock, _SIOCSIFFLAGS, struct.pack("16sH14s", b"lo", flags | _IFF_UP, b""))


def _checked(result: int, what: str) -> None:
    if result != 0:
        number = ctypes.get_errno()
        raise OSError(number, f"{what}: {os.strerror(number)}")
