import sys

import pytest

from rosbeat.workspace.terminals.steadiness import polisher


def test_a_learner_sees_the_real_thing(monkeypatch, tmp_path):
    monkeypatch.delenv("ROSBEAT_STEADY_HOME", raising=False)
    line = f"Finished <<< a [1.23s] in {tmp_path} with {sys.prefix}"
    assert polisher()(line) == line


@pytest.mark.parametrize(
    ("real", "steady"),
    [
        ("Finished <<< a [1.23s]", "Finished <<< a [0.00s]"),
        ("Summary: 1 package finished [1min 2.5s]", "Summary: 1 package finished [0.00s]"),
        ("===== 3 passed in 0.05s =====", "===== 3 passed in 0.00s ====="),
        ("[1] 31234", "[1] 1234"),
        ("[INFO] [1732212345.123456789] [a]: b", "[INFO] [a]: b"),
        ("lib/python3.11/site-packages", "lib/python3.12/site-packages"),
        ("Publishing: 22.13C", "Publishing: 22.13C"),
        ("HOME/ws", "/home/you/ws"),
        ("at HOME.", "at /home/you."),
        ("HOME-2/ws", "HOME-2/ws"),
        ("PREFIX/bin/ros2", "/home/you/rosbeat/.venv/bin/ros2"),
    ],
)
def test_what_differs_is_made_the_same(home, real, steady):
    real = real.replace("PREFIX", sys.prefix).replace("HOME", str(home))
    assert polisher()(real) == steady.replace("HOME", str(home))
