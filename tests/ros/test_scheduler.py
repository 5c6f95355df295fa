"""Inside virtual time: the order of what is due, and the end of endless chains."""

from types import SimpleNamespace

import pytest
from hypothesis import given
from hypothesis import strategies as st
from rclpy.exceptions import InvalidHandle

from rosbeat.errors import EndlessChainError
from rosbeat.ros import virtual_time
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
