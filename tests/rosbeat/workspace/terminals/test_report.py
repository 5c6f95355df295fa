"""What a command means is asked of `rosbeat.workspace.meanings`."""

import pytest

from rosbeat.workspace import meanings
from rosbeat.workspace.terminals.report import meaning


@pytest.fixture
def asked(monkeypatch):
    """What the explanations were asked, and an answer that names a folder."""
    calls = []

    def explain(*question):
        calls.append(question)
        return f"It means\n{question[4]}"

    monkeypatch.setattr(meanings, "explain", explain)
    return calls


def test_the_question_holds_everything(asked, home):
    assert meaning("ls", ["a", "b"], 2, home) == "It means\n/home/you/ROS2_and_RL_Tutorials"
    assert asked == [("ls", "a\nb", 2, home, home / "ROS2_and_RL_Tutorials")]


def test_a_terminal_shows_the_meaning_below_the_exit_code(asked, seen, home):
    shown = seen("cd /\nfalse")
    assert shown[-3:] == [
        "# exit code 1",
        "# It means",
        "# /home/you/ROS2_and_RL_Tutorials",
    ]
    assert [(call[0], call[2], str(call[3])) for call in asked] == [
        ("cd /", 0, str(home)),
        ("false", 1, "/"),
    ]


def test_what_is_not_known_is_not_said(monkeypatch, home):
    monkeypatch.setattr(meanings, "explain", lambda *_: None)
    assert meaning("true", [], 0, home) is None
