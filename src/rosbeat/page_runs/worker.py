"""Run inside a sandbox: import once what pages need, then fork for each run of a page.

`python -m rosbeat.page_runs.worker DESCRIPTOR` is process 1 of a sandbox, whose outside is
`sandbox`. Over the socket that it inherits it gets orders, each as a file, and the pipe for the
result. It answers with how the fork ended.

Process 1 never runs anything of a learner, hears no signal from inside, and lets nobody look into
it. ROS itself is only started in forks: a context of this process would not work there.
"""

from __future__ import annotations

import gc
import importlib
import inspect
import os
import pickle
import resource
import shutil
import signal
import socket
import sys
import tempfile
import traceback
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import NoReturn

from rosbeat.page_runs import system_calls

MB = 1_000_000
#: What makes a worker run answers without a sandbox.
UNSAFE = "--unsafe-no-sandbox"
#: What the two ends of the socket say when they are ready, with descriptors beside it.
READY = b"ready"
#: Where everything that is written is thrown away.
SCRATCH = ("/tmp", "/dev/shm")
#: What is run; it gets the descriptor to which it writes its result.
Work = Callable[[int], None]
#: What root may still do as process 1: end works, become their user, remove their files.
RIGHTS = ("CAP_DAC_OVERRIDE", "CAP_KILL", "CAP_SETGID", "CAP_SETUID", "CAP_SETPCAP")
#: `__WALL` of wait(2): also children that say nothing when they end.
_ALL = 0x40000000


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
        result: Bytes that are read of its result.
    """

    wall: float = 30.0
    cpu: int = 30
    memory: int = 1_000 * MB
    address_space: int = 4_000 * MB
    processes: int = 128
    file: int = 50 * MB
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
class Order:
    """Say what is run.

    Attributes:
        work: The function.
        limits: What it may use.
        environment: Its whole environment.
        user: Who it is, where process 1 is root; else 0.
    """

    work: Work
    limits: Limits
    environment: Mapping[str, str]
    user: int = 0


def descendants(process: int) -> list[int]:
    """Return the processes below a process; none if it has ended."""
    below: list[int] = []
    left = [process]
    while left:
        tasks = Path(f"/proc/{left.pop()}/task")
        with suppress(OSError):  # it may have ended, or one of its threads
            for task in os.listdir(tasks):
                with suppress(OSError):
                    text = (tasks / task / "children").read_text(encoding="ascii")
                    left += map(int, text.split())
                    below += map(int, text.split())
    return below


# The process that forks.


def serve(descriptor: int, isolated: bool, prepare: Callable[[], object]) -> None:
    """Run what is ordered, one fork after the other, until nobody orders any more.

    Args:
        descriptor: The socket over which orders come.
        isolated: Whether this is process 1 of a sandbox.
        prepare: Imports what works need.
    """
    # Whoever grades may be killed in the middle; nothing of a submission runs on after that.
    system_calls.prctl(system_calls.PR_SET_PDEATHSIG, signal.SIGKILL)
    # Process 1 hears only signals for which it has a handler, as Python has for this one.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    system_calls.prctl(system_calls.PR_SET_DUMPABLE, 0)
    if not isolated:
        system_calls.prctl(system_calls.PR_SET_CHILD_SUBREAPER, 1)
    first = {path: set(os.listdir(path)) for path in SCRATCH if isolated}
    prepare()
    _empty(first)  # libraries of ROS leave something there
    folders = [os.open(path, os.O_RDONLY | os.O_DIRECTORY) for path in first]
    # Whoever orders may have ended meanwhile, and nobody listens.
    with suppress(ConnectionError), socket.socket(fileno=descriptor) as control:
        socket.send_fds(control, [READY], folders)
        while True:
            _, descriptors, _, _ = socket.recv_fds(control, 100, 2, socket.MSG_CMSG_CLOEXEC)
            if len(descriptors) < 2:
                return
            with os.fdopen(descriptors[0], "rb") as file:
                order: Order = pickle.load(file)
            if isolated:
                code = _forked(order, descriptors[1], "/tmp", _kill_all)
                _empty(first)
            else:
                with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
                    code = _forked(order, descriptors[1], folder, _kill_descendants)
            control.send(str(code).encode())


def _forked(order: Order, result: int, folder: str, kill_all: Callable[[], None]) -> int:
    """Run an order, and end all that it leaves; return its exit code, or less a signal."""
    told, tells = os.pipe()
    child = os.fork()
    if child == 0:
        _be_work(order, result, tells, folder)
    os.close(result)
    os.close(tells)
    with os.fdopen(told, "rb") as file:
        if not file.read():
            sys.exit("The process of a page could not become what it has to be.")
    process, status = 0, 0
    while process != child:  # whatever else loses its parent in there is this process's child, too
        process, status = os.waitpid(-1, _ALL)
    with suppress(ChildProcessError):
        while True:
            kill_all()
            os.waitpid(-1, _ALL)
    return os.waitstatus_to_exitcode(status)


def _empty(first: Mapping[str, set[str]]) -> None:
    """Remove what was written to folders; whoever started this looks whether that was all.

    Args:
        first: The folders, and what was in them at first.
    """
    with suppress(OSError, RecursionError):
        for entry in [entry for folder in first for entry in os.scandir(folder)]:
            if entry.name in first[os.path.dirname(entry.path)]:
                continue
            if entry.is_dir(follow_symlinks=False):
                shutil.rmtree(entry.path)
            else:
                os.unlink(entry.path)


def _kill_all() -> None:
    with suppress(ProcessLookupError):
        os.kill(-1, signal.SIGKILL)


def _kill_descendants() -> None:
    for process in descendants(os.getpid()):
        with suppress(ProcessLookupError):
            os.kill(process, signal.SIGKILL)


# The fork.


def _be_work(order: Order, result: int, tells: int, folder: str) -> NoReturn:
    """Be the work, with nothing of what this process was; for good."""
    code = 1
    try:
        os.setsid()
        os.chdir(folder)
        signal.signal(signal.SIGINT, signal.default_int_handler)
        os.environ.clear()
        os.environ.update(order.environment)
        if folder not in SCRATCH:
            os.environ.update(HOME=folder, TMPDIR=folder)
        if order.user:
            system_calls.become(order.user)
        # A change of the user undoes it. Who ends process 1 ends this, without a sandbox too.
        system_calls.prctl(system_calls.PR_SET_PDEATHSIG, signal.SIGKILL)
        system_calls.prctl(system_calls.PR_SET_DUMPABLE, 1)
        null = os.open(os.devnull, os.O_RDWR)
        order.limits.apply()
        # From here on, whatever goes wrong is the work's own fault.
        os.write(tells, b".")
        for descriptor in range(3):
            os.dup2(null, descriptor)
        os.dup2(result, 3, inheritable=False)
        os.closerange(4, os.sysconf("SC_OPEN_MAX"))
        order.work(3)
        code = 0
    except SystemExit as error:
        code = error.code if isinstance(error.code, int) else 1
    except BaseException:
        traceback.print_exc()
    finally:
        os._exit(code & 0xFF)


# What runs in it: pages.

#: What answers use, and what takes time to import.
_PREPARED = (
    *("rclpy", "rclpy.node", "rclpy.qos", "rclpy.executors", "rclpy.action"),
    *("numpy", "numpy.random"),
    *("std_msgs.msg", "std_srvs.srv", "sensor_msgs.msg", "rcl_interfaces.msg", "test_msgs.action"),
    *("rosbeat.page_session", "rosbeat.ros.scenario", "rosbeat.ros.test_nodes"),
    *("IPython.core.interactiveshell", "rosbeat.exercises.registry", "rosbeat.exercises.check"),
    *("rosbeat.workspace.terminals", "rosbeat.workspace.magics", "rosbeat.workspace.saving_magic"),
    *("IPython.core.magics", "pygments.lexers.python", "rosbeat.exercises.quiz"),
    *("rosbeat.exercises.predict", "rosbeat.viz.diagrams", "matplotlib.backends.backend_svg"),
    *("mpl_toolkits.mplot3d", "dateutil.parser"),
)
#: Types of messages that answers use, and of the services and topics that every node has.
_TYPES = (
    *(f"std_msgs/msg/{name}" for name in ("Bool", "Float32", "Int32", "String")),
    *(f"rcl_interfaces/msg/{name}" for name in ("Log", "ParameterEvent")),
    *(f"rcl_interfaces/srv/{name}Parameters" for name in ("Describe", "Get", "List", "Set")),
    *("rcl_interfaces/srv/SetParametersAtomically", "rcl_interfaces/srv/GetParameterTypes"),
    "type_description_interfaces/srv/GetTypeDescription",
)


def prepare() -> None:
    """Import what answers will need, and load the C part of their message types."""
    for name in _PREPARED:
        importlib.import_module(name)
    recording = importlib.import_module("rosbeat.ros.recording")
    recording.load_type_support(_TYPES)
    recording.repair_message_classes()  # it looks for them once
    importlib.import_module("rosbeat.page_runs.page_process")
    # The first log line of a process looks for the file of each module; it finds them here.
    inspect.getmodule(sys._getframe())
    # What is here stays. A fork that looked through it for garbage would copy all of its pages; and
    # it ends before much garbage has come together.
    gc.collect()
    gc.freeze()
    gc.set_threshold(20_000, 20, 20)


def main(words: Sequence[str]) -> None:
    """Run pages as they are ordered.

    Args:
        words: `UNSAFE` if there is no sandbox, and the number of the socket's descriptor.
    """
    serve(int(words[-1]), UNSAFE not in words, prepare)


if __name__ == "__main__":
    main(sys.argv[1:])
