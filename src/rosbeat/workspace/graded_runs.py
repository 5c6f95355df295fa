"""A page that nbgrader runs: it has a home of its own, and one stream for all that it prints.

nbgrader runs one learner's pages after the other on the instructor's account. Without a home of
its own, a page would find what the learner before has saved, and note its outcomes in the
instructor's progress.

And nbgrader takes anything on stderr for a failure (`nbgrader/utils.py`, `determine_grade`), in
whichever cell it happens to arrive. ROS writes every log line there.
"""

from __future__ import annotations

import atexit
import os
import shutil
import sys
import tempfile

from rosbeat.workspace.place import STEADY

#: nbgrader says in it why it runs a page: `autograde` or `validate`
#: (`nbgrader/converters/autograde.py` and `nbgrader/validator.py`).
VARIABLE = "NBGRADER_EXECUTION"


def execution() -> str:
    """Return why nbgrader runs this page, `autograde` or `validate`; empty if it does not."""
    return os.environ.get(VARIABLE, "")


def settle_in() -> None:
    """Make this process ready to be graded, if it is the kernel of a page that nbgrader runs."""
    if not execution() or os.environ.get(STEADY):  # the kernel's own processes find it settled
        return
    _own_home()
    _one_stream()


def _own_home() -> None:
    folder = tempfile.mkdtemp(prefix="rb-")
    os.environ[STEADY] = folder
    atexit.register(_remove, folder, os.getpid())


def _remove(folder: str, owner: int) -> None:
    if os.getpid() == owner:  # a process that was forked ends long before the page does
        shutil.rmtree(folder, ignore_errors=True)


def _one_stream() -> None:
    """Send to stdout what would go to stderr: what Python writes, and what C code writes."""
    sys.stderr.flush()
    sys.stderr = sys.stdout
    os.dup2(1, 2)
