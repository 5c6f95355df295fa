import json

import pytest

from course_tool import proof, running
from course_tool.messages import Problem


def answer(layout, monkeypatch, code, text):
    monkeypatch.setattr(running, "quiet", lambda command, env, timeout: running.Result(code, text))
    return proof.ask_ros(layout, {})


def test_facts_are_the_last_line(layout, monkeypatch):
    text = "a warning\n" + json.dumps({"milliseconds": 200.0}) + "\n"
    assert answer(layout, monkeypatch, 0, text) == {"milliseconds": 200.0}


@pytest.mark.parametrize(
    ("code", "text"),
    [
        (1, "Traceback\nImportError: librcl.so"),
        (124, "It did not end within 60 s."),
        (0, ""),
        (0, "3"),
    ],
)
def test_a_ros_that_does_not_start(layout, monkeypatch, code, text):
    with pytest.raises(Problem, match="does not start") as caught:
        answer(layout, monkeypatch, code, text)
    assert caught.value.details == text


def test_a_wrong_middleware_is_named(layout, monkeypatch):
    with pytest.raises(Problem) as caught:
        answer(layout, monkeypatch, 102, "")
    assert "RMW_IMPLEMENTATION" in caught.value.cure


def test_a_message_that_never_comes(layout, monkeypatch):
    with pytest.raises(Problem, match="hears nothing"):
        answer(layout, monkeypatch, 0, '{"milliseconds": null}')
