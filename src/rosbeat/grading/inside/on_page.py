"""What runs in a kernel of Jupyter beside a learner's page; see `kernel`.

It gives the page's names what they stand for while answers are observed, and looks at the answer
once the cells have run. Between the two it keeps nothing but a function that IPython calls.
"""

from __future__ import annotations

import ast
import json
import sys
from collections.abc import Callable, Iterator
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any

from rosbeat.exercises.evidence import to_json
from rosbeat.exercises.registry import scenario
from rosbeat.grading.inside.kernel import JOB, SEEN
from rosbeat.grading.inside.observing import fault_of
from rosbeat.grading.inside.standins import StandIn, run_imports
from rosbeat.grading.jobs import Job, read_job


def settle_in(folder: str) -> None:
    """Make the page's imports work, and note what the answer's cells raise.

    Args:
        folder: Where the job is, and where is written what was seen.
    """
    from IPython import get_ipython

    job, shell = _job(folder), get_ipython()
    run_imports(job.imports, shell.user_ns)
    for module, name in _ours(job.imports):
        _put(module, name, shell.user_ns[name])
    workspace = import_module("rosbeat.workspace")
    workspace.catch_up = StandIn()  # type: ignore[attr-defined]
    workspace.register(shell)
    shell.events.register("post_run_cell", _noter(job, Path(folder), shell))


def look(folder: str, subject: Any) -> None:  # noqa: ANN401 - whatever a learner hands over
    """Run the scenario, and write the evidence.

    Args:
        folder: As `settle_in` got it.
        subject: What the page hands over to its check.
    """
    job = _job(folder)
    evidence = to_json(scenario(job.exercise)(subject, **json.loads(job.given)))
    _write(folder, {"evidence": evidence})


def _job(folder: str) -> Job:
    return read_job(Path(folder, JOB).read_text(encoding="utf-8"))


def _write(folder: str | Path, said: dict[str, Any]) -> None:
    Path(folder, SEEN).write_text(json.dumps(said), encoding="utf-8")


def _ours(imports: str) -> Iterator[tuple[str, str]]:
    """Modules and names that the page imports from the course."""
    for statement in ast.parse(imports).body:
        if isinstance(statement, ast.ImportFrom) and str(statement.module).startswith("rosbeat"):
            yield from ((str(statement.module), alias.name) for alias in statement.names)


def _put(module: str, name: str, value: object) -> None:
    """Make `from module import name` give a value, even if the sandbox hides the module."""
    try:
        found = import_module(module)
    except ImportError:
        found = sys.modules[module] = ModuleType(module)
    setattr(found, name, value)


def _noter(job: Job, folder: Path, shell: Any) -> Callable[[Any], None]:  # noqa: ANN401
    """What IPython calls after each cell.

    As in `observing.subject_of`, the first fault of the answer's cells counts if the name that
    they should define is not there.
    """
    faults: list[dict[str, Any]] = []
    cells = (*job.parts, job.answer)

    def note(ended: Any) -> None:  # noqa: ANN401 - IPython carries no types
        text, error = ended.info.raw_cell, ended.error_before_exec or ended.error_in_exec
        if error is None:
            return
        cell = text if text in cells else job.answer
        fault = fault_of(error, cell, shell.compile.get_code_name(cell, cell, 0))
        if text in cells:
            faults.append(fault)
        elif str(folder) in text and text not in job.kernel:
            _write(folder, faults[0] if faults and isinstance(error, NameError) else fault)

    return note
