"""A recording into a session: the same messages, the same log lines."""

import math
from dataclasses import replace

import pytest
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import Float32, Int32

from nodes import Listener, Talker
from record_builders import pub, run_of, sample
from rosbeat import Session
from rosbeat.bags import Bag, dropouts, record, replay, stuck, with_nan
from rosbeat.errors import BagError
from rosbeat.records import NANOSECONDS, Observation, QoS
from rosbeat.workspace.finished.sensor_simulator.temperature_publisher import TemperatureSensor
from rosbeat.workspace.finished.sensor_simulator.temperature_subscriber import TemperatureMonitor

pytestmark = pytest.mark.ros


class Chatty(Node):
    """Logs what it hears on two topics, and once in a while on its own."""

    def __init__(self):
        super().__init__("chatty")
        for topic in ("count", "other"):
            self.create_subscription(Int32, topic, self.hear(topic), 2)
        self.create_timer(1.0, lambda: self.get_logger().info("tick"))

    def hear(self, topic):
        return lambda message: self.get_logger().info(f"{topic} {message.data}")


@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
def test_the_monitor_says_exactly_what_it_said(tmp_path, storage):
    with Session(seed=3) as ros:
        ros.add(TemperatureSensor)
        ros.add(TemperatureMonitor)
        ros.run(600, quiet=True)
        record(ros, tmp_path / "run", storage=storage)
        before = ros.logs("temperature_monitor"), ros.messages("temperature")
    bag = Bag(tmp_path / "run")
    with Session(seed=99) as ros:
        ros.add(replay(bag))
        ros.add(TemperatureMonitor)
        ros.run(bag.seconds, quiet=True)
        assert ros.logs("temperature_monitor") == before[0]
        sent = [replace(one, node="/temperature_sensor") for one in ros.messages("temperature")]
        assert tuple(sent) == before[1]
        assert len(before[0]) == 601


def crowd(ros):
    """Three that talk at the same instants, one in bursts that are longer than a queue."""
    ros.add(lambda: Talker("one", burst=3))
    ros.add(lambda: Talker("two", topic="other"))
    ros.add(lambda: Talker("three", topic="third", period=0.5))


def test_many_at_one_instant_are_replayed_in_order():
    with Session() as ros:
        crowd(ros)
        ros.add(Chatty)
        ros.run(20, quiet=True)
        seen = ros.observation()
    for _ in range(2):
        with Session() as ros:
            ros.add(replay(seen))
            ros.add(Chatty)
            ros.run(20, quiet=True)
            assert ros.logs("chatty") == seen.logs
            again = [(one.time_ns, one.topic, one.data) for one in ros.observation().samples]
            assert again == [(one.time_ns, one.topic, one.data) for one in seen.samples]


def test_two_sensors_on_a_topic_are_replayed_one_after_the_other(tmp_path):
    with Session() as ros:
        ros.add(lambda: Talker("one"))
        ros.add(lambda: Talker("two"))
        listener = ros.add(lambda: Listener(qos=1))
        ros.run(10)
        bag = record(ros, tmp_path / "run")
    with Session() as ros:
        ros.add(replay(bag))
        again = ros.add(lambda: Listener(qos=1))
        ros.run(bag.seconds)
    assert again.heard == listener.heard
    assert len(again.heard) == 20


def test_times_count_from_when_the_node_is_added():
    with Session() as ros:
        ros.run(10)
        ros.add(replay(run_of([1.0, 2.0])))
        ros.run(10)
        assert [one.time for one in ros.messages("temperature")] == [11.0, 12.0]


def test_topics_are_chosen_and_remapped():
    run = run_of([1.0])
    door = sample(1, True, "/door", "/lock", "std_msgs/msg/Bool")
    run = replace(run, samples=(*run.samples, door))
    with Session() as ros:
        ros.add(replay(run, topics="door", name="player"), remappings={"door": "old/door"})
        ros.run(2)
        seen = ros.observation()
    assert [(one.topic, one.node, one.value) for one in seen.samples] == [
        ("/old/door", "/player", True)
    ]
    assert seen.graph.topics() == ("/old/door",)


def test_faults_are_injected_on_the_way():
    run = run_of([float(at) for at in range(10)])
    faults = [stuck(at=3, seconds=2), with_nan(at=7), dropouts(spans=[(8, 10)])]
    with Session() as ros:
        ros.add(replay(run, faults=faults))
        ros.run(20)
        found = {one.time: one.value for one in ros.messages("temperature")}
    assert list(found) == [1, 2, 3, 4, 5, 6, 7, 10]
    assert [found[at] for at in (2, 3, 4, 5)] == [1.0, 1.0, 1.0, 4.0]
    assert math.isnan(found[7])


def test_it_offers_what_was_offered():
    qos = QoS("RELIABLE", "TRANSIENT_LOCAL", "KEEP_LAST", 2)
    run = run_of([1.0, 2.0, 3.0])
    run = replace(
        run, graph=replace(run.graph, endpoints=(pub("/sensor", "/temperature", -1, qos=qos),))
    )
    heard = []

    class Late(Node):
        def __init__(self):
            super().__init__("late")
            late = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)
            self.create_subscription(
                Float32, "temperature", lambda message: heard.append(message.data), late
            )

    with Session() as ros:
        ros.add(replay(run))
        ros.run(5)
        (end,) = ros.graph().on("/temperature", "publisher")
        assert end.qos == qos
        ros.add(Late)
        ros.run(1)
    assert heard == [2.0, 3.0]


def test_a_message_at_the_very_beginning_and_no_message_at_all():
    run = Observation(0, 0, (sample(0, 1.0), sample(0, 2.0)))
    with Session() as ros:
        ros.add(replay(run))
        ros.add(replay(Observation(0, 0), name="nobody"))
        ros.run(0)
        assert [(one.time, one.value) for one in ros.messages("temperature")] == [(0, 1), (0, 2)]


def test_live_it_runs_by_the_wall_clock(eventually):
    samples = tuple(sample(at / 20, float(at)) for at in range(4))
    with Session() as ros:
        ros.add(replay(Observation(NANOSECONDS, 0, samples)))
        ros.start()
        eventually(lambda: len(ros.messages("temperature")) == 4)
        assert [one.value for one in ros.messages("temperature")] == [0.0, 1.0, 2.0, 3.0]


def test_a_paused_player_catches_up():
    with Session() as ros:
        player = ros.add(replay(run_of([1.0, 2.0, 3.0])))
        ros.run(1)
        ros.pause(player)
        ros.run(10)
        ros.resume(player)
        ros.run(0)
        assert [one.time for one in ros.messages("temperature")] == [1.0, 11.0, 11.0]


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"source": "first_run"}, "is not a run"),
        ({"topics": "tmperature"}, "Did you mean '/temperature'"),
        ({"faults": [3]}, "is not a fault"),
        ({"faults": [stuck(topic="door")]}, "no topic '/door'"),
        ({"faults": [lambda samples: [sample(1, 1e300)]]},
         "Message 1 on /temperature is not a std_msgs/msg/Float32"),
    ],
)  # fmt: skip
def test_bad_input_gets_three_parts(says, given, words):
    with pytest.raises(BagError) as caught:
        replay(**{"source": run_of([1.0]), **given})
    says(caught.value, words)
