from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from rosbeat.authoring import execution, pages
from rosbeat.authoring.execution import kernel_place
from rosbeat.domains import PRIVATE_IDS
from rosbeat.errors import LessonError

LATE = "import threading\nt = threading.Thread(target=lambda: 1 / 0)\nt.start(); t.join()"


def run(checkout, code):
    lesson = checkout.lesson(f"# %%\nprint('before')\n\n# %% {code}")
    return pages.solution_page(lesson, checkout.course.root)


def test_a_failing_cell_is_shown_with_its_source_its_prints_and_its_error(checkout):
    with pytest.raises(LessonError) as caught:
        run(checkout, "\nprint('so far')\n1 / 0")
    text = str(caught.value)
    line = checkout.lesson("# %%\nprint('before')\n\n# %% \n1").cells[2].line
    assert f"00_hear_it.py: the cell at line {line} raised ZeroDivisionError" in text
    assert "cell    | 1 / 0" in text
    assert "printed | so far" in text
    assert "raises-exception" in caught.value.to_try


def test_a_cell_that_is_to_fail_has_to_fail(checkout):
    with pytest.raises(LessonError, match="raised nothing"):
        run(checkout, 'tags=["raises-exception"]\n1 + 1')


def test_an_exception_in_a_thread_is_not_overlooked(checkout):
    with pytest.raises(LessonError, match="in the background") as caught:
        run(checkout, f"\n{LATE}")
    assert "ZeroDivisionError" in caught.value.means


def test_a_cell_that_takes_too_long_is_named(checkout, monkeypatch):
    monkeypatch.setattr(execution, "CELL_SECONDS", 1.0)
    with pytest.raises(LessonError, match="did not end within 1 s"):
        run(checkout, "\nimport time; time.sleep(60)")


def test_a_cell_that_ends_the_kernel_is_named_at_once(checkout, monkeypatch):
    monkeypatch.setattr(execution, "CELL_SECONDS", 1_000.0)  # longer than the test may take
    with pytest.raises(LessonError, match="ended the kernel"):
        run(checkout, "\nimport os; os._exit(1)")


def test_a_kernel_that_does_not_start_says_so(checkout, monkeypatch, tmp_path):
    broken = tmp_path / "python"
    broken.write_text("#!/bin/sh\necho no ipykernel here >&2\nexit 1\n")
    broken.chmod(0o755)
    monkeypatch.setattr(sys, "executable", str(broken))
    with pytest.raises(LessonError, match="did not start") as caught:
        run(checkout, "\n1")
    assert "no ipykernel here" in caught.value.means


def test_ctrl_c_ends_the_build_and_its_kernel_at_once(checkout):
    body = "# %%\nimport os, time\nprint(os.getpid(), file=open('pid', 'w'))\ntime.sleep(60)"
    checkout.write(body)
    command = [sys.executable, "-m", "rosbeat", "build", "--root", str(checkout.course.root)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as build:
        pid = wait_for_text(checkout.course.solutions / "pid")
        build.send_signal(signal.SIGINT)
        _, said = build.communicate(timeout=30)
    assert build.returncode == 130
    assert said.decode().startswith("rosbeat: interrupted.\n")
    with pytest.raises(ProcessLookupError):
        os.kill(int(pid), 0)


def wait_for_text(path, seconds=30.0):
    deadline = time.monotonic() + seconds
    while time.monotonic() < deadline:
        text = path.read_text() if path.exists() else ""
        if text.endswith("\n"):
            return text
        time.sleep(0.02)
    raise AssertionError(f"{path.name} was not written")


# The kernel.


def test_each_kernel_has_an_empty_workspace_and_a_domain_of_its_own(monkeypatch):
    monkeypatch.setenv("ROS_DOMAIN_ID", "7")
    with kernel_place() as one, kernel_place() as other:
        homes = {place.environment["ROSBEAT_STEADY_HOME"] for place in (one, other)}
        domains = {int(place.environment["ROS_DOMAIN_ID"]) for place in (one, other)}
        assert all(list(Path(home).iterdir()) == [] for home in homes)
    assert len(homes) == len(domains) == 2
    assert domains < set(PRIVATE_IDS)
    assert not any(Path(home).exists() for home in homes)


def test_sockets_have_short_paths_and_leave_with_the_kernel(monkeypatch, tmp_path):
    deep = tmp_path / ("x" * 100)
    deep.mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(deep))
    with kernel_place() as one, kernel_place() as other:
        assert one.folder != other.folder
        assert len(str(one.options()["ip"]) + "-5") < 107
    assert not one.folder.exists()
