"""What a command's output and exit code mean, if `rosbeat.workspace.meanings` knows it."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from rosbeat.workspace.place import workspace
from rosbeat.workspace.terminals.steadiness import polisher

_ENOUGH = 2000


def meaning(command: str, output: Sequence[str], code: int, folder: Path) -> str | None:
    """Return what to tell the learner, or None.

    Args:
        command: The command as it was typed.
        output: The lines that it printed.
        code: Its exit code; 0 also while it still runs.
        folder: Where it was typed.
    """
    # Loaded when the first command has ended: the first prompt does not wait for it.
    from rosbeat.workspace.meanings import explain

    said = explain(command, "\n".join(output[-_ENOUGH:]), code, folder, workspace())
    return "\n".join(map(polisher(), said.splitlines())) if said else None
