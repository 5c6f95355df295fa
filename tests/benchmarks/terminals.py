"""Terminals of many users on one machine: each lists its own nodes, all of them and nobody else's.

Every user has a system user id, a home and a `course shell`, in which both programs of the course's
package run. When all of them do, each user in turn opens a second shell and types `ros2 node list`.
The package is built once, as is `.venv`, and both are readable by all.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path

import psutil
from measuring import Row
from processes import at_95_percent, cost

from rosbeat.domains import lease_domain
from rosbeat.environment import SHARED_DOMAINS
from rosbeat.errors import DomainsExhaustedError

ROOT = Path(__file__).resolve().parents[2]
#: User ids that no account has.
FIRST_USER = 61_000
PROGRAMS = ("temperature_publisher", "temperature_subscriber")
#: Seconds that programs get to start, and the machine to become calm.
DEADLINE = 120.0
#: Calm: so little of the processors is in use, for a second.
CALM_PERCENT = 60.0


@dataclass
class User:
    """One user: where they are at home, and what their shell with both programs has printed."""

    number: int
    home: Path

    @property
    def names(self) -> list[str]:
        """Return the full names of their nodes, sorted."""
        return sorted(f"/{name}_{self.number}" for name in PROGRAMS)

    @property
    def printed(self) -> str:
        """Return what their programs have printed."""
        return (self.home / "printed.txt").read_text(encoding="utf-8", errors="replace")

    def shell(self, text: str, output: Path) -> subprocess.Popen[bytes]:
        """Start commands in a `course shell` of this user's."""
        with output.open("wb") as file:
            return subprocess.Popen(
                [ROOT / "environment" / "course", "shell", "-c", text], env=self._environ(),
                cwd=self.home, stdin=subprocess.DEVNULL, stdout=file, stderr=subprocess.STDOUT,
                start_new_session=True,
                user=self.number, group=self.number, extra_groups=[],
            )  # fmt: skip

    def _environ(self) -> Mapping[str, str]:
        return {"PATH": os.defpath, "HOME": str(self.home), "LANG": "C.UTF-8"}


def measure(quick: bool) -> list[Row]:
    """Users in the first ids of terminals, and users for whom only those from 102 on are left."""
    if os.geteuid() != 0:
        return [Row("terminals of many users", "needs root, to be all of them")]
    if not _others_may_run_python():
        return [Row("terminals of many users", "needs a Python that every user may run")]
    number = 10 if quick else 60
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        folder.chmod(0o755)
        setup = _build(folder)
        rows = _rows("", number, folder / "low", setup)
        with ExitStack() as stack:
            for one in SHARED_DOMAINS:
                with suppress(DomainsExhaustedError):  # somebody has it already
                    stack.callback(lease_domain(range(one, one + 1)).release)
            rows += _rows(", ids from 102", number, folder / "high", setup)
    return rows


def _others_may_run_python() -> bool:
    """Tell whether a user besides root can run the Python of the environment."""
    try:
        done = subprocess.run(
            [sys.executable, "-c", ""], check=False, user=FIRST_USER, group=FIRST_USER,
            extra_groups=[], stderr=subprocess.DEVNULL,
        )  # fmt: skip
    except PermissionError:
        return False
    return done.returncode == 0


def _build(folder: Path) -> Path:
    """Build the finished package of the course; return what a terminal has to source."""
    workspace = folder / "workspace"
    shutil.copytree(ROOT / "solutions" / "sensor_simulator", workspace / "src" / "sensor_simulator")
    done = cost([sys.executable, "-m", "colcon", "build"], os.environ, workspace)
    assert done.code == 0, done.error
    return workspace / "install" / "setup.bash"


def _rows(which: str, number: int, folder: Path, setup: Path) -> list[Row]:
    users = [_user(folder, FIRST_USER + n) for n in range(number)]
    with ExitStack() as stack:
        for user in users:
            stack.enter_context(_programs(user, setup))
        with suppress(TimeoutError):  # something else is at work here; the rows say so
            _wait(lambda: psutil.cpu_percent(1) < CALM_PERCENT, "the machine is busy")
        used, load = psutil.cpu_percent(5), os.getloadavg()[0]
        answers = [_ask(user) for user in users]
    right = sum(names == user.names for user, (names, _, _) in zip(users, answers, strict=True))
    ids = {domain for _, domain, _ in answers}
    p95 = at_95_percent([seconds for _, _, seconds in answers])
    what = f"{number} users{which}"
    return [
        Row(f"{what}: list all of their own nodes, and no others", f"{right}",
            target=f"{number}", met=right == number),
        Row(f"{what}: different domains", f"{len(ids)}, {min(ids)} to {max(ids)}",
            target=f"{number}", met=len(ids) == number),
        Row(f"{what}: ros2 node list, 95 %", f"{p95:.2f} s", target="< 1 s", met=p95 < 1),
        Row(f"{what}: processors in use before", f"{used:.0f} %, load {load:.1f}"),
    ]  # fmt: skip


def _user(folder: Path, number: int) -> User:
    home = folder / str(number)
    home.mkdir(parents=True)
    home.chmod(0o700)
    os.chown(home, number, number)
    return User(number, home)


@contextmanager
def _programs(user: User, setup: Path) -> Iterator[None]:
    """Run both programs of a user, under names of their own; end them afterwards."""
    runs = [
        f"ros2 run sensor_simulator {name} --ros-args -r __node:={name}_{user.number} &"
        for name in PROGRAMS
    ]
    text = "\n".join([f". {setup}", *runs, "wait"])
    shell = user.shell(text, user.home / "printed.txt")
    try:
        # The subscriber has heard the publisher.
        _wait(lambda: "Status:" in user.printed, f"no message of user {user.number}")
        yield
    finally:
        _end(shell)


def _wait(done: Callable[[], bool], otherwise: str) -> None:
    deadline = time.monotonic() + DEADLINE
    while not done():
        if time.monotonic() > deadline:
            raise TimeoutError(otherwise)
        time.sleep(0.1)


def _end(shell: subprocess.Popen[bytes]) -> None:
    family = [psutil.Process(shell.pid), *psutil.Process(shell.pid).children(recursive=True)]
    for one in family:
        one.terminate()
    _, alive = psutil.wait_procs(family, 5)
    for one in alive:
        one.kill()
    shell.wait()


def _ask(user: User) -> tuple[list[str], int, float]:
    """Return the nodes that a second shell lists, its domain, and the seconds of the listing."""
    answer = user.home / "answer.txt"
    clock = 'echo "$EPOCHREALTIME"'
    shell = user.shell(
        f'echo "$ROS_DOMAIN_ID"; {clock}; ros2 node list 2>notes.txt; {clock}', answer
    )
    shell.wait(DEADLINE)
    domain, begin, *names, end = answer.read_text(encoding="utf-8").splitlines()
    return names, int(domain), float(end) - float(begin)
