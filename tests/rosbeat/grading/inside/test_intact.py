"""What an answer may change, and what not."""

import json
import random

import pytest
import rclpy.node
from rclpy.node import Node
from std_msgs.msg import Float32

from rosbeat.grading.inside import intact
from rosbeat.grading.inside.intact import census, differences
from rosbeat.ros import world

pytestmark = pytest.mark.ros


def other(*_, **__):
    """What is put in the place of something."""


def test_nothing_has_changed_where_nothing_was_done():
    before = census()
    json.dumps([random.random()])
    assert differences(before) == ()


@pytest.mark.parametrize(
    ("place", "name", "said"),
    [
        (json, "dumps", "json.dumps"),
        (json.JSONEncoder, "encode", "json.encoder.JSONEncoder.encode"),
        (random, "uniform", "random.uniform"),
        (Node, "create_timer", "rclpy.node.Node.create_timer"),
        (rclpy.node, "Node", "rclpy.node.Node"),
        (world, "SeededRandom", "rosbeat.ros.world.SeededRandom"),
        (intact, "differences", "rosbeat.grading.inside.intact.differences"),
    ],
)
def test_what_is_replaced_is_named(monkeypatch, place, name, said):
    before = census()
    monkeypatch.setattr(place, name, other)
    assert said in differences(before)
    monkeypatch.undo()
    assert differences(before) == ()


def test_what_calls_itself_equal_is_another_thing(monkeypatch):
    class Equal:
        __hash__ = object.__hash__

        def __eq__(self, other):
            return True

        def __call__(self):
            """Do nothing."""

    before = census()
    monkeypatch.setattr(json, "dumps", Equal())
    assert differences(before) == ("json.dumps",)


def test_what_is_taken_away_is_named(monkeypatch):
    before = census()
    monkeypatch.delattr(json, "loads")
    assert "json.loads" in differences(before)


def test_another_body_is_another_function(monkeypatch):
    before = census()
    monkeypatch.setattr(json.dumps, "__code__", other.__code__)
    assert "json.dumps" in differences(before)


def test_other_defaults_are_another_function(monkeypatch):
    before = census()
    monkeypatch.setattr(json.dumps, "__kwdefaults__", {"skipkeys": True})
    assert "json.dumps" in differences(before)


def test_values_and_messages_may_change(monkeypatch):
    before = census()
    monkeypatch.setattr(world, "NANOSECONDS", 5, raising=False)
    monkeypatch.setattr(Float32, "data", 1.0)
    assert differences(before) == ()


def test_a_report_stays_short(monkeypatch):
    before = census()
    for name in dir(random):
        if callable(getattr(random, name)) and not name.startswith("_"):
            monkeypatch.setattr(random, name, other)
    assert len(differences(before)) == 5


@pytest.mark.parametrize("seconds", [1, 3])
def test_what_the_course_does_itself_is_no_change(seconds):
    before = census()
    from rosbeat import Session

    with Session(seed=1) as session:
        session.run(seconds=seconds, quiet=True)
    assert differences(before) == ()
