"""A page of terminals and files, run cell by cell as a kernel runs it, up to one check.

Some exercises are not about a class but about what was typed: a folder that is there now, a program
that runs in a terminal. So the course's own cells are run in order, with the learner's answer among
them, in a workspace as the pages before leave it.
"""

from __future__ import annotations

import json
import os
import warnings
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from rosbeat.exercises.evidence import to_json
from rosbeat.exercises.registry import scenario
from rosbeat.grading.inside.observing import fault_of, writer
from rosbeat.grading.inside.standins import StandIn, run_imports
from rosbeat.grading.jobs import Job
from rosbeat.grading.sandbox import linux
from rosbeat.workspace.place import STEADY
from rosbeat.workspace.place import workspace as folder

#: Files by their path in the workspace.
Files = Mapping[str, bytes]


class _Seen(Exception):  # noqa: N818 - no error: the check was reached
    """The check has seen its evidence."""


def replay_job(job: Job, files: Files, seal: str, result: int) -> None:
    """Run a page up to its check, and write down what the check sees.

    Args:
        job: The answer, and the cells of the page.
        files: The workspace as the pages before leave it.
        seal: What the text begins with.
        result: The descriptor to write to; see `observing.observe_job`.
    """
    look, write = scenario(job.exercise), writer(seal, result)
    # What is typed in a terminal is another process, and may not look into this one.
    linux.prctl(linux.PR_SET_DUMPABLE, 0)
    warnings.simplefilter("ignore")
    # A steady home, as when pages are built: what it prints names no machine and no person.
    os.environ[STEADY] = str(Path.cwd() / "home")
    _put(files, folder())
    shell = _shell()
    try:
        _run_cells(job, shell, look)
    except _Seen as seen:
        write({"evidence": seen.args[0]})
    except BaseException as error:
        write(fault_of(error, job.answer))


def _put(files: Files, root: Path) -> None:
    root.mkdir(parents=True, exist_ok=True)
    for name, content in files.items():
        path = root / name
        if name.endswith("/"):
            path.mkdir(parents=True, exist_ok=True)
        else:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)


def _shell() -> Any:  # noqa: ANN401 - IPython carries no types
    from IPython.core.interactiveshell import InteractiveShell
    from traitlets.config import Config

    config = Config()
    config.HistoryManager.enabled = False
    return InteractiveShell.instance(config=config)


def _run_cells(job: Job, shell: Any, look: Any) -> None:  # noqa: ANN401
    from rosbeat import workspace

    # The workspace is as the pages before leave it; what makes it is not in here.
    workspace.catch_up = StandIn()  # type: ignore[assignment]
    workspace.register(shell)
    run_imports(job.imports, shell.user_ns)
    for cell in job.replay:
        shell.run_cell(cell, store_history=False)
    answer = eval(compile(job.subject, "<check>", "eval", dont_inherit=True), shell.user_ns)
    raise _Seen(to_json(look(answer, **json.loads(job.given))))
