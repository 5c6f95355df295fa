"""Implement `ros2 run`: start a package's executable, forward signals and return its exit code."""

from __future__ import annotations

import os
import re
import shlex
import signal
import subprocess
import sys
import time
from argparse import REMAINDER, Namespace
from collections.abc import Collection, Sequence
from pathlib import Path
from types import TracebackType

from ros2_command.errors import CommandError
from ros2_command.names import nearest
from ros2_command.packages import executables, package_prefix
from ros2_command.registry import Verb, argument

# Executables of one package are often called alike, and the other one is then not what was meant.
_ONLY_A_SLIP = 0.85
_QUOTED_PYTHON = re.compile(rb'#!"([^"]+)"\s*$')
#: What somebody may send to `ros2 run` and mean for the program.
PASSED_ON = frozenset({signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT})
_FROM_KERNEL = 128  # SI_KERNEL: typed at a terminal, so every process in the foreground has it
#: Seconds to wait for a signal that the whole group gets.
_LATER = 0.2


def _main(args: Namespace) -> int:
    path = find_executable(args.package_name, args.executable_name)
    rest = args.argv[1:] if args.argv[:1] == ["--"] else args.argv
    try:
        prefix = shlex.split(args.prefix or "")
    except ValueError as error:
        raise CommandError(f"--prefix {args.prefix!r} cannot be read: {error}") from None
    return run_child([*prefix, *startable(path), *rest], is_prefixed=bool(prefix))


def startable(path: Path) -> list[str]:
    """Return the words that start an executable.

    A Python in a folder with a space stands in quotes on a script's first line, as setuptools
    writes it, and Linux does not understand that.
    """
    with path.open("rb") as file:
        quoted = _QUOTED_PYTHON.match(file.readline())
    return [os.fsdecode(quoted[1]), str(path)] if quoted else [str(path)]


def find_executable(package: str, name: str) -> Path:
    """Return the one file of this name that a package offers.

    Raises:
        CommandError: If there is none or more than one.
    """
    prefix = package_prefix(package)
    offered = executables(prefix, package)
    found = [path for path in offered if path.name == name]
    if len(found) > 1:
        paths = "".join(f"\n- {path}" for path in found)
        raise CommandError(f"Multiple executables found:{paths}")
    if not found:
        raise CommandError("No executable found", *_why_not_found(prefix, package, name, offered))
    return found[0]


def _why_not_found(prefix: Path, package: str, name: str, offered: list[Path]) -> list[str]:
    folder = prefix / "lib" / package
    unmarked = [path for path in folder.rglob(name) if path.is_file()] if folder.is_dir() else []
    if unmarked:
        return [f"{unmarked[0]} is there, but it has no execute permission (chmod +x)."]
    if not offered and (prefix / "bin" / name).is_file():
        return [
            f"{prefix / 'bin' / name} is there, where `ros2 run` does not look.",
            f"In setup.cfg of the package, install_scripts should be $base/lib/{package}.",
        ]
    if not offered:
        return [
            f"Package '{package}' has no executables at all: {folder} is empty or missing.",
            "A Python package needs an entry point in setup.py, and `colcon build` after that.",
        ]
    names = sorted({path.name for path in offered})
    listed = f"Package '{package}' has: {', '.join(names)}"
    stem = os.path.splitext(name)[0]
    meant = stem if stem in names else nearest(name, names, _ONLY_A_SLIP)
    if meant:
        return [f"Did you mean '{meant}'?", listed]
    return [listed, "A new entry point in setup.py counts after the next `colcon build`."]


class GroupWatch:
    """Tell a signal for the whole process group from one for this process alone.

    The program is in the same group, so it has the first kind already, and a second Ctrl+C while
    it is ending would break its good end. Linux does not say which kind a signal was; therefore a
    small process in the group blocks them all, and what waits there was sent to the group.
    """

    def __init__(self) -> None:
        self._read, self._write = os.pipe()
        self._pid = os.fork()
        if self._pid == 0:
            os.close(self._write)
            os.read(self._read, 1)  # ends when the parent does, however it ends
            os._exit(0)

    def has_seen(self, number: int) -> bool:
        """Return whether the signal reached the group; says no only after a while.

        The kernel hands a signal to one process of the group after the other, and on a busy machine
        the watch may get it later than this process does.
        """
        deadline = time.monotonic() + _LATER
        while not (seen := self._holds(number)) and time.monotonic() < deadline:
            time.sleep(0.005)
        return seen

    def _holds(self, number: int) -> bool:
        status = Path(f"/proc/{self._pid}/status").read_text()
        masks = [line.split()[1] for line in status.splitlines() if line.startswith("ShdPnd:")]
        return any(int(mask, 16) >> (number - 1) & 1 for mask in masks)

    def __enter__(self) -> GroupWatch:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        os.close(self._write)
        os.close(self._read)
        os.waitpid(self._pid, 0)


def run_child(command: Sequence[str], is_prefixed: bool = False) -> int:
    """Run a program with this one's input and output, and wait for it.

    Args:
        command: The program and its arguments.
        is_prefixed: Whether the program is that of `--prefix`, which starts the executable.

    Returns:
        Its exit code, or 256 minus the number of the signal that ended it.

    Raises:
        CommandError: If it cannot be started.
    """
    sys.stdout.flush()
    watched = PASSED_ON | {signal.SIGCHLD}
    before = signal.pthread_sigmask(signal.SIG_BLOCK, watched)
    try:
        # The watch is there first, so that it misses no signal that the program gets.
        with GroupWatch() as watch:
            code = _wait(_start(command, before, is_prefixed), watch)
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
    return _report(code)


def _start(
    command: Sequence[str], mask: Collection[int], is_prefixed: bool
) -> subprocess.Popen[bytes]:
    def unblock() -> None:
        signal.pthread_sigmask(signal.SIG_SETMASK, mask)

    try:
        # One thread only and nothing but a system call in between, so preexec_fn is safe.
        return subprocess.Popen(list(command), preexec_fn=unblock)
    except OSError as error:
        why = "The first line of a program names what runs it, such as:  #!/usr/bin/env python3"
        if is_prefixed:
            why = (
                f"--prefix begins with '{command[0]}', and this terminal cannot run a program of "
                "that name. Install it, or leave --prefix out."
            )
        raise CommandError(f"Failed to start {command[0]}: {error.strerror}", why) from None


def _wait(process: subprocess.Popen[bytes], watch: GroupWatch) -> int:
    awaited = PASSED_ON | {signal.SIGCHLD}
    for_the_group: dict[int, tuple[int, float]] = {}
    while (code := process.poll()) is None:
        info = signal.sigwaitinfo(awaited)
        number = info.si_signo
        if number == signal.SIGCHLD or info.si_code == _FROM_KERNEL:
            continue
        # What waits in the watch stays there, so of each signal only the first tells anything;
        # the same one again is passed on: somebody insists.
        if number not in for_the_group and watch.has_seen(number):
            # `timeout` sends its signal to this process, and then to the whole group.
            twice = signal.sigtimedwait({number}, 0) if number in signal.sigpending() else None
            if twice is not None and twice.si_pid != info.si_pid:
                process.send_signal(number)
            for_the_group[number] = (info.si_pid, time.monotonic() + _LATER)
        elif not _is_the_same(info, for_the_group.get(number)):
            process.send_signal(number)
    return code


def _is_the_same(info: signal.struct_siginfo, before: tuple[int, float] | None) -> bool:
    """Return whether a signal is the second half of one that the group got just before."""
    return before is not None and info.si_pid == before[0] and time.monotonic() < before[1]


def _report(code: int) -> int:
    if code > 0:
        print(f"[ros2run]: Process exited with failure {code}")
    elif code < 0:
        print(f"[ros2run]: {signal.strsignal(-code)}")
        return 256 + code
    return code


VERBS = {
    "": Verb(
        "",
        _main,
        argument("--prefix", help="Prefix command, which should go before the executable. Command "
                 "must be wrapped in quotes if it contains spaces (e.g. --prefix 'gdb -ex run "
                 "--args')."),
        argument("package_name", help="Name of the ROS package"),
        argument("executable_name", help="Name of the executable"),
        argument("argv", nargs=REMAINDER, help="Pass arbitrary arguments to the executable"),
    )
}  # fmt: skip
