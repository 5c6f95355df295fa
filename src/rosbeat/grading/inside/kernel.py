"""A learner's page in a kernel of Jupyter, up to one answer: slow, and what others must equal.

A kernel is a program of its own, started afresh. It sees what a sandbox shows, so that of this
package it has the files that `kernel_files` names, and no others of the room.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path

from rosbeat.grading.inside.observing import writer
from rosbeat.grading.jobs import Job, write_line
from rosbeat.workspace.place import STEADY

#: Where `on_page` finds the job and leaves what it has seen, in the folder that it is given.
JOB, SEEN = "job.json", "seen.json"
_PAGE, _DRIVE = "page.ipynb", "inside/drive.py"
_ON_PAGE = "rosbeat.grading.inside.on_page"
_SETTLE = (
    "__import__('rosbeat.grading').grading.__path__.append({folder!r});"
    "__import__({module!r}, fromlist=['']).settle_in({folder!r})"
)
#: The subject stands on a line of its own: it is the course's, and may be any expression.
_LOOK = "__import__({module!r}, fromlist=['']).look({folder!r}, (\n{subject}\n))"


def kernel_files() -> dict[str, str]:
    """The files that a kernel needs of this room, by path in it; to be read outside."""
    room = Path(__file__).resolve().parents[1]
    paths = [room / "jobs.py", *sorted((room / "inside").glob("*.py"))]
    return {path.relative_to(room).as_posix(): path.read_text(encoding="utf-8") for path in paths}


def kernel_job(job: Job, files: Mapping[str, str], seal: str, result: int) -> None:
    """Run a page in a kernel, and write down what the check has seen.

    Args:
        job: The answer, and the cells of the page.
        files: What `kernel_files` has read.
        seal: What the text begins with.
        result: The descriptor to write to; see `observing.observe_job`.
    """
    write, folder = writer(seal, result), Path.cwd() / "course"
    for name, text in {**files, JOB: write_line(job), _PAGE: page_of(job, str(folder))}.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text, encoding="utf-8", errors="backslashreplace")
    os.environ[STEADY] = str(Path.cwd() / "home")
    drive = [sys.executable, "-I", str(folder / _DRIVE), str(folder / _PAGE)]
    ended = subprocess.run(drive, check=False)
    if ended.returncode:
        sys.exit(ended.returncode)
    seen = folder / SEEN
    write(json.loads(seen.read_text(encoding="utf-8")) if seen.exists() else {})


def page_of(job: Job, folder: str) -> str:
    """The page as a notebook: settling in, the learner's cells, a look.

    Args:
        job: The answer, and the cells of the page.
        folder: Where the job will be.
    """
    names = {"module": _ON_PAGE, "folder": folder, "subject": job.subject}
    texts = (_SETTLE.format(**names), *job.kernel, _LOOK.format(**names))
    cells = [
        {
            **{"id": f"cell-{number}", "cell_type": "code", "metadata": {}, "source": text},
            **{"execution_count": None, "outputs": []},
        }
        for number, text in enumerate(texts)
    ]
    return json.dumps({"cells": cells, "metadata": {}, "nbformat": 4, "nbformat_minor": 5})
