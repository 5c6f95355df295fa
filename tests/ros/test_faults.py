"""An exception in a callback: shown once, with the learner's own line; the others go on."""

from functools import partial

import pytest
from rclpy.node import Node
from std_srvs.srv import Trigger

from nodes import Doer, Listener, Server, Speaker, Talker, Ticker
from rosbeat.errors import SessionError
from rosbeat.ros.faults import fault_of, learners_line


class Bomb(Listener):
    def listen(self, message):
        raise ZeroDivisionError("boom")


class AsyncBomb(Listener):
    async def listen(self, message):
        raise ZeroDivisionError("boom")


class Broken(Server):
    def answer(self, request, response):
        raise ZeroDivisionError("boom")


class Quits(Listener):
    def listen(self, message):
        raise SystemExit(3)


class AsyncQuits(Listener):
    async def listen(self, message):
        raise SystemExit(3)


@pytest.mark.parametrize("kind", [Bomb, AsyncBomb, Quits, AsyncQuits])
def test_a_fault_in_a_subscription(ros, kind, capsys):
    ros.add(Talker)
    ros.add(kind)
    ticker = ros.add(partial(Ticker, 1.0))
    ros.run(5)
    ros.run(5)
    (fault,) = ros.observation().faults
    assert (fault.node, fault.callback, fault.time) == ("/listener", "listen", 1.0)
    assert fault.kind in ("ZeroDivisionError", "SystemExit")
    assert fault.code.startswith("raise ")
    assert len(ticker.fired) == 10
    shown = capsys.readouterr().err
    assert shown.count("/listener stopped at 1.000 s, in listen") == 1
    assert f"line {fault.line}: {fault.code}" in shown
    assert "What it means" in shown
    assert "What to try" in shown


def test_a_fault_in_a_timer_and_the_node_made_again(ros, capsys):
    ros.add(partial(Doer, lambda node: {}["missing"]))
    ros.run(3)
    (fault,) = ros.observation().faults
    assert (fault.kind, fault.text, fault.callback) == ("KeyError", "'missing'", "act")
    assert "{}" in fault.code
    with pytest.raises(SessionError, match="cannot go on"):
        ros.resume("doer")
    done = []
    ros.add(partial(Doer, done.append))
    ros.run(3)
    assert len(done) == 3
    assert len(ros.observation().faults) == 1
    assert capsys.readouterr().err.count("stopped at") == 1


def test_a_fault_in_a_service_leaves_the_client_waiting(ros, capsys):
    ros.add(Broken)
    node = ros.add(lambda: Node("asker"))
    future = node.create_client(Trigger, "ask").call_async(Trigger.Request())
    ros.run(1)
    assert not future.done()
    (fault,) = ros.observation().faults
    assert (fault.node, fault.callback) == ("/server", "answer")
    assert "boom" in capsys.readouterr().err


def test_a_fault_in_a_done_callback(ros, capsys):
    ros.add(Server)

    class Asker(Node):
        def __init__(self):
            super().__init__("asker")
            self.client = self.create_client(Trigger, "ask")
            self.create_timer(1.0, self.ask)

        def ask(self):
            self.client.call_async(Trigger.Request()).add_done_callback(self.answered)

        def answered(self, future):
            raise ZeroDivisionError("boom")

    ros.add(Asker)
    ros.run(3)
    (fault,) = ros.observation().faults
    assert (fault.node, fault.callback) == ("/asker", "answered")
    capsys.readouterr()


def test_a_callback_that_takes_no_message(ros, capsys):
    ros.add(Talker)
    node = ros.add(Listener)
    node.subscription._callback = None
    ros.add(partial(Doer, lambda node: node.nothing()))
    ros.run(1)
    kinds = {fault.kind for fault in ros.observation().faults}
    assert "AttributeError" in kinds
    capsys.readouterr()


def test_a_timer_without_a_callback(ros, capsys):
    node = ros.add(lambda: Node("forgetful"))
    node.create_timer(1.0, None)
    ros.run(1)
    (fault,) = ros.observation().faults
    assert fault.text == "'NoneType' object is not callable"
    capsys.readouterr()


def test_a_fault_after_an_await(ros, capsys):
    class Asker(Node):
        def __init__(self):
            from rclpy.callback_groups import ReentrantCallbackGroup

            super().__init__("asker")
            self.client = self.create_client(
                Trigger, "ask", callback_group=ReentrantCallbackGroup()
            )
            self.create_timer(1.0, self.ask)

        async def ask(self):
            await self.client.call_async(Trigger.Request())
            raise ZeroDivisionError("boom")

    ros.add(Server)
    ros.add(Asker)
    ros.run(5)
    (fault,) = ros.observation().faults
    assert (fault.node, fault.callback) == ("/asker", "ask")
    assert fault.code == 'raise ZeroDivisionError("boom")'
    assert "never retrieved" not in capsys.readouterr().err


def test_logs_of_the_fault_s_instant_come_before_it(ros, capsys):
    def do(node):
        node.get_logger().warning("now")
        raise ZeroDivisionError("boom")

    ros.add(Speaker)
    ros.add(partial(Doer, do))
    ros.run(1)
    printed = capsys.readouterr()
    assert printed.out.splitlines() == [
        "[INFO] [1.000] [speaker]: here is speaker",
        "[WARN] [1.000] [doer]: now",
    ]


def test_the_innermost_own_line():
    def outer():
        inner()

    def inner():
        return int("no number")

    with pytest.raises(ValueError, match="no number") as caught:
        outer()
    line, code = learners_line(caught.value)
    assert code == 'return int("no number")'
    assert line > 0


def test_no_line_is_better_than_a_wrong_one():
    assert learners_line(ValueError("never raised")) == (0, "")


def test_an_error_that_misleads_is_translated(ros, capsys):
    def do(node):
        node.create_publisher(float, "temperature", 10)

    ros.add(partial(Doer, do))
    ros.run(1)
    shown = capsys.readouterr().err
    assert "What it means: In the place of the message type stands the type float" in shown
    assert "ends its node" in shown
    assert "Then run the cell that adds the node again." in shown


def test_an_error_that_nobody_knows_is_left_as_it_is(ros, capsys):
    def do(node):
        raise ValueError("one, at /two\nthree")

    ros.add(partial(Doer, do))
    ros.run(1)
    shown = capsys.readouterr().err
    assert "ValueError: one, at /two\nthree\n" in shown
    assert "What it means: an exception that leaves a callback" in shown


def test_the_line_is_the_one_that_calls_the_callback_too_early():
    class Hasty:
        def __init__(self):
            self.create_timer(1.0, self.tick())

        def create_timer(self, period, callback):
            pass

        def tick(self):
            return self.temperature

    with pytest.raises(AttributeError) as caught:
        Hasty()
    fault = fault_of(caught.value, 0, "", "__init__")
    assert fault.code == "self.create_timer(1.0, self.tick())"
    assert fault.asked == "create(called[tick])"
