"""Starting a bash at the end of a pseudo-terminal."""

from __future__ import annotations

import select
import shutil
import signal
import warnings
from contextlib import suppress
from pathlib import Path

from ptyprocess import PtyProcess, PtyProcessError

from rosbeat.errors import TerminalError
from rosbeat.workspace.terminals.surroundings import surroundings

# Lines are never wrapped, whatever the width: that is done by whoever displays them. But programs
# ask for it, `ls` for its columns, and this is about as wide as a page.
_ROWS, _COLUMNS = 40, 120
_SIGNALS = ("SIGINT", "SIGQUIT", "SIGTERM", "SIGHUP", "SIGPIPE", "SIGTSTP", "SIGTTIN", "SIGTTOU")


def start_bash(folder: Path, token: str) -> PtyProcess:
    """Start a bash without anybody's start-up files.

    Args:
        folder: Where it starts.
        token: The mark of the terminal.

    Raises:
        TerminalError: If there is no bash, or the folder cannot be entered.
    """
    command = shutil.which("bash")
    if command is None:
        raise TerminalError(
            "This computer has no bash.",
            "A terminal of a page is a real bash, and the program is not on the search path.",
            "Install it (`sudo apt install bash`), then restart the kernel.",
        )
    try:
        # PWD keeps bash from finding its own idea of where it is.
        environ = {**surroundings(token), "PWD": str(folder)}
        return _spawn([command, "--norc", "--noprofile", "-i"], folder, environ)
    except (OSError, RuntimeError) as error:
        raise TerminalError(
            f"A terminal cannot start in {folder}: {error}.",
            "The operating system refused.",
            "See whether the folder is there and whether the computer is short of memory.",
        ) from error


def _spawn(argv: list[str], folder: Path, environ: dict[str, str]) -> PtyProcess:
    if not folder.is_dir():
        raise NotADirectoryError("there is no such folder")
    with warnings.catch_warnings():
        # Python 3.12 warns whenever a process with threads forks. Here `exec` follows at once.
        warnings.simplefilter("ignore", DeprecationWarning)
        return PtyProcess.spawn(
            argv,
            cwd=str(folder),
            env=environ,
            echo=False,
            preexec_fn=_usual_signals,
            dimensions=(_ROWS, _COLUMNS),
        )


def _usual_signals() -> None:
    """Take back what a kernel, or whoever started it, has ignored: Ctrl+C is to work."""
    for name in _SIGNALS:
        signal.signal(getattr(signal, name), signal.SIG_DFL)
    signal.pthread_sigmask(signal.SIG_SETMASK, [])


def alive(process: PtyProcess) -> bool:
    """Tell whether a process runs; one that somebody else has waited for does not."""
    try:
        return bool(process.isalive())
    except PtyProcessError:
        return False


def exit_code(process: PtyProcess) -> int | None:
    """Wait for a process that has hung up; return its exit code as a shell counts, if known."""
    try:
        process.wait()
    except PtyProcessError:
        return None
    number = process.signalstatus
    return int(process.exitstatus) if number is None else 128 + int(number)


def close_quietly(process: PtyProcess) -> None:
    """Give the pseudo-terminal back, without the waits of `PtyProcess.close`."""
    if not process.closed:
        process.closed = True
        process.fileobj.close()
        process.fd = -1


def wait_for_event(descriptor: int, event: int, seconds: float) -> None:
    """Wait until a descriptor is ready; `select` would refuse those above 1023.

    Args:
        descriptor: The terminal's.
        event: `select.POLLIN` or `select.POLLOUT`.
        seconds: How long to wait at most.
    """
    poll = select.poll()
    with suppress(OSError, ValueError):
        poll.register(descriptor, event)
        poll.poll(seconds * 1000)
