"""Time jumps from one deadline to the next, all that is due runs in order, and chains end."""

from dataclasses import dataclass
from functools import partial

import pytest
from hypothesis import given
from hypothesis import strategies as st
from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from rclpy.qos import QoSProfile

from nodes import SECOND, Doer, Listener, Relay, Talker, Ticker
from rosbeat import Session
from rosbeat.errors import EndlessChainError
from rosbeat.ros import recording, schedule
from rosbeat.ros.schedule import ChainGuard, Schedule


def test_a_timer_fires_once_a_period_and_the_end_belongs_to_the_run(ros):
    ticker = ros.add(partial(Ticker, 1.0))
    ros.run(60)
    assert ticker.times() == [n * SECOND for n in range(1, 61)]
    assert ros.time == 60


def test_coprime_periods_interleave_by_deadline_and_then_by_creation(ros):
    ticker = ros.add(partial(Ticker, 0.7, 0.3, 0.21))
    ros.run(21)
    wanted = sorted(
        (at, number)
        for number, step in enumerate((700, 300, 210))
        for at in range(step * 1_000_000, 21 * SECOND + 1, step * 1_000_000)
    )
    assert ticker.fired == wanted


def test_two_halves_are_a_whole():
    def run(*spans):
        with Session(seed=3) as ros:
            for node in (partial(Ticker, 0.5, 0.125), Talker, Listener):
                ros.add(node)
            for span in spans:
                ros.run(span, quiet=True)
            return ros.observation()

    assert run(0.5, 0.5) == run(1.0) == run(0.25, 0, 0.25, 0.5, 0)


def test_a_period_of_zero_is_refused_by_name(ros, says):
    ros.add(partial(Ticker, 0.0, name="hasty"))
    with pytest.raises(EndlessChainError) as caught:
        ros.run(1)
    says(caught.value, "/hasty", "period is zero")
    ros.remove("hasty")
    other = ros.add(partial(Ticker, 1.0))
    ros.run(3)
    assert len(other.fired) == 3


def test_a_shorter_period_takes_effect_with_a_reset(ros):
    ticker = ros.add(partial(Ticker, 100.0))

    def do(node):
        node.timer.cancel()
        ticker.clocks[0].timer_period_ns = SECOND
        ticker.clocks[0].reset()

    ros.add(partial(Doer, do, period=0.5))
    ros.run(5)
    assert ticker.times() == [SECOND * n + SECOND // 2 for n in range(1, 5)]


@pytest.mark.parametrize("name", ["ROS_TIME", "STEADY_TIME", "SYSTEM_TIME"])
def test_every_clock_of_a_node_shows_virtual_time(ros, name):
    clock_type = getattr(ClockType, name)

    class Other(Node):
        def __init__(self):
            super().__init__("other")
            self.clock, self.seen = Clock(clock_type=clock_type), []
            self.begin = self.clock.now()
            assert self.begin.clock_type == clock_type
            assert self.begin.nanoseconds > 0
            self.create_timer(2.0, self.tick, clock=self.clock)

        def tick(self):
            self.seen.append((self.clock.now() - self.begin).nanoseconds)

    other = ros.add(Other)
    ros.run(7)
    assert other.seen == [2 * SECOND, 4 * SECOND, 6 * SECOND]
    ros.start()
    assert ros.wait(10, until=lambda: len(other.seen) > 3)


def test_a_circle_names_its_nodes_and_leaves_the_session_usable(ros, says):
    ros.add(partial(Relay, "ping", "a", "b"))
    ros.add(partial(Relay, "pong", "b", "a"))
    ros.add(partial(Talker, topic="a"))
    ticker = ros.add(partial(Ticker, 0.5))
    with pytest.raises(EndlessChainError) as caught:
        ros.run(2)
    says(caught.value, "/ping (/a)", "/pong (/b)")
    ros.remove("pong")
    ros.run(10)
    assert len(ticker.fired) == 22


def test_a_circle_that_doubles_is_found_too(ros, says, monkeypatch):
    monkeypatch.setattr("rosbeat.ros.schedule.MOST_FOLLOWERS", 5_000)
    ros.add(partial(Relay, "ping", "a", "b", copies=2))
    ros.add(partial(Relay, "pong", "b", "a", copies=2))
    ros.add(partial(Talker, topic="a"))
    with pytest.raises(EndlessChainError) as caught:
        ros.run(2)
    says(caught.value, "/ping", "/pong")


def test_wide_bursts_are_no_circle(ros):
    everything = QoSProfile(depth=1_500)
    ros.add(partial(Talker, burst=1_500, qos=everything))
    listener = ros.add(partial(Listener, qos=everything))
    ros.run(2)
    assert listener.heard == list(range(1, 3_001))


def test_a_paused_node_keeps_what_its_queue_holds(ros):
    ros.add(Talker)
    listener = ros.add(partial(Listener, qos=3))
    ticker = ros.add(partial(Ticker, 1.0))
    ros.run(2)
    ros.pause(listener)
    ros.pause("ticker")
    ros.run(10)
    assert listener.heard == [1, 2]
    ros.resume(listener)
    ros.resume(ticker)
    ros.run(0)
    assert listener.heard == [1, 2, 10, 11, 12]
    assert ticker.times() == [SECOND, 2 * SECOND, 12 * SECOND]
    ros.run(2)
    assert listener.heard == [1, 2, 10, 11, 12, 13, 14]


def test_what_was_sent_before_the_node_was_added_waits_in_its_queue(ros):
    listener = Listener()
    talker = ros.add(partial(Talker, period=100.0))
    talker.talk()
    ros.run(1)
    assert listener.heard == []
    ros.add(listener)
    ros.run(0)
    assert listener.heard == [1]


def test_an_interrupted_run_loses_no_timer_and_no_message(ros):
    def do(node):
        if ros.time == 3:
            raise KeyboardInterrupt

    ros.add(partial(Doer, do))
    ticker, talker = ros.add(partial(Ticker, 1.0)), ros.add(partial(Talker, burst=2))
    listener = ros.add(Listener)
    with pytest.raises(KeyboardInterrupt):
        ros.run(10)
    ros.run(2)
    assert [at // SECOND for at in ticker.times()] == [1, 2, 3, 4, 5]
    assert talker.count == 10
    assert listener.heard == list(range(1, 11))
    assert len([run for run in ros.observation().callbacks if run.node == "/doer"]) == 5
    assert ros.observation().faults == ()


def test_no_wait_set_is_built_while_nothing_changes(ros, monkeypatch):
    ros.add(Talker)
    ros.add(Listener)
    ros.run(1)
    executor = ros.nodes[0].executor
    monkeypatch.setattr(executor, "wait_for_ready_callbacks", None)
    ros.run(100)
    assert len(ros.messages("count")) == 101


# Inside: the order of what is due, and the count of what fires at one instant. The schedule knows
# no rclpy, so its timers here are plain objects.


@dataclass
class Timer:
    order: int
    remaining: int | None
    is_over: bool = False
    due_ns: int | None = None

    def remaining_ns(self):
        return self.remaining


def drain(schedule):
    order = []
    while schedule.next_due(0) is not None:
        order.append(schedule.pop().order)
    return order


@given(st.lists(st.integers(-5, 20), max_size=20))
def test_the_schedule_is_ordered_by_time_and_by_when_things_were_set(spans):
    schedule = Schedule()
    for number, span in enumerate(spans):
        schedule.add_timer(Timer(number, span), 0)
    wanted = sorted(range(len(spans)), key=lambda number: (max(0, spans[number]), number))
    assert drain(schedule) == wanted


def test_sleepers_and_timers_of_an_instant_keep_the_order_in_which_they_were_set():
    schedule = Schedule()
    schedule.add(Timer(3, None), 50)
    schedule.add_timer(Timer(4, 50), 0)
    schedule.add_timer(Timer(1, 50), 0)
    schedule.add(Timer(2, None), 50)
    assert drain(schedule) == [1, 2, 3, 4]


def test_a_timer_that_moved_is_there_once():
    schedule, timer = Schedule(), Timer(1, 100)
    for timer.remaining in (100, 5, 50, 7):
        schedule.add_timer(timer, 0)
    assert schedule.next_due(0) == 7
    assert drain(schedule) == [1]


def test_what_was_dropped_is_not_due():
    schedule, timer = Schedule(), Timer(1, 100)
    schedule.add_timer(timer, 0)
    schedule.drop(timer)
    assert schedule.next_due(0) is None


def test_timers_that_rest_come_back_and_those_that_are_over_do_not():
    schedule, resting = Schedule(), Timer(1, None)
    for timer in (resting, Timer(2, 2, is_over=True)):
        schedule.add_timer(timer, 0)
    assert schedule.next_due(0) is None
    resting.remaining = 3
    assert drain(schedule) == [1]


def test_time_that_passes_resets_the_count():
    guard = ChainGuard()

    def fire(times):
        for _ in range(times):
            guard.timer_fires("/node", "tick")

    for _ in range(3):
        fire(schedule.MOST_FIRINGS)
        guard.instant_ends()
    with pytest.raises(EndlessChainError):
        fire(schedule.MOST_FIRINGS + 1)


def test_the_recorder_keeps_the_real_clock_while_nodes_run(ros):
    real, seen = recording.monotonic, []  # it reads the clock for each callback
    ros.add(partial(Doer, lambda node: seen.append(recording.monotonic)))
    ros.run(1)
    assert seen
    assert set(seen) == {real}
