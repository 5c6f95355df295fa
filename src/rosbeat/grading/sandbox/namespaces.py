"""Who may make namespaces, which ones a sandbox has, and how their rights are given up again."""

from __future__ import annotations

import os
import sys
from contextlib import suppress

from rosbeat.grading.sandbox import linux
from rosbeat.grading.sandbox.view import make_read_only

#: What a sandbox has of its own and a process can enter; process and user namespaces come besides.
OWN = linux.CLONE_NEWNS | linux.CLONE_NEWNET | linux.CLONE_NEWIPC | linux.CLONE_NEWUTS
_NOBODY = 65534
#: Who the work believes to be.
_INSIDE = 1000


def become_able() -> None:
    """Get the right to make namespaces; to be called while this process has one thread.

    The administrator has it. To an ordinary user the kernel gives it in a user namespace of its
    own, in which this process is then user 0, with no more rights outside than before.

    An ordinary user may own the file of Python itself, and `/proc/self/exe` leads whoever is forked
    from here to it, past all that a sandbox shows. So the program begins once more, from a mount
    that cannot be written to: call this before anything else is done.

    Raises:
        OSError: If the kernel refuses.
    """
    if os.getuid() != 0:
        user, group = os.getuid(), os.getgid()
        linux.unshare(linux.CLONE_NEWUSER | linux.CLONE_NEWNS)
        _map_ids(0, user, 0, group)
        folder = os.path.dirname(os.path.realpath(sys.executable))
        linux.mount("none", "/", flags=linux.MS_REC | linux.MS_PRIVATE)
        linux.mount(folder, folder, flags=linux.MS_BIND)
        make_read_only(folder)
        os.execv(sys.executable, [sys.executable, *sys.orig_argv[1:]])


def give_up_rights() -> None:
    """Become an ordinary user in a user namespace without any right, for good.

    Raises:
        OSError: If the kernel refuses.
    """
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
