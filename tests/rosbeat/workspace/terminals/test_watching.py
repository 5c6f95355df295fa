"""How long a page follows a command."""

import time

import pytest

from rosbeat.errors import TerminalError

TICK = 'i=0; while true; do i=$((i+1)); echo "[INFO] [sensor]: tick $i"; sleep 0.05; done'


def test_a_command_is_watched_until_a_text_and_goes_on(terminal):
    shown = []
    terminal.type(TICK, until="tick", lines=3, show=shown.append)
    assert shown[1:] == [f"[INFO] [sensor]: tick {number}" for number in (1, 2, 3)]
    assert terminal.busy
    assert terminal.wait_for("tick", lines=6)[5] == "[INFO] [sensor]: tick 6"
    later = []
    terminal.look(until="tick", lines=2, show=later.append)
    assert later == ["[INFO] [sensor]: tick 4", "[INFO] [sensor]: tick 5"]
    assert terminal.logs()[0].text == "tick 1"


def test_only_the_last_command_is_waited_for_by_its_text(terminal):
    shown = []
    terminal.type("cd /\necho tick\necho tock; cat", until="tock", show=shown.append)
    assert shown == ["~$ cd /", "/$ echo tick", "tick", "/$ echo tock; cat", "tock"]


def test_a_command_is_watched_for_a_while(terminal):
    shown = []
    began = time.monotonic()
    terminal.type("echo a; sleep 100", seconds=0.6, show=shown.append)
    assert time.monotonic() - began >= 0.6
    assert shown == [
        "~$ echo a; sleep 100",
        "a",
        "# `echo a; sleep 100` goes on running in the terminal `sensor`",
    ]
    assert terminal.busy


def test_a_command_that_ends_earlier_is_not_waited_for(seen):
    began = time.monotonic()
    assert seen("echo a", seconds=60) == ["~$ echo a", "a"]
    assert time.monotonic() - began < 30


def test_a_text_that_does_not_come_is_an_error(terminal, says):
    with pytest.raises(TerminalError) as caught:
        terminal.type("echo abc; sleep 100", until="xyz", timeout=0.4, show=str)
    says(caught.value, "`xyz` did not appear", "0.4 s", "abc")
    assert terminal.busy
    with pytest.raises(TerminalError):
        terminal.wait_for("xyz", timeout=0.1)


def test_a_command_that_ends_before_the_text_is_an_error(terminal, says):
    with pytest.raises(TerminalError) as caught:
        terminal.type("echo abc", until="xyz", lines=2, show=str)
    says(caught.value, "before the command ended", "in 2 lines")
    assert not terminal.busy


def test_the_typed_line_itself_does_not_count(terminal):
    with pytest.raises(TerminalError):
        terminal.type("true xyz", until="xyz", show=str)


def test_a_question_without_a_newline_counts_when_the_program_is_silent(terminal):
    shown = []
    terminal.type("read -p 'Your name: ' name; echo Hello $name", until="name", show=shown.append)
    assert shown[-1] == "Your name: "
    terminal.answer("Ada", show=shown.append)
    assert shown[-2:] == ["Your name: Ada", "Hello Ada"]


def test_what_comes_between_two_cells_is_kept_and_not_shown(terminal, eventually, home):
    terminal.type("(until [ -e go ]; do sleep 0.02; done; echo late) &", show=str)
    (home / "go").touch()
    eventually(lambda: "late" in terminal.text.splitlines())
    shown = []
    terminal.type("echo now", show=shown.append)
    assert shown[:2] == ["~$ echo now", "now"]
    assert "late" not in shown


def test_a_look_shows_what_came_and_how_it_ended(terminal, eventually, home):
    terminal.type("until [ -e go ]; do sleep 0.02; done; echo late; (exit 5)", seconds=0, show=str)
    (home / "go").touch()
    eventually(lambda: not terminal.busy)
    shown = []
    terminal.look(show=shown.append)
    assert shown == ["late", "# exit code 5"]
    shown.clear()
    terminal.look(show=shown.append)
    assert shown == []


def test_a_look_for_a_text_that_never_came_is_an_error(terminal, says):
    terminal.type("echo abc", show=str)
    with pytest.raises(TerminalError) as caught:
        terminal.look(until="xyz", show=str)
    says(caught.value, "before the command ended", "abc")
