"""What is drawn of one topic."""

import math

import pytest

from rosbeat.panel.charts import POINTS, Arrival, Chart
from rosbeat.records import Sample


def arrival(data, count=1, seconds=0.0, node="/sensor"):
    return Arrival(count, Sample(round(seconds * 1e9), "/t", "a/msg/B", node, data))


def test_points_are_sent_once_and_all_of_them_when_asked_for():
    chart = Chart()
    for k in range(4):
        chart.add(arrival({"data": float(k)}, seconds=k))
    assert chart.news(4, whole=False)["points"] == [(0, 0), (1, 1), (2, 2), (3, 3)]
    assert chart.news(4, whole=False)["points"] == []
    chart.add(arrival({"data": 4.0}, seconds=4))
    assert chart.news(4, whole=False)["points"] == [(4, 4)]
    assert len(chart.news(4, whole=True)["points"]) == 5


def test_counts_are_those_of_the_session_and_not_of_the_points():
    chart = Chart()
    chart.add(arrival({"data": 1.0}, count=7))
    chart.add(arrival({"data": 1.0}, count=2, node="/other"))
    news = chart.news(0, whole=False)
    assert news["total"] == 9
    assert news["from"] == {"/sensor": 7, "/other": 2}
    assert chart.news(0, whole=False)["from"] == {}


def test_only_half_a_minute_is_drawn():
    chart = Chart()
    for k in range(2 * POINTS):
        chart.add(arrival({"data": 0.0}, seconds=k / 20))
    at = [point[0] for point in chart.news(64, whole=True)["points"]]
    assert at[0] >= 34
    assert at[-1] == pytest.approx(63.95)


def test_a_rate_is_counted_over_two_seconds_and_falls_to_nothing():
    chart = Chart()
    rates = []
    for k in range(100):
        if k < 60:
            chart.add(arrival({"data": 0.0}, count=5, seconds=k / 20))
        rates.append(chart.news(k / 20, whole=False)["rate"])
    assert rates[55] == 100
    assert rates[-1] < 2
    chart.news(60, whole=False)
    assert chart.news(61, whole=False)["rate"] == 0
    assert not chart.was_busy


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_what_has_no_place_on_an_axis_is_a_gap(value):
    chart = Chart()
    chart.add(arrival({"data": value}))
    news = chart.news(0, whole=False)
    assert news["points"] == [(0, None)]
    assert news["text"] in ("nan", "inf", "−inf")


@pytest.mark.parametrize(
    ("data", "text", "field", "points"),
    [
        ({"data": 22.123456789}, "22.12", "", 1),
        ({"data": "Normal"}, "Normal", "", 0),
        ({"data": True}, "True", "", 1),
        ({}, "{}", "", 0),
        ({"header": {"stamp": {"sec": 3}}, "temperature": 4.5}, "4.5", "temperature", 1),
        ({"position": {"x": 1.5}, "y": 2}, "1.5", "position.x", 1),
        ({"data": "x" * 500}, "x" * 119 + "…", "", 0),
    ],
)
def test_any_message_has_words_and_numbers_have_points(data, text, field, points):
    chart = Chart()
    chart.add(arrival(data))
    news = chart.news(0, whole=False)
    assert (news["text"], news["field"], len(news["points"])) == (text, field, points)
