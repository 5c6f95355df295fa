"""What makes sandboxes may fail, and may be killed; both are said, and nothing is left."""

import os
import signal
import sys

import pytest

from rosbeat.errors import GradingError
from rosbeat.grading.sandbox import sandboxes as module
from rosbeat.grading.sandbox.cage import Cage, Ends
from rosbeat.grading.sandbox.nursery import ENDED, MADE, READY, TROUBLE, settings
from rosbeat.grading.sandbox.processes import children
from rosbeat.grading.sandbox.sandboxes import Sandboxes

#: Stands for what makes sandboxes: it says these lines, one for each that it is told.
SAYS = "import sys, os\nif os.fork(): os.wait(); sys.exit()\nfor line, _ in zip({!r}, sys.stdin):\n"


@pytest.fixture
def says(monkeypatch, tmp_path):
    """Let lines be said instead of sandboxes be made."""

    def say(*lines):
        program = f"{SAYS.format(list(lines))}    print(line, flush=True)"
        (tmp_path / "says.py").write_text(program)
        monkeypatch.setenv("PYTHONPATH", str(tmp_path), prepend=os.pathsep)
        monkeypatch.setattr(module, "_NURSERY", "says")

    return say


ENDS = Ends(-1, -1, -1)


def test_why_none_can_be_made_is_said_in_three_parts(says):
    says(f"{TROUBLE}[Errno 1] unshare: Operation not permitted")
    with pytest.raises(GradingError, match="unshare: Operation not permitted") as caught:
        Sandboxes(Cage())
    assert "user namespaces" in caught.value.to_try


def test_one_that_says_nothing_makes_none(says):
    says()
    with pytest.raises(GradingError, match="has ended"):
        Sandboxes(Cage())


def test_one_that_cannot_be_made_later_is_refused(says):
    says(READY, f"{TROUBLE}no memory")
    with Sandboxes(Cage()) as sandboxes, pytest.raises(GradingError, match="no memory"):
        sandboxes.start(Cage(), ENDS, bool)


def test_one_that_is_killed_is_no_reason_to_grade_nobody(says):
    says(READY)
    with Sandboxes(Cage()) as sandboxes, pytest.raises(ConnectionError, match="has ended"):
        sandboxes.start(Cage(), ENDS, bool)


def test_nothing_is_left_when_it_is_closed(says):
    says(READY, MADE, ENDED)
    with Sandboxes(Cage()) as sandboxes:
        maker = sandboxes._process.pid
        assert children(maker)
    assert not children(maker)
    assert maker not in children(os.getpid())


def test_a_real_one_needs_its_folder_only_at_first(tmp_path, monkeypatch):
    monkeypatch.setattr(module.tempfile, "tempdir", str(tmp_path))
    try:
        with Sandboxes(Cage((sys.prefix,))) as sandboxes:
            assert list(tmp_path.iterdir()) == []
            assert children(sandboxes._nursery) == []
            os.kill(sandboxes._nursery, signal.SIGKILL)
            assert sandboxes._process.wait(20) == 0
    except GradingError as refused:
        pytest.skip(str(refused))


def test_folders_in_folders_are_read_once():
    said = settings("/x", ["/usr/lib", "/usr", "/usr"], ["/usr/y"], 5)
    assert '"readable": ["/usr"]' in said
