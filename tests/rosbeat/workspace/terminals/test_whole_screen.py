"""Programs that paint a whole screen; the test's own `vi` does what the real one does."""

import sys

import pytest

from rosbeat.workspace.terminals.whole_screen import refused, words

VI = f"""#!{sys.executable} -IS
import sys, time, tty
tty.setcbreak(1)
print("~" * 5000, flush=True)
time.sleep(100)
"""


@pytest.fixture
def vi(home, seen):
    program = home / "bin" / "vi"
    program.parent.mkdir()
    program.write_text(VI)
    program.chmod(0o755)
    (home / "bin" / "python-keys").symlink_to(program)
    seen("PATH=$HOME/bin:$PATH")


@pytest.mark.parametrize("command", ["vi", "cat /dev/null | vi x", "(vi); vi", "sh -c 'vi; true'"])
def test_they_are_stopped_at_once_and_nothing_is_shown(vi, seen, terminal, command):
    shown = seen(f"{command}\necho never", until="x")
    assert shown[:2] == [f"~$ {command}", shown[1]]
    assert shown[1].startswith("# `vi` was stopped: it needs a whole screen")
    assert "File, New, Terminal" in " ".join(shown)
    assert "~~" not in " ".join(shown)
    assert shown[-1] == "# 1 more line in the cell, not typed"
    assert not terminal.busy
    terminal.look(show=shown.append)
    assert shown[-1] == "# 1 more line in the cell, not typed"
    assert seen("echo fine") == ["~$ echo fine", "fine"]


def test_one_that_takes_the_place_of_the_shell(vi, seen, terminal):
    shown = seen("exec vi")
    assert shown[1].startswith("# `vi` was stopped")
    assert shown[-1].startswith("# the terminal `sensor` has ended")


def test_a_program_that_only_wants_keys_is_left_alone(vi, seen, terminal):
    seen("python-keys", until="~~~")
    assert terminal.busy
    assert terminal.ctrl_c(show=str) == 130


def test_those_that_refuse_by_themselves_are_explained():
    said = ["open terminal failed: terminal does not support clear"]
    assert refused("tmux new", said) == "tmux"
    assert refused("nano setup.py", ["Error opening terminal: dumb."]) == "nano"
    assert refused("grep terminal", said) == ""
    assert refused("tmux ls", ["no server running"]) == ""
    assert refused("", said) == ""


def test_words_name_another_way():
    assert "file browser" in words("nano", "was stopped")
    assert "cat FILE" in words("less", "was stopped")
    assert words("mc", "did not start").endswith("File, New, Terminal.")
