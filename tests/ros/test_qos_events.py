"""Deadlines, lifespans and stored messages, in virtual time and as Fast DDS has them."""

import pytest
from rcl_interfaces.msg import Log
from rclpy.duration import Duration
from rclpy.event_handler import (
    PublisherEventCallbacks,
    QoSOfferedDeadlineMissedInfo,
    QoSRequestedDeadlineMissedInfo,
    SubscriptionEventCallbacks,
)
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rclpy.wait_for_message import wait_for_message
from std_msgs.msg import Int32

from digests import digest
from limited import TOPIC, Heart, Nurse, by_the_wall, quality, virtually
from nodes import Talker
from rosbeat import Session
from rosbeat.ros.qos_events import event_name, limit_ns, topic_of

pytestmark = pytest.mark.ros

# Deadlines in virtual time, and that Fast DDS counts the same by the wall clock.


WORLDS = pytest.mark.parametrize("world", [virtually, by_the_wall])
PERIOD = 0.25


def events(session, node="/nurse"):
    return [(one.time, one.name, one.source) for one in session.observation().callbacks
            if one.kind == "event" and one.node == node]  # fmt: skip


# What both clocks must agree on.


@WORLDS
def test_nothing_is_missed_before_the_first_message(world):
    with world() as here:
        nurse = here.make(Nurse, quality(PERIOD))
        here.pass_time(3 * PERIOD)
        heart = here.make(Heart, quality(PERIOD))
        here.pass_time(3 * PERIOD)
        assert (nurse.missed, heart.missed) == ([], [])
        heart.beat(1)
        here.wait_for(lambda: nurse.missed and heart.missed)
        assert nurse.heard == [1]
        assert (nurse.missed[0], heart.missed[0]) == ((1, 1), (1, 1))


@WORLDS
def test_one_is_missed_in_each_period_of_silence_also_when_nobody_is_left(world):
    with world() as here:
        nurse, heart = here.make(Nurse, quality(PERIOD)), here.make(Heart, quality(PERIOD))
        heart.beat(1)
        here.wait_for(lambda: len(nurse.missed) >= 2 and len(heart.missed) >= 2)
        heart.destroy_publisher(heart.publisher)
        known = len(heart.missed)
        here.wait_for(lambda: nurse.missed[-1][0] >= 4)
        assert len(heart.missed) == known
        assert [total for total, _ in nurse.missed] == [
            sum(change for _, change in nurse.missed[: k + 1]) for k in range(len(nurse.missed))
        ]


@WORLDS
def test_a_subscription_counts_what_comes_from_all_a_publisher_only_its_own(world):
    with world() as here:
        nurse = here.make(Nurse, quality(5.0))
        hearts = [here.make(Heart, quality(PERIOD), name) for name in ("one", "two")]
        hearts[0].beat(1)
        for number in range(8):
            hearts[1].beat(number)
            here.pass_time(PERIOD / 2)
        assert nurse.missed == []
        assert hearts[0].missed[-1][0] >= 2


@WORLDS
def test_a_late_joiner_counts_from_the_stored_message(world):
    with world() as here:
        heart = here.make(Heart, quality(PERIOD, stored=True))
        heart.beat(1)
        here.pass_time(3 * PERIOD)
        nurse = here.make(Nurse, quality(PERIOD, stored=True))
        here.wait_for(lambda: nurse.missed)
        assert nurse.heard == [1]
        assert nurse.missed[0] == (1, 1)


@WORLDS
def test_an_offer_must_be_as_short_as_what_is_asked(world):
    offered = (0.2, 0.3, 0.3, 0.0, 0.3, 0.0, 86400.0, 3600.0)
    asked = (0.3, 0.3, 0.2, 0.3, 0.0, 0.0, 3600.0, 86400.0)
    fits = [True, True, False, False, True, True, False, True]
    with world() as here:
        nurses = [here.make(Nurse, quality(one), namespace=f"pair{k}")
                  for k, one in enumerate(asked)]  # fmt: skip
        hearts = [here.make(Heart, quality(one), namespace=f"pair{k}")
                  for k, one in enumerate(offered)]  # fmt: skip
        here.pass_time(0.1)
        assert [heart.publisher.get_subscription_count() == 1 for heart in hearts] == fits
        assert [not nurse.misfits for nurse in nurses] == fits
        for heart in hearts:
            heart.beat(1)
        here.pass_time(0.1)
        assert [nurse.heard == [1] for nurse in nurses] == fits


# What virtual time adds.


def test_the_times_are_exact_and_recorded(ros):
    nurse = ros.add(lambda: Nurse(quality(1.5)))
    heart = ros.add(lambda: Heart(quality(1.5)))
    heart.beat(1)
    ros.run(4.5)
    assert nurse.missed == [(1, 1), (2, 1), (3, 1)] == heart.missed
    assert isinstance(nurse.infos[0], QoSRequestedDeadlineMissedInfo)
    assert isinstance(heart.infos[0], QoSOfferedDeadlineMissedInfo)
    told = [(1.5, "on_missed", "deadline of /pulse"), (3.0, "on_missed", "deadline of /pulse"),
            (4.5, "on_missed", "deadline of /pulse")]  # fmt: skip
    assert events(ros) == told == events(ros, "/heart")


def test_a_message_exactly_at_the_deadline_is_in_time(ros):
    nurse = ros.add(lambda: Nurse(quality(1.0)))
    ros.add(lambda: Talker(topic=TOPIC, period=1.0, qos=quality(1.0)))
    ros.run(10)
    assert nurse.missed == []
    assert len(nurse.heard) == 10


def test_live_time_is_not_counted_and_virtual_time_begins_with_a_message(ros):
    nurse = ros.add(lambda: Nurse(quality(0.05)))
    heart = ros.add(lambda: Heart(quality(0.05)))
    heart.beat(1)
    ros.run(0.05)
    ros.start()
    heart.beat(2)
    assert ros.wait(10, until=lambda: nurse.heard == [1, 2])
    ros.wait(0.2)
    ros.stop()
    ros.run(1)
    assert (len(nurse.missed), len(heart.missed)) == (1, 1)
    heart.beat(3)
    ros.run(0.1)
    assert nurse.missed == [(1, 1), (2, 1), (3, 1)]


def test_a_domain_that_was_joined_shows_what_was_written(empty_domain):
    with Session(domain_id=empty_domain) as joined:
        heart = joined.add(lambda: Heart(quality(0.5, 0.25)))
        told = joined.add(lambda: Node("asker"))
        (info,) = told.get_publishers_info_by_topic(f"/{TOPIC}")
        assert info.qos_profile.deadline.nanoseconds == 500_000_000
        heart.beat(1)
        joined.run(5)
        assert heart.missed == []


def watched_for_a_minute():
    with Session(seed=3) as session:
        session.add(lambda: Nurse(quality(1.0, 0.7)))
        session.add(lambda: Talker(topic=TOPIC, period=1.3, qos=quality(1.0, 0.7)))
        session.run(20, quiet=True)
        session.pause("nurse")
        session.run(20, quiet=True)
        session.resume("nurse")
        session.run(20, quiet=True)
        return session.observation()


def test_every_run_is_the_same():
    assert len({digest(watched_for_a_minute()) for _ in range(2)}) == 1


# Lifespans in virtual time, and that Fast DDS drops the same by the wall clock.


SHORT, LONG, NONE = 1.0, 60.0, 0.0


def expired(session):
    return [(one.time, one.node, one.name, one.source) for one in session.observation().callbacks
            if one.kind == "expired"]  # fmt: skip


def apart(here, kind, lifespans, **options):
    """Make a node for each lifespan, each in a namespace of its own: nobody hears another pair."""
    return [
        here.make(kind, quality(lifespan=one, **options), namespace=f"pair{number}")
        for number, one in enumerate(lifespans)
    ]


@WORLDS
def test_the_queue_of_a_busy_subscription_drops_by_its_own_lifespan(world):
    offered = (NONE, SHORT, NONE, SHORT, SHORT, LONG)
    asked = (NONE, NONE, SHORT, SHORT, LONG, SHORT)
    with world() as here:
        hearts, nurses = apart(here, Heart, offered), apart(here, Nurse, asked)
        with here.busy(*nurses):
            for heart in hearts:
                heart.beat(1)
            here.pass_time(1.5)
            for heart in hearts:
                heart.beat(2)
        here.wait_for(lambda: all(2 in nurse.heard for nurse in nurses))
        assert [nurse.heard for nurse in nurses] == [[1, 2], [1, 2], [2], [2], [1, 2], [2]]


@WORLDS
def test_what_a_publisher_stores_is_dropped_by_either_lifespan(world):
    offered, asked = (NONE, SHORT, NONE, LONG, SHORT), (NONE, NONE, SHORT, LONG, SHORT)
    with world() as here:
        hearts = apart(here, Heart, offered, stored=True)
        for heart in hearts:
            heart.beat(1)
        here.pass_time(1.5)
        nurses = apart(here, Nurse, asked, stored=True)
        for heart in hearts:
            heart.beat(2)
        here.wait_for(lambda: all(2 in nurse.heard for nurse in nurses))
        here.pass_time(0.2)
        assert [nurse.heard for nurse in nurses] == [[1, 2], [2], [2], [1, 2], [2]]


def test_what_was_dropped_is_recorded_and_runs_no_callback(ros):
    heart = ros.add(lambda: Heart(quality()))
    nurse = ros.add(lambda: Nurse(quality(lifespan=1.0)))
    ros.pause(nurse)
    for number in range(4):
        heart.beat(number)
        ros.run(0.5)
    ros.resume(nurse)
    ros.run(0)
    # At 2.0 s the messages are 2.0, 1.5, 1.0 and 0.5 s old.
    assert nurse.heard == [3]
    assert expired(ros) == [(2.0, "/nurse", "hear", "/pulse")] * 3
    assert len(ros.messages("pulse")) == 4
    ran = [one for one in ros.observation().callbacks if one.kind == "subscription"]
    assert len(ran) == 1


def test_several_publishers_are_told_apart(ros):
    hearts = [ros.add(lambda name=name: Heart(quality(), name)) for name in ("one", "two")]
    nurse = ros.add(lambda: Nurse(quality(lifespan=1.0)))
    ros.pause(nurse)
    hearts[0].beat(1)  # each publisher's first
    ros.run(2)
    hearts[1].beat(2)
    ros.resume(nurse)
    ros.run(0)
    assert nurse.heard == [2]


# A late joiner has all that is stored for it when it has been made.


STORED = quality(stored=True)
#: Fast DDS is late with stored messages 1 time in 5 to 1 time in 2.
TIMES = 15


@pytest.mark.parametrize(
    "asked",
    [STORED, QoSProfile(depth=10, durability=DurabilityPolicy.BEST_AVAILABLE)],
    ids=["transient local", "best available"],
)
def test_stored_messages_hold_back_nothing_that_follows(ros, asked):
    heart = ros.add(lambda: Heart(STORED))
    for number in (1, 2):
        heart.beat(number)
    for number in range(3, TIMES + 3):
        nurse = ros.add(lambda number=number: Nurse(asked, f"nurse{number}"))
        heart.beat(number)
        ros.run(0)
        assert nurse.heard == list(range(1, number + 1))[-10:]


@pytest.fixture
def unacknowledged(ros):
    """A publisher that knows of nobody what has arrived: a volatile subscription came too late."""
    heart = ros.add(lambda: Heart(quality(stored=True, depth=1)))
    for number in (1, 2):  # the first is not stored any more
        heart.beat(number)
    ros.add(lambda: Nurse(quality(), "passer_by"))
    heart.beat(3)
    assert not heart.publisher.wait_for_all_acked(Duration(seconds=0.2))
    return heart


def test_nobody_waits_for_a_volatile_subscription_that_came_late(ros, unacknowledged, monkeypatch):
    monkeypatch.setattr("rosbeat.ros.qos_events._LIMIT", 1_000.0)  # longer than the test may take
    for number in range(4, 7):
        nurse = ros.add(lambda number=number: Nurse(STORED, f"nurse{number}"))
        unacknowledged.beat(number)
        ros.run(0)
        assert nurse.heard == [number - 1, number]


def test_what_was_taken_early_is_a_part_of_the_queue(ros, unacknowledged):
    nurse = ros.add(lambda: Nurse(quality(stored=True, depth=2)))
    ros.pause(nurse)
    for number in (4, 5):
        unacknowledged.beat(number)
    ros.resume(nurse)
    ros.run(0)
    assert nurse.heard == [4, 5]
    unacknowledged.beat(6)
    ros.run(0)
    assert nurse.heard == [4, 5, 6]


def test_what_was_taken_early_is_returned_to_who_waits_for_a_message(ros, unacknowledged):
    class Waiting(Node):
        def __init__(self):
            super().__init__("waiting")
            self.timer = self.create_timer(1.0, self.ask)

        def ask(self):
            self.timer.cancel()
            self.got = wait_for_message(Int32, self, TOPIC, qos_profile=STORED, time_to_wait=5.0)

    waiting = ros.add(Waiting)
    ros.run(1)
    assert waiting.got == (True, Int32(data=3))


def test_what_was_taken_early_is_heard_in_real_time(ros, unacknowledged):
    nurse = ros.add(lambda: Nurse(STORED))
    ros.start()
    assert ros.wait(10, until=lambda: nurse.heard)
    unacknowledged.beat(4)
    assert ros.wait(10, until=lambda: len(nurse.heard) > 1)
    assert nurse.heard == [3, 4]


# What the middleware is given of a deadline and a lifespan, and what everybody else sees.


@pytest.mark.parametrize("limit", [0.000_000_001, 0.001, 86400.0 * 365])
def test_limits_read_as_written_wherever_the_profile_is_handed_over(ros, limit):
    mine = quality(limit, limit)

    class Holder(Node):
        def __init__(self):
            super().__init__("holder")
            self.ends = (
                self.create_publisher(Int32, TOPIC, mine),
                self.create_publisher(Int32, TOPIC, qos_profile=mine),
                self.create_subscription(Int32, TOPIC, print, mine),
                self.create_subscription(Int32, TOPIC, print, qos_profile=mine),
            )

    node = ros.add(Holder)
    assert [one.qos_profile for one in node.ends] == [mine] * 4 == [quality(limit, limit)] * 4
    told = (*node.get_publishers_info_by_topic(TOPIC), *node.get_subscriptions_info_by_topic(TOPIC))
    limits = {(limit_ns(one.qos_profile.deadline), limit_ns(one.qos_profile.lifespan))
              for one in told}  # fmt: skip
    assert limits == {(limit_ns(mine.deadline), limit_ns(mine.lifespan))}


# Events of the middleware, by the names that a learner writes.


OF_PUBLISHERS = ["deadline", "liveliness", "incompatible_qos", "incompatible_type", "matched"]
OF_SUBSCRIPTIONS = [*OF_PUBLISHERS, "message_lost"]


def test_each_event_has_the_name_of_its_argument(ros):
    node = ros.add(lambda: Node("node"))
    publisher = node.create_publisher(
        Int32, "count", 10,
        event_callbacks=PublisherEventCallbacks(**dict.fromkeys(OF_PUBLISHERS, print)),
    )  # fmt: skip
    subscription = node.create_subscription(
        Int32, "count", print, 10,
        event_callbacks=SubscriptionEventCallbacks(**dict.fromkeys(OF_SUBSCRIPTIONS, print)),
    )  # fmt: skip
    assert sorted(map(event_name, publisher.event_handlers)) == sorted(OF_PUBLISHERS)
    assert sorted(map(event_name, subscription.event_handlers)) == sorted(OF_SUBSCRIPTIONS)
    handler = subscription.event_handlers[0]
    assert topic_of(handler, node) == "/count"
    node.destroy_subscription(subscription)
    assert topic_of(handler, node) == "?"


def test_what_the_middleware_tells_at_once_is_recorded_as_an_event(ros):
    node = ros.add(lambda: Node("node"))
    told = []

    def on_misfit(info):
        told.append(info.total_count)

    node.create_subscription(
        Int32, "count", print, 10,
        event_callbacks=SubscriptionEventCallbacks(incompatible_qos=on_misfit),
    )  # fmt: skip
    weak = QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT)
    silent = PublisherEventCallbacks(use_default_callbacks=False)
    node.create_publisher(Int32, "count", weak, event_callbacks=silent)
    ros.run(1)
    assert told == [1]
    (record,) = [one for one in ros.observation().callbacks if one.kind == "event"]
    assert (record.name, record.source) == ("on_misfit", "incompatible_qos of /count")


# What a session counts of deadlines and lifespans, and what it leaves alone.


def test_a_lifespan_on_a_topic_of_every_node_is_left_to_the_middleware(ros):
    node = ros.add(Talker)
    heard = []
    qos = QoSProfile(
        depth=1000, durability=DurabilityPolicy.TRANSIENT_LOCAL, lifespan=quality(0, 60).lifespan
    )
    node.create_subscription(Log, "/rosout", lambda line: heard.append(line.msg), qos)
    node.get_logger().info("hello")
    ros.run(1)
    assert heard == ["hello"]
