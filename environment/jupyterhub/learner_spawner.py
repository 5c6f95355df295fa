"""Start each learner's server in namespaces of its own, within limits of its own.

A learner is a user of the system with a home. Their server, its kernels and terminals share a
network, a process table, `/tmp` and `/dev/shm` with nobody else: the middleware of ROS 2 trusts
everybody that it can reach, so other learners must not be reachable. JupyterHub and its proxy talk
with the server through a Unix socket, in a folder that only the learner and root can enter.
"""

from __future__ import annotations

import os
import pwd
import shutil
import signal
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from urllib.parse import quote

from jupyterhub.objects import Server
from jupyterhub.spawner import LocalProcessSpawner
from jupyterhub.utils import AnyTimeoutError, exponential_backoff
from traitlets import Integer, Unicode, default

_HERE = Path(__file__).resolve().parent
_ENTER = _HERE / "learner_server"
_COURSE = _HERE.parent / "course"
_SINGLE_USER = _HERE.parents[1] / ".venv" / "bin" / "jupyterhub-singleuser"
_NAMESPACES = ("--net", "--ipc", "--mount", "--pid", "--fork", "--kill-child")
_SYSTEMD = Path("/run/systemd/system")
_CGROUPS = Path("/sys/fs/cgroup")
#: Microseconds over which the limit of the processor holds.
_PERIOD = 100_000


def make_folders(run: Path, state: Path) -> None:
    """Make the hub's folders: one for sockets, which all users can pass, and one for its state.

    Args:
        run: The folder of sockets.
        state: The folder of the database and the secrets, for root alone.
    """
    for folder, mode in ((run, 0o711), (run / "learners", 0o711), (state, 0o700)):
        folder.mkdir(parents=True, exist_ok=True)
        folder.chmod(mode)


class LearnerSpawner(LocalProcessSpawner):
    """Start servers of learners, each isolated from all others."""

    sockets = Unicode(help="The folder in which each learner gets a folder for a socket.").tag(
        config=True
    )
    task_limit = Integer(500, help="How many processes and threads a learner may have.").tag(
        config=True
    )

    @default("cmd")
    def _default_cmd(self) -> list[str]:
        enter = ["unshare", *_NAMESPACES, "--", str(_ENTER), self.user.name, str(self.mem_limit)]
        return [*self._scope(), *enter, str(_COURSE), "serve", str(_SINGLE_USER)]

    @property
    def socket(self) -> Path:
        """Return the path of the socket on which the learner's server listens."""
        return Path(self.sockets) / self.user.name / "server.sock"

    @property
    def server(self) -> Server | None:
        """Return where the server is reached; JupyterHub itself stores an address and a port."""
        server = LocalProcessSpawner.server.fget(self)
        if server is not None:
            server.connect_url = "http+unix://" + quote(str(self.socket), safe="")
        return server

    @server.setter
    def server(self, server: Server | None) -> None:
        LocalProcessSpawner.server.fset(self, server)

    def user_env(self, env: dict[str, str]) -> dict[str, str]:
        """Return the environment with the learner's home, and the folder of pages in it."""
        env = super().user_env(env)
        env["ROSBEAT_MY_COURSE"] = os.path.join(env["HOME"], "my_course")
        return env

    async def start(self) -> tuple[str, int]:
        """Start the server in its namespaces."""
        user = pwd.getpwnam(self.user.name)
        os.chmod(user.pw_dir, 0o700)
        shutil.rmtree(self.socket.parent, ignore_errors=True)
        self.socket.parent.mkdir(mode=0o700)
        os.chown(self.socket.parent, user.pw_uid, user.pw_gid)
        # Jupyter's own default: with another port, it refuses to listen on a socket.
        self.port = 8888
        return await super().start()

    def get_args(self) -> list[str]:
        """Return the options of Jupyter's server."""
        return [f"--ServerApp.sock={self.socket}", *super().get_args()]

    def make_preexec_fn(self, name: str) -> Callable[[], None]:
        """Return what the new process does, as root, before it becomes the command.

        Args:
            name: The user.
        """
        groups = self._cgroups()

        def prepare() -> None:
            os.umask(0o077)
            for group in groups:
                (group / "cgroup.procs").write_text(str(os.getpid()))

        return prepare

    async def stop(self, now: bool = False) -> None:
        """Stop the server, and with its process namespace whatever it has started.

        Args:
            now: Whether to kill it at once.
        """
        await super().stop(now)
        with suppress(AnyTimeoutError):  # an empty group costs nothing, and the next start uses it
            await exponential_backoff(self._is_unlimited, "", timeout=self.kill_timeout)

    def _is_unlimited(self) -> bool:
        """Remove the control groups; tell whether none is left, as when all processes are gone."""
        try:
            for group, _ in self._limits():
                if group.exists():
                    group.rmdir()
        except OSError:
            return False
        return True

    async def _signal(self, sig: int) -> bool:
        """Send a signal to the first process of the namespaces; `unshare` itself ignores some."""
        if sig in (signal.SIGINT, signal.SIGTERM):
            children = Path(f"/proc/{self.pid}/task/{self.pid}/children")
            with suppress(OSError):
                for child in children.read_text().split():
                    os.kill(int(child), sig)
                return True
        return bool(await super()._signal(sig))

    # Limits: by systemd where it runs, otherwise, as in a container, by control groups themselves.

    def _scope(self) -> list[str]:
        """Return the beginning of a command that systemd is to limit; nothing without systemd."""
        if not _SYSTEMD.exists():
            return []
        limits = {
            "MemoryMax": self.mem_limit,
            "MemorySwapMax": 0,
            "CPUQuota": f"{self.cpu_limit:.0%}" if self.cpu_limit else None,
            "TasksMax": self.task_limit,
        }
        properties = [
            f"--property={name}={value}" for name, value in limits.items() if value is not None
        ]
        return ["systemd-run", "--scope", "--quiet", "--collect", *properties, "--"]

    def _limits(self) -> list[tuple[Path, dict[str, str]]]:
        """Return the control groups of this learner, and what to write into their files."""
        memory, tasks = str(self.mem_limit), str(self.task_limit)
        quota = int(self.cpu_limit * _PERIOD) if self.cpu_limit else None
        if _SYSTEMD.exists():
            return []
        if (_CGROUPS / "cgroup.controllers").exists():
            most = {
                "memory.max": memory,
                "pids.max": tasks,
                "cpu.max": f"{quota or 'max'} {_PERIOD}",
            }
            return [(_CGROUPS / "rosbeat-hub" / self.user.name, most)]
        first = {
            "memory": {"memory.limit_in_bytes": memory},
            "pids": {"pids.max": tasks},
            "cpu": {"cpu.cfs_period_us": str(_PERIOD), "cpu.cfs_quota_us": str(quota or -1)},
        }
        return [(_CGROUPS / one / "rosbeat-hub" / self.user.name, first[one]) for one in first]

    def _cgroups(self) -> list[Path]:
        """Make the control groups with their limits, as far as this machine allows it."""
        made = []
        for group, files in self._limits():
            try:
                group.mkdir(parents=True, exist_ok=True)
                if "memory.max" in files:
                    for above in (group.parents[1], group.parent):
                        (above / "cgroup.subtree_control").write_text("+memory +cpu +pids")
                for name, text in files.items():
                    (group / name).write_text(text)
                made.append(group)
            except OSError as error:
                self.log.warning("No limit for %s: %s: %s", self.user.name, group, error)
        return made
