"""Sets of terminals, what survives in them, and that nothing of one stays behind."""

import time
from pathlib import Path

import pytest

from rosbeat.errors import TerminalError
from rosbeat.workspace.terminals import Terminals, terminal, terminals_of
from rosbeat.workspace.terminals.reaper import marked

HARD_TO_END = """\
sleep 300 &
setsid sleep 300 &
nohup sleep 300 > /dev/null 2>&1 &
(trap '' HUP TERM INT; sleep 300) &
disown -a
(setsid sh -c 'sleep 300 & sleep 300' &)
"""


class Page:
    """Stands for an IPython shell."""


def test_a_page_has_one_set_and_two_pages_have_two(says):
    one, two = Page(), Page()
    assert terminals_of(one) is terminals_of(one)
    assert terminals_of(one) is not terminals_of(two)
    with pytest.raises(TerminalError) as caught:
        terminal("sensor")  # without a page
    says(caught.value, "Terminals()")


def test_closing_leaves_nothing(home, eventually):
    terminals = Terminals()
    sensor = terminals.get("sensor")
    sensor.type(HARD_TO_END, show=str)
    # The prompt is back before what runs in the background has begun.
    eventually(lambda: len(marked(terminals._mark)) >= 6)
    began = time.monotonic()
    terminals.close()
    assert time.monotonic() - began < 20
    assert marked(terminals._mark) == []
    assert sensor.ended
    assert list(terminals) == []


def test_sets_do_not_disturb_each_other_and_can_be_used_again(home):
    with Terminals() as one, Terminals() as two:
        one.get("a").type("sleep 300", seconds=0, show=str)
        two.get("a").type("sleep 300", seconds=0, show=str)
        one.close()
        assert two.get("a").busy
        assert one.find("a") is None
        one.get("a").type("true", show=str)


@pytest.mark.parametrize("missing", ["folder", "bash"])
def test_a_folder_or_a_bash_that_is_not_there(home, monkeypatch, says, missing):
    monkeypatch.setenv("PATH", str(home)) if missing == "bash" else None
    with Terminals(home / "nowhere" if missing == "folder" else None) as terminals:
        with pytest.raises(TerminalError) as caught:
            terminals.get("a")
        says(caught.value, "bash" if missing == "bash" else "nowhere")


def test_nothing_is_left_open(home):
    def files():
        return len(list(Path("/proc/self/fd").iterdir()))

    with Terminals() as terminals:
        terminals.get("a")
    before = files()
    for _ in range(3):
        with Terminals() as terminals:
            terminals.get("a").type("exit", show=str)
            terminals.get("a")
    assert files() <= before


def test_closing_one_ends_what_runs_in_it_and_in_no_other(terminals, terminal):
    assert terminal.state == "waits at ~$"
    terminal.type("sleep 100", seconds=0, show=str)
    assert repr(terminal) == "<terminal sensor: runs `sleep 100`>"
    for number in range(10):
        terminals.get(f"other{number}")
    terminals.get("other9").type("sleep 100", seconds=0, show=str)  # the marks begin alike
    terminal.close()
    terminal.close()
    assert repr(terminal) == "<terminal sensor: ended>"
    assert terminals.get("other9").busy


# The environment.


def test_what_a_kernel_sets_for_itself_stays_behind(home, monkeypatch):
    for name in ("MPLBACKEND", "FORCE_COLOR", "PYTEST_CURRENT_TEST", "PS4", "XDG_CONFIG_HOME"):
        monkeypatch.setenv(name, "x")
    monkeypatch.setenv("LC_ALL", "C")
    with Terminals() as terminals:
        terminals.get("a").type(
            "echo [$MPLBACKEND$FORCE_COLOR$PYTEST_CURRENT_TEST$XDG_CONFIG_HOME] $LC_ALL; cd; pwd",
            show=(shown := []).append,
        )
    assert shown[1:] == ["[] C.UTF-8", "/home/you"]


def test_a_learner_keeps_home_name_and_folders(monkeypatch, tmp_path):
    monkeypatch.delenv("ROSBEAT_STEADY_HOME", raising=False)
    monkeypatch.setenv("ROSBEAT_WORKSPACE_IN", str(tmp_path))
    monkeypatch.setenv("HOME", str(tmp_path / "ada"))
    monkeypatch.setenv("USER", "ada")
    monkeypatch.setenv("LC_ALL", "de_DE.utf8")
    (tmp_path / "ada" / "more").mkdir(parents=True)
    with Terminals() as terminals:
        terminal = terminals.get("a")
        terminal.type(
            "echo $USER $HOME $LC_ALL; echo 'in 0.05s [INFO] [1732212345.5] [a]: b'\n"
            "mkdir ws; cd ws\ncd ~/more\ncd /\ncd ~\ntrue",
            show=(shown := []).append,
        )
    place = tmp_path.name
    assert shown == [
        f"{place}$ echo $USER $HOME $LC_ALL; echo 'in 0.05s [INFO] [1732212345.5] [a]: b'",
        f"ada {tmp_path}/ada de_DE.utf8",
        "in 0.05s [INFO] [1732212345.5] [a]: b",
        f"{place}$ mkdir ws; cd ws",
        "ws$ cd ~/more",
        "ada/more$ cd /",
        "/$ cd ~",
        "~$ true",
    ]


# The prompt by which a page knows that a command has ended.


@pytest.mark.parametrize(
    "command",
    [
        "PS1='mine> '",
        "PROMPT_COMMAND=",
        "stty sane",
        "set -u",
        "set -o pipefail; set -x; set +x",
        "set -o vi",
        "trap 'true' INT EXIT ERR DEBUG",
        "export TERM=xterm LANG=C LC_ALL=C",
    ],
)
def test_the_prompt_survives(terminal, seen, command):
    terminal.type(command, timeout=20, show=str)
    terminal.type("true", show=str)
    assert seen("echo °fine°; (exit 7)") == ["~$ echo °fine°; (exit 7)", "°fine°", "# exit code 7"]


def test_a_folder_with_odd_letters(seen, terminal, home):
    name = 'o d$d `é\' "x" \\n'
    (home / name).mkdir()
    seen("cd o*")
    assert terminal.folder == home / name


def test_a_folder_that_is_gone(seen, home):
    seen("mkdir gone; cd gone")
    (home / "gone").rmdir()
    assert seen("echo hello") == ["gone$ echo hello", "hello"]
    assert "# exit code 1" in seen("ls .. > /dev/null; cd nowhere 2> /dev/null")
