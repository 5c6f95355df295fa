"""What a page sees of a terminal, with a real bash."""

import time


def test_a_terminal_starts_quickly(terminals):
    began = time.monotonic()
    terminals.get("quick")
    # 30 ms on a quiet machine.
    assert time.monotonic() - began < 5


def test_two_names_are_two_terminals(terminals):
    one, two = terminals.get("one"), terminals.get("two")
    one.type("cd /usr; X=1", show=str)
    two.type("echo [$X]; pwd", show=str)
    assert two.text.splitlines()[1:] == ["[]", "/home/you"]
    assert terminals.get("one") is one
    assert [terminal.name for terminal in terminals] == ["one", "two"]


def test_closing_ends_what_runs(terminal):
    terminal.type("sleep 100", seconds=0, show=str)
    terminal.close()
    terminal.close()
    assert terminal.ended
    assert repr(terminal) == "<terminal sensor: ended>"


def test_state_words(terminal):
    assert terminal.state == "waits at ~$"
    terminal.type("sleep 100", seconds=0, show=str)
    assert repr(terminal) == "<terminal sensor: runs `sleep 100`>"
