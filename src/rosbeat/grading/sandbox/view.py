"""What a sandboxed program sees of the disk: a root of its own, nearly all of it read-only.

::

    /usr /lib /lib64 /bin /sbin      the system, read-only
    /etc                             a few files that the C library reads
    the folders that were asked for  read-only, each at its own path; some in them empty
    /tmp /dev/shm                    empty, private, limited, gone afterwards
    /dev                             null, zero, full, random, urandom; terminals of its own
    /proc                            its own processes, if the kernel gives that
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from contextlib import suppress
from pathlib import Path

from rosbeat.grading.sandbox import linux

_SYSTEM = ("/usr", "/lib", "/lib32", "/lib64", "/bin", "/sbin")
_ETC = ("ld.so.cache", "ld.so.conf", "ld.so.conf.d", "localtime", "alternatives")
#: Names of users and hosts come from files, of which there are none: nobody else is asked.
_NAMES = "passwd: files\ngroup: files\nhosts: files\n"
_DEVICES = ("null", "zero", "full", "random", "urandom")
_LOCKED = {
    os.ST_NOSUID: linux.MS_NOSUID,
    os.ST_NODEV: linux.MS_NODEV,
    os.ST_NOEXEC: linux.MS_NOEXEC,
    os.ST_NOATIME: linux.MS_NOATIME,
    os.ST_NODIRATIME: linux.MS_NODIRATIME,
    os.ST_RELATIME: linux.MS_RELATIME,
}
_PLAIN = linux.MS_NOSUID | linux.MS_NODEV


def make_root(root: str, readable: Iterable[str], hidden: Iterable[str], scratch: int) -> None:
    """Build the new root on an empty folder; needs a mount namespace of one's own.

    Args:
        root: The folder.
        readable: Folders that are there at their own paths, read-only.
        hidden: Folders in those that are there and empty.
        scratch: Bytes of `/tmp`, and of `/dev/shm`.

    Raises:
        OSError: If the kernel refuses.
    """
    linux.mount("none", "/", flags=linux.MS_REC | linux.MS_PRIVATE)
    linux.mount("tmpfs", root, "tmpfs", _PLAIN, "size=4m,mode=755")
    # First, for what may be read may lie in a folder below /tmp.
    for path in ("/tmp", "/dev/shm"):
        os.makedirs(root + path, exist_ok=True)
        options = f"size={scratch},nr_inodes=20000,mode=1777"
        linux.mount("tmpfs", root + path, "tmpfs", _PLAIN, options)
    for path in _SYSTEM:
        _show(root, path)
    for name in _ETC:
        _show(root, f"/etc/{name}")
    Path(f"{root}/etc/nsswitch.conf").write_text(_NAMES, encoding="ascii")
    for path in _outermost(readable):
        _show(root, path)
    for path in hidden:
        if os.path.isdir(root + path):
            linux.mount("tmpfs", root + path, "tmpfs", _PLAIN | linux.MS_RDONLY, "size=4k,mode=755")
    _make_devices(root)
    os.makedirs(root + "/proc", exist_ok=True)
    os.makedirs(root + "/old", exist_ok=True)


def _outermost(paths: Iterable[str]) -> Iterator[str]:
    """The paths without those that lie in others of them."""
    wanted = sorted(set(paths))
    for path in wanted:
        if not any(path.startswith(f"{other}/") for other in wanted):
            yield path


def enter_root(root: str) -> None:
    """Make it the root of this process, and take what was there before away.

    Args:
        root: What `make_root` has built.

    Raises:
        OSError: If the kernel refuses.
    """
    # Some containers do not let anybody mount it; little needs it. It stays writable for the maps
    # of the user namespace that comes; what is dangerous in it belongs to the machine's own root.
    with suppress(OSError):
        linux.mount("proc", f"{root}/proc", "proc", _PLAIN | linux.MS_NOEXEC)
    linux.pivot_root(root, f"{root}/old")
    os.chdir("/")
    linux.unmount("/old")
    os.rmdir("/old")
    linux.mount("none", "/", "", linux.MS_REMOUNT | linux.MS_BIND | linux.MS_RDONLY | _PLAIN)
    os.chdir("/tmp")


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
    for point in _mounted_below(root + path):
        _make_read_only(point)


def _make_target(path: str, target: str) -> None:
    os.makedirs(target if os.path.isdir(path) else os.path.dirname(target), exist_ok=True)
    if not os.path.isdir(path):
        Path(target).touch()


def _make_read_only(point: str) -> None:
    # What the mount forbids already has to be forbidden again, or the kernel refuses.
    found = os.statvfs(point).f_flag
    locked = sum(flag for bit, flag in _LOCKED.items() if found & bit)
    flags = linux.MS_REMOUNT | linux.MS_BIND | linux.MS_RDONLY | _PLAIN | locked
    linux.mount("none", point, "", flags)


def _mounted_below(path: str) -> Iterator[str]:
    for line in Path("/proc/self/mountinfo").read_text(encoding="utf-8").splitlines():
        point = line.split()[4].encode().decode("unicode_escape")
        if point == path or point.startswith(path + "/"):
            yield point


def _make_devices(root: str) -> None:
    os.makedirs(f"{root}/dev", exist_ok=True)
    for name in _DEVICES:
        Path(f"{root}/dev/{name}").touch()
        linux.mount(f"/dev/{name}", f"{root}/dev/{name}", flags=linux.MS_BIND)
    _make_terminals(root)
    for name, target in (("fd", "/proc/self/fd"), ("stdin", "fd/0"), ("stdout", "fd/1")):
        os.symlink(target, f"{root}/dev/{name}")


def _make_terminals(root: str) -> None:
    """Pseudo-terminals that nobody outside has; where the kernel gives none, there are none."""
    os.makedirs(f"{root}/dev/pts", exist_ok=True)
    options = "newinstance,ptmxmode=0666,mode=0620"
    with suppress(OSError):
        flags = linux.MS_NOSUID | linux.MS_NOEXEC
        linux.mount("devpts", f"{root}/dev/pts", "devpts", flags, options)
        os.symlink("pts/ptmx", f"{root}/dev/ptmx")
