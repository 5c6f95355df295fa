"""What strangers' code may try, each in a sandbox; run as a program, it tells how each ended.

It is a process of its own because a sandbox is forked, and a test process has threads.
"""

import ctypes
import json
import mmap
import os
import platform
import shutil
import signal
import socket
import sys
import tempfile
import time
from contextlib import suppress
from pathlib import Path

from rosbeat.errors import GradingError
from rosbeat.grading.linux import REFUSED, number_of
from rosbeat.grading.sandbox import Limits, Sandbox, View, become_able, python_folders

LIMITS = Limits(wall=2.0, memory=300_000_000)
#: A folder that is shown, and one of which only one file is.
SHOWN, HIDDEN = (Path(tempfile.gettempdir(), f"rosbeat {one} Ü {os.getpid()}") for one in "ab")
SECRET = Path(tempfile.gettempdir(), f"rosbeat-secret-{os.getpid()}")


def attempt(deed):
    """What came of something: the error's name, or `done`."""
    try:
        deed()
    except (OSError, ValueError) as error:
        return type(error).__name__
    return "done"


def tells(result, value):
    os.write(result, json.dumps(value).encode())


def looks(result):
    lines = Path("/proc/self/status").read_text().splitlines()
    tells(result, {
        "user": os.getuid(), "folders": sorted(os.listdir("/")), "environment": dict(os.environ),
        "processes": [one for one in os.listdir("/proc") if one.isdigit()], "here": os.getcwd(),
        "capabilities": {one.split()[1] for one in lines if one.startswith("Cap")} == {"0" * 16},
        "host": socket.gethostname(), "home": attempt(lambda: os.listdir(os.path.expanduser("~"))),
        "shm": os.listdir("/dev/shm"), "tmp": os.listdir("/tmp"),
        "secret": attempt(SECRET.read_text),
    })  # fmt: skip


def writes(result):
    places = ("/usr/x", "/etc/x", "/x", sys.prefix + "/x", "/proc/sys/kernel/hostname", "/tmp/x")
    tells(result, {one: attempt(lambda one=one: Path(one).write_text("x")) for one in places})


def gains_rights(result):
    libc = ctypes.CDLL(None, use_errno=True)
    tells(result, {
        "user namespace": libc.unshare(0x10000000),
        "mount": libc.mount(b"x", b"/tmp", b"tmpfs", 0, 0),
        "user": attempt(lambda: os.setuid(0)), "nice": attempt(lambda: os.nice(-5)),
        "limits": attempt(lambda: __import__("resource").setrlimit(7, (9_999, 9_999))),
        "trace the first process": libc.ptrace(16, 1, 0, 0),
    })  # fmt: skip


def calls_out(result):
    def connect(address):
        socket.create_connection(address, timeout=0.5).close()

    with socket.create_server(("127.0.0.1", 0)) as server:
        tells(result, {
            "itself": attempt(lambda: connect(server.getsockname())),
            "others": attempt(lambda: connect(("10.0.0.1", 80))),
            "names": attempt(lambda: socket.getaddrinfo("pypi.org", 80)),
            "interfaces": [name for _, name in socket.if_nameindex()],
        })  # fmt: skip


def loops(result):
    while True:
        pass


def sleeps(result):
    time.sleep(1000)


def forks(result):
    while True:
        with suppress(OSError):
            os.fork()


def eats(result):
    kept = []
    while True:
        kept.append(b"x" * 10_000_000)


def shares_memory(result):
    kept = []
    while True:
        kept.append(mmap.mmap(-1, 10_000_000))
        kept[-1].write(b"x" * 10_000_000)


def prints(result):
    while True:
        os.write(1, b"x" * 100_000)


def answers_too_much(result):
    while True:
        os.write(result, b"x" * 100_000)


def fills_a_file(result):
    with open("/tmp/x", "wb") as file:
        while True:
            file.write(b"x" * 1_000_000)


def fills_memory_that_is_shared(result):
    for number in range(1000):
        Path(f"/dev/shm/{number}").write_bytes(b"x" * 10_000_000)


def kills_itself(result):
    os.kill(os.getpid(), signal.SIGKILL)


def kills_all(result):
    found = {}
    for process in (1, os.getppid(), -1, -os.getpgid(0)):
        with suppress(OSError):
            os.kill(process, signal.SIGTERM if process == -os.getpgid(0) else signal.SIGKILL)
    tells(result, found)


def crashes(result):
    ctypes.string_at(0)


def leaves(result):
    os._exit(0)


def leaves_with_a_code(result):
    sys.exit(7)


def raises(result):
    raise ValueError("no")


def stays_behind(result):
    if os.fork() == 0:
        os.setsid()
        if os.fork() == 0:
            Path("/dev/shm/mine").write_text("x")
            time.sleep(1000)
        os._exit(0)


def has_a_sibling(result):
    _sibling(lambda: time.sleep(1000))


def has_a_sibling_that_eats(result):
    _sibling(lambda: eats(result))
    time.sleep(1000)


def _sibling(deed):
    """Fork a process that is a child of this one's parent: clone(2)."""
    number, flags = {"x86_64": 56, "aarch64": 220}[platform.machine()], 0x8000 | signal.SIGCHLD
    if ctypes.CDLL(None).syscall(number, flags, 0, 0, 0, 0) == 0:
        deed()


def closes_everything(result):
    os.closerange(0, 100)


def closes_everything_and_sleeps(result):
    os.closerange(0, 100)
    time.sleep(1000)


def leaves_with_a_high_code(result):
    os._exit(200)


def reads_what_lies_below_tmp(result):
    tells(result, {
        "folder": (SHOWN / "one").read_text(), "file": (HIDDEN / "two").read_text(),
        "there": [sorted(os.listdir(SHOWN)), sorted(os.listdir(HIDDEN))],
        "write": attempt(lambda: (SHOWN / "one").write_text("x")),
        "replace": attempt(lambda: (HIDDEN / "two").write_text("x")),
    })  # fmt: skip


def calls_what_is_not_there(result):
    """Keys of the kernel are kept apart by no namespace; some memory belongs to no process."""
    libc = ctypes.CDLL(None, use_errno=True)

    def refused(name):
        ctypes.set_errno(0)
        return libc.syscall(number_of(name), 0, 0, 0, 0, 0), ctypes.get_errno()

    tells(result, {name: refused(name) for name in REFUSED} | {"others": os.getpid()})


def opens_sockets(result):
    families = {"unix": 1, "inet": 2, "inet6": 10, "netlink": 16, "packet": 17, "alg": 38,
                "vsock": 40, "xdp": 44, "bluetooth": 31}  # fmt: skip
    kinds = {"netlink of another kind": (16, 3, 12), "tipc": (30, 1, 0)}
    tells(result, {
        **{name: attempt(lambda one=one: socket.socket(one, socket.SOCK_DGRAM).close())
           for name, one in families.items() if name not in ("netlink",)},
        "netlink": attempt(lambda: socket.socket(16, 3, 0).close()),
        **{name: attempt(lambda one=one: socket.socket(*one).close())
           for name, one in kinds.items()},
        "pair": attempt(lambda: [one.close() for one in socket.socketpair()]),
    })  # fmt: skip


def keeps_memory_in_sockets(result):
    for _ in range(20):
        if os.fork() == 0:
            kept = []
            with suppress(OSError):
                while True:
                    kept.append(socket.socketpair(socket.AF_UNIX, socket.SOCK_DGRAM))
                    kept[-1][0].setblocking(False)
                    with suppress(BlockingIOError):
                        while True:
                            kept[-1][0].send(b"x" * 50_000)
            time.sleep(1000)
    time.sleep(1000)


def fills_both_scratch_folders(result):
    for folder in ("/tmp", "/dev/shm"):
        with suppress(OSError):
            for number in range(100):
                Path(folder, str(number)).write_bytes(b"x" * 10_000_000)
    eaten = b"x" * 150_000_000
    time.sleep(1000)
    print(len(eaten))


def leaves_files(result):
    for folder in ("/tmp", "/dev/shm"):
        Path(folder, "left").write_text("x")


def finds_files(result):
    tells(result, {"found": [*os.listdir("/tmp"), *os.listdir("/dev/shm")]})


def hides_a_pipe(result):
    """Send the pipe through a socket that is sent through itself: who ends so leaves it open."""
    one, other = socket.socketpair(socket.AF_UNIX)
    socket.send_fds(one, [b"x"], [1, result, one.fileno(), other.fileno()])


def looks_around(result):
    def reads(path):
        with open(path, "rb") as file:
            return file.read()

    mounts = reads("/proc/self/mountinfo").decode().splitlines()
    tells(result, {
        "python": attempt(lambda: os.chmod("/proc/self/exe", 0o4755)),
        "root": attempt(lambda: os.listdir("/proc/1/root")),
        "environment": attempt(lambda: reads("/proc/1/environ")),
        "memory": attempt(lambda: reads("/proc/1/mem")),
        "signal": attempt(lambda: os.kill(1, signal.SIGTERM)),
        "alive": attempt(lambda: os.kill(1, 0)),
        "mounts": sorted({line.split()[4] for line in mounts}),
        "descriptors": sorted(int(one) for one in os.listdir("/proc/self/fd")),
        "session": os.getsid(0) == os.getpid(),
    })  # fmt: skip


def ignores_signals(result):
    for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
        signal.signal(number, signal.SIG_IGN)
    while True:
        time.sleep(1)


DEEDS = (
    *(looks, writes, gains_rights, calls_out, loops, sleeps, forks, eats, prints, answers_too_much),
    *(fills_a_file, fills_memory_that_is_shared, kills_itself, kills_all, crashes, leaves),
    *(leaves_with_a_code, leaves_with_a_high_code, raises, stays_behind, closes_everything),
    *(has_a_sibling, has_a_sibling_that_eats),
    *(calls_what_is_not_there, hides_a_pipe, shares_memory),
    *(closes_everything_and_sleeps, looks_around, reads_what_lies_below_tmp, ignores_signals),
    *(opens_sockets, keeps_memory_in_sockets, fills_both_scratch_folders),
    *(leaves_files, finds_files),
)


def ending(found):
    told = json.loads(found.result) if found.result[:1] == b"{" else len(found.result)
    return {
        "how": found.how, "number": found.number, "told": told, "seconds": found.seconds,
        "output": found.output[-200:].decode("utf-8", "replace"), "read": len(found.output),
    }  # fmt: skip


def kept(view):
    """Run every deed in one sandbox, whose keeper is a process of its own."""
    reading, writing = os.pipe()
    keeper = os.fork()
    if keeper:
        os.close(writing)
        with os.fdopen(reading) as file:
            told = json.load(file)
        os.waitpid(keeper, 0)
        return told
    try:
        with Sandbox(view) as sandbox:
            told = {deed.__name__: ending(sandbox.run(deed, LIMITS)) for deed in DEEDS}
    except GradingError as error:
        told = {"refused": str(error)}
    with os.fdopen(writing, "w") as file:
        json.dump(told, file)
    os._exit(0)


def main():
    """Run every deed and print how it ended, as JSON."""
    with suppress(OSError):
        become_able()  # the program begins again with this
    SECRET.write_text("secret")
    for folder in (SHOWN, HIDDEN):
        folder.mkdir()
        for name in ("one", "two"):
            (folder / name).write_text(name)
    readable = (*python_folders(), str(SHOWN), str(HIDDEN / "two"))
    view = View(readable, (), {"PATH": "/usr/bin", "HOME": "/tmp"})
    seen = {}
    try:
        seen = kept(view)
    finally:
        SECRET.unlink()
        for folder in (SHOWN, HIDDEN):
            shutil.rmtree(folder)
    mine = Path("/proc/self/task", str(os.getpid()), "children").read_text().split()
    shared = [one for one in os.listdir("/dev/shm") if one == "mine"]
    print(json.dumps({"seen": seen, "left": [*mine, *shared]}))


if __name__ == "__main__":
    main()
