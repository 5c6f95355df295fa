"""Interrupts, the agenda's bookkeeping, the chain guard, spans of time and their texts."""

import os
import signal
import sys
import threading
from types import SimpleNamespace

import pytest
from hypothesis import given
from hypothesis import strategies as st
from rclpy.exceptions import InvalidHandle, NotInitializedException
from rclpy.node import Node

from rosbeat.errors import DurationError, EndlessChainError, NoSessionError
from rosbeat.records import Fault, LogRecord
from rosbeat.ros import virtual_time
from rosbeat.ros.console import fault_text, log_text, seconds_text
from rosbeat.ros.context import Interrupts, show_briefly
from rosbeat.ros.entities import callback_name, full_name
from rosbeat.ros.errors import duration_ns
from rosbeat.ros.virtual_time import Agenda


class Handle:
    def __init__(self, wait, canceled=False, destroyed=False):
        self.wait, self.canceled, self.destroyed = wait, canceled, destroyed

    def __enter__(self):
        if self.destroyed:
            raise InvalidHandle("gone")

    def __exit__(self, *_):
        pass

    def is_timer_canceled(self):
        return self.canceled

    def time_until_next_call(self):
        return self.wait


def entry(number, wait, **options):
    state = SimpleNamespace(spinning=True, ended=False, name=f"/n{number}")
    label = SimpleNamespace(name="callback", source=f"/t{number}")
    handle = Handle(wait, **options)
    timer = SimpleNamespace(clock=SimpleNamespace(move=bool))
    return SimpleNamespace(
        number=number, handle=handle, state=state, deadline=None, label=label, entity=timer
    )


def drain(agenda):
    order = []
    while agenda.next_deadline(0) is not None:
        order.append(agenda.pop().number)
    return order


@given(st.lists(st.integers(-5, 20), max_size=20))
def test_the_agenda_is_ordered_by_deadline_and_creation(waits):
    agenda = Agenda()
    for number, wait in enumerate(waits):
        agenda.add(entry(number, wait), 0)
    wanted = sorted(range(len(waits)), key=lambda number: (max(0, waits[number]), number))
    assert drain(agenda) == wanted


def test_a_timer_that_moved_is_there_once():
    agenda, one = Agenda(), entry(1, 100)
    agenda.add(one, 0)
    for wait in (5, 50, 7):
        one.handle.wait = wait
        agenda.move(one, 0)
    assert agenda.next_deadline(0) == 7
    assert drain(agenda) == [1]


def test_canceled_resting_destroyed_and_ended_timers():
    agenda = Agenda()
    canceled, resting = entry(1, 1, canceled=True), entry(2, 2)
    resting.state.spinning = False
    ended = entry(4, 4)
    ended.state.ended = True
    for one in (canceled, resting, entry(3, 3, destroyed=True), ended):
        agenda.add(one, 0)
    assert agenda.next_deadline(0) is None
    canceled.handle.canceled = False
    resting.state.spinning = True
    assert drain(agenda) == [1, 2]


def test_a_deep_chain_is_refused_with_its_names():
    guard, ping, pong = virtual_time.ChainGuard(), entry(1, 0), entry(2, 0)

    def follow():
        for depth in range(virtual_time.SUSPICIOUS + 1, 10_000):
            guard.depth = depth
            guard.inspect(pong if depth % 2 else ping)

    with pytest.raises(EndlessChainError, match=r"/n\d \(/t\d\) -> /n\d \(/t\d\) -> /n\d"):
        follow()


def test_time_that_passes_resets_the_count():
    guard, timer = virtual_time.ChainGuard(), entry(1, 0)

    def fire(times):
        for _ in range(times):
            guard.timer_fires(timer)

    for _ in range(3):
        fire(virtual_time.MOST_FIRINGS)
        guard.instant_ends()
    with pytest.raises(EndlessChainError):
        fire(virtual_time.MOST_FIRINGS + 1)


def test_an_interrupt_that_became_another_error_is_not_lost():
    before = signal.getsignal(signal.SIGINT)
    interrupts = Interrupts()
    with interrupts:
        try:
            os.kill(os.getpid(), signal.SIGINT)
            threading.Event().wait(5)
        except KeyboardInterrupt:
            assert interrupts.pressed
    with pytest.raises(KeyboardInterrupt):
        interrupts.raise_if_pressed()
    assert signal.getsignal(signal.SIGINT) is before


def test_interrupts_are_left_alone_in_other_threads():
    seen = []

    def work():
        with Interrupts() as interrupts:
            seen.append((signal.getsignal(signal.SIGINT), interrupts.pressed))

    thread = threading.Thread(target=work)
    thread.start()
    thread.join()
    assert seen == [(signal.getsignal(signal.SIGINT), False)]


@given(st.integers(0, 10**9))
def test_whole_seconds_are_exact(seconds):
    assert duration_ns(seconds) == seconds * 10**9


@pytest.mark.parametrize("value", [None, "1", 1j, [], True, -0.1, float("nan"), 2e9])
def test_other_spans_are_refused(value):
    with pytest.raises(DurationError):
        duration_ns(value)


def test_texts():
    assert seconds_text(1_234_567_890) == "1.234"
    assert log_text(LogRecord(5 * 10**8, "WARN", "n", "text", "f", 3)) == "[WARN] [0.500] [n]: text"
    assert "line" not in fault_text(Fault(0, "/n", "cb", "KeyError", "x", 0, "")).splitlines()[1]
    assert callback_name(None) == "nothing"
    assert callback_name(Handle(1)) == "Handle"
    assert [full_name("a", space) for space in ("", "/", "x", "/x/y/")] == [
        "/a", "/a", "/x/a", "/x/y/a",
    ]  # fmt: skip


def test_an_interrupt_shows_one_line_where_it_can():
    interrupt = KeyboardInterrupt()
    show_briefly(interrupt, "stopped at 3 s.")
    assert interrupt._render_traceback_() == ["KeyboardInterrupt: stopped at 3 s."]


def test_on_a_page_a_node_without_a_session_is_explained(monkeypatch):
    with pytest.raises(NotInitializedException):  # in a program: rclpy's own words
        Node("alone")
    monkeypatch.setitem(sys.modules, "ipykernel.kernelapp", sys)
    with pytest.raises(NoSessionError, match="no session is open") as caught:
        Node("alone")
    assert caught.value.means
    assert "Session()" in caught.value.to_try
    assert "the class itself, without parentheses" in caught.value.to_try
