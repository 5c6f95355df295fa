"""Services, parameters, tasks and everything else that is neither a timer nor a topic."""

from contextlib import nullcontext
from functools import partial

import pytest
import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger

from distributions import IS_KILTED
from nodes import SECOND, AsyncDoer, Doer, Server, Ticker, since_start
from rosbeat.errors import EndlessChainError, NodeConstructionError, SessionError


class Client(Node):
    def __init__(self, name="client", service="ask"):
        super().__init__(name)
        self.client = self.create_client(Trigger, service)
        self.answers = []
        self.create_timer(1.0, self.ask)

    def ask(self):
        self.client.call_async(Trigger.Request()).add_done_callback(self.answered)

    def answered(self, future):
        self.answers.append((since_start(self), future.result().message))


def test_a_question_is_answered_in_no_time(ros):
    ros.add(Server)
    client = ros.add(Client)
    ros.run(3)
    assert client.answers == [(SECOND, "1"), (2 * SECOND, "2"), (3 * SECOND, "3")]
    kinds = [(run.kind, run.name) for run in ros.observation().callbacks[:4]]
    assert kinds[:3] == [("timer", "ask"), ("service", "answer"), ("client", "answer")]


def test_call_in_a_cell_runs_virtual_time(ros):
    ros.add(Server)
    client = ros.add(lambda: Node("asker")).create_client(Trigger, "ask")
    assert client.call(Trigger.Request()).message == "1"
    assert ros.time == 0
    assert client.call(Trigger.Request(), timeout_sec=1.0).message == "2"


def test_call_without_a_server(ros, says):
    client = ros.add(lambda: Node("asker")).create_client(Trigger, "nothing")
    with pytest.raises(TimeoutError) if IS_KILTED else nullcontext():
        assert client.call(Trigger.Request(), timeout_sec=2.0) is None
    assert ros.time == 2
    with pytest.raises(SessionError) as caught:
        client.call(Trigger.Request())
    says(caught.value, "No node has responded to the call of /nothing")


def test_a_constructor_that_calls_is_explained(ros, says):
    server = ros.add(Server)

    class Curious(Node):
        def __init__(self):
            super().__init__("curious")
            client = self.create_client(Trigger, "ask")
            self.answer = client.call(Trigger.Request()).message

    with pytest.raises(NodeConstructionError) as caught:
        ros.add(Curious)
    says(caught.value, "/curious calls /ask before the node itself runs")
    assert server.asked == 0


def test_tasks_that_make_tasks_for_ever_are_stopped(ros, says, monkeypatch):
    monkeypatch.setattr("rosbeat.ros.schedule.MOST_TURNS", 1_000)

    def do(node):
        node.executor.create_task(do, node)

    ros.add(partial(Doer, do))
    with pytest.raises(EndlessChainError) as caught:
        ros.run(1)
    says(caught.value, "/doer")


def test_closing_while_a_coroutine_waits_runs_its_finally(ros):
    ends = []

    async def do(_):
        try:
            await rclpy.task.Future()
        finally:
            ends.append("finally")

    ros.add(partial(AsyncDoer, do))
    ros.run(1)
    assert ends == []
    ros.remove("doer")
    assert ends == ["finally"]


def test_create_task(ros):
    log = []
    node = ros.add(lambda: Node("worker"))
    task = node.executor.create_task(lambda number: log.append(number) or number, 7)
    assert not log
    ros.run(0)
    assert log == [7]
    assert task.result() == 7


def test_a_guard_condition_runs_through_rclpy(ros):
    node = ros.add(lambda: Node("guarded"))
    log = []
    guard = node.create_guard_condition(lambda: log.append(ros.time))
    ros.add(partial(Doer, lambda _: guard.trigger()))
    ros.run(3)
    assert log == [1, 2, 3]
    runs = [run for run in ros.observation().callbacks if run.kind == "guard condition"]
    assert [(run.node, run.time) for run in runs] == [("/guarded", n) for n in (1, 2, 3)]


def test_an_exception_in_a_guard_condition(ros, capsys):
    node = ros.add(lambda: Node("guarded"))
    guard = node.create_guard_condition(lambda: 1 / 0)
    guard.trigger()
    ros.run(1)
    (fault,) = ros.observation().faults
    assert (fault.node, fault.kind, fault.callback) == ("/guarded", "ZeroDivisionError", "<lambda>")
    capsys.readouterr()


def test_rate_sleeps_in_virtual_time(ros):
    node = ros.add(lambda: Node("steady"))
    ticker = ros.add(partial(Ticker, 0.1))
    rate = node.create_rate(2.0)
    for _ in range(4):
        rate.sleep()
    assert ros.time == 2.0
    assert len(ticker.fired) == 20
