"""A right answer gets its points in nbgrader, too, wherever it stands on a page."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from arrangements import ARRANGEMENTS, NOT_IN_NBGRADER, ROOT

pytestmark = [pytest.mark.ros, pytest.mark.timeout(900), pytest.mark.thorough]
SCRIPT = Path(__file__).with_name("arranged_course.py")


def test_every_arrangement_that_nbgrader_can_read_gets_all_points(tmp_path):
    home = tmp_path / "home"
    own = {"HOME": str(home), "ROSBEAT_WORKSPACE_IN": str(home), "ROSBEAT_PROGRESS_IN": str(home)}
    home.mkdir()
    own["PATH"] = os.pathsep.join([str(Path(sys.executable).parent), os.environ.get("PATH", "")])
    environ = {name: os.environ[name] for name in os.environ if name != "ROSBEAT_STEADY_HOME"}
    words = [sys.executable, SCRIPT, tmp_path]
    done = subprocess.run(words, capture_output=True, text=True, env={**environ, **own})
    assert done.returncode == 0, done.stderr[-4000:]
    marks = json.loads((tmp_path / "marks.json").read_text())
    assert len(marks) == 2 * len(ARRANGEMENTS)
    full = {
        case
        for case, points in marks.items()
        if all(score == most for score, most in points.values())
    }
    assert {case[:-3] for case in set(marks) - full} == NOT_IN_NBGRADER
    assert len(ARRANGEMENTS.keys() - NOT_IN_NBGRADER) >= 12


def test_what_nbgrader_cannot_read_is_documented():
    text = (ROOT / "docs" / "nbgrader.md").read_text(encoding="utf-8")
    assert all(word in text for word in ("split", "copied", "renamed", "second check", "metadata"))
