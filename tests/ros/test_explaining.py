"""`ros.explain`: what sessions see of themselves, and of nodes in other processes."""

import ctypes
import signal
import threading
import time
from functools import partial

import pytest
import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_sensor_data
from rclpy.task import Future
from std_msgs.msg import Int32
from std_srvs.srv import Trigger

from nodes import Doer, Listener, Server, Talker
from other_process import other_process
from rosbeat import Session
from rosbeat.diagnosis.silence import Explanation
from rosbeat.domains import lease_domain
from rosbeat.errors import SessionError
from rosbeat.records import is_hidden

pytestmark = pytest.mark.ros


LATCHED = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)


def verdicts(ros, topic="count"):
    found = ros.explain(topic)
    return [one.mistake for one in found.diagnoses] or [found.verdict]


def silent_node(ros, name="talker", do=lambda _: None):
    """A node with a timer and a publisher that it does not use."""
    node = ros.add(partial(Doer, do, name))
    node.create_publisher(Int32, "count", 10)
    return node


def test_all_is_well_with_the_rate(ros):
    ros.add(partial(Talker, period=0.25))
    ros.add(Listener)
    ros.run(10)
    found = ros.explain("/count")
    assert isinstance(found, Explanation)
    assert found.is_well
    assert found.rate_hz == 4.0
    assert found.title == "All is well on /count: 4 messages a second arrive at /listener."
    assert "40 messages" in found.sentences[0]
    assert "ran 40 times, the last at 10 s" in found.sentences[1]


def removed(ros):
    ros.add(Talker)
    ros.add(Listener)
    ros.run(3)
    ros.remove("talker")


def misspelt(ros):
    ros.add(Talker)
    ros.add(partial(Listener, topic="cuont"))
    ros.run(3)
    assert verdicts(ros, "cuont") == ["topic-misspelled"]
    assert "Did you mean /count?" in ros.explain("counts").diagnoses[0].hint


def of_other_qualities(ros):
    ros.add(partial(Talker, qos=qos_profile_sensor_data))
    ros.add(Listener)
    ros.add(partial(Listener, "latched", qos=LATCHED))
    ros.run(3)
    assert ros.explain("count").headlines == (
        "the reliability of /talker and /listener is incompatible",
        "reliability and durability of /talker and /latched are incompatible",
    )


def paused(ros):
    ros.add(Talker)
    ros.add(Listener)
    ros.run(3)
    ros.pause("listener")


def never_added(ros):
    ros.add(Talker)
    Listener()
    ros.run(3)


def ended(ros):
    silent_node(ros, do=lambda _: 1 / 0)
    ros.add(Listener)
    ros.run(3)


def never_used(ros):
    silent_node(ros)
    ros.add(Listener)
    ros.run(3)


def stopped(ros):
    talker = ros.add(Talker)
    ros.add(Listener)
    ros.run(3)
    talker.timer.cancel()
    ros.run(10)


def two_causes(ros):
    ended(ros)
    ros.pause("listener")


def from_a_constructor(ros):
    ros.add(Listener)
    list(silent_node(ros).publishers)[-1].publish(Int32(data=1))


def too_late(ros, qos=10):
    talker = ros.add(partial(Talker, qos=qos))
    ros.run(3)
    talker.timer.cancel()
    ros.add(partial(Listener, qos=qos))
    ros.run(1)


#: What is done, the verdicts, and a text of the first diagnosis: its evidence and its hint.
CAUSES = [
    (lambda ros: None, ["topic-unknown"], ""),
    (lambda ros: ros.add(Listener), ["no-publisher"], ""),
    (lambda ros: (ros.add(Talker), ros.run(1)), ["no-subscription"], ""),
    (removed, ["no-publisher"], ""),
    (misspelt, ["topic-misspelled"], ""),
    (of_other_qualities, ["qos-mismatch", "qos-mismatch"], ""),
    (from_a_constructor, ["not-spun"], ""),
    (paused, ["not-spun"], 'ros.resume("listener")'),
    (never_added, ["not-spun"], "ros.add"),
    (ended, ["node-ended"], "At 1 s act raised ZeroDivisionError: division by zero."),
    (never_used, ["never-published"], "act ran 3 times"),
    (stopped, ["gone-quiet"], ""),
    (too_late, ["first-messages-lost"], ""),
    (partial(too_late, qos=LATCHED), ["all-is-well"], ""),
    (two_causes, ["node-ended", "not-spun"], ""),
]


@pytest.mark.parametrize(("do", "expected", "text"), CAUSES)
def test_why_nothing_arrives(ros, capsys, do, expected, text):
    do(ros)
    assert verdicts(ros) == expected
    if text:
        (first, *_) = ros.explain("count").diagnoses
        assert text in f"{first.evidence} {first.hint}"
    capsys.readouterr()


def test_no_time_has_passed(ros):
    ros.add(Talker)
    ros.add(Listener)
    assert verdicts(ros) == ["not-spun"]
    ros.run(3)
    assert verdicts(ros) == ["all-is-well"]
    ros.add(Talker)  # in the place of the other
    assert verdicts(ros) == ["not-spun"]


def test_live_a_callback_that_does_not_return(eventually):
    begun, stop = [], []

    def hang(_):
        begun.append(True)
        while not stop:
            time.sleep(0.01)

    with Session() as ros:
        ros.add(partial(Doer, hang, period=0.01))
        ros.add(Talker)
        ros.add(Listener)
        ros.start()
        eventually(lambda: begun, 60)
        found = ros.explain("count")
        stop.append(True)
    assert found.verdict == "callback-blocks"
    assert "act has started but not returned" in found.diagnoses[0].evidence
    assert len(found.diagnoses) == 1


@pytest.mark.parametrize("name", ["room temperature", "1temp", "", "a//b", "temperature/", "a-b"])
def test_a_bad_name_gets_three_parts(ros, says, name):
    with pytest.raises(SessionError) as caught:
        ros.explain(name)
    says(caught.value, "cannot be the name of a topic", "topic name must not")


# Callbacks that have not returned: whatever holds up a process or a callback group.


class Hearer(Listener):
    """Does something with each message."""

    def __init__(self, do=lambda _: None, qos=10, topic="count", period=3.0, **options):
        super().__init__(topic=topic, qos=qos)
        self.do = do
        self.create_timer(period, self.act, **options)

    def act(self):
        """Run every 3 s; for subclasses."""

    def listen(self, message):
        super().listen(message)
        self.do(self)


def sleep_at(number, span=1000):
    return lambda node: time.sleep(span) if len(node.heard) == number else None


class Asleep(Hearer):
    def act(self):
        time.sleep(1000)


class Looping(Hearer):
    def act(self):
        while rclpy.ok():
            time.sleep(0.5)


class Awaiting(Hearer):
    async def act(self):
        await Future()


class Asking(Hearer):
    """Awaits a response, and its client is in the same group."""

    def __init__(self, **options):
        super().__init__(**options)
        self.client = self.create_client(Trigger, "ask")

    async def act(self):
        await self.client.call_async(Trigger.Request())


class Calling(Asking):
    def act(self):
        self.client.call(Trigger.Request())


class Serving(Hearer):
    """Its service awaits what never comes."""

    def __init__(self, **options):
        super().__init__(**options)
        self.create_service(Trigger, "ask", self.answer)

    async def answer(self, _, response):
        await Future()
        return response


class TalkerAsleep(Talker):
    def talk(self):
        super().talk()
        if self.count == 3:
            time.sleep(1000)


#: Who listens, and parts of what is said.
HELD_UP = [
    (partial(Hearer, sleep_at(3)), ["listen of /listener began at 3 s and has not returned; it "
                                    "sleeps until 1003 s."]),
    (partial(Hearer, sleep_at(1)), ["listen of /listener began at 1 s"]),
    (Asleep, ["act of /listener began at 3 s and has not returned; it sleeps until 1003 s."]),
    (Looping, ["it sleeps until 10.5 s, and not for the first time."]),
    (Awaiting, ["it waits for a future that is not done. /listener hears nothing until then"]),
    (Asking, ["it waits for a response from /ask, whose client is in the callback group that it "
              "occupies."]),
    (Calling, ["it waits for a response from /ask, which was reported as a deadlock."]),
]  # fmt: skip


@pytest.mark.parametrize(("make", "parts"), HELD_UP)
def test_a_callback_of_the_listener_has_not_returned(ros, make, parts, capsys):
    ros.add(Server)
    ros.add(Talker)
    ros.add(make)
    ros.run(10)
    found = ros.explain("count")
    assert mistakes(found) == ["callback-blocks"]
    assert found.headlines == ("a callback of /listener has not returned",)
    for part in [*parts, "messages have come since its callback last ran"]:
        assert part in found.diagnoses[0].evidence
    capsys.readouterr()


def test_an_async_service_beside_the_subscription(ros):
    ros.add(Talker)
    ros.add(Serving)
    asker = ros.add(partial(Doer, lambda node: node.client.call_async(Trigger.Request()), "asker"))
    asker.client = asker.create_client(Trigger, "ask")
    ros.run(10)
    found = ros.explain("count")
    assert mistakes(found) == ["callback-blocks"]
    assert "answer of /listener began at 1 s and has not returned" in found.diagnoses[0].evidence


@pytest.mark.parametrize("make", [Awaiting, Asking])
def test_a_group_of_its_own_holds_nobody_up(ros, make):
    ros.add(Server)
    ros.add(Talker)
    ros.add(partial(make, callback_group=ReentrantCallbackGroup()))
    ros.run(10)
    assert verdicts(ros) == ["all-is-well"]


def test_with_more_threads_a_sleeping_callback_holds_its_group_up_only(ros):
    ros.add(Talker)
    ros.add(Asleep, threads=4)
    ros.run(10)
    assert verdicts(ros) == ["callback-blocks"]
    ros.add(partial(Asleep, callback_group=ReentrantCallbackGroup()), threads=4)
    ros.run(10)
    assert verdicts(ros) == ["all-is-well"]


def test_a_callback_of_the_publisher_has_not_returned(ros):
    ros.add(TalkerAsleep)
    ros.add(Listener)
    ros.run(5)
    assert verdicts(ros) == ["all-is-well"]
    ros.run(10)
    found = ros.explain("count")
    assert mistakes(found) == ["callback-blocks"]
    assert "talk of /talker began at 3 s" in found.diagnoses[0].evidence
    assert "it has published no message since 3 s" in found.diagnoses[0].evidence


def test_short_waits_are_well(ros):
    ros.add(Talker)
    ros.add(partial(Hearer, lambda _: time.sleep(0.9)))
    ros.run(1)
    assert verdicts(ros) == ["callback-blocks"]  # nothing has returned yet
    for _ in range(7):
        ros.run(1.7)
        assert verdicts(ros) == ["all-is-well"]


@pytest.mark.parametrize("depth", [1, 10])
def test_a_callback_that_is_slower_than_its_messages(ros, depth):
    ros.add(Talker)
    ros.add(partial(Hearer, lambda _: time.sleep(2.7), qos=depth))
    ros.run(20)
    found = ros.explain("count")
    assert mistakes(found) == ["slow-callback"]
    evidence = found.diagnoses[0].evidence
    assert "Of the 19 newest messages, 8 have reached the callback of /listener." in evidence
    assert f"its queue, which holds {depth}, or wait there" in evidence


def test_a_burst_that_the_queue_does_not_hold(ros):
    ros.add(partial(Talker, burst=10))
    ros.add(partial(Listener, qos=5))
    ros.run(10)
    found = ros.explain("count")
    assert found.is_well
    assert found.title == (
        "All is well on /count: of the 20 newest messages, 10 arrived at /listener."
    )


def test_a_callback_that_is_left_after_stop(ros, capsys, eventually):
    begun = threading.Event()

    def hang():
        begun.set()
        ctypes.CDLL(None).sleep(6)  # a sleep in C cannot be interrupted

    ros.add(Talker)
    listener = ros.add(Hearer)
    ros.start()
    listener.create_timer(0.01, hang)
    assert begun.wait(60)
    ros.stop()
    assert "hang of /listener has not returned" in capsys.readouterr().out
    ros.run(5)
    found = ros.explain("count")
    assert mistakes(found) == ["callback-blocks"]
    assert "has not returned. /listener hears nothing until then" in found.diagnoses[0].evidence
    eventually(lambda: ros.observation().faults, 60)
    assert "hang had not returned when it was interrupted" in capsys.readouterr().err
    assert verdicts(ros) == ["node-ended"]


# Programs: a `main` that does not spin.


def listen_only():
    rclpy.init()
    Listener()
    time.sleep(1000)


def listen_now_and_then():
    rclpy.init()
    node = Listener()
    while rclpy.ok():
        rclpy.spin_once(node, timeout_sec=0.1)
        time.sleep(0.5)


def talk_in_a_loop():
    rclpy.init()
    node = Talker()
    while rclpy.ok():
        node.talk()
        time.sleep(1.0)


def test_a_main_that_does_not_spin(ros):
    ros.add(Talker)
    ros.spawn(listen_only)
    ros.run(10)
    found = ros.explain("count")
    assert mistakes(found) == ["not-spun"]
    assert "The main function of its program has waited since 0 s" in found.diagnoses[0].evidence


def spin_the_other_one():
    rclpy.init()
    nodes = [Listener(), Doer(lambda _: None)]
    rclpy.spin(nodes[1])


def test_a_main_that_spins_another_node(ros):
    ros.add(Talker)
    ros.spawn(spin_the_other_one)
    ros.run(10)
    found = ros.explain("count")
    assert mistakes(found) == ["not-spun"]
    assert "has spun since 0 s, but not this node" in found.diagnoses[0].evidence


@pytest.mark.parametrize("moment", [0.0, 0.1, 0.3, 0.55])
def test_a_main_that_spins_now_and_then(ros, moment):
    ros.add(Talker)
    ros.spawn(listen_now_and_then)
    ros.run(10 + moment)
    assert verdicts(ros) == ["all-is-well"]


def test_a_main_that_publishes_in_a_loop_of_its_own(ros):
    ros.add(Listener)
    ros.spawn(talk_in_a_loop)
    ros.run(10)
    assert verdicts(ros) == ["all-is-well"]


# Why a node has ended.


def raises(_):
    raise ValueError("no")


def shuts_down(_):
    rclpy.shutdown()


@pytest.mark.parametrize(
    ("do", "own", "shared"),
    [
        (raises, "At 1 s act raised ValueError: no.",
         "At 1 s act of /doer raised ValueError: no."),
        (shuts_down, "/doer called rclpy.shutdown() in act, which ended the node.",
         "act of /doer called rclpy.shutdown(), which ends its process."),
    ],
)  # fmt: skip
def test_a_node_that_ended_itself_and_its_neighbor(ros, capsys, do, own, shared):
    doer, _ = ros.add(partial(Doer, do), Talker)
    doer.create_publisher(Int32, "own", 10)
    ros.add(Listener)
    ros.add(partial(Listener, "other", "own"))
    ros.run(3)
    found = ros.explain("count")
    assert mistakes(found) == ["node-ended"]
    assert shared in found.diagnoses[0].evidence
    assert "/talker ran in the same process" in found.diagnoses[0].evidence
    found = ros.explain("own")
    assert own in found.diagnoses[0].evidence
    assert "same process" not in found.diagnoses[0].evidence
    assert "/talker ran in the same process, which has ended." in capsys.readouterr().out


def test_a_node_whose_neighbor_was_interrupted(ros):
    def hang(_):
        # By the system's clock, and long enough: an interrupt of a callback that has just begun
        # ends no node.
        end = time.clock_gettime(time.CLOCK_MONOTONIC) + 1.2
        while True:
            if time.clock_gettime(time.CLOCK_MONOTONIC) > end:
                signal.raise_signal(signal.SIGINT)

    ros.add(partial(Doer, hang, period=3.0), Talker)
    ros.add(Listener)
    with pytest.raises(KeyboardInterrupt):
        ros.run(5)
    found = ros.explain("count")
    assert mistakes(found) == ["node-ended"]
    evidence = found.diagnoses[0].evidence
    assert "act of /doer was interrupted before it had returned" in evidence
    assert "/talker ran in the same process, which ended with it." in evidence


def test_a_node_whose_callback_was_interrupted_live(ros, capsys):
    begun = threading.Event()

    def hang(_):
        begun.set()
        while True:
            time.sleep(0.01)

    ros.add(partial(Doer, hang, period=0.01)).create_publisher(Int32, "count", 10)
    ros.add(Listener)
    ros.start()
    assert begun.wait(60)
    ros.stop()
    found = ros.explain("count")
    assert mistakes(found) == ["node-ended"]
    assert "act was interrupted before it had returned" in found.diagnoses[0].evidence
    capsys.readouterr()


# Nodes of other processes: what arrives from them, and whether they answer.


#: The second one is in the graph and nobody spins it.
NODES = (
    "Talker(period=0.1), *(kept := [Listener('deaf', 'count'), Talker('quiet', 'hush')])[2:], "
    "Listener(topic='cuont'), Listener(topic='hush'), Words(topic='words'), "
    "Talker('_ros2cli_4711', 'typed', period=0.1), Talker('steady', 'steady', period=0.1),"
)


@pytest.fixture(scope="module")
def domain():
    lease = lease_domain()
    with other_process(lease.domain_id, NODES):
        yield lease.domain_id
    lease.release()


@pytest.fixture
def joined(domain):
    with Session(domain_id=domain) as session:
        yield session


def mistakes(found):
    return [one.mistake for one in found.diagnoses] or [found.verdict]


def test_a_node_that_is_not_spun_hears_nothing(joined):
    found = joined.explain("count", seconds=20)
    assert mistakes(found) == ["not-spun"]
    assert found.headlines == ("/deaf does not answer",)
    assert found.rate_hz > 0


def test_a_node_that_is_not_spun_says_nothing(joined):
    found = joined.explain("hush", seconds=0.5)
    assert mistakes(found) == ["not-spun"]
    assert found.headlines == ("/quiet does not answer",)


def test_an_own_node_hears_them(joined):
    listener = joined.add(partial(Listener, "own", "words"))
    assert listener.heard == []
    found = joined.explain("words", seconds=20)
    assert mistakes(found) == ["type-mismatch"]
    assert "/words publishes String, and /own subscribes to Int32" in found.diagnoses[0].evidence


def test_a_hidden_node_publishes_too(joined):
    listener = joined.add(partial(Listener, topic="typed"))
    joined.start()
    assert joined.wait(30, until=lambda: listener.heard)
    found = joined.explain("typed", seconds=20)
    assert found.is_well
    assert "/_ros2cli_4711 publishes Int32" in found.sentences[0]
    assert all(not is_hidden(name) for name in joined.graph().nodes)


def test_in_virtual_time_an_own_node_does_not_hear_them(joined):
    joined.add(partial(Listener, topic="steady"))
    joined.run(10)
    found = joined.explain("steady", seconds=20)
    assert mistakes(found) == ["not-spun"]
    assert "/steady publishes in another process, in real time." in found.diagnoses[0].evidence


@pytest.mark.parametrize("holds", [True, False])
def test_live_an_own_node_hears_them_or_is_held_up(joined, holds):
    listener = joined.add(partial(Awaiting if holds else Hearer, topic="steady"))
    joined.start()
    assert joined.wait(30, until=lambda: listener.heard)
    listener.create_timer(0.1, listener.act)
    ran = lambda: any(one.name == "act" for one in joined.observation().callbacks)  # noqa: E731
    assert joined.wait(30, until=ran)
    found = joined.explain("steady", seconds=20)
    assert mistakes(found) == ["callback-blocks" if holds else "all-is-well"]
    if holds:
        assert "act of /listener began at" in found.diagnoses[0].evidence


def test_nothing_is_left_behind(joined, eventually):
    nodes = joined._core.graph_observer.nodes
    hidden = lambda: [name for name in nodes() if name.startswith("/_rosbeat")]  # noqa: E731
    before = hidden()
    joined.explain("cuont", seconds=0)
    eventually(lambda: hidden() == before, 30)
    assert joined.nodes == ()
