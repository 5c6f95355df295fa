"""Start processes: `ExecuteLocal` and `ExecuteProcess`, of which every node is one."""

from __future__ import annotations

import codecs
import logging
import os
import re
import shlex
import signal
from collections.abc import Callable, Iterable, Mapping
from typing import Any

from ros2_command.untyped import Untyped

from launch.action import Action
from launch.conditions import evaluate_condition_expression
from launch.errors import LaunchError
from launch.event_handlers import EventHandler, Handled, OnProcessExit, OnShutdown
from launch.events import Event, Shutdown, matches_action
from launch.events.process import (
    ProcessExited,
    ProcessIO,
    ProcessStarted,
    ShutdownProcess,
    SignalProcess,
)
from launch.host import Order, RunningProcess
from launch.launch_context import LaunchContext
from launch.substitution import (
    SomeSubstitutionsType,
    normalize_to_list_of_substitutions,
    perform_substitutions,
    performed,
    performed_flag,
)
from launch.substitutions import LaunchConfiguration

SomeOutput = SomeSubstitutionsType | Mapping[str, str | Iterable[str]]
_SCREEN, _LOG, _OWN = "screen", "log", "own_log"
#: Where the two streams go, by the word for `output`.
_PLACES = {
    "screen": ({_SCREEN}, {_SCREEN}),
    "log": ({_LOG}, {_LOG, _SCREEN}),
    "both": ({_LOG, _SCREEN}, {_LOG, _SCREEN}),
    "own_log": ({_OWN}, {_OWN}),
    "full": ({_LOG, _SCREEN, _OWN}, {_LOG, _SCREEN, _OWN}),
}


class Executable:
    """Describe a command line, where it runs and with which environment.

    Args:
        cmd: Its words.
        prefix: Words before it, such as a debugger's.
        name: What the log calls it; the name of the program by default.
        cwd: The folder in which it runs.
        env: Its environment, in the place of the launch's.
        additional_env: Variables besides those.
        arguments: More words.
    """

    def __init__(
        self, *, cmd: Iterable[SomeSubstitutionsType], prefix: SomeSubstitutionsType | None = None,
        name: SomeSubstitutionsType | None = None, cwd: SomeSubstitutionsType | None = None,
        env: Mapping[Any, SomeSubstitutionsType] | None = None,
        additional_env: Mapping[Any, SomeSubstitutionsType] | None = None,
        arguments: Iterable[SomeSubstitutionsType] | None = None,
    ) -> None:  # fmt: skip
        words = [*cmd, *(arguments or ())]
        self.cmd = [normalize_to_list_of_substitutions(word) for word in words]
        self.prefix, self.name, self.cwd, self.env = prefix, name, cwd, env
        self.additional_env = additional_env
        #: What the log calls it, with its number; None before it starts.
        self.final_name: str | None = None

    def words(self, context: LaunchContext) -> list[str]:
        """Return the command line."""
        words = [perform_substitutions(context, word) for word in self.cmd]
        if self.prefix is not None:
            return [*shlex.split(performed(context, self.prefix)), *words]
        prefix = performed(context, LaunchConfiguration("launch-prefix", default=""))
        pattern = performed(context, LaunchConfiguration("launch-prefix-filter", default=""))
        if re.match(pattern, os.path.basename(words[0])):
            return [*shlex.split(prefix), *words]
        return words

    def environment(self, context: LaunchContext) -> dict[str, str]:
        """Return its environment."""
        values = dict(context.environment) if self.env is None else {}
        for given in (self.env, self.additional_env):
            for name, value in (given or {}).items():
                values[performed(context, name)] = performed(context, value)
        return values


class ExecuteLocal(Action):
    """Start a process, and end it with the launch.

    Args:
        process_description: What to start.
        shell: Whether a shell reads the command line.
        sigterm_timeout: Seconds from SIGINT to SIGTERM when it has to end.
        sigkill_timeout: Seconds from SIGTERM to SIGKILL.
        emulate_tty: Whether its output looks like a terminal to it.
        output: `screen`, `log`, `both`, `own_log` or `full`, or a dictionary of these by stream.
        output_format: A line of its output, with `{line}` and `{this}`.
        cached_output: Whether `get_stdout` and `get_stderr` have what it printed.
        log_cmd: Whether to log its command line.
        on_exit: What to do when it has ended: actions, or a function that returns some.
        respawn: Whether to start it again when it has ended.
        respawn_delay: Seconds before that.
        respawn_max_retries: How many times; less than 0 for ever.
        condition: When to start it at all.
    """

    def __init__(
        self, *, process_description: Executable, shell: bool = False,
        sigterm_timeout: SomeSubstitutionsType | None = None,
        sigkill_timeout: SomeSubstitutionsType | None = None, emulate_tty: bool = False,
        output: SomeOutput = "log",
        output_format: str = "[{this.process_description.final_name}] {line}",
        cached_output: bool = False, log_cmd: bool = False, on_exit: Handled | None = None,
        respawn: bool | SomeSubstitutionsType = False, respawn_delay: float | None = None,
        respawn_max_retries: int = -1, **action: Untyped,
    ) -> None:  # fmt: skip
        super().__init__(**action)
        self.process_description = process_description
        self.shell, self.emulate_tty, self.log_cmd = shell, emulate_tty, log_cmd
        self.sigterm_timeout = _seconds("sigterm_timeout", sigterm_timeout)
        self.sigkill_timeout = _seconds("sigkill_timeout", sigkill_timeout)
        self.output: SomeOutput = os.environ.get("OVERRIDE_LAUNCH_PROCESS_OUTPUT", output)
        self.output_format, self.cached_output = output_format, cached_output
        self.on_exit, self.respawn, self.respawn_delay = on_exit, respawn, respawn_delay
        self.respawn_max_retries = respawn_max_retries
        #: What events of the process tell of it; None before it starts.
        self.process_details: dict[str, Any] | None = None
        self.return_code: int | None = None
        self._run: _Run | None = None
        self._printed = {1: "", 2: ""}

    def get_sub_entities(self) -> list[Any]:
        """Return the actions for its end."""
        return list(self.on_exit) if isinstance(self.on_exit, list | tuple) else []

    def execute(self, context: LaunchContext) -> None:
        """Start the process when the events that wait have been handled."""
        description = self.process_description
        words = description.words(context)
        name = description.name
        label = os.path.basename(words[0]) if name is None else performed(context, name)
        order = Order(
            self, f"{label}-{context.next_process_number()}", words,
            None if description.cwd is None else performed(context, description.cwd),
            description.environment(context), self.shell, self._terminal(context),
        )  # fmt: skip
        if self._run is not None:
            raise LaunchError(
                f"ExecuteLocal action '{order.name}': executed more than once: {self.describe()}",
                "An action is one process, and this one has been started before.",
                "Make another action for the second process.",
            )
        self.process_details = {
            **{"action": self, "name": order.name, "cmd": words, "cwd": order.folder},
            "env": order.environment,
        }
        if context.is_shutdown:
            return
        run = _Run(context, self, order)
        run.listen()
        self._run = run
        context.begin(self)
        context.later.append(run.start)

    def _terminal(self, context: LaunchContext) -> bool:
        if "emulate_tty" not in context.launch_configurations:
            return self.emulate_tty
        return evaluate_condition_expression(
            context, normalize_to_list_of_substitutions(LaunchConfiguration("emulate_tty"))
        )

    def keep(self, fd: int, text: str) -> None:
        """Keep what the process has printed, if that is wanted."""
        if self.cached_output:
            self._printed[fd] += text

    def get_stdout(self) -> str:
        """Return what it has printed; needs `cached_output`."""
        return self._cached(1)

    def get_stderr(self) -> str:
        """Return what it has printed as errors; needs `cached_output`."""
        return self._cached(2)

    def _cached(self, fd: int) -> str:
        if not self.cached_output:
            raise RuntimeError(
                f"cached output must be true to be able to get {'stdout' if fd == 1 else 'stderr'}"
            )
        return self._printed[fd]


class ExecuteProcess(ExecuteLocal):
    """Start a program by its command line.

    Args:
        cmd: Its words.
        prefix: Words before it.
        name: What the log calls it.
        cwd: The folder in which it runs.
        env: Its environment, in the place of the launch's.
        additional_env: Variables besides those.
        **local: What `ExecuteLocal` takes.
    """

    def __init__(
        self, *, cmd: Iterable[SomeSubstitutionsType], prefix: SomeSubstitutionsType | None = None,
        name: SomeSubstitutionsType | None = None, cwd: SomeSubstitutionsType | None = None,
        env: Mapping[Any, SomeSubstitutionsType] | None = None,
        additional_env: Mapping[Any, SomeSubstitutionsType] | None = None, **local: Untyped,
    ) -> None:  # fmt: skip
        executable = Executable(
            cmd=cmd, prefix=prefix, name=name, cwd=cwd, env=env, additional_env=additional_env
        )
        super().__init__(process_description=executable, **local)

    @property
    def name(self) -> Untyped:
        """Return what the log calls it."""
        return (self.process_details or {}).get("name", self.process_description.name)

    @property
    def cmd(self) -> Untyped:
        """Return its words."""
        return (self.process_details or {}).get("cmd", self.process_description.cmd)


class _Run:
    """Run the process of one action, again and again if it asks for that."""

    def __init__(self, context: LaunchContext, action: ExecuteLocal, order: Order) -> None:
        self._context, self._action, self._order = context, action, order
        self._places = _places(context, action.output)
        self._respawn = performed_flag(context, action.respawn)
        action.process_description.final_name = order.name
        _check_format(action)
        self._process: RunningProcess | None = None
        self._retries = 0
        self._must_end = self._is_waiting = False
        self._cancels: list[Callable[[], None]] = []

    def listen(self) -> None:
        """Register what ends the process, and what follows its end."""
        register = self._context.register_event_handler
        register(_On(ShutdownProcess, self._on_shutdown_process))
        register(_On(SignalProcess, self._on_signal))
        register(OnShutdown(on_shutdown=self._on_shutdown))
        if self._action.on_exit is not None:
            register(OnProcessExit(target_action=self._action, on_exit=self._action.on_exit))

    def start(self) -> None:
        """Start the process, unless it has to end already."""
        if self._must_end:
            self._end()
            return
        self._decoders = {fd: codecs.getincrementaldecoder("utf-8")("replace") for fd in (1, 2)}
        self._rests = {1: "", 2: ""}
        if self._action.log_cmd:
            self._log(
                logging.INFO,
                f"process details: cmd='{' '.join(self._order.words)}', cwd='{self._order.folder}'"
                ", custom_env?=True",
            )
        try:
            self._context.host.start(self._order, self)
        except LaunchError:  # the host has no such processes
            self._end()
            raise

    # What the host tells.

    def started(self, process: RunningProcess) -> None:
        """Tell everybody that the process runs."""
        self._process = process
        self._details["pid"] = process.pid
        self._log(logging.INFO, f"process started with pid [{process.pid}]")
        self._context.emit_event(ProcessStarted(**self._details))
        if self._must_end:  # asked before it ran, so no Ctrl+C has reached it
            self._shut_down(send_sigint=True)

    def printed(self, fd: int, data: bytes) -> None:
        """Show what the process has printed, line by line."""
        text = self._decoders[fd].decode(data)
        self._action.keep(fd, text)
        *lines, self._rests[fd] = (self._rests[fd] + text).split("\n")
        for line in lines:
            self._show(fd, line)
        self._context.emit_event(ProcessIO(text=data, fd=fd, **self._details))

    def ended(self, returncode: int) -> None:
        """Tell everybody that the process has ended."""
        for fd, rest in self._rests.items():
            if rest:
                self._show(fd, rest)
        self._process = None
        self._action.return_code = returncode
        pid = self._details["pid"]
        if returncode == 0:
            self._log(logging.INFO, f"process has finished cleanly [pid {pid}]")
        else:
            words = " ".join(word for word in self._order.words if word.strip())
            self._log(
                logging.ERROR,
                f"process has died [pid {pid}, exit code {returncode}, cmd '{words}'].",
            )
        self._context.emit_event(ProcessExited(returncode=returncode, **self._details))
        self._context.later.append(self._go_on)  # when everybody has heard of it

    def _go_on(self) -> None:
        most = self._action.respawn_max_retries
        if self._must_end or not self._respawn or 0 <= most <= self._retries:
            self._end()
            return
        self._retries += 1
        self._is_waiting = True
        delay = self._action.respawn_delay or 0.0
        self._cancels.append(self._context.host.call_later(delay, self._start_again))

    def _start_again(self) -> None:
        self._is_waiting = False
        self._context.later.append(self.start)
        self._context.host.wake()

    def failed(self, error: OSError) -> None:
        """Say that the process could not be started."""
        self._log(
            logging.ERROR,
            f"exception occurred while executing process:\n{type(error).__name__}: {error}",
        )
        self._context.host.note(
            f"The program {self._order.words[0]!r} cannot be started, so the launch goes on "
            "without it.",
            "Compare its path; a script needs the execute permission (chmod +x), and a first line "
            "such as #!/usr/bin/env python3",
        )
        self._end()

    @property
    def _details(self) -> dict[str, Any]:
        assert self._action.process_details is not None
        return self._action.process_details

    def _show(self, fd: int, line: str) -> None:
        stream = "stdout" if fd == 1 else "stderr"
        text = self._action.output_format.format(line=line, this=self._action)
        self._context.host.write(text, self._order.name, stream, self._places[fd])

    def _log(self, level: int, text: str) -> None:
        self._context.host.log(level, self._order.name, text)

    def _end(self) -> None:
        for cancel in self._cancels:
            cancel()
        self._context.end(self._action)

    # What ends it.

    def _on_shutdown(self, event: Event, context: LaunchContext) -> None:
        assert isinstance(event, Shutdown)
        self._ask_to_end(send_sigint=not event.due_to_sigint or context.noninteractive)

    def _on_shutdown_process(self, event: Event, context: LaunchContext) -> None:
        del context
        assert isinstance(event, ShutdownProcess)
        if event.process_matcher(self._action):
            self._ask_to_end(send_sigint=True)

    def _on_signal(self, event: Event, context: LaunchContext) -> None:
        del context
        assert isinstance(event, SignalProcess)
        if event.process_matcher(self._action) and self._process is not None:
            self._log(
                logging.INFO, f"sending signal '{event.signal_name}' to process[{self._order.name}]"
            )
            self._process.send_signal(event.signal)

    def _ask_to_end(self, send_sigint: bool) -> None:
        if self._must_end or self._action not in self._context.running:
            return
        self._must_end = True
        if self._process is not None:
            self._shut_down(send_sigint)
        elif self._is_waiting:  # to be started again
            self._end()

    def _shut_down(self, send_sigint: bool) -> None:
        if send_sigint:
            self._send(signal.SIGINT)
        term, kill = (
            performed(self._context, value)
            for value in (self._action.sigterm_timeout, self._action.sigkill_timeout)
        )
        both = str(float(term) + float(kill))
        for seconds, before, after in (
            (term, signal.SIGINT, signal.SIGTERM),
            (both, signal.SIGTERM, signal.SIGKILL),
        ):
            self._cancels.append(
                self._context.host.call_later(
                    float(seconds),
                    lambda seconds=seconds, before=before, after=after: self._escalate(  # type: ignore[misc]
                        seconds, before, after
                    ),
                )
            )

    def _escalate(self, seconds: str, before: signal.Signals, after: signal.Signals) -> None:
        self._log(
            logging.ERROR,
            f"process[{self._order.name}] failed to terminate '{seconds}' seconds after "
            f"receiving '{before.name}', escalating to '{after.name}'",
        )
        self._send(after)

    def _send(self, number: signal.Signals) -> None:
        is_meant = matches_action(self._action)
        self._context.emit_event(SignalProcess(signal_number=number, process_matcher=is_meant))


class _On(EventHandler):
    """Call a function for each event of a class."""

    def __init__(
        self, event_class: type[Event], function: Callable[[Event, LaunchContext], None]
    ) -> None:
        super().__init__(matcher=lambda event: isinstance(event, event_class))
        self._function = function

    def handle(self, event: Event, context: LaunchContext) -> None:
        """Call it."""
        super().handle(event, context)
        self._function(event, context)


def _seconds(name: str, given: SomeSubstitutionsType | None) -> SomeSubstitutionsType:
    return LaunchConfiguration(name, default="5") if given is None else given


def _check_format(action: ExecuteLocal) -> None:
    """Check that `output_format` is one.

    Raises:
        LaunchError: If it is not.
    """
    try:
        action.output_format.format(line="", this=action)
    except (AttributeError, IndexError, KeyError, ValueError) as error:
        raise LaunchError(
            f"output_format={action.output_format!r} cannot be used: {error}",
            "It says what a line that the process prints looks like, with {line} and {this}.",
            "Write for example '[{this.process_description.final_name}] {line}'.",
        ) from None


def _places(context: LaunchContext, output: SomeOutput) -> dict[int, frozenset[str]]:
    """Return where what is printed on 1 and 2 goes."""
    if not isinstance(output, Mapping):
        word = performed(context, output)
        if word not in _PLACES:
            raise LaunchError(
                f'{word} is not a valid standard output config i.e. "screen", "log" or "both"',
                "`output` says where the lines go that a process prints.",
                "Write 'screen' to see them, or 'log' to keep them in a file.",
            )
        return dict(zip((1, 2), map(frozenset, _PLACES[word]), strict=True))
    places = {"stdout": set[str](), "stderr": set[str](), "both": set[str]()}
    for stream, given in output.items():
        words = {given} if isinstance(given, str) else set(given)
        if stream not in places or not words <= {_SCREEN, _LOG, _OWN}:
            raise LaunchError(
                f"{dict(output)} is not a valid output configuration",
                "Its keys are stdout, stderr and both; its values screen, log and own_log.",
                "Write output='screen' to see all lines.",
            )
        places[stream] |= words
    return {fd: frozenset(places[name] | places["both"]) for fd, name in ((1, "stdout"),
            (2, "stderr"))}  # fmt: skip
