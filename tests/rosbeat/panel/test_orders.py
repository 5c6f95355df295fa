"""What comes from the browser."""

import math

import pytest

from rosbeat.errors import SessionError
from rosbeat.panel.orders import carry_out


@pytest.mark.parametrize(
    ("order", "asked"),
    [
        ({"do": "pause", "node": "/a"}, ("pause", "/a")),
        ({"do": "start", "node": "/a"}, ("start", "/a")),
        ({"do": "publish", "topic": "/t", "value": 3}, ("publish", "/t", 3.0)),
        ({"do": "repeat", "topic": "/t", "value": 3, "on": True}, ("repeat", "/t", 3.0)),
        ({"do": "repeat", "topic": "/t", "on": False}, ("repeat", "/t", None)),
        (
            {"do": "disturb", "topic": "/t", "kind": "offset", "amount": 2},
            ("disturb", "/t", "offset", 2.0),
        ),
        ({"do": "load", "milliseconds": 200}, ("load", 200.0)),
        ({"do": "load", "milliseconds": 1e9}, ("load", 900.0)),
    ],
)
def test_an_order_reaches_the_session(made_up, order, asked):
    assert carry_out(order, made_up) == ""
    assert made_up.asked == [asked]


@pytest.mark.parametrize(
    "order",
    [
        {},
        {"do": "release"},
        {"do": "__class__"},
        {"do": "pause"},
        {"do": "pause", "node": 3},
        {"do": "publish", "topic": "/t", "value": "hot"},
        {"do": "publish", "topic": "/t", "value": True},
        {"do": "publish", "topic": "/t", "value": math.nan},
        {"do": "disturb", "topic": "/t", "kind": "fire", "amount": 2},
    ],
)
def test_an_order_that_makes_no_sense_changes_nothing(made_up, order):
    assert "does not understand" in carry_out(order, made_up)
    assert made_up.asked == []


def test_what_a_session_refuses_is_said_in_words(made_up):
    def refuse(node):
        raise SessionError(f"There is no {node}.", "It means this.", "Try that.")

    made_up.pause = refuse
    assert carry_out({"do": "pause", "node": "/a"}, made_up) == "There is no /a. Try that."
