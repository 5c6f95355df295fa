"""Exceptions: the learner's own line, the call that failed, and a suggestion."""

import math
import random
from functools import partial

import pytest
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.node import Node
from rclpy.qos import QoSProfile
from std_msgs.msg import Float32
from std_srvs.srv import Trigger

from failed_calls import failed_call
from nodes import Doer, Listener, Server, Talker, Ticker
from rosbeat.errors import SessionError
from rosbeat.ros.exception_origin import failed_call as described
from rosbeat.ros.exception_origin import fault_of, suggestion

pytestmark = pytest.mark.ros

# An exception in a callback: shown once, with the learner's own line; the others go on.


def bomb(error):
    """A listener whose callback raises, as a function or as a coroutine."""

    class Bomb(Listener):
        def listen(self, message):
            raise error

    class AsyncBomb(Listener):
        async def listen(self, message):
            raise error

    return Bomb, AsyncBomb


@pytest.mark.parametrize("kind", [*bomb(ZeroDivisionError("boom")), *bomb(SystemExit(3))])
def test_a_fault_in_a_subscription(ros, kind, capsys):
    ros.add(Talker)
    ros.add(kind)
    ticker = ros.add(partial(Ticker, 1.0))
    ros.run(5)
    ros.run(5)
    (fault,) = ros.observation().faults
    assert (fault.node, fault.callback, fault.time) == ("/listener", "listen", 1.0)
    assert fault.kind in ("ZeroDivisionError", "SystemExit")
    assert fault.code == "raise error"
    assert len(ticker.fired) == 10
    shown = capsys.readouterr().err
    assert shown.count("/listener stopped at 1.000 s, in listen") == 1
    assert f"line {fault.line}: {fault.code}" in shown
    assert "What it means" in shown
    assert "What to try" in shown


class Asker(Node):
    """Asks a server of the session once a second; raises when it has been answered."""

    def __init__(self):
        super().__init__("asker")
        self.client = self.create_client(Trigger, "ask", callback_group=ReentrantCallbackGroup())
        self.create_timer(1.0, self.ask)

    def ask(self):
        self.client.call_async(Trigger.Request()).add_done_callback(self.answered)

    def answered(self, future):
        raise ZeroDivisionError("boom")


class AwaitingAsker(Asker):
    async def ask(self):
        await self.client.call_async(Trigger.Request())
        raise ZeroDivisionError("boom")


class Broken(Server):
    def answer(self, request, response):
        raise ZeroDivisionError("boom")


@pytest.mark.parametrize(
    ("server", "asker", "place"),
    [(Broken, Asker, ("/server", "answer")), (Server, Asker, ("/asker", "answered")),
     (Server, AwaitingAsker, ("/asker", "ask"))],
)  # fmt: skip
def test_a_fault_around_a_service(ros, capsys, server, asker, place):
    ros.add(server)
    ros.add(asker)
    ros.run(5)
    (fault,) = ros.observation().faults
    assert (fault.node, fault.callback) == place
    assert fault.code == 'raise ZeroDivisionError("boom")'
    shown = capsys.readouterr().err
    assert "boom" in shown
    assert "never retrieved" not in shown


def test_a_fault_in_a_timer_and_the_node_made_again(ros, capsys):
    ros.add(partial(Doer, lambda node: {}["missing"]))
    ros.run(3)
    (fault,) = ros.observation().faults
    assert (fault.kind, fault.text, fault.callback) == ("KeyError", "'missing'", "act")
    assert "{}" in fault.code
    with pytest.raises(SessionError, match="cannot be resumed"):
        ros.resume("doer")
    done = []
    ros.add(partial(Doer, done.append))
    ros.run(3)
    assert len(done) == 3
    assert len(ros.observation().faults) == 1
    assert capsys.readouterr().err.count("stopped at") == 1


def test_an_error_that_misleads_is_translated(ros, capsys):
    def do(node):
        node.create_publisher(float, "temperature", 10)

    ros.add(partial(Doer, do))
    ros.run(1)
    shown = capsys.readouterr().err
    assert (
        "What it means: The message type is missing: this call got the type float instead." in shown
    )
    assert "ends its node" in shown
    assert "Then run the cell that adds the node again." in shown


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
    assert fault.asked == failed_call("create(called[tick])")


# The call of rclpy that failed is noted on the exception, without calling what it was given.


class Deceiver:
    """Anything that describes it by asking it is deceived."""

    @property
    def __code__(self):
        raise RuntimeError("boom")

    def __repr__(self):
        raise RuntimeError("boom")

    def listen(self, msg):
        pass


@pytest.mark.parametrize(
    ("given", "words"),
    [
        (Float32, "message_type[Float32]"),
        (Float32(), "message[Float32]"),
        (float, "type[float]"),
        ("temperature", "str"),
        (10, "int"),
        (True, "bool"),
        (1.0, "float"),
        (None, "NoneType"),
        (math, "module"),
        (print, "builtin_function_or_method"),
        (partial(print, 1), "partial"),
        (QoSProfile(depth=1), "QoSProfile"),
        (lambda msg: msg, "function[function(msg)]"),
        (Deceiver().listen, "method[listen(self, msg)]"),
        (Deceiver(), "Deceiver"),
    ],
)
def test_how_a_thing_is_described(given, words):
    assert described("f", (given,), {"by": given}) == failed_call(f"f({words}, by={words})")


def raise_own(_):
    raise ValueError("boom")


@pytest.mark.parametrize(
    ("do", "asked"),
    [
        (lambda node: node.create_publisher(Float32, "temperature"),
         "create_publisher(message_type[Float32], str)"),
        (raise_own, None),
    ],
)  # fmt: skip
def test_a_node_s_failing_calls_are_noted_and_errors_of_its_own_are_not(ros, capsys, do, asked):
    ros.add(partial(Doer, do))
    ros.run(1)
    (fault,) = ros.observation().faults
    assert fault.asked == (asked and failed_call(asked))
    capsys.readouterr()


# What was meant by a name that does not exist.


class Pretender:
    def __dir__(self):
        raise RuntimeError("boom")

    def __getattr__(self, name):
        raise AttributeError(f"no {name}", name=name, obj=self)


class Sensor(Node):
    def __init__(self):
        super().__init__("sensor")
        self.temperature, self.publisher_ = 22.0, None

    def publish_temperature(self):
        pass

    def use(self):
        publish_temperature()  # noqa: F821


def error_of(call):
    with pytest.raises((AttributeError, NameError)) as caught:
        call()
    return caught.value


@pytest.mark.parametrize(
    ("call", "meant"),
    [
        (lambda node: node.temprature, "temperature"),
        (lambda node: node.publisher, "publisher_"),
        (lambda node: node.publish_pressure, "publish_temperature"),
        (lambda node: node.read_pressure, ""),
        (lambda node: node.publsh_temperature, "publish_temperature"),
        (lambda node: node.create_publisherr, "create_publisher"),
        (lambda node: node.timerss, ""),
        (lambda node: node.temp, ""),
        (lambda node: node.use(), "self.publish_temperature"),
        (lambda node: random.unifrom(0, 1), "uniform"),
        (lambda node: nodee, "node"),  # noqa: F821
        (lambda node: ____, ""),  # noqa: F821
        (lambda node: Pretender().anything, ""),
    ],
)
def test_what_was_meant(ros, call, meant):
    node = ros.add(Sensor)
    assert suggestion(error_of(lambda: call(node))) == meant


def test_other_errors_have_none():
    assert suggestion(KeyError("temprature")) == ""
    assert suggestion(NameError("never raised", name="x")) == ""
