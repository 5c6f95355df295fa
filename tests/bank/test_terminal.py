"""Every case of a terminal is recognised, those that cost little from a real command."""

import pytest

from bank.terminal import CASES, ROWS
from bank.workspaces import Desk, typed
from rosbeat.diagnosis.mistakes import MISTAKES
from rosbeat.workspace.commands import explain, recognise


@pytest.fixture
def root(tmp_path, monkeypatch):
    """A furnished workspace, where a page would find it."""
    monkeypatch.setenv("ROSBEAT_STEADY_HOME", str(tmp_path))
    root = tmp_path / "ROS2_and_RL_Tutorials"
    Desk(root).furnish(with_package=True)
    return root


def ended(case, root):
    """What a case printed, its exit code, and where it was typed."""
    place = root / case.place
    if case.before:
        typed(case.before, root)
    if case.output is not None:
        return case.output, case.code, place
    terminal = typed(case.command, root, case.place)
    return terminal.text.partition("\n")[2], terminal.exit_code, place


@pytest.mark.parametrize("case", CASES, ids=lambda one: one.name)
def test_a_case_is_recognised(case, root):
    seen = (case.command, *ended(case, root), root)
    found = recognise(*seen)
    assert (found.mistake if found else "") == case.mistake, (found, seen[1])
    if found is None:
        assert explain(*seen) is None
        return
    assert found.evidence
    assert found.hint
    said = explain(*seen)
    # Nothing is said only where the course's `ros2` has said it.
    assert said or "Did you mean" in seen[1] or "is a package itself" in seen[1]


def test_each_row_has_its_own_names():
    for row in range(20, 30):
        cases = [case for case in ROWS if case.name.startswith(f"{row} ")]
        assert len(cases) >= 2, row
        assert {MISTAKES[case.mistake].row for case in cases} == {row}
        known = {one.id for one in MISTAKES.values() if one.row == row}
        assert {case.mistake for case in cases} == known, row
