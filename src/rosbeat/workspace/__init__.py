"""Manage the learner's workspace: terminals, packages, and the files that cells become.

Nothing here imports rclpy: what runs in a terminal is another process. On a page::

    from rosbeat import workspace

    workspace.terminal("sensor")    # the terminal of that name
    workspace.folder()              # where the workspace lies
    workspace.catch_up("05")        # makes what earlier pages leave, as pages do by themselves

A page knows `%%terminal`, `%terminal` and `%%save` (`register`).

- `magics`, `saving_magic`: the three commands, with their options; loaded when one is used.
- `terminals/`: `shell` (a bash on a pseudo-terminal, and the thread that reads it), `terminal`
  (what a page does with one, and with all of a kernel), `output` (from characters to lines, and
  what is shown of them, in which colours), `environment`, and `reaper` (what ends all processes).
- `commands`: which commands are not typed, and what the outcome of the others means, by the rules
  of `diagnosis.terminal`.
- `saving`: a text becomes a file, and the version before is kept.
- `prerequisites`: makes what earlier pages leave, where it is missing.
- `packages`: what the files of a package say.
- `location`: where the workspace is, which page this is, and whether nbgrader runs it.
- `busy_notice`: what is said while something takes long.

How it works, and why:

- **ptyprocess, and a thread that reads.** A node that runs on must never be held up by a full
  buffer, and pexpect reads only while somebody expects something. The prompt carries an OSC
  escape sequence with the exit code and the folder, so the end of a command is told and never
  guessed; bash's second prompt carries one that says that it wants more lines. A command that
  takes this prompt away, such as `exec bash`, never ends for the page: the terminal has to be
  closed.
- **Lines, not a screen.** pyte emulates a screen of a fixed width at 0.2 MB/s, where `output`
  reads 68 MB/s on the same machine, and it would wrap long lines. A page follows only what
  repaints one line. Programs that need a whole screen, such as `vim` and `less`, are refused by
  name.
- **Watching is not running.** `--until`, `--for` and the deadline end the watching, and so does
  an interrupt of the cell. Only `--ctrl-c`, `--kill` and `--close` end a program.
- **Remarks of the course begin with `#`**: exit codes, what they mean, and which program still
  runs. A cell with a blank `____` is not typed, nor one that bash would not finish, nor
  `colcon build` outside of the workspace, which would crawl whatever folder the terminal is in.
- **Nothing outlives the kernel.** Each process of a terminal has the kernel's mark in its
  environment. A watcher (`reaper`) holds a pipe from the kernel; when that closes, for whatever
  reason, it ends every process with the mark, daemons too.
- **Outputs that can be compared.** Where pages are built and tested, `ROSBEAT_STEADY_HOME` names
  an empty folder: it is the terminals' home and holds the workspace. It is shown as `/home/you`,
  ROS prints no time stamps there, and colcon's timings read 0.00 s.
- **Files are never lost.** `%%save` writes in one step and keeps the version before in `kept/`.
  `catch_up` changes nothing that is there, with one exception: an empty list of entry points
  gets its entries, and the file as it was is kept.
- **A build script is run only if it calculates.** The literals of a `setup.py` come from its
  syntax tree. Anything else is found by running it in a subprocess, with a deadline of 10 s, in
  the learner's workspace, where `colcon build` runs it too. `package.xml` is read without
  entities.
"""

from __future__ import annotations

import os
import sys
from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from IPython.core.interactiveshell import InteractiveShell

    from rosbeat.workspace.location import workspace as folder
    from rosbeat.workspace.prerequisites import catch_up as catch_up
    from rosbeat.workspace.terminals import terminal as terminal

__all__ = ["catch_up", "folder", "register", "terminal"]

_HOMES = {
    "catch_up": ("rosbeat.workspace.prerequisites", "catch_up"),
    "folder": ("rosbeat.workspace.location", "workspace"),
    "terminal": ("rosbeat.workspace.terminals", "terminal"),
}


def __getattr__(name: str) -> Any:  # noqa: ANN401 - the type depends on the name
    """Load a public name when it is first used."""
    if name not in _HOMES:
        raise AttributeError(f"module 'rosbeat.workspace' has no attribute {name!r}")
    module_name, attribute = _HOMES[name]
    return getattr(import_module(module_name), attribute)


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})


def register(shell: InteractiveShell) -> None:
    """Make the commands of a page known to a shell; a second time changes nothing.

    They begin with `%`, and so do IPython's own on a page: a bare `cd` or `ls` is no command.
    `!ros2` and `%%bash` find what a terminal finds, wherever the kernel was started from.

    Args:
        shell: A running IPython shell.
    """
    from IPython.core.magic import no_var_expand

    # `$HOME` is for bash, a path is a path, and IPython is not to put variables in their places.
    @no_var_expand  # type: ignore[untyped-decorator]  # IPython carries no types
    def terminal(line: str, cell: str | None = None) -> None:
        """Type the cell into a terminal, or look at one; any wrong option shows the right ones."""
        import_module("rosbeat.workspace.magics").run(shell, line, cell)

    @no_var_expand  # type: ignore[untyped-decorator]  # IPython carries no types
    def save(line: str, cell: str) -> None:
        """Save the cell as a file of the workspace; a module of a package runs here, too."""
        import_module("rosbeat.workspace.saving_magic").save_cell(shell, line, cell)

    if sys.prefix != sys.base_prefix:
        os.environ["PATH"] = import_module("rosbeat.workspace.location").search_path()
    shell.register_magic_function(terminal, "line_cell", "terminal")
    shell.register_magic_function(save, "cell", "save")
    shell.automagic = False  # or `cd` would change the folder of the page, and not a terminal's
