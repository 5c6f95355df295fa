"""What the middleware is given of a deadline and a lifespan, and what everybody else sees."""

import pytest
import rclpy
from rclpy.duration import Duration, Infinite
from rclpy.node import Node
from rclpy.qos import QoSProfile
from std_msgs.msg import Int32

from limited import TOPIC, Heart, Nurse, quality
from rosbeat.ros.qos_events import STRETCH, as_written, limit_ns, stretched

pytestmark = pytest.mark.ros


def c_side(profile):
    """What the middleware gets of a profile when an endpoint is made of it."""
    with stretched("publisher", (None, "x", profile), {}) as (args, _):
        told = args[2].get_c_qos_profile().to_dict()
    return told["deadline"].nanoseconds, told["lifespan"].nanoseconds


@pytest.mark.parametrize(
    ("limit", "found"),
    [(Duration(seconds=0.5), 500_000_000), (Duration(), 0), (Infinite, 0)],
)
def test_no_limit_is_zero(limit, found):
    assert limit_ns(limit) == found


def test_the_middleware_gets_three_years_more():
    assert c_side(quality(0.5, 0.25)) == (STRETCH + 500_000_000, STRETCH + 250_000_000)


def test_the_order_of_deadlines_is_kept_and_no_limit_stays_none():
    limits = (0.000_000_001, 0.001, 1.0, 3600.0, 86400.0 * 365)
    deadlines = [c_side(quality(limit))[0] for limit in limits]
    assert deadlines == sorted(set(deadlines))
    assert c_side(quality(0.5))[1] == c_side(quality(0.0, 1.0))[0] == 0
    assert c_side(quality(10.0**9))[0] == 2 * STRETCH  # more than the middleware can count


@pytest.mark.parametrize(("kind", "place"), [("publisher", 2), ("subscription", 3)])
def test_the_profile_is_found_by_place_and_by_name(kind, place):
    mine = quality(0.5)
    args = (*([None] * place), mine)
    with stretched(kind, args, {}) as (given, _):
        assert given[place] is not mine
        assert type(given[place]) is not QoSProfile
    assert type(given[place]) is QoSProfile
    with stretched(kind, (), {"qos_profile": mine}) as (_, named):
        assert named["qos_profile"] is not mine


@pytest.mark.parametrize(
    ("kind", "args"),
    [("publisher", (None, "x", 10)), ("publisher", (None, "x", quality())),
     ("publisher", (None,)), ("timer", (1.0, quality(0.5), quality(0.5)))],
)  # fmt: skip
def test_what_needs_no_stretching_is_left_alone(kind, args):
    with stretched(kind, args, {}) as (given, _):
        assert given is args


def test_nodes_and_the_graph_see_what_was_written(ros):
    mine = quality(0.5, 0.25)
    heart, nurse = ros.add(lambda: Heart(mine)), ros.add(lambda: Nurse(quality(1.5, 2.0)))
    assert heart.publisher.qos_profile == mine
    assert type(heart.publisher.qos_profile) is QoSProfile
    assert nurse.subscription.qos_profile.deadline == Duration(seconds=1.5)
    limits = [(end.kind, end.qos.deadline_ns, end.qos.lifespan_ns)
              for end in ros.graph().endpoints if end.name == f"/{TOPIC}"]  # fmt: skip
    assert limits == [("publisher", 500_000_000, 250_000_000),
                      ("subscription", 1_500_000_000, 2_000_000_000)]  # fmt: skip


def test_what_the_middleware_tells_a_node_is_what_was_written(ros):
    heart = ros.add(lambda: Heart(quality(0.5)))
    ros.add(lambda: Nurse(quality(1.5, 2.0)))
    (one,) = heart.get_publishers_info_by_topic(TOPIC)
    (other,) = heart.get_subscriptions_info_by_topic(TOPIC)
    assert one.qos_profile.deadline == Duration(seconds=0.5)
    assert limit_ns(one.qos_profile.lifespan) == 0
    assert other.qos_profile.lifespan == Duration(seconds=2.0)


def test_a_real_limit_below_three_years_is_not_touched():
    class Info:
        qos_profile = quality(86400.0 * 365)

    (info,) = as_written([Info])
    assert info.qos_profile.deadline == Duration(seconds=86400 * 365)


def test_a_node_outside_of_a_session_is_not_stretched(ros):
    context = rclpy.Context()
    context.init(domain_id=ros.domain_id)
    try:
        stranger = Node("stranger", context=context)
        stranger.create_publisher(Int32, "own", quality(0.5))
        (info,) = stranger.get_publishers_info_by_topic("own")
        assert info.qos_profile.deadline == Duration(seconds=0.5)
        stranger.destroy_node()
    finally:
        context.shutdown()
