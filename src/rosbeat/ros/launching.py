"""Carry out a launch file in a session: each node is a simulated program, in virtual time.

The `launch` and `launch_ros` packages of the `ros2` command read the file and visit it against a
host (`launch.host`). Here the host is the session: a node's program is started as `ros.spawn` does,
with the very `--ros-args` that `ros2 launch` gives it, and a `TimerAction` waits in virtual time.

The launch itself is a simulated program, too. It runs whenever the session does, `Ctrl+C` ends it
and with it the nodes, and its exit code is that of `ros2 launch`.
"""

from __future__ import annotations

import logging
import os
import signal
import sys
import tempfile
from collections.abc import Callable, Iterator, Mapping, MutableMapping, Sequence
from heapq import heappop, heappush
from importlib import metadata
from itertools import count
from pathlib import Path
from typing import TYPE_CHECKING

from rosbeat.errors import SessionError
from rosbeat.ros.simulated_program import SimulatedProgram

if TYPE_CHECKING:
    from launch.errors import LaunchError
    from launch.host import Order, Watcher
    from launch_ros.actions import Node

    from rosbeat.ros.ports import AllPorts

_PREFIXES = "AMENT_PREFIX_PATH"
#: What colcon leaves in a folder of installed packages.
_INSTALLED = ".colcon_install_layout"
#: How often a node may be started at one instant.
_MOST_STARTS = 100
_ROS_LEVELS = {"WARNING": "WARN", "CRITICAL": "FATAL"}


def check_launch() -> None:
    """Check that the `launch` that Python finds can be carried out in a session.

    Raises:
        SessionError: If there is none, or another one.
    """
    try:
        import launch
    except ModuleNotFoundError:
        raise SessionError(
            "Python finds no package `launch`.",
            "A session reads launch files with the one that comes with the `ros2` command for pip.",
            "Install it: `pip install rosbeat-ros2-command`.",
        ) from None
    if not hasattr(launch, "LaunchError"):
        raise SessionError(
            f"Python finds another `launch`, in {os.path.dirname(str(launch.__file__))}.",
            "A full ROS 2 that is sourced comes first. Its `launch` starts processes of the "
            "operating system only, and a session has none.",
            "Run the session in a terminal that has not sourced it, or start the nodes with "
            "`ros.spawn`.",
        )


class SimulatedLaunch(SimulatedProgram):
    """Run a launch in a session's virtual time; `Session.launch` creates one.

    Args:
        core: The state of the session.
        source: A launch file, or a launch description.
        arguments: The values of its launch arguments.
        on_start: Called with each node's program before it runs.

    Attributes:
        programs: The programs of its nodes, by the name that the log gives them, such as
            `talker-1`; if one was started again, the last.
        error: What went wrong in the launch itself; None if nothing did.

    Raises:
        SessionError: If `source` is neither, or there is no such file.
    """

    def __init__(
        self,
        core: AllPorts,
        source: object,
        arguments: Mapping[str, object],
        on_start: Callable[[SimulatedProgram], None],
    ) -> None:
        from launch import LaunchContext, LaunchDescription
        from launch.actions import IncludeLaunchDescription
        from launch.events import IncludeLaunchDescription as Include
        from launch.launch_description_sources import (
            AnyLaunchDescriptionSource,
            LaunchDescriptionSource,
        )
        from launch.launch_service import Engine

        path = None if isinstance(source, LaunchDescription) else _checked_file(source)
        values = [(name, _text(value)) for name, value in arguments.items()]
        super().__init__(core, self._run_launch, [f"{name}:={text}" for name, text in values])
        self.name = "launch" if path is None else path.name
        self.programs: dict[str, SimulatedProgram] = {}
        self._host = _SessionHost(self, path, on_start)
        # A session has no terminal whose Ctrl+C reaches the nodes as well.
        context = LaunchContext(argv=self.argv[1:], noninteractive=True, host=self._host)
        if isinstance(source, LaunchDescription):
            given = LaunchDescriptionSource(source, str(Path.cwd() / "launch description"))
        else:
            given = AnyLaunchDescriptionSource(str(path))
        include = IncludeLaunchDescription(given, launch_arguments=values)
        context.emit_event(Include(LaunchDescription([include])))
        self._engine = Engine(context)

    @property
    def error(self) -> Exception | None:
        """Return what went wrong in the launch itself; None if nothing did."""
        return self._engine.error

    def start(self) -> None:
        """Begin to launch, up to where everything waits for the first time.

        Raises:
            SessionError: If something went wrong in the launch itself.
        """
        from launch.launch_service import explained

        super().start()
        self._host.is_starting = False
        if self.error is not None:
            for program in [*self.programs.values(), self]:
                program.kill()  # those that have not heard the launch
            *means, to_try = explained(self.error)
            raise SessionError(str(self.error), " ".join(means), to_try) from self.error

    def enter(self) -> None:
        """Put what belongs to the program in place, and the packages that the launch finds."""
        if not self.is_entered:
            self._host.variables.set()
        super().enter()

    def leave(self) -> None:
        """Put everything back."""
        super().leave()
        if not self.is_entered:
            self._host.variables.restore()

    def _run_launch(self) -> int:
        from launch.logging import logging_to

        host, engine = self._host, self._engine
        while True:
            try:
                host.fire()
                with logging_to(host):
                    engine.work()
                if engine.finished:
                    return engine.return_code
                virtual = self.core.virtual
                virtual.block("spin", host.next_due, lambda: host.is_woken, idle=True)
            except KeyboardInterrupt as interrupt:
                if interrupt is not self.interrupt:
                    raise  # a real one, meant for the cell
                host.log(logging.WARNING, "launch", "user interrupted with ctrl-c (SIGINT)")
                engine.shut_down("ctrl-c (SIGINT)", due_to_sigint=True)

    def _deliver(self, number: signal.Signals) -> None:
        if number == signal.SIGINT:
            super()._deliver(number)
        else:
            self._engine.return_code = 1
            self._engine.shut_down(number.name)


class LaunchedNode(SimulatedProgram):
    """Run the program of a node that a launch starts.

    Args:
        core: The state of the session.
        target: Its file, or a function that runs it.
        entry: The function of the file that an entry point names; None for `main`, or all of it.
        arguments: Its command line.
        environment: The variables that it reads.
    """

    def __init__(
        self,
        core: AllPorts,
        target: Path | Callable[[], object],
        entry: str | None,
        arguments: Sequence[str],
        environment: Mapping[str, str],
    ) -> None:
        super().__init__(core, target, arguments, entry)
        self._variables = _Variables(environment)

    def enter(self) -> None:
        """Put what belongs to the program in place, and its environment."""
        if not self.is_entered:
            self._variables.set()
        super().enter()

    def leave(self) -> None:
        """Put everything back."""
        super().leave()
        if not self.is_entered:
            self._variables.restore()

    def send_signal_here(self, number: int) -> None:
        """Send a signal, from code that the session runs."""
        if self.returncode is not None:
            return
        if number == signal.SIGKILL:
            self.kill()
        elif not self.has_begun:
            self._end(-number)  # nothing in it answers signals yet
        else:
            self._deliver(signal.Signals(number))


class _Variables:
    """Set variables of the environment for a while; there is one environment for all programs."""

    def __init__(self, values: Mapping[str, str]) -> None:
        self._values = {
            name: value for name, value in values.items() if os.environ.get(name) != value
        }
        self._before: dict[str, str | None] = {}

    def set(self) -> None:
        """Set them."""
        self._before = {name: os.environ.get(name) for name in self._values}
        os.environ.update(self._values)

    def restore(self) -> None:
        """Let them be as they were."""
        for name, value in self._before.items():
            if value is None:
                os.environ.pop(name, None)
            else:
                os.environ[name] = value


class _Running:
    """Be a node's process to the launch."""

    def __init__(self, program: LaunchedNode, pid: int) -> None:
        self._program, self.pid = program, pid

    def send_signal(self, number: int) -> None:
        """Send it a signal; one that has ended gets none."""
        self._program.send_signal_here(number)


class _SessionHost:
    """Be the place where a launch runs: a session (see `launch.host.Host`).

    Attributes:
        environment: The variables that actions set and nodes get.
        variables: Those that the launch itself reads.
        is_woken: Whether the launch has something to do.
        is_starting: Whether an error will be raised where the launch was asked for.
    """

    def __init__(
        self,
        launch: SimulatedLaunch,
        path: Path | None,
        on_start: Callable[[SimulatedProgram], None],
    ) -> None:
        self.environment: MutableMapping[str, str] = dict(os.environ)
        self.environment[_PREFIXES] = os.pathsep.join(_prefixes(path))
        self.variables = _Variables({_PREFIXES: self.environment[_PREFIXES]})
        self.is_woken, self.is_starting = False, True
        self._launch, self._on_start = launch, on_start
        self._alarms: list[tuple[int, int, list[Callable[[], None]]]] = []
        self._numbers, self._pids = count(), count(1)
        self._starts: dict[str, tuple[int, int]] = {}  # when last, and how often then

    def wake(self) -> None:
        """Let the launch look soon at what there is to do."""
        self.is_woken = True

    def call_later(self, seconds: float, call: Callable[[], None]) -> Callable[[], None]:
        """Call something after some seconds of virtual time, and return what cancels that."""
        due = self._launch.core.now() + max(0, round(seconds * 1e9))
        calls = [call]
        heappush(self._alarms, (due, next(self._numbers), calls))
        return calls.clear

    @property
    def next_due(self) -> int | None:
        """Return when the next call is due, in nanoseconds; None if none is."""
        while self._alarms and not self._alarms[0][2]:
            heappop(self._alarms)
        return self._alarms[0][0] if self._alarms else None

    def fire(self) -> None:
        """Call what is due; from now on somebody has to wake the launch anew."""
        self.is_woken = False
        while (due := self.next_due) is not None and due <= self._launch.core.now():
            for call in heappop(self._alarms)[2]:
                call()

    def start(self, order: Order, watcher: Watcher) -> None:
        """Start a node as a simulated program, and tell the watcher what becomes of it."""
        self._check_chain(order)
        target, entry = _program_of(order)
        program = LaunchedNode(self._launch.core, target, entry, order.words[1:], order.environment)
        program.name = Path(order.words[0]).name
        program.on_end = watcher.ended
        self._launch.programs[order.name] = program
        self._on_start(program)
        program.begin()
        watcher.started(_Running(program, next(self._pids)))

    def _check_chain(self, order: Order) -> None:
        """Refuse to start a node again and again while no time passes."""
        from launch.errors import LaunchError

        now = self._launch.core.now()
        at, times = self._starts.get(order.name, (now, 0))
        self._starts[order.name] = now, times + 1 if at == now else 1
        if self._starts[order.name][1] > _MOST_STARTS:
            raise LaunchError(
                f"{order.name} was started {_MOST_STARTS} times at one instant.",
                "The node ends at once and is started again, and no virtual time passes meanwhile.",
                "Find out why it ends; `respawn_delay` lets time pass before each start.",
            )

    def log(self, level: int, name: str, text: str) -> None:
        """Log a line of the launch itself, among those of the nodes."""
        word = logging.getLevelName(level)
        is_raised = self.is_starting and name == "launch" and level >= logging.ERROR
        if level >= logging.INFO and not is_raised:
            self._launch.core.logged(_ROS_LEVELS.get(word, word), name, text, "", 0)

    def note(self, *lines: str) -> None:
        """Say what something means, unless an error says it where the launch was asked for."""
        if not self.is_starting or self._launch.error is None:
            for line in lines:
                print(f"# {line}", file=sys.stderr)

    def write(self, line: str, process: str, stream: str, places: frozenset[str]) -> None:
        """Do nothing: what a node prints appears as it prints it."""

    def log_folder(self) -> str:
        """Return the folder of log files, of which a session has none of its own."""
        return tempfile.gettempdir()


def _checked_file(source: object) -> Path:
    if isinstance(source, str | os.PathLike):
        path = Path(source).resolve()
        if path.is_file():
            return path
    raise SessionError(
        f"There is no launch file {source!r}.",
        "`ros.launch` takes the path of a launch file, or a LaunchDescription.",
        'Check the name; a relative one begins at the current folder, as in "launch/x.launch.py".',
    )


def _text(value: object) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)


def _prefixes(path: Path | None) -> Iterator[str]:
    """Yield where packages are installed: the workspace of the launch file, then as sourced."""
    for folder in [Path.cwd(), *Path.cwd().parents] if path is None else path.parents:
        for installed in (folder, folder / "install"):
            if (installed / _INSTALLED).is_file():
                layout = (installed / _INSTALLED).read_text(encoding="utf-8").strip()
                found = [installed] if layout == "merged" else sorted(installed.iterdir())
                yield from (str(prefix) for prefix in found if (prefix / "share").is_dir())
                break
        else:
            continue
        break
    yield os.environ.get(_PREFIXES) or sys.prefix


def _program_of(order: Order) -> tuple[Path | Callable[[], object], str | None]:
    """Return what runs a node: its file and the function of its entry point, or a function.

    Raises:
        LaunchError: If it is no node in Python.
    """
    from launch.errors import LaunchError
    from launch_ros.actions import Node

    name = Path(order.words[0]).name
    if not isinstance(order.action, Node) or order.in_shell:
        raise LaunchError(
            f"A session cannot start `{' '.join(order.words)}`.",
            "In a session, the nodes of a launch file are simulated in virtual time. Any other "
            "program would run by the clock on the wall.",
            "Start the file with `ros2 launch`, or give this action a condition that is false in "
            "the session, such as IfCondition(LaunchConfiguration('real')).",
        )
    path = Path(order.words[0])
    if not _is_python(path):
        raise LaunchError(
            f"A session cannot start the program `{name}`.",
            f"It simulates nodes in Python, and '{path}' is none, or starts another program first.",
            "Start the file with `ros2 launch`.",
        )
    found = _entry_point(path, order.action)
    if found is not None:
        return found
    if path.suffix == ".py":
        return path, None

    def run_script() -> None:
        code = compile(path.read_bytes(), path, "exec")
        exec(code, {"__name__": "__main__", "__file__": str(path)})

    return run_script, None


def _is_python(path: Path) -> bool:
    try:
        with path.open("rb") as file:
            return path.suffix == ".py" or b"python" in file.readline()
    except OSError:
        return False


def _entry_point(path: Path, node: Node) -> tuple[Path, str] | None:
    """Return the file and the function that a script of an entry point runs; None for another."""
    if node.node_package is None:
        return None
    prefix = path.parents[2]
    folders = [*prefix.glob("lib/python3*/site-packages"), *prefix.glob("local/lib/python3*/*")]
    # With `colcon build --symlink-install`, a link names the folder that has the package.
    links = [link for folder in folders for link in folder.glob("*.egg-link")]
    folders += [Path(link.read_text(encoding="utf-8").split("\n")[0]) for link in links]
    for distribution in metadata.distributions(path=[str(folder) for folder in folders]):
        for entry in distribution.entry_points:
            if (entry.group, entry.name) != ("console_scripts", path.name):
                continue
            module, _, function = entry.value.partition(":")
            places = (folder / module.replace(".", "/") for folder in folders)
            for place in places:
                for file in (place.with_suffix(".py"), place / "__init__.py"):
                    if file.is_file():
                        return file, function.partition("[")[0].strip()
            raise _no_module(module, path)
    return None


def _no_module(module: str, path: Path) -> LaunchError:
    from launch.errors import LaunchError

    return LaunchError(
        f"The program `{path.name}` wants the module `{module}`, which is not installed.",
        "The entry point in setup.py names a module that the package does not have.",
        "Compare the name, and type `colcon build` again.",
    )
