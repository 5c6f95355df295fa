"""Parse the arguments, run one verb, and turn its result into an exit code."""

from __future__ import annotations

import os
import signal
import sys
from argparse import Namespace
from collections.abc import Callable, Sequence
from contextlib import suppress
from importlib.util import find_spec
from io import TextIOWrapper
from typing import NoReturn

from ros2_command.errors import ENDED_BY, CommandError, UsageError
from ros2_command.registry import build, verbs_of, what_is_left_out, words_of

INTERRUPTED = 2


def main(argv: Sequence[str] | None = None) -> int:
    """Run `ros2` and return its exit code.

    A real ros2cli, where there is one, knows more and takes over.
    """
    if find_spec("ros2cli") is not None:
        from ros2cli.cli import main as original

        return int(original(argv=argv) or 0)
    _open_streams()
    code = guarded(lambda: _run(list(sys.argv[1:] if argv is None else argv)))
    if argv is None and "rclpy" in sys.modules:
        _leave_at_once(code)
    return code


def _leave_at_once(code: int) -> NoReturn:
    """End the process; the node has left the graph, and unloading the middleware takes 0.15 s."""
    for stream in (sys.stdout, sys.stderr):
        with suppress(OSError):
            stream.flush()
    os._exit(code)


def _open_streams() -> None:
    """Give a stream that the shell has closed, with `>&-`, somewhere to go.

    What the encoding of a stream has no character for is shown as an escape.
    """
    for name in ("stdout", "stderr"):
        stream = getattr(sys, name)
        if stream is None:
            setattr(sys, name, open(os.devnull, "w", encoding="utf-8"))  # noqa: SIM115
        elif isinstance(stream, TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")


def guarded(action: Callable[[], int]) -> int:
    """Run something; errors become a message, Ctrl+C and a closed pipe become silence."""
    try:
        code = action()
        sys.stdout.flush()
    except CommandError as error:
        error.show()
        return error.code
    except KeyboardInterrupt:
        return _quietly(INTERRUPTED)
    except BrokenPipeError:
        return _quietly(0)
    except ModuleNotFoundError as error:
        CommandError(
            f"Python cannot find '{error.name}'.",
            "ROS 2 is not installed in this environment, or parts of it are missing.",
        ).show()
        return 1
    except OSError as error:
        _what_the_system_says(error).show()
        return _quietly(1)  # what is left in the buffer would fail once more at the very end
    except Exception as error:  # a learner cannot do anything with our stack
        if ENDED_BY:
            number = ENDED_BY[0]
            return _quietly(INTERRUPTED if number == signal.SIGINT else 128 + number)
        print(f"ros2: unexpected {type(error).__name__}: {error}", file=sys.stderr)
        return 1
    return code


def _what_the_system_says(error: OSError) -> CommandError:
    if isinstance(error, FileNotFoundError) and not error.filename:  # from `os.getcwd`
        return CommandError(
            "This terminal's current folder no longer exists.", "Change to another folder:  cd ~"
        )
    file = f": {error.filename}" if error.filename else ""
    return CommandError(f"ros2: {error.strerror or error}{file}")


def _quietly(code: int) -> int:
    """Drop what is still in the buffer of stdout; it has no reader any more."""
    try:
        sys.stdout.flush()
    except OSError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    return code


def _run(argv: list[str]) -> int:
    command, verb = words_of(argv)
    refusal = what_is_left_out(command, verb) if command else None
    if refusal:
        raise CommandError(*refusal)
    args = build(argv).parse_args(argv, Namespace(typed_words=argv))
    if not args.use_python_default_buffering and isinstance(sys.stdout, TextIOWrapper):
        sys.stdout.reconfigure(line_buffering=True)
    name, verb = args.chosen_command, getattr(args, "chosen_verb", None)
    chosen = verbs_of(name).get(verb or "") if name else None
    if chosen is None:
        args.chosen_parser.print_help()
        return 0
    try:
        return int(chosen.main(args) or 0)
    except UsageError as error:
        args.chosen_parser.print_usage(sys.stderr)
        raise CommandError(f"{args.chosen_parser.prog}: error: {error}", code=2) from None
