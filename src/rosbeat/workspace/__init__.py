"""The learner's workspace: terminals, packages, and the files that cells become. No rclpy here.

On a page::

    from rosbeat import workspace

    workspace.catch_up("05")        # makes what earlier pages would have made
    workspace.terminal("sensor")    # the terminal of that name
    workspace.folder()              # where the workspace lies

Importing it inside IPython makes the commands `%%terminal`, `%terminal` and `%%save` known.
"""

from __future__ import annotations

import sys
from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rosbeat.workspace.catching_up import catch_up as catch_up
    from rosbeat.workspace.place import workspace as folder
    from rosbeat.workspace.terminals import terminal as terminal

__all__ = ["catch_up", "folder", "register", "terminal"]

_HOMES = {
    "catch_up": ("rosbeat.workspace.catching_up", "catch_up"),
    "folder": ("rosbeat.workspace.place", "workspace"),
    "terminal": ("rosbeat.workspace.terminals", "terminal"),
}
_MAGICS = ("rosbeat.workspace.magics", "rosbeat.workspace.saving_magic")


def __getattr__(name: str) -> Any:  # noqa: ANN401 - the type depends on the name
    """Load a public name when it is first used."""
    if name not in _HOMES:
        raise AttributeError(f"module 'rosbeat.workspace' has no attribute {name!r}")
    module_name, attribute = _HOMES[name]
    return getattr(import_module(module_name), attribute)


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})


def register(shell: Any) -> None:  # noqa: ANN401 - IPython carries no types
    """Make the commands of a page known to a shell; a second time changes nothing.

    Args:
        shell: A running IPython shell.
    """
    for name in _MAGICS:
        import_module(name).register(shell)


def _running_shell() -> Any:  # noqa: ANN401
    """Return the shell of this process, without loading IPython where there is none."""
    ipython = sys.modules.get("IPython")
    return ipython.get_ipython() if ipython else None


if (_shell := _running_shell()) is not None:
    register(_shell)
