"""A set of terminals is closed together, and nothing of it stays behind."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from rosbeat.errors import TerminalError
from rosbeat.workspace.terminals import Terminals, reaper, terminal, terminals_of
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


def test_two_names_are_two_terminals(terminals):
    one, two = terminals.get("one"), terminals.get("two")
    one.type("cd /usr; X=1", show=str)
    two.type("echo [$X]; pwd", show=str)
    assert two.text.splitlines()[1:] == ["[]", "/home/you"]
    assert terminals.get("one") is one
    assert [terminal.name for terminal in terminals] == ["one", "two"]


def test_closing_one_ends_what_runs_in_it(terminal):
    assert terminal.state == "waits at ~$"
    terminal.type("sleep 100", seconds=0, show=str)
    assert repr(terminal) == "<terminal sensor: runs `sleep 100`>"
    terminal.close()
    terminal.close()
    assert terminal.ended
    assert repr(terminal) == "<terminal sensor: ended>"


# The program that ends what is marked.


@pytest.fixture
def mark():
    return f"test-{os.getpid()}-{os.urandom(4).hex()}."


@pytest.fixture
def start(mark):
    """Start programs that carry the mark; kill what is left of them."""
    started = []

    def start(code, number=1):
        environ = {**os.environ, reaper.VARIABLE: f"{mark}{number}."}
        command = [sys.executable, "-I", "-S", "-c", code]
        process = subprocess.Popen(
            command, env=environ, stdout=subprocess.PIPE, start_new_session=True
        )
        started.append(process)
        assert process.stdout.readline() == b"ready\n"
        return process

    yield start
    for process in started:
        process.kill()
        process.wait()
        process.stdout.close()


SLEEP = "import time; print('ready', flush=True); time.sleep(100)"
CHILD = f"""
import os, subprocess, sys
subprocess.Popen([sys.executable, "-I", "-S", "-c", {SLEEP!r}])
import time; time.sleep(100)
"""


def test_marked_processes_are_found(mark, start):
    one, two = start(SLEEP, 1), start(SLEEP, 12)
    assert set(reaper.marked(mark)) == {one.pid, two.pid}
    assert reaper.marked(f"{mark}1.") == [one.pid]
    assert reaper.marked("nobody.") == []


def test_a_follower_is_asked_first(mark, start, eventually):
    polite = """
import signal, sys, time
signal.signal(signal.SIGTERM, lambda *_: sys.exit(7))
print('ready', flush=True)
time.sleep(100)
"""
    leader = start(CHILD.replace(repr(SLEEP), repr(polite)))
    reaper.end_marked(mark)
    assert leader.wait(10) == -signal.SIGKILL
    assert reaper.marked(mark) == []


def test_the_deaf_are_killed(mark, start):
    deaf = "import signal; signal.signal(signal.SIGTERM, signal.SIG_IGN); " + SLEEP
    process = start(CHILD.replace(repr(SLEEP), repr(deaf)))
    reaper.end_marked(mark, grace=0.1)
    assert process.wait(10) == -signal.SIGKILL
    assert reaper.marked(mark) == []


def test_the_watcher_ends_what_is_marked_when_its_pipe_closes(mark, start, eventually):
    process = start(SLEEP)
    command = [sys.executable, "-I", "-S", reaper.__file__, mark, str(os.getpid())]
    watcher = subprocess.Popen(command, stdin=subprocess.PIPE)
    assert process.poll() is None
    watcher.stdin.close()
    assert watcher.wait(20) == 0
    assert process.wait(10) == -signal.SIGKILL
