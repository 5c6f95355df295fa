"""rosbeat: learn how robots talk.

A learner needs eleven names from here: `Session` runs nodes, `viz` draws what a session recorded,
`predict` compares what you expect with what happens, `check` looks at the answer to an exercise,
`hint` helps with it, `quiz` asks the questions of a page, `progress` shows how far you are,
`workspace` is where packages are built, `bags` keeps recordings of runs, `clinic` has broken
systems to examine, `watch_robot` shows a robot live. The course's kernel brings them to every page,
and in any other notebook `import rosbeat` does.
Importing the package is quick and does not import ROS: names load when they are first used
(PEP 562), so that tools which only build or check pages work where ROS is not installed.
"""

from __future__ import annotations

import os
import sys
from importlib import import_module
from typing import TYPE_CHECKING, Any

from rosbeat import environment

if TYPE_CHECKING:
    from rosbeat import bags as bags
    from rosbeat import clinic as clinic
    from rosbeat import viz as viz
    from rosbeat import workspace as workspace
    from rosbeat.exercises.check import check as check
    from rosbeat.exercises.hint import hint as hint
    from rosbeat.exercises.predict import predict as predict
    from rosbeat.exercises.progress import progress as progress
    from rosbeat.exercises.quiz import quiz as quiz
    from rosbeat.page_session import Session as Session
    from rosbeat.panel.robot_view import watch_robot as watch_robot

__version__ = "0.1.0"
__all__ = [
    *("Session", "bags", "check", "clinic", "hint", "predict", "progress", "quiz", "viz"),
    *("watch_robot", "workspace"),
]

# Before any message class is imported: the field checks are read at that moment.
if "_pytest" in sys.modules and "ipykernel.kernelapp" not in sys.modules:
    environment.apply_for_tests()
else:
    environment.apply()
if os.environ.get("NBGRADER_EXECUTION"):
    import_module("rosbeat.workspace.location").settle_in()
_HOMES = {
    "Session": ("rosbeat.page_session", "Session"),
    "bags": ("rosbeat.bags", None),
    "check": ("rosbeat.exercises.check", "check"),
    "clinic": ("rosbeat.clinic", None),
    "hint": ("rosbeat.exercises.hint", "hint"),
    "predict": ("rosbeat.exercises.predict", "predict"),
    "progress": ("rosbeat.exercises.progress", "progress"),
    "quiz": ("rosbeat.exercises.quiz", "quiz"),
    "viz": ("rosbeat.viz", None),
    "watch_robot": ("rosbeat.panel.robot_view", "watch_robot"),
    "workspace": ("rosbeat.workspace", None),
}


def __getattr__(name: str) -> Any:  # noqa: ANN401 - the type depends on the name
    """Load a public name when it is first used."""
    if name not in _HOMES:
        raise AttributeError(f"module 'rosbeat' has no attribute {name!r}")
    module_name, attribute = _HOMES[name]
    module = import_module(module_name)
    return module if attribute is None else getattr(module, attribute)


def load_ipython_extension(shell: Any) -> None:  # noqa: ANN401 - IPython carries no types
    """Bring the course to a shell: names, commands, and explained errors (`%load_ext rosbeat`).

    The course's kernels do it when they start; a second time changes nothing.

    Args:
        shell: The running shell.
    """
    if not os.environ.get("NBGRADER_EXECUTION"):
        import_module("rosbeat.jupyter_lease").hold_domain()
    import_module("rosbeat.page_names").register(shell, __all__, __getattr__)
    for part in ("page_errors", "exercises.cells", "record_display", "workspace"):
        import_module(f"rosbeat.{part}").register(shell)
    offer = import_module("rosbeat.exercises.progress_widget").offer
    offer(shell, lambda: __getattr__("progress")())


# Without loading IPython where there is none.
if (_ipython := sys.modules.get("IPython")) and (_shell := _ipython.get_ipython()):
    load_ipython_extension(_shell)
