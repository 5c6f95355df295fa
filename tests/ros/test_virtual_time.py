"""Time jumps from one deadline to the next, and everything due runs in order."""

from functools import partial

import pytest
from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from std_msgs.msg import Empty, Int32

from nodes import SECOND, Doer, Listener, Relay, Talker, Ticker
from rosbeat import Session
from rosbeat.errors import EndlessChainError


def test_a_timer_fires_once_a_period_and_the_end_belongs_to_the_run(ros):
    ticker = ros.add(partial(Ticker, 1.0))
    ros.run(60)
    assert ticker.times() == [n * SECOND for n in range(1, 61)]
    assert ros.time == 60


@pytest.mark.parametrize("period", [0.001, 0.007, 0.1, 1 / 3, 1.0, 2.5, 7.77])
def test_any_period(ros, period):
    ticker = ros.add(partial(Ticker, period))
    ros.run(10)
    step = int(period * SECOND)
    assert ticker.times() == list(range(step, 10 * SECOND + 1, step))


def test_coprime_periods_interleave_by_deadline_and_then_by_creation(ros):
    ticker = ros.add(partial(Ticker, 0.7, 0.3, 0.21))
    ros.run(21)
    wanted = sorted(
        (at, number)
        for number, step in enumerate((700, 300, 210))
        for at in range(step * 1_000_000, 21 * SECOND + 1, step * 1_000_000)
    )
    assert ticker.fired == wanted


def test_a_nanosecond(ros):
    ticker = ros.add(partial(Ticker, 1e-9))
    ros.run(2e-6)
    assert ticker.times() == list(range(1, 2001))


def test_a_year_costs_nothing(ros):
    ticker = ros.add(partial(Ticker, 86_400.0 * 100))
    ros.run(86_400 * 365)
    assert [at // SECOND // 86_400 for at in ticker.times()] == [100, 200, 300]


def test_run_zero_does_nothing_at_the_beginning(ros):
    ticker = ros.add(partial(Ticker, 1.0))
    ros.run(0)
    assert not ticker.fired
    assert ros.time == 0


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


def test_timers_made_in_a_callback_count_from_then(ros):
    def do(node):
        node.timer.cancel()
        node.made = node.create_timer(0.4, lambda: node.seen.append(ros.time))

    doer = ros.add(partial(Doer, do))
    doer.seen = []
    ros.run(2)
    assert doer.seen == [1.4, 1.8]


def test_a_timer_cancels_itself_and_is_reset_by_another_node(ros):
    ticker = ros.add(partial(Ticker, 1.0))

    def do(node):
        ticker.clocks[0].cancel() if ros.time == 2 else ticker.clocks[0].reset()

    ros.add(partial(Doer, do, period=2.0))
    ros.run(7)
    # At 2 s the ticker comes first; then it is canceled, until it is reset at 4 s and at 6 s.
    assert [at // SECOND for at in ticker.times()] == [1, 2, 5, 6, 7]


def test_a_timer_reset_in_its_own_callback_goes_on(ros):
    doer = ros.add(partial(Doer, lambda node: node.timer.reset(), period=0.5))
    ros.run(5)
    assert doer.timer.time_until_next_call() == SECOND // 2
    assert len([run for run in ros.observation().callbacks if run.name == "act"]) == 10


def test_a_shorter_period_takes_effect_with_a_reset(ros):
    ticker = ros.add(partial(Ticker, 100.0))

    def do(node):
        node.timer.cancel()
        ticker.clocks[0].timer_period_ns = SECOND
        ticker.clocks[0].reset()

    ros.add(partial(Doer, do, period=0.5))
    ros.run(5)
    assert ticker.times() == [SECOND * n + SECOND // 2 for n in range(1, 5)]


def test_a_new_period_without_reset_counts_after_the_next_call(ros):
    ticker = ros.add(partial(Ticker, 2.0))
    ticker.clocks[0].timer_period_ns = SECOND
    ros.run(5)
    assert [at // SECOND for at in ticker.times()] == [2, 3, 4, 5]


def test_a_timer_destroyed_in_a_callback_never_fires_again(ros):
    ticker = ros.add(partial(Ticker, 1.0, 1.0))

    def do(node):
        node.timer.cancel()
        ticker.destroy_timer(ticker.clocks[1])

    ros.add(partial(Doer, do, period=2.5))
    ros.run(6)
    assert len(ticker.times(0)) == 6
    assert len(ticker.times(1)) == 2


def test_a_timer_destroyed_in_its_own_callback(ros):
    doer = ros.add(partial(Doer, lambda node: node.destroy_timer(node.timer)))
    ros.run(5)
    assert [run.time for run in ros.observation().callbacks] == [1.0]
    assert doer.timer not in list(doer.timers)


def test_a_timer_started_later(ros):
    class Late(Node):
        def __init__(self):
            super().__init__("late")
            self.seen = []
            self.timer = self.create_timer(1.0, lambda: self.seen.append(ros.time), autostart=False)

    late = ros.add(Late)
    ros.run(3)
    assert late.seen == []
    late.timer.reset()
    ros.run(2)
    assert late.seen == [4, 5]


def test_a_timer_on_the_wall_clock_waits_for_live_mode(ros, capsys):
    class Wall(Node):
        def __init__(self):
            super().__init__("wall")
            self.seen = 0
            clock = Clock(clock_type=ClockType.STEADY_TIME)
            self.create_timer(0.01, self.tick, clock=clock)

        def tick(self):
            self.seen += 1

    wall = ros.add(Wall)
    assert "fires only while the session is live" in capsys.readouterr().out
    ros.run(100)
    assert wall.seen == 0
    ros.start()
    assert ros.wait(10, until=lambda: wall.seen > 2)


def test_a_node_that_destroys_itself_ends_there(ros):
    ros.add(partial(Doer, lambda node: node.destroy_node()))
    other = ros.add(partial(Ticker, 1.0))
    ros.run(4)
    assert [node.get_name() for node in ros.nodes] == ["ticker"]
    assert len(other.fired) == 4


def test_messages_arrive_at_the_instant_they_were_sent(ros):
    ros.add(partial(Talker, period=0.25))
    listener = ros.add(Listener)
    ros.run(1)
    assert listener.heard == [1, 2, 3, 4]
    assert listener.times == [n * SECOND // 4 for n in (1, 2, 3, 4)]


def test_a_chain_of_a_hundred_nodes_takes_no_time(ros):
    ros.add(partial(Talker, topic="t0"))
    for step in range(100):
        ros.add(partial(Relay, f"relay{step}", f"t{step}", f"t{step + 1}"))
    end = ros.add(partial(Listener, topic="t100"))
    ros.run(3)
    assert end.heard == [101, 102, 103]
    assert end.times == [SECOND, 2 * SECOND, 3 * SECOND]


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


def test_a_circle_that_doubles_is_found_too(ros, says):
    ros.add(partial(Relay, "ping", "a", "b", copies=2))
    ros.add(partial(Relay, "pong", "b", "a", copies=2))
    ros.add(partial(Talker, topic="a"))
    with pytest.raises(EndlessChainError) as caught:
        ros.run(2)
    says(caught.value, "/ping", "/pong")


def test_a_node_that_talks_to_itself(ros, says):
    ros.add(partial(Relay, "echo", "a", "a"))
    ros.add(partial(Talker, topic="a"))
    with pytest.raises(EndlessChainError) as caught:
        ros.run(2)
    says(caught.value, "/echo (/a) -> /echo (/a)")


def test_wide_bursts_are_no_circle(ros):
    everything = QoSProfile(depth=4_000)  # Fast DDS holds 5,000
    ros.add(partial(Talker, burst=4_000, qos=everything))
    listeners = [ros.add(partial(Listener, f"ear{n}", qos=everything)) for n in range(3)]
    ros.run(2)
    for listener in listeners:
        assert listener.heard == list(range(1, 8_001))


@pytest.mark.parametrize("depth", [1, 5, 10])
def test_a_queue_keeps_the_last(ros, depth):
    ros.add(partial(Talker, burst=20))
    listener = ros.add(partial(Listener, qos=depth))
    ros.run(1)
    assert listener.heard == list(range(21 - depth, 21))
    ros.run(1)
    assert listener.heard[depth:] == list(range(41 - depth, 41))


@pytest.mark.parametrize("reliability", list(ReliabilityPolicy)[1:3])
def test_best_effort_and_reliable(ros, reliability):
    qos = QoSProfile(depth=7, reliability=reliability)
    ros.add(partial(Talker, burst=3, qos=qos))
    listener = ros.add(partial(Listener, qos=qos))
    ros.run(5)
    assert listener.heard == list(range(1, 16))


def test_a_qos_that_does_not_fit_delivers_nothing(ros):
    ros.add(partial(Talker, qos=QoSProfile(depth=5, reliability=ReliabilityPolicy.BEST_EFFORT)))
    listener = ros.add(Listener)
    ros.run(5, quiet=True)
    assert listener.heard == []
    assert [end.matched for end in ros.graph().on("/count", "publisher")] == [0]


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


def test_publishing_in_a_cell_is_heard_in_the_next_run(ros):
    talker, listener = ros.add(partial(Talker, period=100.0)), ros.add(Listener)
    talker.talk()
    talker.talk()
    assert listener.heard == []
    ros.run(0)
    assert listener.heard == [1, 2]


def test_what_was_sent_before_the_node_was_added_waits_in_its_queue(ros):
    listener = Listener()
    talker = ros.add(partial(Talker, period=100.0))
    talker.talk()
    ros.run(1)
    assert listener.heard == []
    ros.add(listener)
    ros.run(0)
    assert listener.heard == [1]


def test_a_subscription_made_and_destroyed_in_callbacks(ros):
    ros.add(partial(Talker, period=1.0))

    def do(node):
        if ros.time == 3.5:
            node.heard = []
            node.ear = node.create_subscription(Int32, "count", node.heard.append, 10)
        if ros.time == 7.0:
            node.destroy_subscription(node.ear)

    doer = ros.add(partial(Doer, do, period=0.5))
    ros.run(10)
    assert [message.data for message in doer.heard] == [4, 5, 6, 7]


def test_a_message_without_fields(ros):
    heard = []
    node = ros.add(lambda: Node("empty"))
    node.create_subscription(Empty, "beep", heard.append, 10)
    publisher = node.create_publisher(Empty, "beep", 10)
    publisher.publish(Empty())
    ros.run(0)
    assert len(heard) == 1
    assert [sample.data for sample in ros.messages("beep")] == [{}]


def test_the_order_of_callbacks_does_not_depend_on_the_set_of_nodes():
    def order():
        with Session() as ros:
            for name in "delta", "alpha", "echo", "bravo", "charlie":
                ros.add(partial(Ticker, 1.0, name=name))
            ros.run(2)
            return [run.node for run in ros.observation().callbacks]

    assert order() == ["/delta", "/alpha", "/echo", "/bravo", "/charlie"] * 2


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


def test_an_interrupted_subscription_gets_the_next_message_in_time(ros):
    class Once(Listener):
        def listen(self, message):
            super().listen(message)
            if message.data == 2:
                raise KeyboardInterrupt

    ros.add(partial(Talker, burst=3))
    listener = ros.add(Once)
    with pytest.raises(KeyboardInterrupt):
        ros.run(1)
    ros.run(1)
    assert listener.heard == [1, 2, 3, 4, 5, 6]
    assert listener.times[3:] == [2 * SECOND] * 3


def test_no_wait_set_is_built_while_nothing_changes(ros, monkeypatch):
    ros.add(Talker)
    ros.add(Listener)
    ros.run(1)
    executor = ros.nodes[0].executor
    monkeypatch.setattr(executor, "wait_for_ready_callbacks", None)
    ros.run(100)
    assert len(ros.messages("count")) == 101
