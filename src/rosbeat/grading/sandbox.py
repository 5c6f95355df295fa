"""Run untrusted code in a sandbox: one sandbox per submission, one fork per answer.

::

    keeper           a fork of a prepared process, in new namespaces; watches, kills; trusted
      ├─ init        process 1 of the PID namespace: when it dies, the kernel kills all others in it
      └─ work        a fork of the keeper for one answer: an ordinary user without capabilities,
                     in its own user namespace, with some system calls refused, and limits

The work sees its own root file system, nearly all of it read-only::

    /usr /lib /lib64 /bin /sbin      the system, read-only
    /etc                             a few files that the C library reads
    the requested folders            read-only, each at its own path; some in them empty
    /dev                             null, zero, full, random, urandom, private terminals
    /proc                            its own processes, if the kernel allows it
    /tmp /dev/shm                    empty, private, limited, new for each answer

Everything that an answer leaves behind (processes, shared memory, files) is removed before the next
one begins. Answers of one learner share namespaces; those of two learners share nothing.
"""

from __future__ import annotations

import errno
import os
import re
import resource
import selectors
import signal
import socket
import sys
import tempfile
import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import NoReturn

from rosbeat.errors import GradingError
from rosbeat.grading import system_calls

MB = 1_000_000


@dataclass(frozen=True)
class Limits:
    """Say how much one run may use.

    Attributes:
        wall: Seconds by the clock on the wall.
        cpu: Seconds of processor time of each process.
        memory: Bytes of memory of all processes and of all files in `/tmp` and `/dev/shm` together.
        address_space: Bytes of address space of each process; libraries take hundreds of MB.
        processes: Processes and threads.
        file: Bytes of one file.
        output: Bytes that are read of what it prints.
        result: Bytes that are read of its result.
    """

    wall: float = 30.0
    cpu: int = 30
    memory: int = 1_000 * MB
    address_space: int = 4_000 * MB
    processes: int = 128
    file: int = 50 * MB
    output: int = 64_000
    result: int = 40 * MB

    def apply(self) -> None:
        """Limit this process and those that it starts; it cannot be undone."""
        for what, most in (
            (resource.RLIMIT_CPU, self.cpu),
            (resource.RLIMIT_AS, self.address_space),
            (resource.RLIMIT_NPROC, self.processes),
            (resource.RLIMIT_FSIZE, self.file),
            (resource.RLIMIT_CORE, 0),
            (resource.RLIMIT_NOFILE, 512),
            (resource.RLIMIT_MEMLOCK, 0),
        ):
            _, hard = resource.getrlimit(what)
            bound = most if hard == resource.RLIM_INFINITY else min(most, hard)
            resource.setrlimit(what, (bound, bound))


@dataclass(frozen=True)
class View:
    """Say what a work sees.

    Attributes:
        readable: Files and folders that it may read, at their own paths.
        hidden: Folders in those that are empty for it.
        environment: All of its environment.
    """

    readable: Sequence[str] = ()
    hidden: Sequence[str] = ()
    environment: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Ending:
    """Say how a run ended.

    Attributes:
        how: `ended`, `exit`, `signal`, `deadline`, `memory`, `output` or `result`: it came to its
            end, left with an exit code, was ended by a signal, or used too much of something.
        number: The exit code or the number of the signal.
        result: What it wrote as its result; hostile until it is parsed.
        output: What it printed, as far as it was read; hostile, too.
        seconds: How long it took, by the clock on the wall.
    """

    how: str
    number: int
    result: bytes
    output: bytes
    seconds: float


#: What is run; it gets the descriptor to which it writes its result.
Work = Callable[[int], None]


def python_folders() -> tuple[str, ...]:
    """Return the folders that Python and this package are read from, for `View.readable`."""
    return tuple({sys.prefix, sys.base_prefix, str(Path(__file__).resolve().parents[1])})


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
        system_calls.unshare(system_calls.CLONE_NEWUSER | system_calls.CLONE_NEWNS)
        _map_ids(0, user, group)
        folder = os.path.dirname(os.path.realpath(sys.executable))
        system_calls.mount("none", "/", flags=system_calls.MS_REC | system_calls.MS_PRIVATE)
        system_calls.mount(folder, folder, flags=system_calls.MS_BIND)
        _make_read_only(folder)
        os.execv(sys.executable, [sys.executable, *sys.orig_argv[1:]])


def cannot_be_made(why: str) -> GradingError:
    """Return the error for a machine on which no sandbox can be made."""
    return GradingError(
        f"This machine does not let the sandbox be made: {why}.",
        "Other people's code would run here with all that you may do, so nothing was run.",
        "Allow user namespaces (`sudo sysctl kernel.unprivileged_userns_clone=1`, on Ubuntu 24.04 "
        "also `kernel.apparmor_restrict_unprivileged_userns=0`), or grade as root or in a "
        "virtual machine. The kernel has to be Linux 5.8 or newer (`uname -r`).",
    )


# A sandbox.

#: Seconds between two looks at how much memory is used.
_LOOK = 0.05
#: `__WALL` of wait(2): also children that say nothing when they end.
_ALL = 0x40000000
_NEW = (
    *(
        system_calls.CLONE_NEWNS,
        system_calls.CLONE_NEWPID,
        system_calls.CLONE_NEWNET,
        system_calls.CLONE_NEWIPC,
    ),
    system_calls.CLONE_NEWUTS,
)
#: Lines of `/proc/PID/status` that count as memory, in KiB: pages of its own and shared ones, and
#: tables of pages. Pages of files, as libraries, do not count.
_COUNTED = (b"RssAnon:", b"RssShmem:", b"VmPTE:")
#: What the two buffers of a socket take when they are full, how many sockets of an answer need not
#: count for full ones, and what one buffer of a TCP connection may take.
_BUFFERS, _FREE_SOCKETS, _MOST_OF_TCP = 2 * 212_992, 64, 65_536
#: Bytes of `/proc/PID/maps`, some 10,000 mappings, from which on what the kernel notes of a process
#: counts, and how much that may be.
_MOST_MAPS, _NOTES = 1_000_000, 64 * MB
#: What a process says when it has settled, and before it says what went wrong.
_SETTLED, _TROUBLE = b".", b"!"
#: What the keeper asks of init, and what that answers when it is done.
_SWEEP = b"s"


class Sandbox:
    """Run several works in one sandbox, one after the other; usable in a `with` block.

    The process that makes it becomes its keeper: it is in there itself, with all rights in there,
    and cannot leave. So it is to be a fork that has nothing else to do.

    Args:
        view: What works see.
        isolated: Whether there are namespaces; without, all that is left are limits, a folder and
            an environment of its own, and an end for the processes that a work leaves behind.

    Raises:
        GradingError: If it cannot be made on this machine.
    """

    def __init__(self, view: View, isolated: bool = True) -> None:
        self._view = view
        self._proc = os.open("/proc", os.O_RDONLY | os.O_DIRECTORY)
        self._init = _Init() if isolated else None
        if self._init is None:
            system_calls.prctl(system_calls.PR_SET_CHILD_SUBREAPER, 1)
            return
        try:
            _isolate(view, self._init)
        except OSError as error:
            raise cannot_be_made(str(error)) from error

    def __enter__(self) -> Sandbox:
        return self

    def __exit__(self, *_: object) -> None:
        if self._init is not None:
            self._init.end()
        os.close(self._proc)

    def run(self, work: Work, limits: Limits) -> Ending:
        """Run a function in a fork, and end all that it leaves behind.

        Raises:
            GradingError: If the sandbox cannot be made on this machine.
            ConnectionError: If somebody has ended init.
        """
        watch = _Watch(limits)
        if self._init is None:
            with tempfile.TemporaryDirectory(prefix="rosbeat-", ignore_cleanup_errors=True) as own:
                return self._watched(watch, work, own)
        try:
            _new_scratch(self._view.readable)
        except OSError as error:
            raise cannot_be_made(str(error)) from error
        return self._watched(watch, work, "/tmp")

    def _watched(self, watch: _Watch, work: Work, folder: str) -> Ending:
        code = 0
        child = os.fork()
        if child == 0:
            self._become(watch, work, folder)
        watch.forked()
        try:
            descriptor = system_calls.pidfd_open(child)
            watch.listen(descriptor, self._memory)
            os.close(descriptor)
        finally:
            code = self._sweep(child)
        return watch.ending(code)

    def _become(self, watch: _Watch, work: Work, folder: str) -> NoReturn:
        """Be the work, in the child: an ordinary user in a place of its own; for good."""
        ends = watch.ends
        try:
            os.setsid()
            os.chdir(folder)
            environment = self._view.environment
            if self._init is not None:
                _give_up_rights()
                system_calls.forbid_calls()
            else:
                environment = {**environment, "HOME": folder, "TMPDIR": folder}
            # After that, for who changes its rights is forgotten by this.
            system_calls.prctl(system_calls.PR_SET_PDEATHSIG, signal.SIGKILL)
            result = _settle(ends, environment)
            watch.limits.apply()
            # The last thing: from here on nothing can say that the sandbox was not made.
            os.write(ends[2], _SETTLED)
            os.close(ends[2])
        except BaseException as error:
            _refuse(ends[2], error)
        _run(work, result)

    def _memory(self) -> int:
        """Return the bytes of memory that are used in there."""
        total, left, sockets = 0, self._guests(), set[str]()
        if self._init is not None:
            left += _children(self._proc, self._init.pid)
        while left:
            one = left.pop()
            left += _children(self._proc, one)
            total += _memory_of(self._proc, one)
            sockets |= _sockets_of(self._proc, one)
        total += _BUFFERS * max(0, len(sockets) - _FREE_SOCKETS)
        if self._init is not None:
            for path in _SCRATCH:
                found = os.statvfs(path)
                total += (found.f_blocks - found.f_bfree) * found.f_frsize
        return total

    def _sweep(self, child: int) -> int:
        """End everything in there but init; return the exit code of the work, or less a signal."""
        self._kill_all()
        _, status = os.waitpid(child, _ALL)
        # Only now what it has started is init's, which waits until that is gone: processes that are
        # still ending would count for the next work.
        self._kill_all()
        while self._guests():
            self._kill_all()
            os.waitpid(-1, _ALL)
        return os.waitstatus_to_exitcode(status)

    def _kill_all(self) -> None:
        if self._init is not None:
            self._init.sweep()
            return
        found, left = [], self._guests()
        while left:
            found.append(left.pop())
            left += _children(self._proc, found[-1])
        for one in found:
            with suppress(ProcessLookupError):
                os.kill(one, signal.SIGKILL)

    def _guests(self) -> list[int]:
        """Return the keeper's children but init: the work, and siblings that it may have made.

        Where there is no init, whatever loses its parent becomes a child of the keeper.
        """
        init = self._init.pid if self._init is not None else 0
        return [one for one in _children(self._proc, os.getpid()) if one != init]


def _children(proc: int, process: int) -> list[int]:
    """Return the children of all threads of a process; none if it has ended.

    Args:
        proc: A descriptor of `/proc`.
        process: Its number there.
    """
    found: list[int] = []
    with suppress(OSError):
        tasks = os.open(f"{process}/task", os.O_RDONLY, dir_fd=proc)
        try:
            for task in os.listdir(tasks):
                with suppress(OSError):  # a thread may have ended
                    found += map(int, _read(f"{task}/children", tasks).split())
        finally:
            os.close(tasks)
    return found


def _memory_of(proc: int, process: int) -> int:
    """Return the bytes of memory of a process."""
    total = 0
    with suppress(OSError):
        lines = _read(f"{process}/status", proc).splitlines()
        total = 1024 * sum(int(one.split()[1]) for one in lines if one.startswith(_COUNTED))
        if len(_read(f"{process}/maps", proc, _MOST_MAPS)) >= _MOST_MAPS:
            total += _NOTES
    return total


def _sockets_of(proc: int, process: int) -> set[str]:
    """Return the sockets that a process has open; what waits in them is charged to nobody."""
    found: set[str] = set()
    with suppress(OSError):
        descriptors = os.open(f"{process}/fd", os.O_RDONLY, dir_fd=proc)
        try:
            for name in os.listdir(descriptors):
                with suppress(OSError):  # it may be closed meanwhile
                    found.add(os.readlink(name, dir_fd=descriptors))
        finally:
            os.close(descriptors)
    return {one for one in found if one.startswith("socket:")}


def _read(path: str, folder: int, most: int = 1 << 30) -> bytes:
    """Return a file's content, as soon as it is whole or has as many bytes."""
    handle = os.open(path, os.O_RDONLY, dir_fd=folder)
    found = bytearray()
    try:
        while len(found) < most and (data := os.read(handle, 65_536)):
            found += data
    finally:
        os.close(handle)
    return bytes(found)


# Becoming the work.


def _settle(ends: tuple[int, int, int], environment: Mapping[str, str]) -> int:
    """Keep nothing of what this process was, and return the descriptor of its result."""
    to_result, to_output, control = ends
    signal.signal(signal.SIGINT, signal.default_int_handler)
    os.dup2(os.open("/dev/null", os.O_RDONLY), 0)
    os.dup2(to_output, 1)
    os.dup2(to_output, 2)
    result = os.dup2(to_result, 3, inheritable=False)
    os.closerange(4, control)
    os.closerange(control + 1, os.sysconf("SC_OPEN_MAX"))
    os.environ.clear()
    os.environ.update(environment)
    return result


def _refuse(control: int, error: BaseException) -> NoReturn:
    with suppress(OSError):
        os.write(control, _TROUBLE + f" {type(error).__name__}: {error}\n".encode())
    os._exit(1)


def _run(work: Work, result: int) -> NoReturn:
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


# Watching it.

_MOST_CONTROL = 10_000


@dataclass
class _Pipe:
    """Keep what comes out of one pipe.

    Attributes:
        most: Bytes of it that are kept.
        name: What is used up if there are more; empty if the rest may be lost.
        kept: What has come.
    """

    most: int
    name: str = ""
    kept: bytearray = field(default_factory=bytearray)

    def __post_init__(self) -> None:
        self.reading, self.writing = os.pipe()
        os.set_blocking(self.reading, False)


class _Watch:
    """Watch a run while it goes on."""

    def __init__(self, limits: Limits) -> None:
        self.limits = limits
        self._result = _Pipe(limits.result, "result")
        self._output, self._control = _Pipe(limits.output), _Pipe(_MOST_CONTROL)
        self._pipes = (self._result, self._output, self._control)
        self._began, self._looked, self._stopped = time.monotonic(), 0.0, ""

    @property
    def ends(self) -> tuple[int, int, int]:
        """Return the child's ends: for its result, for what it prints, for how it has settled."""
        return self._result.writing, self._output.writing, self._control.writing

    def forked(self) -> None:
        """Close the child's ends here."""
        for end in self.ends:
            os.close(end)

    def listen(self, process: int, memory: Callable[[], int]) -> None:
        """Read the pipes until the process has ended, or something is used up."""
        with selectors.DefaultSelector() as selector:
            selector.register(process, selectors.EVENT_READ)
            for pipe in self._pipes:
                selector.register(pipe.reading, selectors.EVENT_READ, pipe)
            while not self._stopped:
                ready = [key.data for key, _ in selector.select(_LOOK)]
                if None in ready:
                    break
                for pipe in ready:
                    if not self._take(pipe):
                        selector.unregister(pipe.reading)
                self._look(memory)

    def _take(self, pipe: _Pipe) -> bool:
        """Read once; return whether more may come."""
        try:
            data = os.read(pipe.reading, 65_536)
        except BlockingIOError:
            return True  # somebody in there has taken it away meanwhile
        if len(pipe.kept) + len(data) > pipe.most and pipe.name:
            self._stopped = pipe.name
        pipe.kept += data[: pipe.most - len(pipe.kept)]
        return bool(data)

    def _look(self, memory: Callable[[], int]) -> None:
        now = time.monotonic()
        if now - self._looked < _LOOK:
            return
        self._looked = now
        if now - self._began > self.limits.wall:
            self._stopped = self._stopped or "deadline"
        elif memory() > self.limits.memory:
            self._stopped = self._stopped or "memory"

    def ending(self, code: int) -> Ending:
        """Return how the run has ended, when nobody is there any more to write.

        Args:
            code: Its exit code, or less the number of a signal.

        Raises:
            GradingError: If it has not settled.
        """
        for pipe in self._pipes:
            self._drain(pipe)
            os.close(pipe.reading)
        said = bytes(self._control.kept)
        if _TROUBLE in said or not (said or self._stopped):
            why = said.decode("utf-8", "replace").partition(_TROUBLE.decode())[2].strip()
            raise cannot_be_made(why or "it ended early")
        how, number = self._stopped, 0
        if not how and code < 0:
            how, number = "signal", -code
        elif not how:
            how, number = ("exit" if code else "ended"), code
        seconds = time.monotonic() - self._began
        return Ending(how, number, bytes(self._result.kept), bytes(self._output.kept), seconds)

    def _drain(self, pipe: _Pipe) -> None:
        with selectors.DefaultSelector() as selector:
            selector.register(pipe.reading, selectors.EVENT_READ)
            # A pipe that was sent through a socket may stay open for a while.
            while not self._stopped and selector.select(0) and self._take(pipe):
                pass


# Namespaces, and how their rights are given up again.

_NOBODY = 65534
#: Who a work believes to be.
_INSIDE = 1000
#: Where the new root is built: a folder that every Linux has, and no sandbox shows.
_ROOT = "/sys"


class _Init:
    """Start and end process 1 of a sandbox, which ends the others when it is told to or dies."""

    def __init__(self) -> None:
        self.pid = 0
        self._asks, self._answers = -1, -1

    def start(self) -> None:
        """Fork it; to be called when the namespaces are new and the machine's disk is still there.

        Raises:
            OSError: If it cannot start.
        """
        (asked, self._asks), (self._answers, answers) = os.pipe(), os.pipe()
        self.pid = os.fork()
        if self.pid == 0:
            _be_init(asked, answers)
        os.close(asked)
        os.close(answers)
        said = os.read(self._answers, _MOST_CONTROL)
        if said != _SETTLED:
            raise OSError(errno.EPERM, said.decode("utf-8", "replace") or "init ended early")

    def sweep(self) -> None:
        """End all processes in there, but itself and what the keeper has to wait for.

        Raises:
            ConnectionError: If it is gone.
        """
        try:
            os.write(self._asks, _SWEEP)
            said = os.read(self._answers, 1)
        except OSError as error:
            raise ConnectionError(str(error)) from error
        if said != _SWEEP:
            raise ConnectionError("init of a sandbox has ended")

    def end(self) -> None:
        """End it, and with it everything in there."""
        if self.pid:
            os.kill(self.pid, signal.SIGKILL)
            # It is not gone before all others are, and some wait to be heard of here.
            while os.waitpid(-1, _ALL)[0] != self.pid:
                pass
            os.close(self._asks)
            os.close(self._answers)


def _be_init(asked: int, answers: int) -> NoReturn:
    try:
        os.setsid()
        low, high = sorted((asked, answers))
        for begin, end in ((0, low), (low + 1, high), (high + 1, os.sysconf("SC_OPEN_MAX"))):
            os.closerange(begin, end)
        with suppress(OSError):  # some containers do not let anybody; little needs it
            flags = system_calls.MS_NOSUID | system_calls.MS_NODEV | system_calls.MS_NOEXEC
            system_calls.mount("proc", f"{_ROOT}/proc", "proc", flags)
        _give_up_rights()
        # After that, for who changes its rights is forgotten by this.
        system_calls.prctl(system_calls.PR_SET_PDEATHSIG, signal.SIGKILL)
        # Nobody in there may look into this process, which could end the others.
        system_calls.prctl(system_calls.PR_SET_DUMPABLE, 0)
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        # Whatever loses its parent in there becomes its child, and is cleared away when it ends.
        signal.signal(signal.SIGCHLD, signal.SIG_IGN)
        os.write(answers, _SETTLED)
        while os.read(asked, 1):
            with suppress(ProcessLookupError):
                os.kill(-1, signal.SIGKILL)
            with suppress(ChildProcessError):
                os.waitpid(-1, _ALL)  # as SIGCHLD is ignored: until there is none any more
            os.write(answers, _SWEEP)
    except BaseException as error:
        with suppress(OSError):
            os.write(answers, f"{error}".encode())
    finally:
        os._exit(0)


def _isolate(view: View, init: _Init) -> None:
    """Begin new namespaces, and see nothing of the machine's disk but what the view shows."""
    flags = 0
    for one in _NEW:
        flags |= one
    system_calls.unshare(flags)
    system_calls.limit_tcp(_MOST_OF_TCP)
    _make_root(_ROOT, view.readable, view.hidden)
    os.chdir("/")
    init.start()
    system_calls.pivot_root(_ROOT, _ROOT + _OLD)
    os.chdir("/")
    system_calls.unmount(_OLD)
    os.rmdir(_OLD)
    system_calls.loopback_up()
    socket.sethostname("sandbox")
    with suppress(OSError):
        system_calls.mount(
            "devpts",
            "/dev/pts",
            "devpts",
            system_calls.MS_NOSUID | system_calls.MS_NOEXEC,
            _TERMINALS,
        )
    system_calls.mount(
        "none",
        "/",
        "",
        system_calls.MS_REMOUNT | system_calls.MS_BIND | system_calls.MS_RDONLY | _PLAIN,
    )


def _give_up_rights() -> None:
    """Become an ordinary user in a user namespace without any right, for good."""
    if os.getuid() == 0 and not _is_mapped():
        os.setgroups([])
        os.setresgid(_NOBODY, _NOBODY, _NOBODY)
        os.setresuid(_NOBODY, _NOBODY, _NOBODY)
        # Who has changed its user may not look into /proc/self until this is said.
        system_calls.prctl(system_calls.PR_SET_DUMPABLE, 1)
    user, group = os.getuid(), os.getgid()
    if os.path.exists("/proc/self/uid_map"):
        system_calls.unshare(system_calls.CLONE_NEWUSER)
        _map_ids(_INSIDE, user, group)
        with suppress(OSError):
            _write("/proc/sys/user/max_user_namespaces", "0")
    system_calls.drop_capabilities()


def _is_mapped() -> bool:
    """Return whether this user 0 is an ordinary user outside."""
    with suppress(OSError), open("/proc/self/uid_map", encoding="ascii") as file:
        return file.read().split()[:2] != ["0", "0"]
    return os.getuid() != 0


def _map_ids(inside: int, user: int, group: int) -> None:
    _write("/proc/self/setgroups", "deny")
    _write("/proc/self/uid_map", f"{inside} {user} 1")
    _write("/proc/self/gid_map", f"{inside} {group} 1")


def _write(path: str, text: str) -> None:
    handle = os.open(path, os.O_WRONLY)
    try:
        os.write(handle, text.encode())
    finally:
        os.close(handle)


# What a work sees of the disk.

_SYSTEM = ("/usr", "/lib", "/lib32", "/lib64", "/bin", "/sbin")
_ETC = ("ld.so.cache", "ld.so.conf", "ld.so.conf.d", "localtime", "alternatives")
#: Names of users and hosts come from files, of which there are none: nobody else is asked.
_NAMES = "passwd: files\ngroup: files\nhosts: files\n"
#: The one user in there: programs ask for its name and home.
_USER = f"learner:x:{_INSIDE}:{_INSIDE}::/tmp:/bin/sh\n"
_DEVICES = ("null", "zero", "full", "random", "urandom")
#: Where everything that is written is thrown away, and how many bytes each may hold.
_SCRATCH, _MOST_SCRATCH = ("/tmp", "/dev/shm"), 100 * MB
_TERMINALS = "newinstance,ptmxmode=0666,mode=0620"
#: Where something is mounted before it gets its place, and where the machine's root is left.
_FRESH, _OLD = "/fresh", "/old"
_LOCKED = {
    os.ST_NOSUID: system_calls.MS_NOSUID,
    os.ST_NODEV: system_calls.MS_NODEV,
    os.ST_NOEXEC: system_calls.MS_NOEXEC,
    os.ST_NOATIME: system_calls.MS_NOATIME,
    os.ST_NODIRATIME: system_calls.MS_NODIRATIME,
    os.ST_RELATIME: system_calls.MS_RELATIME,
}
_PLAIN = system_calls.MS_NOSUID | system_calls.MS_NODEV


def _make_root(root: str, readable: Iterable[str], hidden: Iterable[str]) -> None:
    """Build what works see, on a folder; needs a mount namespace of one's own."""
    system_calls.mount("none", "/", flags=system_calls.MS_REC | system_calls.MS_PRIVATE)
    system_calls.mount("tmpfs", root, "tmpfs", _PLAIN, "size=4m,mode=755")
    for path in (*_SCRATCH, "/dev/pts", "/proc", _FRESH, _OLD):
        os.makedirs(root + path, exist_ok=True)
    for path in (*_SYSTEM, *(f"/etc/{name}" for name in _ETC), *_outermost(readable)):
        _show(root, path)
    Path(f"{root}/etc/nsswitch.conf").write_text(_NAMES, encoding="ascii")
    Path(f"{root}/etc/passwd").write_text(_USER, encoding="ascii")
    for path in hidden:
        if os.path.isdir(root + path):
            system_calls.mount(
                "tmpfs", root + path, "tmpfs", _PLAIN | system_calls.MS_RDONLY, "size=4k,mode=755"
            )
    for name in _DEVICES:
        Path(f"{root}/dev/{name}").touch()
        system_calls.mount(f"/dev/{name}", f"{root}/dev/{name}", flags=system_calls.MS_BIND)
    links = (("fd", "/proc/self/fd"), ("stdin", "fd/0"), ("stdout", "fd/1"), ("ptmx", "pts/ptmx"))
    for name, target in links:
        os.symlink(target, f"{root}/dev/{name}")


def _outermost(paths: Iterable[str]) -> Iterator[str]:
    """Give absolute paths without those that lie in others of them."""
    wanted = sorted({"/" + os.path.abspath(path).lstrip("/") for path in paths})
    for path in wanted:
        if not any(path.startswith(f"{other}/") for other in wanted):
            yield path


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
    system_calls.mount(path, root + path, flags=system_calls.MS_BIND | system_calls.MS_REC)
    points = list(_mounted_below(root + path))
    if not points:
        raise OSError(errno.ENOENT, f"what is mounted at {path} cannot be told")
    for point in points:
        _make_read_only(point)


def _make_target(path: str, target: str) -> None:
    os.makedirs(target if os.path.isdir(path) else os.path.dirname(target), exist_ok=True)
    if not os.path.isdir(path):
        Path(target).touch()


def _make_read_only(point: str) -> None:
    """Let nobody write to a mount."""
    # What the mount forbids already has to be forbidden again, or the kernel refuses.
    found = os.statvfs(point).f_flag
    locked = sum(flag for bit, flag in _LOCKED.items() if found & bit)
    flags = (
        system_calls.MS_REMOUNT | system_calls.MS_BIND | system_calls.MS_RDONLY | _PLAIN | locked
    )
    system_calls.mount("none", point, "", flags)


def _mounted_below(path: str) -> Iterator[str]:
    for line in Path("/proc/self/mountinfo").read_bytes().split(b"\n")[:-1]:
        # Blanks and the like are written as numbers of three octal digits (proc(5)).
        field_ = re.sub(rb"\\([0-7]{3})", lambda found: bytes([int(found[1], 8)]), line.split()[4])
        point = os.fsdecode(field_)
        if point == path or point.startswith(path + "/"):
            yield point


def _new_scratch(readable: Iterable[str]) -> None:
    """Put empty folders where works write, with the readable paths that lie in them."""
    options = f"size={_MOST_SCRATCH},nr_inodes=20000,mode=1777"
    for path in _SCRATCH:
        with suppress(OSError):  # the first time there is none
            system_calls.unmount(path)
        system_calls.mount("tmpfs", _FRESH, "tmpfs", _PLAIN, options)
        for one in _outermost(readable):
            if one.startswith(f"{path}/") and os.path.exists(one):
                target = _FRESH + one.removeprefix(path)
                _make_target(one, target)
                system_calls.mount(one, target, flags=system_calls.MS_BIND | system_calls.MS_REC)
        system_calls.mount(_FRESH, path, flags=system_calls.MS_MOVE)
