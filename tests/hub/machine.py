"""What a hub needs: an installation that all users share, users, and the hub itself."""

from __future__ import annotations

import os
import pwd
import secrets
import shutil
import signal
import socket
import stat
import subprocess
import sys
import tempfile
import time
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path

import requests

from hub.learner import Learner

ROOT = Path(__file__).resolve().parents[2]
CONFIG = Path(__file__).with_name("hub_config.py")
#: What the test needs besides the course; Debian has each in a package of this or another name.
PROGRAMS = ("unshare", "setpriv", "ip", "useradd", "userdel", "groupadd", "groupdel", "chpasswd")
_INSTALLING, _STARTING, _ENDING = 900, 120, 60
#: Where installations go: learners cannot see the machine's /tmp.
_PLACE = "/opt"


def missing():
    """Why no hub can run here; nothing if one can."""
    if os.geteuid() != 0:
        return "a hub with system users needs root"
    gone = [one for one in PROGRAMS if not shutil.which(one)]
    if gone:
        return f"not on this machine: {', '.join(gone)}"
    if not shared_python():
        return "no Python 3.10 to 3.13 that other users may run"
    return ""


def shared_python():
    """The path of a Python that every user may run; nothing if there is none."""
    for name in (sys._base_executable, *map(shutil.which, ("python3", "/usr/bin/python3"))):
        if name and all(one.stat().st_mode & stat.S_IXOTH for one in _parents(Path(name))):
            command = [name, "-c", "import sys, venv, ensurepip; print(sys.version_info[:2])"]
            done = subprocess.run(command, capture_output=True, text=True, check=False)
            if done.returncode == 0 and (3, 10) <= eval(done.stdout) <= (3, 13):
                return name
    return ""


def _parents(path):
    real = path.resolve()
    return [real, *real.parents]


@contextmanager
def installation():
    """The course in a folder that all may read and only root may write, with JupyterHub."""
    folder = Path(tempfile.mkdtemp(prefix="rosbeat-hub-test-", dir=_PLACE))
    try:
        folder.chmod(0o755)
        course = folder / "course"
        listed = subprocess.run(
            ["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, check=True
        ).stdout.decode()
        for name in filter(None, listed.split("\0")):
            if (ROOT / name).is_file():
                (course / name).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(ROOT / name, course / name)
        command = [course / "environment" / "course", "hub", "--version"]
        subprocess.run(command, env=environ(), check=True, timeout=_INSTALLING, umask=0o022)
        yield course
    finally:
        shutil.rmtree(folder)


def environ():
    """The environment of this process without what tests, Python and ROS have put into it."""
    kept = {
        name: value
        for name, value in os.environ.items()
        if not name.startswith(("PYTEST", "PYTHON", "ROS", "AMENT", "COLCON", "FAST", "JUPYTER"))
        and name != "VIRTUAL_ENV"
    }
    return {**kept, "ROSBEAT_PYTHON": shared_python()}


@dataclass(frozen=True)
class User:
    """A user of the system.

    Attributes:
        name: Who.
        password: The one to log in with.
    """

    name: str
    password: str

    @property
    def home(self):
        return Path(pwd.getpwnam(self.name).pw_dir)

    @property
    def uid(self):
        return pwd.getpwnam(self.name).pw_uid

    def pids(self):
        """The processes of this user, as the machine counts them."""
        found = []
        for entry in Path("/proc").iterdir():
            with suppress(OSError):
                if entry.name.isdigit() and entry.stat().st_uid == self.uid:
                    found.append(int(entry.name))
        return found


@contextmanager
def users(count, homes):
    """Users of the system, in a group of their own; in the end nothing is left of them.

    Args:
        count: How many.
        homes: The folder for their homes.
    """
    homes.mkdir(exist_ok=True)
    group = f"rbh{secrets.token_hex(3)}"
    made = [User(f"{group}-{number:02}", secrets.token_hex(8)) for number in range(count)]
    _run("groupadd", group)
    try:
        for one in made:
            _run("useradd", "--create-home", "--base-dir", str(homes), "--shell", "/bin/bash",
                 "--groups", group, one.name)  # fmt: skip
        lines = "".join(f"{one.name}:{one.password}\n" for one in made)
        subprocess.run(["chpasswd"], input=lines, text=True, check=True, timeout=_ENDING)
        yield group, made
    finally:
        for one in made:
            with suppress(KeyError):
                _end_all(one)
                _run("userdel", "--remove", one.name)
        _run("groupdel", group)


def _end_all(user):
    deadline = time.monotonic() + _ENDING
    while (left := user.pids()) and time.monotonic() < deadline:
        for pid in left:
            with suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)
        time.sleep(0.1)


def _run(*command):
    subprocess.run(command, check=True, timeout=_ENDING, capture_output=True)


@dataclass(frozen=True)
class Hub:
    """A hub that answers.

    Attributes:
        url: Its address, without a slash at the end.
        course: The shared installation.
        users: Who can log in.
        run: The folder of sockets.
        state: The folder of the database and the secrets.
        pid: The process of JupyterHub.
    """

    url: str
    course: Path
    users: list[User]
    run: Path
    state: Path
    pid: int

    def log_in(self, user):
        """Log a user in."""
        return Learner(self.url, user.name, user.password)


@contextmanager
def running_hub(course, group, members, log):
    """Start JupyterHub with the course's configuration, and end it with all it has started."""
    run, state = (Path(place) / group for place in ("/run", "/var/lib"))
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        address = f"http://127.0.0.1:{probe.getsockname()[1]}"
    settings = {
        **environ(),
        "RUNTIME_DIRECTORY": str(run),
        "STATE_DIRECTORY": str(state),
        "ROSBEAT_TEST_CONFIG": str(course / "environment" / "jupyterhub" / "jupyterhub_config.py"),
        "ROSBEAT_TEST_ADDRESS": address,
        "ROSBEAT_TEST_GROUP": group,
    }
    command = [course / "environment" / "course", "hub", "-f", CONFIG]
    with log.open("wb") as messages:
        process = subprocess.Popen(
            command, env=settings, stdout=messages, stderr=subprocess.STDOUT, umask=0o022
        )
        try:
            _wait_for(address, process, log)
            yield Hub(address, course, members, run, state, process.pid)
        finally:
            process.terminate()
            try:
                process.wait(_ENDING)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
            for folder in (run, state):
                shutil.rmtree(folder, ignore_errors=True)
            _require_end(course)


def _require_end(course):
    """Wait until no process of the installation is left: the hub, its proxy, learners' servers."""
    deadline = time.monotonic() + _ENDING
    while left := _processes_of(course):
        if time.monotonic() > deadline:
            raise RuntimeError(f"still running after the hub has ended: {left}")
        time.sleep(0.1)


def _processes_of(course):
    found = []
    for path in Path("/proc").glob("[0-9]*/cmdline"):
        with suppress(OSError):
            command = path.read_text().replace("\0", " ")
            if str(course) in command:
                found.append(f"{path.parent.name}: {command}")
    return found


def _wait_for(address, process, log):
    deadline = time.monotonic() + _STARTING
    while time.monotonic() < deadline and process.poll() is None:
        with suppress(requests.ConnectionError):
            if requests.get(f"{address}/hub/login", timeout=_STARTING).ok:
                return
        time.sleep(0.1)
    raise RuntimeError("JupyterHub did not start:\n" + log.read_text()[-5000:])
