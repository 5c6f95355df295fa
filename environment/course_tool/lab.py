"""`course lab`: JupyterLab, on the first page."""

from __future__ import annotations

import os
import signal
from collections.abc import Sequence
from pathlib import Path
from typing import NoReturn

from course_tool import prepare, shell
from course_tool.layout import Layout
from course_tool.messages import say

_TERMINALS = "--ServerApp.terminado_settings"
FIRST_PAGE = Path("notebooks") / "00_hear_the_heartbeat.ipynb"


def lab(layout: Layout, options: Sequence[str]) -> NoReturn:
    """Become JupyterLab, with a person's options passed through."""
    environ = shell.for_shells(prepare.ready(layout, "course"), layout)
    command = lab_command(layout, options, root_user=os.geteuid() == 0)
    os.chdir(layout.root)
    # Started in the background of a script, it would hand an ignored Ctrl+C on to every terminal.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    os.execve(layout.python, command, environ)


def lab_command(layout: Layout, options: Sequence[str], root_user: bool) -> list[str]:
    """Return the command that opens JupyterLab.

    Args:
        layout: The checkout.
        options: What the person added; a page of their own takes the first page's place.
        root_user: Whether to allow what Jupyter refuses to the root user, as in a container.
    """
    command = [str(layout.python), "-m", "jupyterlab", f"--ServerApp.root_dir={layout.root}"]
    if root_user and "--allow-root" not in options:
        command.append("--allow-root")
    return [*command, *_terminals(options), *_page(layout, options), *options]


def _terminals(options: Sequence[str]) -> list[str]:
    """Return the option that makes JupyterLab's terminals the same as `course shell`.

    A person's own start file may put another Python first, or another ROS.
    """
    if any(option.startswith(_TERMINALS) for option in options):
        return []
    settings = {"shell_command": shell.interactive()}
    return [f"{_TERMINALS}={settings!r}"]


def _page(layout: Layout, options: Sequence[str]) -> list[str]:
    if any(option.endswith(".ipynb") for option in options):
        return []
    # What an instructor hands out may begin later.
    pages = sorted((layout.root / FIRST_PAGE.parent).glob("[0-9][0-9]_*.ipynb"))
    if pages:
        page = FIRST_PAGE.parent / pages[0].name
        # As an address, not as a file: so it is also in what --no-browser prints.
        return [f"--LabApp.default_url=/lab/tree/{page.as_posix()}"]
    say(f"{FIRST_PAGE} is not there; JupyterLab opens on the folder.")
    return []
