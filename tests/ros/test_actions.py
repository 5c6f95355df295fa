"""Actions in virtual time: the same each time, seen in the graph, explained where they wait."""

from functools import partial
from typing import Any

import pytest
from action_msgs.msg import GoalStatus, GoalStatusArray
from rclpy.action import ActionClient, ActionServer, CancelResponse, GoalResponse
from rclpy.exceptions import InvalidHandle
from rclpy.node import Node
from rclpy.task import Future
from test_msgs.action import Fibonacci

from nodes import since_start
from rosbeat import Session
from rosbeat.errors import SessionError

pytestmark = pytest.mark.ros
SUCCEEDED, CANCELED = GoalStatus.STATUS_SUCCEEDED, GoalStatus.STATUS_CANCELED
ABORTED = GoalStatus.STATUS_ABORTED


class Heater(Node):
    """Counts the seconds of a goal, from 1 to 9, one at a time."""

    def __init__(self, name: str = "heater", action: str = "heat") -> None:
        super().__init__(name)
        self.done = 0
        self.tick = Future()
        self.create_timer(1.0, self.next_tick)
        self.server = ActionServer(
            self,
            Fibonacci,
            action,
            self.heat,
            goal_callback=self.decide,
            cancel_callback=lambda _: CancelResponse.ACCEPT,
        )

    def next_tick(self) -> None:
        self.tick.set_result(None)
        self.tick = Future()

    def decide(self, goal: Any) -> GoalResponse:
        return GoalResponse.ACCEPT if 0 < goal.order < 10 else GoalResponse.REJECT

    async def wait(self) -> None:
        await self.tick

    async def heat(self, goal: Any) -> Any:
        seconds: list[int] = []
        while len(seconds) < goal.request.order and not goal.is_cancel_requested:
            await self.wait()
            seconds.append(len(seconds) + 1)
            goal.publish_feedback(Fibonacci.Feedback(sequence=seconds))
        if goal.is_cancel_requested:
            goal.canceled()
        else:
            goal.succeed()
        self.done += 1
        return Fibonacci.Result(sequence=seconds)


class Sender(Node):
    """Sends goals and remembers what comes back, and in which second."""

    def __init__(self, name: str = "sender", action: str = "heat") -> None:
        super().__init__(name)
        self.client = ActionClient(self, Fibonacci, action)
        self.log: list[Any] = []
        self.goal: Any = None

    def note(self, what: Any) -> None:
        seconds = since_start(self) / 1e9
        self.log.append((int(seconds) if seconds == int(seconds) else seconds, what))

    def send(self, order: int) -> None:
        sent = self.client.send_goal_async(
            Fibonacci.Goal(order=order), lambda heard: self.note(list(heard.feedback.sequence))
        )
        sent.add_done_callback(self.decided)

    def decided(self, future: Any) -> None:
        self.goal = future.result()
        self.note("accepted" if self.goal.accepted else "rejected")
        if self.goal.accepted:
            self.goal.get_result_async().add_done_callback(self.ended)

    def ended(self, future: Any) -> None:
        response = future.result()
        self.note((response.status, list(response.result.sequence)))

    def cancel(self) -> None:
        self.goal.cancel_goal_async().add_done_callback(
            lambda future: self.note(f"canceling {len(future.result().goals_canceling)}")
        )


@pytest.fixture
def pair(ros):
    """A server and a client, made and added."""
    return ros.add(Heater), ros.add(Sender)


def test_work_that_does_not_say_how_it_ended_is_aborted(ros, capsys):
    class Careless(Heater):
        async def heat(self, goal):
            await self.wait()
            return Fibonacci.Result(sequence=[7])

    ros.add(Careless)
    client = ros.add(Sender)
    client.send(1)
    ros.run(2)
    assert client.log[-1] == (1, (ABORTED, [7]))
    assert "Goal state not set, assuming aborted" in capsys.readouterr().out


def test_an_exception_in_the_work_aborts_its_goal_and_the_node_goes_on(ros, capsys):
    class Clumsy(Heater):
        async def heat(self, goal):
            await self.wait()
            return [] if goal.request.order == 1 / 0 else None

    server, client = ros.add(Clumsy), ros.add(Sender)
    client.send(1)
    ros.run(2)
    assert client.log[-1] == (1, (ABORTED, []))
    (fault,) = ros.observation().faults
    assert (fault.node, fault.callback, fault.kind) == ("/heater", "heat", "ZeroDivisionError")
    assert fault.code == "return [] if goal.request.order == 1 / 0 else None"
    said = capsys.readouterr()
    assert "aborted a goal" in said.err
    assert "Traceback" not in said.err
    before = server.tick
    ros.run(1)
    assert server.tick is not before


def _everything():
    with Session(seed=4) as ros:
        ros.add(Heater)
        clients = [ros.add(partial(Sender, name)) for name in ("one", "two")]
        clients[0].send(3)
        clients[1].send(4)
        ros.run(1.5)
        clients[1].cancel()
        ros.run(3)
        late = ros.add(partial(Sender, "late"))
        late.send(1)
        ros.run(3)
        return ros.observation(), [client.log for client in (*clients, late)]


def test_every_run_is_the_same():
    first = _everything()
    assert [_everything() for _ in range(2)] == [first] * 2


def test_the_graph_shows_an_action_and_what_it_is_made_of(ros, pair):
    del pair
    ends = [end for end in ros.graph().endpoints if end.name.startswith("/heat")]
    ours = [end for end in ends if not end.name.startswith("/heater")]
    assert [(end.kind, end.name) for end in ours if end.node == "/heater"] == [
        ("action server", "/heat"),
        ("server", "/heat/_action/send_goal"),
        ("server", "/heat/_action/cancel_goal"),
        ("server", "/heat/_action/get_result"),
        ("publisher", "/heat/_action/feedback"),
        ("publisher", "/heat/_action/status"),
    ]
    kinds = [end.kind for end in ours if end.node == "/sender"]
    assert kinds == ["action client", *["client"] * 3, *["subscription"] * 2]
    assert ros.graph().topics() == ()
    assert "/heat/_action/feedback" in ros.graph().topics(infrastructure=True)


def test_the_names_of_the_parts_are_what_ros_says(ros, pair):
    node = pair[1]
    shown = {name for name, _ in node.get_topic_names_and_types()}
    shown |= {name for name, _ in node.get_service_names_and_types()}
    types = dict(node.get_topic_names_and_types()) | dict(node.get_service_names_and_types())
    for end in ros.graph().endpoints:
        if "/_action/" in end.name:
            assert end.name in shown
            assert types[end.name] == [end.type_name]


def test_an_action_that_is_destroyed_leaves_the_graph(ros, pair):
    pair[0].server.destroy()
    assert not [end for end in ros.graph().endpoints if end.kind == "action server"]


def test_an_ordinary_subscription_hears_feedback_and_status(ros, pair):
    heard, states = [], []
    node = ros.add(lambda: Node("ear"))
    kind = Fibonacci.Impl.FeedbackMessage
    node.create_subscription(kind, "heat/_action/feedback", heard.append, 10)
    node.create_subscription(GoalStatusArray, "heat/_action/status", states.append, 10)
    pair[1].send(2)
    ros.run(3)
    assert [list(one.feedback.sequence) for one in heard] == [[1], [1, 2]]
    assert states[-1].status_list[-1].status == SUCCEEDED


def test_send_goal_in_a_cell_runs_virtual_time(ros, pair):
    response = pair[1].client.send_goal(Fibonacci.Goal(order=2))
    assert list(response.result.sequence) == [1, 2]
    assert ros.time == 2


def test_a_result_is_kept_for_as_long_as_the_server_says(ros):
    """A goal that ends on the second, as all do in virtual time, is forgotten on the second."""

    class Keeper(Node):
        def __init__(self):
            super().__init__("keeper")
            self.server = ActionServer(self, Fibonacci, "heat", self.heat, result_timeout=10)

        def heat(self, goal):
            goal.succeed()
            return Fibonacci.Result()

    class Asker(Node):
        def __init__(self):
            super().__init__("asker")
            self.client = ActionClient(self, Fibonacci, "heat")
            self.states = []
            self.goal = None
            self.create_timer(1.0, self.ask)

        def ask(self):
            if self.goal is None:
                self.goal = self.client.send_goal_async(Fibonacci.Goal())
            else:
                asked = self.goal.result().get_result_async()
                asked.add_done_callback(lambda future: self.states.append(future.result().status))

    ros.add(Keeper)
    asker = ros.add(Asker)
    ros.run(14)
    kept = asker.states.count(SUCCEEDED)
    assert 9 <= kept <= 10
    assert asker.states[kept:] == [GoalStatus.STATUS_UNKNOWN] * (13 - kept)


def test_a_session_that_has_ended_offers_no_action():
    with Session() as ros:
        server, client = ros.add(Heater).server, ros.add(Sender).client
    # While they lived, a later session in the same domain would see the server.
    for handle in (server._handle, client._client_handle):
        with pytest.raises(InvalidHandle), handle:
            pass


def test_a_goal_that_nobody_takes_is_explained(ros, says):
    client = ActionClient(ros.add(lambda: Node("lonely")), Fibonacci, "heat")
    assert client.wait_for_server(timeout_sec=2.0) is False
    assert ros.time == 2
    with pytest.raises(SessionError) as caught:
        client.send_goal(Fibonacci.Goal())
    says(caught.value, "No action server has responded to send_goal for the action /heat")


def test_live(ros, pair):
    class Quick(Heater):
        def heat(self, goal):
            goal.succeed()
            return Fibonacci.Result(sequence=[1])

    ros.add(Quick)
    ros.start()
    response = pair[1].client.send_goal(Fibonacci.Goal(order=1))
    assert list(response.result.sequence) == [1]
    ros.stop()
