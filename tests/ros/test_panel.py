"""The instrument panel of a session: what it sees and what it does."""

import threading
from functools import partial
from itertools import pairwise

import pytest
from rclpy.node import Node
from std_msgs.msg import Float32

from nodes import Doer, Speaker, Talker
from rosbeat import Session
from rosbeat.errors import SessionError
from rosbeat.panel import panel as panels
from rosbeat.panel.session_adapter import SessionInstruments
from rosbeat.ros.test_nodes import INJECTOR, TopicFault

pytestmark = pytest.mark.ros
PANEL = f"/{INJECTOR}"


class Sensor(Node):
    """Publishes the same number ten times a second."""

    def __init__(self, value=20.0):
        super().__init__("sensor")
        self.value = value
        self.publisher = self.create_publisher(Float32, "temperature", 10)
        self.create_timer(0.02, lambda: self.publisher.publish(Float32(data=self.value)))


class Ear(Node):
    """Remembers the numbers it hears."""

    def __init__(self):
        super().__init__("ear")
        self.heard = []
        self.create_subscription(Float32, "temperature", lambda m: self.heard.append(m.data), 10)


@pytest.fixture
def live(ros):
    ros.start()
    return ros


@pytest.fixture
def instruments(live):
    made = SessionInstruments(live._core)
    yield made
    made.release()


def values(ros):
    return [sample.value for sample in ros.messages("temperature")]


def test_the_newest_message_of_each_publisher(instruments, live, eventually):
    live.add(partial(Talker, "one", period=0.01))
    live.add(partial(Talker, "two", period=0.01))
    eventually(lambda: len(live.messages("count")) > 10)
    live.stop()
    newest = {one.node: one for _, one in instruments.news().arrivals}
    assert set(newest) == {"/one", "/two"}
    for node, sample in newest.items():
        assert sample == [one for one in live.messages("count") if one.node == node][-1]


def test_exceptions_and_log_lines(instruments, live, eventually, capsys):
    live.add(partial(Doer, lambda _: 1 / 0, period=0.01))
    live.add(partial(Speaker, period=0.01))
    eventually(lambda: live._core.recorder.faults and live._core.recorder.logs)
    news = instruments.news()
    assert [fault.kind for fault in news.faults] == ["ZeroDivisionError"]
    assert news.logs
    assert instruments.conditions()["/doer"] == "ended"


def test_a_stopped_node_is_made_again_as_it_was_made(instruments, live, eventually):
    live.add(partial(Sensor, 21.0))
    instruments.stop("/sensor")
    assert instruments.conditions() == {"/sensor": "stopped"}
    assert live.nodes == ()
    count = len(values(live))
    instruments.start("/sensor")
    assert instruments.conditions() == {"/sensor": "running"}
    eventually(lambda: len(values(live)) > count)
    instruments.stop("/sensor")
    instruments.start("/sensor")
    assert set(values(live)) == {21.0}


def test_a_node_that_the_page_makes_anew_is_no_longer_stopped(instruments, live):
    live.add(Sensor)
    instruments.stop("/sensor")
    live.add(Sensor)
    assert instruments.conditions() == {"/sensor": "running"}
    live.remove("sensor")
    assert instruments.conditions() == {}


def test_nothing_starts_in_another_session(instruments, live):
    live.add(Sensor)
    instruments.stop("/sensor")
    with Session(), pytest.raises(SessionError, match="cannot be started now"):
        instruments.start("/sensor")
    instruments.start("/sensor")


def test_a_number_is_published_and_heard(instruments, live, eventually):
    ear = live.add(Ear)
    instruments.graph()
    instruments.publish("/temperature", 30.5)
    eventually(lambda: 30.5 in ear.heard)
    assert live.messages("temperature")[0].node == PANEL
    assert PANEL in instruments.graph().nodes
    assert PANEL not in instruments.conditions()


def test_a_number_is_repeated_until_it_is_told_to_end(instruments, live, eventually):
    live.add(Ear)
    instruments.graph()
    instruments.repeat("/temperature", 30.5)
    instruments.publish("/temperature", 10.0)
    eventually(lambda: values(live)[1:].count(10.0) >= 2)
    instruments.repeat("/temperature", None)
    assert values(live)[0] == 30.5


def test_a_fault_reaches_nodes_that_come_later_too(instruments, live, eventually):
    live.add(Sensor)
    instruments.graph()
    instruments.disturb("/temperature", "offset", 100.0)
    eventually(lambda: 120.0 in values(live))
    live.add(Sensor)
    instruments.graph()
    count = len(values(live))
    eventually(lambda: len(values(live)) > count + 3)
    assert set(values(live)[count + 1 :]) == {120.0}
    instruments.disturb("/temperature", "none", 0.0)
    eventually(lambda: values(live)[-1] == 20.0)


def test_a_load_holds_the_others_up(instruments, live, eventually):
    live.add(Sensor)
    instruments.load(300.0)
    gaps = lambda: [b.time - a.time for a, b in pairwise(live.messages("temperature"))]  # noqa: E731
    eventually(lambda: values(live) and max(gaps(), default=0) > 0.28)
    instruments.load(0.0)


def test_release_takes_everything_away(instruments, live, eventually):
    live.add(Sensor)
    instruments.graph()
    instruments.publish("/temperature", 1.0)
    instruments.disturb("/temperature", "offset", 100.0)
    instruments.release()
    assert [node.get_name() for node in live.nodes] == ["sensor"]
    count = len(values(live))
    eventually(lambda: len(values(live)) > count + 2)
    assert values(live)[-1] == 20.0


@pytest.mark.parametrize(
    "act",
    [
        lambda one: one.pause("/nobody"),
        lambda one: one.start("/nobody"),
        lambda one: one.publish("/nothing", 1.0),
        lambda one: one.disturb("/nothing", "nan", 0.0),
    ],
)
def test_what_is_not_there_is_refused_in_words(instruments, act, says):
    with pytest.raises(SessionError) as caught:
        act(instruments)
    says(caught.value)


def test_only_a_live_session_has_controls(instruments, live):
    live.add(Sensor)
    live.stop()
    assert not instruments.is_live()
    with pytest.raises(SessionError, match="live"):
        instruments.pause("/sensor")
    live.close()
    with pytest.raises(SessionError):
        instruments.pause("/sensor")


# The panel of a session.


@pytest.fixture
def in_a_browser(monkeypatch):
    monkeypatch.setattr(panels, "is_for_a_browser", lambda: True)


def panel_threads():
    return [one for one in threading.enumerate() if one.name == "rosbeat panel"]


def test_running_the_cell_again_leaves_one_panel(live, in_a_browser):
    for _ in range(3):
        panel = live.panel()
        panel._heard({"do": "open"})
        live.add(Sensor)
        live._core.panel._instruments.graph()
        panel._heard({"do": "publish", "topic": "/temperature", "value": 1.0})
    assert len(panel_threads()) == 1
    assert [node.get_name() for node in live.nodes] == ["sensor", INJECTOR]
    live.close()
    assert panel_threads() == []
    assert repr(panel) == "Panel(closed)"


def test_a_session_that_nobody_holds_ends_with_its_panel(in_a_browser):
    ros = Session()
    ros.start()
    panel = ros.panel()
    assert len(panel_threads()) == 1
    del ros
    assert panel_threads() == []
    assert repr(panel) == "Panel(closed)"


def test_the_panel_changes_nothing_in_virtual_time(in_a_browser):
    def run(look):
        with Session(seed=3) as ros:
            ros.add(partial(Talker, period=0.01))
            if look:
                ros.panel()._heard({"do": "open"})
            ros.run(60)
            return ros.observation()

    assert run(look=True) == run(look=False)


# Faults on a topic, in virtual time.


@pytest.fixture
def node(ros):
    node = ros.add(lambda: Node("sensor"))
    node.temperature = node.create_publisher(Float32, "temperature", 10)
    node.humidity = node.create_publisher(Float32, "humidity", 10)
    return node


@pytest.fixture
def publish(ros, node):
    def values_of(*values):
        for value in values:
            node.temperature.publish(Float32(data=value))
        return [sample.value for sample in ros.messages("temperature")]

    return values_of


@pytest.fixture
def fault(node):
    made = TopicFault("/temperature")
    made.apply(node.publishers)
    made.apply(node.publishers)  # again and again, as the graph is looked at
    return made


@pytest.mark.parametrize(
    ("kind", "sent"), [("offset", "[25.0, 26.5]"), ("nan", "[nan, nan]"), ("none", "[20.0, 21.5]")]
)
def test_what_is_recorded_is_what_went_out(ros, node, publish, fault, kind, sent):
    fault.kind, fault.amount = kind, 5.0
    assert str(publish(20.0, 21.5)) == sent
    node.humidity.publish(Float32(data=50.0))
    assert [sample.value for sample in ros.messages("humidity")] == [50.0]
    message = Float32(data=1.0)
    node.temperature.publish(message)
    assert message.data == 1.0  # the node's own stays as it is


@pytest.mark.parametrize(("share", "least", "most"), [(0, 200, 200), (50, 70, 130), (100, 0, 0)])
def test_a_share_of_the_messages_is_lost(publish, fault, share, least, most):
    fault.kind, fault.amount = "dropout", float(share)
    assert least <= len(publish(*[1.0] * 200)) <= most
