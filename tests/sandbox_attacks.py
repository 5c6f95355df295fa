"""What strangers' code may try, each in a sandbox; run as a program, it tells how each ended.

It is also what runs inside of the sandbox, where each deed is done in a fork.
"""

import ctypes
import fcntl
import json
import mmap
import os
import platform
import resource
import shutil
import signal
import socket
import struct
import sys
import tempfile
import time
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

from rosbeat.errors import GradingError
from rosbeat.page_runs.sandbox import Sandbox, View, bubblewrap, python_folders
from rosbeat.page_runs.system_calls import REFUSED, number_of
from rosbeat.page_runs.worker import UNSAFE, Limits, descendants, serve

#: Seconds of those that nothing but the deadline ends, and of all others on a busy machine.
SHORT, LONG = (Limits(wall=wall, memory=300_000_000) for wall in (0.7, 15.0))
#: So many processes are enough to see that there are no more; more make the machine busy.
FEW = replace(SHORT, processes=24)
#: A folder that is shown, and one of which only one file is.
RUN = os.environ.get("ROSBEAT_ATTACKS", str(os.getpid()))
SHOWN, HIDDEN = (Path(tempfile.gettempdir(), f"rosbeat {one} Ü {RUN}") for one in "ab")
SECRET = Path(tempfile.gettempdir(), f"rosbeat-secret-{RUN}")
HERE = Path(__file__).parent


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


def shares_with_its_children(result):
    """Fork often with much in memory, which is there once."""
    kept = b"x" * 60_000_000
    children = []
    for _ in range(6):
        children.append(os.fork())
        if children[-1] == 0:
            time.sleep(0.5)
            os._exit(len(kept) % 7)
    for child in children:
        os.waitpid(child, 0)


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


def leaves_queues(result):
    """Queues and semaphores belong to no process, but to the namespace."""
    libc = ctypes.CDLL(None, use_errno=True)
    libc.mq_open(b"/left", os.O_CREAT | os.O_RDWR, 0o666, None)
    libc.msgget(0x1EF7, 0o1666)
    libc.semget(0x1EF7, 1, 0o1666)


def finds_queues(result):
    libc = ctypes.CDLL(None, use_errno=True)
    tells(result, {
        "posix": libc.mq_open(b"/left", os.O_RDWR), "messages": libc.msgget(0x1EF7, 0),
        "semaphores": libc.semget(0x1EF7, 0, 0),
    })  # fmt: skip


def keeps_memory_in_tcp(result):
    """A window grows while somebody reads; what is sent when nobody does any more is kept."""
    kept, sent = [], 0
    with socket.create_server(("127.0.0.1", 0), backlog=50) as server:
        for _ in range(20):
            pair = (socket.create_connection(server.getsockname()), server.accept()[0])
            kept.append(pair)
            for end in pair:
                end.setblocking(False)
            for begin, reading in ((0, True), (1, False)) * 2:
                for _ in range(30):
                    with suppress(BlockingIOError):
                        sent += 0 if reading else pair[begin].send(bytes(1_000_000))
                    with suppress(BlockingIOError):
                        while reading and pair[1 - begin].recv(1 << 20):
                            pass
        time.sleep(5)  # it is looked at many times, and ended
    tells(result, {"kept": sent, "pairs": len(kept)})


def keeps_a_few_sockets_in_many_processes(result):
    for _ in range(100):
        if os.fork() == 0:
            kept = [socket.socketpair(socket.AF_UNIX, socket.SOCK_DGRAM) for _ in range(20)]
            for one in (end for pair in kept for end in pair):
                one.setblocking(False)
                with suppress(OSError):
                    while True:
                        one.send(b"x" * 50_000)
            time.sleep(1000)
    time.sleep(1000)


def asks_for_larger_buffers(result):
    def size(option):
        with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as sock:
            before = sock.getsockopt(socket.SOL_SOCKET, option)
            sock.setsockopt(socket.SOL_SOCKET, option, 8_000_000)
            return sock.getsockopt(socket.SOL_SOCKET, option) == before

    def other_option():
        with socket.socket() as sock:
            sock.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            return sock.getsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR)

    tells(result, {"same": [size(one) for one in (socket.SO_SNDBUF, socket.SO_RCVBUF)],
                   "other": other_option()})  # fmt: skip


def fills_tables_of_pages(result):
    for _ in range(100):
        if os.fork() == 0:
            many = mmap.mmap(-1, 3_000_000_000)
            for at in range(0, len(many), 1 << 21):
                len(many[at : at + 1])  # read only: all of it is one page of zeros
            time.sleep(1000)
    time.sleep(1000)


def maps_in_many_pieces(result):
    for _ in range(100):
        if os.fork() == 0:
            kinds = (mmap.PROT_READ, mmap.PROT_READ | mmap.PROT_WRITE)
            with suppress(OSError):
                kept = []
                while True:
                    kept.append(mmap.mmap(-1, 4096, prot=kinds[len(kept) % 2]))
            time.sleep(1000)
    time.sleep(1000)


def keeps_pages_in_pipes(result):
    libc = ctypes.CDLL(None, use_errno=True)
    reading, writing = os.pipe()
    page = (ctypes.c_size_t * 2)(ctypes.addressof(ctypes.create_string_buffer(4096)), 4096)
    tells(result, {"vmsplice": libc.vmsplice(writing, page, 1, 0), "pipe": reading})


def makes_namespaces(result):
    libc = ctypes.CDLL(None, use_errno=True)
    kinds = {"user": 0x10000000, "mount": 0x20000, "process": 0x20000000, "net": 0x40000000,
             "ipc": 0x8000000, "names": 0x4000000, "groups": 0x2000000, "time": 0x80}  # fmt: skip

    def clone3(kind):
        wanted = ctypes.create_string_buffer(struct.pack("8Q", kind, 0, 0, 0, 17, 0, 0, 0))
        made = libc.syscall(435, wanted, 64)
        if made == 0:
            os._exit(0)
        return made

    tells(result, {
        **{f"unshare {name}": libc.unshare(kind) for name, kind in kinds.items()},
        **{f"clone3 {name}": clone3(kind) for name, kind in kinds.items()},
        "setns": libc.setns(os.open("/proc/self/ns/mnt", os.O_RDONLY), 0),
    })  # fmt: skip


def mounts_in_new_ways(result):
    libc = ctypes.CDLL(None, use_errno=True)
    tells(result, {
        "fsopen": libc.syscall(430, b"tmpfs", 0), "fspick": libc.syscall(433, -100, b"/", 0),
        "open_tree": libc.syscall(428, -100, b"/", 1),
        "move_mount": libc.syscall(429, -100, b"/tmp", -100, b"/usr", 0),
        "mount_setattr": libc.syscall(442, -100, b"/", 0, bytes(32), 32),
        "chroot": attempt(lambda: os.chroot("/tmp")),
        "umount": libc.umount2(b"/tmp", 2), "swapon": libc.swapon(b"/tmp/x", 0),
    })  # fmt: skip


def reaches_init(result):
    """Whoever is of the same user may do some things to init, though it hears no signal."""
    libc = ctypes.CDLL(None, use_errno=True)
    init = libc.syscall(434, 1, 0)
    idle = os.sched_param(0)
    tells(result, {
        "descriptors": libc.syscall(438, init, 0, 0), "compare": libc.syscall(312, 1, 0, 0, 0, 0),
        "advise": libc.syscall(440, init, 0, 0, 21, 0),
        "memory": attempt(lambda: resource.prlimit(1, resource.RLIMIT_AS, (0, 0))),
        "time": [attempt(lambda: os.sched_setscheduler(1, os.SCHED_IDLE, idle)),
                 os.sched_getscheduler(1)],
        "processor": [attempt(lambda: os.sched_setaffinity(1, {0})),
                      len(os.sched_getaffinity(1))],
        "priority": attempt(lambda: os.setpriority(os.PRIO_PROCESS, 1, 19)),
        "priority of all": attempt(lambda: os.setpriority(os.PRIO_USER, 0, 19)),
        "signal": libc.syscall(424, init, signal.SIGKILL, 0, 0),
        "my own": [attempt(lambda: os.sched_setaffinity(0, {0})), attempt(lambda: os.nice(1))],
    })  # fmt: skip


def opens_by_handle(result):
    libc = ctypes.CDLL(None, use_errno=True)
    handle = ctypes.create_string_buffer(struct.pack("II", 128, 0) + bytes(128))
    mount = ctypes.c_int()
    named = libc.name_to_handle_at(-100, b"/usr", handle, ctypes.byref(mount), 0)
    folder = os.open("/usr", os.O_RDONLY)
    tells(result, {"named": named, "opened": libc.open_by_handle_at(folder, handle, 0)})


def holds_a_lease(result):
    """Whoever opens a file that somebody has a lease on waits for up to 45 seconds."""
    Path("/tmp/mine").write_text("x")
    with open("/tmp/mine", "rb") as file:
        tells(result, {
            "lease": attempt(lambda: fcntl.fcntl(file, fcntl.F_SETLEASE, fcntl.F_WRLCK)),
            "lock": attempt(lambda: fcntl.flock(file, fcntl.LOCK_SH)),
        })  # fmt: skip


def stops_itself(result):
    os.kill(os.getpid(), signal.SIGSTOP)


def waits_for_a_child_that_borrows_its_memory(result):
    """The parent of a `vfork` cannot be interrupted until the child has ended."""
    number, flags = {"x86_64": 56, "aarch64": 220}[platform.machine()], 0x4000 | signal.SIGCHLD
    if ctypes.CDLL(None).syscall(number, flags, 0, 0, 0, 0) == 0:
        time.sleep(1000)


def adopts_daemons(result):
    """A subreaper, without a signal when its parent ends, whose grandchildren go on."""
    libc = ctypes.CDLL(None)
    libc.prctl(36, 1, 0, 0, 0)
    libc.prctl(1, 0, 0, 0, 0)
    if os.fork() == 0:
        libc.prctl(1, 0, 0, 0, 0)
        os.setsid()
        if os.fork() == 0:
            Path("/dev/shm/mine").write_text("x")
            time.sleep(1000)
        os._exit(0)
    os.wait()


def hides_and_eats(result):
    ctypes.CDLL(None).prctl(4, 0, 0, 0, 0)  # nobody may look into it
    eats(result)


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


def counts_forks(result):
    """Have as many processes as there can be."""
    number = 0
    with suppress(BlockingIOError):
        while number < 1000:
            if os.fork() == 0:
                time.sleep(1000)
            number += 1
    tells(result, {"processes": number})


def fills_with_small_files(result):
    for folder in range(10_000):
        os.mkdir(f"/tmp/{folder}")
        for name in range(100):
            open(f"/tmp/{folder}/{name}", "x").close()


def digs_deep(result):
    """Leave folders in folders that nobody removes by their path."""
    for _ in range(3_000):
        os.mkdir("deeper")
        os.chdir("deeper")


def changes_the_folders(result):
    """Leave something on the folders themselves; root's they cannot change."""
    tells(result, {
        "mode": attempt(lambda: os.chmod("/tmp", 0o700)),
        "attribute": attempt(lambda: os.setxattr("/dev/shm", "user.left", b"left")),
        "moved": attempt(lambda: os.rename(SHOWN, "/tmp/elsewhere")),
        "folder": attempt(lambda: os.mkdir("/tmp/locked", 0)),
    })  # fmt: skip


def finds_folders(result):
    tells(result, {
        "modes": [oct(os.stat(path).st_mode) for path in ("/tmp", "/dev/shm")],
        "attributes": [os.listxattr(path) for path in ("/tmp", "/dev/shm")],
        "there": sorted(os.listdir("/tmp")),
    })  # fmt: skip


def waits(result):
    """Tell that it has begun, and do nothing more."""
    os.write(result, b"begun")
    time.sleep(1000)


def looks_at_its_place(result):
    tells(result, {"here": os.getcwd(), "environment": dict(os.environ)})


def leaves_a_process(result):
    told, tells_ = os.pipe()
    if os.fork() == 0:
        os.setsid()
        tells(result, {"left": os.getpid()})
        os.write(tells_, b".")
        time.sleep(600)
    os.read(told, 1)


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
    *(leaves_files, finds_files, leaves_queues, finds_queues, keeps_memory_in_tcp),
    *(keeps_a_few_sockets_in_many_processes, asks_for_larger_buffers, fills_tables_of_pages),
    *(maps_in_many_pieces, keeps_pages_in_pipes, makes_namespaces, mounts_in_new_ways),
    *(reaches_init, opens_by_handle, holds_a_lease, stops_itself, adopts_daemons),
    *(waits_for_a_child_that_borrows_its_memory, hides_and_eats, counts_forks),
    *(
        shares_with_its_children,
        fills_with_small_files,
        digs_deep,
        changes_the_folders,
        finds_folders,
    ),
)


def ending(found):
    told = json.loads(found.result) if found.result[:1] == b"{" else len(found.result)
    return {"how": found.how, "number": found.number, "told": told, "seconds": found.seconds}


#: Deeds that end at the deadline.
ENDLESS = (
    *(loops, sleeps, ignores_signals, prints, closes_everything_and_sleeps),
    *(stops_itself, waits_for_a_child_that_borrows_its_memory),
)


def _limits(deed):
    if deed in (forks, counts_forks):
        return FEW if deed is forks else replace(LONG, processes=24)
    return SHORT if deed in ENDLESS else LONG


def sandbox_of(view, isolated=True):
    """Return a sandbox in which deeds of this module are done."""
    given = {"PYTHONPATH": str(HERE), "ROSBEAT_ATTACKS": RUN}
    return Sandbox(view, "sandbox_attacks", isolated, given)


def done(view):
    """Do every deed, and tell how each ended."""
    with sandbox_of(view) as sandbox:
        return {deed.__name__: ending(sandbox.run(deed, _limits(deed))) for deed in DEEDS}


def main():
    """Do every deed and print how it ended, as JSON."""
    import sandbox_attacks as deeds  # by this name it is known inside

    bubblewrap()
    SECRET.write_text("secret")
    for folder in (SHOWN, HIDDEN):
        folder.mkdir()
        for name in ("one", "two"):
            (folder / name).write_text(name)
    readable = (*python_folders(), str(HERE), str(SHOWN), str(HIDDEN / "two"))
    view = View(readable, environment={"PATH": "/usr/bin", "HOME": "/tmp"})
    try:
        seen = deeds.done(view)
    finally:
        SECRET.unlink()
        for folder in (SHOWN, HIDDEN):
            shutil.rmtree(folder)
    shared = [name for name in os.listdir("/dev/shm") if name == "mine"]
    print(json.dumps({"seen": seen, "left": [*descendants(os.getpid()), *shared]}))


if __name__ == "__main__":
    if len(sys.argv) > 1:
        serve(int(sys.argv[-1]), UNSAFE not in sys.argv, lambda: None)
    else:
        try:
            main()
        except GradingError as error:
            print(json.dumps({"seen": {"refused": str(error)}}))
