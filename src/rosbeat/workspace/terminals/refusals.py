"""What a terminal says when it cannot do what it was asked."""

from __future__ import annotations

from rosbeat.errors import TerminalError

_SHORT = 60


def short(command: str) -> str:
    """Return the first line of a command, no longer than reads well."""
    line, *more = command.strip().splitlines() or [""]
    cut = line if len(line) <= _SHORT else f"{line[: _SHORT - 4]} ..."
    return f"{cut} ..." if more and cut == line else cut


def busy(name: str, command: str) -> TerminalError:
    """Return the error for a new command while another one runs."""
    return TerminalError(
        f"The terminal `{name}` is busy: `{short(command)}` runs in it.",
        "A terminal runs one command at a time, and this one has not ended.",
        f"Stop it with `%terminal {name} --ctrl-c`, or use another terminal: "
        f"`%%terminal {_another(name)}`. To type into the program, add `--answer`.",
    )


def does_not_stop(name: str, command: str, key: str, seconds: float) -> TerminalError:
    """Return the error for a program that goes on.

    Args:
        name: The terminal.
        command: What runs in it.
        key: What was pressed, `^C` or `^D`; empty if the program was killed.
        seconds: How long ago.
    """
    after = {"^C": "Ctrl+C", "^D": "Ctrl+D"}.get(key, "it was killed")
    end = f"`%terminal {name} --kill`" if key else f"`%terminal {name} --close`"
    return TerminalError(
        f"`{short(command)}` still runs {seconds:g} s after {after}.",
        "The program does not listen to that, it takes long to tidy up, or it starts others.",
        f"Wait a little and look with `%terminal {name}`, or end it at once with {end}.",
    )


def not_seen(text: str, lines: int, seconds: float | None, last: list[str]) -> TerminalError:
    """Return the error for a text that has not come.

    Args:
        text: What was waited for.
        lines: In how many lines it should have come.
        seconds: How long it was waited for; None if the command ended before.
        last: The last lines of the terminal.
    """
    often = f" in {lines} lines" if lines > 1 else ""
    when = "before the command ended" if seconds is None else f"within {seconds:g} s"
    shown = "".join(f"\n    {line}" for line in last) or " none."
    return TerminalError(
        f"`{text}` did not appear{often} {when}.",
        f"The terminal printed something else. Its last lines:{shown}",
        "Compare the text with what the command prints. A slow computer needs more `--timeout`.",
    )


def ended(name: str) -> TerminalError:
    """Return the error for a command to a terminal whose shell is gone."""
    return TerminalError(
        f"The terminal `{name}` has ended.",
        "Its shell is gone, and what was set in it, too.",
        f'`%%terminal {name}` and `workspace.terminal("{name}")` open a new one of this name.',
    )


def nothing_to_answer(name: str) -> TerminalError:
    """Return the error for an answer that no program waits for."""
    return TerminalError(
        f"No program runs in the terminal `{name}`, so nothing can be answered.",
        "`--answer` types into a running program. Here bash itself waits for a command.",
        "Leave `--answer` out to type a command.",
    )


def odd_character(character: str) -> TerminalError:
    """Return the error for a key that has no place in a command."""
    return TerminalError(
        f"The cell holds the control character {character!r}.",
        "In a terminal such a character is a key of its own and not a part of the command.",
        "Delete it; `%terminal NAME --ctrl-c` sends Ctrl+C.",
    )


def too_long() -> TerminalError:
    """Return the error for an answer that a terminal would cut."""
    return TerminalError(
        "A line of the answer is longer than 4,095 bytes.",
        "A terminal gives a program no longer lines: it would cut the rest.",
        "Write the text to a file, and let the program read the file.",
    )


def _another(name: str) -> str:
    return "monitor" if name == "sensor" else "sensor" if name == "monitor" else f"{name}2"
