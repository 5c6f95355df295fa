"""A set of terminals is closed together."""

import os
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


def test_a_page_has_one_set_and_two_pages_have_two():
    one, two = Page(), Page()
    assert terminals_of(one) is terminals_of(one)
    assert terminals_of(one) is not terminals_of(two)


def test_without_a_page_there_are_no_terminals(says):
    with pytest.raises(TerminalError) as caught:
        terminal("sensor")
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


def test_two_sets_do_not_disturb_each_other(home):
    with Terminals() as one, Terminals() as two:
        one.get("a").type("sleep 300", seconds=0, show=str)
        two.get("a").type("sleep 300", seconds=0, show=str)
        one.close()
        assert two.get("a").busy


def test_a_set_can_be_used_again_after_it_was_closed(home):
    with Terminals() as terminals:
        terminals.get("a")
        terminals.close()
        assert terminals.find("a") is None
        terminals.get("a").type("true", show=str)


def test_a_folder_that_is_not_there(tmp_path, says):
    with Terminals(tmp_path / "nowhere") as terminals:
        with pytest.raises(TerminalError) as caught:
            terminals.get("a")
        says(caught.value, "nowhere")


def test_a_computer_without_bash(home, monkeypatch, says):
    monkeypatch.setenv("PATH", str(home))
    with Terminals() as terminals:
        with pytest.raises(TerminalError) as caught:
            terminals.get("a")
        says(caught.value, "bash")


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


def test_a_forked_child_leaves_the_terminals_alone(terminals):
    terminals.get("a")
    terminals._pid = os.getpid() + 1
    assert terminals.alien
    terminals.close()
    terminals._pid = os.getpid()
    assert not terminals.get("a").ended
