"""After any wrong try of any exercise, the right answer passes: in one kernel and one workspace.

Where a wrong try has left something in the way, the message names a command that removes it, and
that command is typed, too.
"""

import re
import warnings
from unittest.mock import patch

import pytest

from bank import workspaces
from bank.conftest import FOLDER
from bank.pages import solution, subject
from bank.reading import answers
from bank.running import hurried, namespace_of
from bank.workspaces import FILES, SAVED_ON, SETUP_CFG, Desk, Terminal, typed
from rosbeat.exercises import scenarios
from rosbeat.exercises.check import check
from rosbeat.workspace.prerequisites import PACKAGE, finished

WRONG = [one for one in answers() if one.status == "failed"]
#: A command that a message gives, to be typed as it stands.
COMMAND = re.compile(r"`((?:cd|rm|mv|touch|sed) [^`]*\"\$ROS2_WORKSPACE\"[^`]*)`")
#: Of two mistakes at once, a message names one.
MOST_MISTAKES = 3


@pytest.fixture
def own(tmp_path, monkeypatch):
    """Return the folder of a workspace that is not there yet, where a page would find it."""
    monkeypatch.setenv("ROSBEAT_STEADY_HOME", str(tmp_path))
    return tmp_path / FOLDER


@pytest.fixture
def shared(caught_up, monkeypatch):
    """Return the workspace that all cells read."""
    monkeypatch.setenv("ROSBEAT_STEADY_HOME", str(caught_up))
    return caught_up / FOLDER


def checked(exercise, root, terminal):
    """Return the outcome of a check in a workspace, with one terminal open."""
    if exercise == "01b":
        return check(exercise, terminal).outcome
    with patch.object(scenarios, "page_terminals", lambda: (terminal,)):
        return check(exercise, root).outcome


def go_back(outcome, terminal, root):
    """Do what a message says; return the terminal as it is then."""
    for command in COMMAND.findall(f"{outcome.evidence} {outcome.hint}"):
        terminal = type_on(terminal, command, root)
    for path in (
        path for words, paths in SAVED_ON.items() if words in outcome.hint for path in paths
    ):
        Desk(root).write(f"src/{PACKAGE}/{path}", finished(path))
    if "setup.cfg that page 02 shows" in outcome.hint:
        Desk(root).write(f"src/{PACKAGE}/setup.cfg", SETUP_CFG)
    return terminal


def type_on(terminal, lines, root):
    """Type lines into a terminal that goes on; return it as it is then."""
    start = terminal.folder if terminal.folder.is_dir() else root
    now = typed(lines, root, str(start))
    return Terminal(now.folder, terminal.text + now.text, now.exit_code)


@pytest.mark.ros
@pytest.mark.parametrize(
    "wrong", [one for one in WRONG if one.exercise in workspaces.EXERCISES], ids=lambda one: one.id
)
def test_files_and_terminals(wrong, own):
    handed = Desk(own).handed(wrong)
    terminal = handed if isinstance(handed, Terminal) else Terminal(own, "")
    outcome = checked(wrong.exercise, own, terminal)
    assert outcome.status == "failed"
    found = outcome
    for _ in range(MOST_MISTAKES):
        terminal = go_back(found, terminal, own)
        if wrong.exercise in FILES:
            Desk(own).write(FILES[wrong.exercise], solution(wrong.exercise))
        else:
            terminal = type_on(terminal, solution(wrong.exercise), own)
        found = checked(wrong.exercise, own, terminal)
        if found.status == "passed":
            return
    pytest.fail(f"{outcome}\n{found}\n{terminal.text}")


@pytest.mark.ros
@pytest.mark.parametrize(
    "exercise",
    sorted({one.exercise for one in WRONG} - set(workspaces.EXERCISES)),
)
def test_cells(exercise, shared, request):
    mine = [one for one in WRONG if one.exercise == exercise]
    sample = mine if request.config.getoption("--thorough") else mine[:: max(1, len(mine) // 3)]
    right = solution(exercise)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for wrong in sample:
            with hurried(wrong):
                space = namespace_of(exercise, wrong.text, f"<cell of {exercise}>")
                assert check(exercise, eval(wrong.subject, space)).outcome.status == "failed"
            exec(compile(right, f"<cell of {exercise}>", "exec", dont_inherit=True), space)
            found = check(exercise, eval(subject(exercise), space)).outcome
            assert found.status == "passed", (wrong.name, found)
