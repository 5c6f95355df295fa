"""What a sandboxed program sees of the disk: a root of its own, nearly all of it read-only.

::

    /usr /lib /lib64 /bin /sbin      the system, read-only
    /etc                             a few files that the C library reads
    the folders that were asked for  read-only, each at its own path; some in them empty
    /dev                             null, zero, full, random, urandom
    /tmp /dev/shm                    empty, private, limited, gone afterwards
    /dev/pts                         terminals of its own
    /proc                            its own processes, if the kernel gives that

The last three are new in each sandbox; all others are built once, and the same for every one.
"""

from __future__ import annotations

import errno
import os
import re
from collections.abc import Iterable, Iterator
from contextlib import suppress
from pathlib import Path

from rosbeat.grading.sandbox import linux

_SYSTEM = ("/usr", "/lib", "/lib32", "/lib64", "/bin", "/sbin")
_ETC = ("ld.so.cache", "ld.so.conf", "ld.so.conf.d", "localtime", "alternatives")
#: Names of users and hosts come from files, of which there are none: nobody else is asked.
_NAMES = "passwd: files\ngroup: files\nhosts: files\n"
_DEVICES = ("null", "zero", "full", "random", "urandom")
#: Where everything that is written is thrown away.
_SCRATCH = ("/tmp", "/dev/shm")
_TERMINALS = "newinstance,ptmxmode=0666,mode=0620"
#: Where something is mounted before it gets its place, and where the machine's root is left.
_FRESH, _OLD = "/fresh", "/old"
_LOCKED = {
    os.ST_NOSUID: linux.MS_NOSUID,
    os.ST_NODEV: linux.MS_NODEV,
    os.ST_NOEXEC: linux.MS_NOEXEC,
    os.ST_NOATIME: linux.MS_NOATIME,
    os.ST_NODIRATIME: linux.MS_NODIRATIME,
    os.ST_RELATIME: linux.MS_RELATIME,
}
_PLAIN = linux.MS_NOSUID | linux.MS_NODEV


def make_root(root: str, readable: Iterable[str], hidden: Iterable[str]) -> None:
    """Build what all sandboxes share, on an empty folder, and make it the root of this process.

    Needs a mount namespace of one's own.

    Args:
        root: The folder.
        readable: Files and folders that are there at their own paths, read-only.
        hidden: Folders in those that are there and empty.

    Raises:
        OSError: If the kernel refuses.
    """
    linux.mount("none", "/", flags=linux.MS_REC | linux.MS_PRIVATE)
    linux.mount("tmpfs", root, "tmpfs", _PLAIN, "size=4m,mode=755")
    for path in (*_SCRATCH, "/dev/pts", "/proc", _FRESH, _OLD):
        os.makedirs(root + path, exist_ok=True)
    for path in _SYSTEM:
        _show(root, path)
    for name in _ETC:
        _show(root, f"/etc/{name}")
    Path(f"{root}/etc/nsswitch.conf").write_text(_NAMES, encoding="ascii")
    for path in outermost(readable):
        _show(root, path)
    for path in hidden:
        if os.path.isdir(root + path):
            linux.mount("tmpfs", root + path, "tmpfs", _PLAIN | linux.MS_RDONLY, "size=4k,mode=755")
    _make_devices(root)
    # Who has no right outside may mount a new one only where one can be seen.
    linux.mount("/proc", root + "/proc", flags=linux.MS_BIND | linux.MS_REC)
    _enter(root)


def furnish(scratch: int, below: Iterable[str]) -> None:
    """Add what each sandbox has for itself; needs a copy of the mount namespace of `make_root`.

    Args:
        scratch: Bytes of `/tmp`, and of `/dev/shm`.
        below: Readable files and folders that lie in those two.

    Raises:
        OSError: If the kernel refuses.
    """
    _make_processes()
    for path in _SCRATCH:
        _make_scratch(path, scratch, [one for one in below if one.startswith(f"{path}/")])
    with suppress(OSError):
        flags = linux.MS_NOSUID | linux.MS_NOEXEC
        linux.mount("devpts", "/dev/pts", "devpts", flags, _TERMINALS)
    os.chdir("/tmp")


def _make_processes() -> None:
    """Show the sandbox's own processes instead of the machine's.

    Some containers do not let anybody mount them; little needs it. They stay writable for the maps
    of the user namespace that comes; what is dangerous in them belongs to the machine's own root.
    """
    is_mounted = False
    with suppress(OSError):
        linux.mount("proc", _FRESH, "proc", _PLAIN | linux.MS_NOEXEC)
        is_mounted = True
    linux.unmount("/proc")
    if is_mounted:
        linux.mount(_FRESH, "/proc", flags=linux.MS_MOVE)


def _make_scratch(path: str, size: int, below: Iterable[str]) -> None:
    """An empty folder for everything that is thrown away, with the readable ones that lie in it."""
    options = f"size={size},nr_inodes=20000,mode=1777"
    linux.mount("tmpfs", _FRESH, "tmpfs", _PLAIN, options)
    for one in filter(os.path.exists, below):
        target = _FRESH + one.removeprefix(path)
        _make_target(one, target)
        linux.mount(one, target, flags=linux.MS_BIND | linux.MS_REC)
    linux.mount(_FRESH, path, flags=linux.MS_MOVE)


def outermost(paths: Iterable[str]) -> Iterator[str]:
    """The paths without those that lie in others of them.

    Args:
        paths: Absolute paths, as often as you like.
    """
    wanted = sorted(set(paths))
    for path in wanted:
        if not any(path.startswith(f"{other}/") for other in wanted):
            yield path


def _enter(root: str) -> None:
    """Make it the root of this process, and take what was there before away."""
    linux.pivot_root(root, root + _OLD)
    os.chdir("/")
    linux.unmount(_OLD)
    os.rmdir(_OLD)
    linux.mount("none", "/", "", linux.MS_REMOUNT | linux.MS_BIND | linux.MS_RDONLY | _PLAIN)


def _show(root: str, path: str) -> None:
    """Put a file or folder of the system into the new root, read-only."""
    if os.path.islink(path):
        os.makedirs(os.path.dirname(root + path), exist_ok=True)
        with suppress(FileExistsError):
            os.symlink(os.readlink(path), root + path)
        return
    if not os.path.exists(path) or (os.path.exists(root + path) and os.path.ismount(root + path)):
        return
    _make_target(path, root + path)
    linux.mount(path, root + path, flags=linux.MS_BIND | linux.MS_REC)
    points = list(_mounted_below(root + path))
    if not points:
        raise OSError(errno.ENOENT, f"what is mounted at {path} cannot be told")
    for point in points:
        make_read_only(point)


def _make_target(path: str, target: str) -> None:
    os.makedirs(target if os.path.isdir(path) else os.path.dirname(target), exist_ok=True)
    if not os.path.isdir(path):
        Path(target).touch()


def make_read_only(point: str) -> None:
    """Let nobody write to a mount.

    Args:
        point: Where it is mounted.

    Raises:
        OSError: If the kernel refuses.
    """
    # What the mount forbids already has to be forbidden again, or the kernel refuses.
    found = os.statvfs(point).f_flag
    locked = sum(flag for bit, flag in _LOCKED.items() if found & bit)
    flags = linux.MS_REMOUNT | linux.MS_BIND | linux.MS_RDONLY | _PLAIN | locked
    linux.mount("none", point, "", flags)


def _mounted_below(path: str) -> Iterator[str]:
    for line in Path("/proc/self/mountinfo").read_bytes().split(b"\n")[:-1]:
        # Blanks and the like are written as numbers of three octal digits (proc(5)).
        field = re.sub(rb"\\([0-7]{3})", lambda found: bytes([int(found[1], 8)]), line.split()[4])
        point = os.fsdecode(field)
        if point == path or point.startswith(path + "/"):
            yield point


def _make_devices(root: str) -> None:
    os.makedirs(f"{root}/dev", exist_ok=True)
    for name in _DEVICES:
        Path(f"{root}/dev/{name}").touch()
        linux.mount(f"/dev/{name}", f"{root}/dev/{name}", flags=linux.MS_BIND)
    links = (("fd", "/proc/self/fd"), ("stdin", "fd/0"), ("stdout", "fd/1"), ("ptmx", "pts/ptmx"))
    for name, target in links:
        os.symlink(target, f"{root}/dev/{name}")
