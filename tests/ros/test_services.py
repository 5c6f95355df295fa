"""Services, parameters, tasks and everything else that is neither a timer nor a topic."""

from functools import partial

import pytest
import rclpy
from action_msgs.msg import GoalStatus
from rcl_interfaces.msg import SetParametersResult
from rcl_interfaces.srv import GetParameters
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.parameter_client import AsyncParameterClient
from std_srvs.srv import SetBool, Trigger

from action_nodes import Heater, Sender
from nodes import SECOND, AsyncDoer, Doer, Server, Ticker
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
        self.answers.append((self.get_clock().now().nanoseconds, future.result().message))


def test_a_question_is_answered_in_no_time(ros):
    ros.add(Server)
    client = ros.add(Client)
    ros.run(3)
    assert client.answers == [(SECOND, "1"), (2 * SECOND, "2"), (3 * SECOND, "3")]
    kinds = [(run.kind, run.name) for run in ros.observation().callbacks[:4]]
    assert kinds[:3] == [("timer", "ask"), ("service", "answer"), ("client", "answer")]


def test_two_clients_of_one_service_get_their_own_answers(ros):
    server = ros.add(Server)
    clients = [ros.add(partial(Client, name)) for name in ("one", "two")]
    ros.run(3)
    assert [text for _, text in clients[0].answers] == ["1", "3", "5"]
    assert [text for _, text in clients[1].answers] == ["2", "4", "6"]
    assert server.asked == 6


def test_call_in_a_cell_runs_virtual_time(ros):
    ros.add(Server)
    client = ros.add(lambda: Node("asker")).create_client(Trigger, "ask")
    assert client.call(Trigger.Request()).message == "1"
    assert ros.time == 0
    assert client.call(Trigger.Request(), timeout_sec=1.0).message == "2"


def test_call_without_a_server(ros, says):
    client = ros.add(lambda: Node("asker")).create_client(Trigger, "nothing")
    assert client.call(Trigger.Request(), timeout_sec=2.0) is None
    assert ros.time == 2
    with pytest.raises(SessionError) as caught:
        client.call(Trigger.Request())
    says(caught.value, "No node has responded to the call of /nothing")


def test_call_in_a_callback_is_explained(ros, capsys):
    ros.add(Server)

    class Waits(Client):
        def ask(self):
            self.client.call(Trigger.Request())

    ros.add(Waits)
    ros.run(1)
    (fault,) = ros.observation().faults
    assert fault.kind == "DeadlockError"
    assert "deadlock" in fault.text
    assert "call_async" in fault.text
    assert fault.code == "self.client.call(Trigger.Request())"
    assert capsys.readouterr().err.count("deadlock") == 1


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


def test_random_numbers_in_a_called_service_are_the_sessions():
    import random

    from rosbeat import Session

    class Dice(Server):
        def answer(self, request, response):
            response.message = str(random.random())
            return response

    def draw():
        with Session(seed=5) as ros:
            ros.add(Dice)
            client = ros.add(lambda: Node("asker")).create_client(Trigger, "ask")
            random.random()
            return [client.call(Trigger.Request()).message for _ in range(3)]

    assert draw() == draw()
    assert len(set(draw())) == 3


def test_spin_until_future_complete_runs_virtual_time(ros):
    ros.add(Server)
    node = ros.add(lambda: Node("asker"))
    future = node.create_client(Trigger, "ask").call_async(Trigger.Request())
    rclpy.spin_until_future_complete(node, future)
    assert future.result().message == "1"


class Patient(Node):
    """Awaits an answer in its callback."""

    def __init__(self, group=None):
        super().__init__("patient")
        self.client = self.create_client(Trigger, "ask", callback_group=group)
        self.log = []
        self.create_timer(1.0, self.ask)

    async def ask(self):
        self.log.append("asked")
        answer = await self.client.call_async(Trigger.Request())
        self.log.append(answer.message)


@pytest.mark.parametrize("group", [MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup])
def test_a_coroutine_awaits_an_answer(ros, group):
    ros.add(Server)
    patient = ros.add(partial(Patient, group()))
    ros.run(3)
    assert patient.log == ["asked", "1", "asked", "2", "asked", "3"]


def test_awaiting_in_the_only_callback_group_is_a_deadlock_but_the_run_ends(ros):
    ros.add(Server)
    patient = ros.add(Patient)
    ticker = ros.add(partial(Ticker, 1.0))
    ros.run(10)
    assert patient.log == ["asked"]
    assert len(ticker.fired) == 10
    assert ros.time == 10


def test_an_async_service_that_asks_another(ros):
    class Middle(Node):
        def __init__(self):
            super().__init__("middle")
            group = ReentrantCallbackGroup()
            self.client = self.create_client(Trigger, "ask", callback_group=group)
            self.create_service(SetBool, "forward", self.forward, callback_group=group)

        async def forward(self, request, response):
            answer = await self.client.call_async(Trigger.Request())
            response.success, response.message = request.data, f"heard {answer.message}"
            return response

    ros.add(Server)
    ros.add(Middle)
    client = ros.add(lambda: Node("asker")).create_client(SetBool, "forward")
    answer = client.call(SetBool.Request(data=True))
    assert (answer.success, answer.message) == (True, "heard 1")


def test_coroutines_wake_one_another_at_one_instant(ros):
    class Sleepers(Node):
        """The first to begin is the last to be woken."""

        def __init__(self):
            super().__init__("sleepers")
            self.log = []
            self.create_timer(1.0, self.go)

        def go(self):
            self.alarms = [rclpy.task.Future() for _ in range(6)]
            for number in range(5):
                self.executor.create_task(self.sleep, number)
            self.executor.create_task(self.begin)

        async def sleep(self, number):
            await self.alarms[number + 1]
            self.log.append((number, self.get_clock().now().nanoseconds))
            self.alarms[number].set_result(None)

        async def begin(self):
            self.alarms[5].set_result(None)
            await rclpy.task.Future()

    sleepers = ros.add(Sleepers)
    ros.run(1)
    assert sleepers.log == [(number, SECOND) for number in (4, 3, 2, 1, 0)]


def test_tasks_that_make_tasks_for_ever_are_stopped(ros, says):
    def do(node):
        node.executor.create_task(do, node)

    ros.add(partial(Doer, do))
    with pytest.raises(EndlessChainError) as caught:
        ros.run(1)
    says(caught.value, "/doer")


def test_services_that_ask_each_other_for_ever_are_stopped(ros, says):
    class Both(Node):
        def __init__(self, name, mine, theirs):
            super().__init__(name)
            self.client = self.create_client(Trigger, theirs)
            self.create_service(Trigger, mine, self.answer)
            self.create_timer(1.0, lambda: self.answer(None, None))

        def answer(self, _, response):
            self.client.call_async(Trigger.Request())
            return response

    ros.add(partial(Both, "ping", "a", "b"))
    ros.add(partial(Both, "pong", "b", "a"))
    with pytest.raises(EndlessChainError) as caught:
        ros.run(1)
    says(caught.value, "/ping", "/pong")


def test_a_callback_that_goes_on_awaiting_does_not_keep_time_from_passing(ros):
    async def do(_):
        await rclpy.task.Future()

    ros.add(partial(AsyncDoer, do))
    ticker = ros.add(partial(Ticker, 1.0))
    ros.run(5)
    assert len(ticker.fired) == 5


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


def test_a_parameter_is_set_with_its_callback(ros):
    node = ros.add(lambda: Node("chosen"))
    node.declare_parameter("rate", 1.0)
    seen = []

    def check(parameters):
        seen.extend(parameter.value for parameter in parameters)
        return SetParametersResult(successful=parameters[0].value < 10, reason="too fast")

    node.add_on_set_parameters_callback(check)
    assert node.set_parameters([Parameter("rate", value=2.0)])[0].successful
    assert not node.set_parameters([Parameter("rate", value=20.0)])[0].successful
    assert node.get_parameter("rate").value == 2.0
    assert seen == [2.0, 20.0]


def test_one_node_sets_the_parameter_of_another(ros):
    node = ros.add(lambda: Node("chosen"))
    node.declare_parameter("rate", 1)
    asker = ros.add(lambda: Node("asker"))
    client = AsyncParameterClient(asker, "chosen")
    future = client.set_parameters([Parameter("rate", value=5)])
    rclpy.spin_until_future_complete(asker, future)
    assert future.result().results[0].successful
    assert node.get_parameter("rate").value == 5
    future = client.get_parameters(["rate"])
    rclpy.spin_until_future_complete(asker, future)
    assert future.result().values[0].integer_value == 5


def test_a_parameter_service_is_a_service(ros):
    ros.add(lambda: Node("chosen"))
    client = ros.add(lambda: Node("asker")).create_client(GetParameters, "chosen/get_parameters")
    answer = client.call(GetParameters.Request(names=["use_sim_time"]))
    assert answer.values[0].bool_value is True


def test_a_guard_condition_runs_through_rclpy(ros):
    node = ros.add(lambda: Node("guarded"))
    log = []
    guard = node.create_guard_condition(lambda: log.append(ros.time))
    ros.add(partial(Doer, lambda _: guard.trigger()))
    ros.run(3)
    assert log == [1, 2, 3]
    runs = [run for run in ros.observation().callbacks if run.kind == "guard condition"]
    assert [(run.node, run.time) for run in runs] == [("/guarded", n) for n in (1, 2, 3)]


def test_a_message_from_a_guard_condition_arrives_at_once(ros):
    from nodes import Listener, Talker

    talker, listener = ros.add(partial(Talker, period=100.0)), ros.add(Listener)
    guard = talker.create_guard_condition(talker.talk)
    ros.add(partial(Doer, lambda _: guard.trigger()))
    ros.run(2)
    assert listener.times == [SECOND, 2 * SECOND]


def test_an_exception_in_a_guard_condition(ros, capsys):
    node = ros.add(lambda: Node("guarded"))
    guard = node.create_guard_condition(lambda: 1 / 0)
    guard.trigger()
    ros.run(1)
    (fault,) = ros.observation().faults
    assert (fault.node, fault.kind, fault.callback) == ("/guarded", "ZeroDivisionError", "<lambda>")
    capsys.readouterr()


def test_actions(ros):
    server = ros.add(Heater)
    client = ros.add(Sender)
    client.send(3)
    ros.run(10)
    assert client.log == [
        (0, "accepted"),
        *((second, [*range(1, second + 1)]) for second in (1, 2, 3)),
        (3, (GoalStatus.STATUS_SUCCEEDED, [1, 2, 3])),
    ]
    assert server.done == 1


def test_rate_sleeps_in_virtual_time(ros):
    node = ros.add(lambda: Node("steady"))
    ticker = ros.add(partial(Ticker, 0.1))
    rate = node.create_rate(2.0)
    for _ in range(4):
        rate.sleep()
    assert ros.time == 2.0
    assert len(ticker.fired) == 20


def test_rate_sleep_in_a_callback_is_explained(ros, capsys):
    def do(node):
        node.create_rate(2.0).sleep()

    ros.add(partial(Doer, do))
    ros.run(2)
    (fault,) = ros.observation().faults
    assert "create a timer" in fault.text
    capsys.readouterr()


def test_rate_sleeps_live(ros):
    rate = ros.add(lambda: Node("steady")).create_rate(50.0)
    ros.start()
    rate.sleep()
    rate.sleep()
    assert ros.time >= 0.03


def test_a_coroutine_that_nobody_awaits_does_not_run(ros):
    log = []

    async def forgotten(_):
        log.append("ran")

    ros.add(partial(Doer, forgotten))
    with pytest.warns(RuntimeWarning, match="never awaited"):
        ros.run(1)
    assert log == []
