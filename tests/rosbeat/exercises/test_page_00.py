"""Page 00: which articles a reader heard, and what a reporter wrote, from made-up evidence."""

import pytest

from rosbeat.exercises.registry import EXERCISES
from rosbeat.records import NANOSECONDS, CallbackRecord, GraphSnapshot, Observation, Sample

STRING = "std_msgs/msg/String"


def heard(*topics):
    """What is said of a reader whose callback ran for messages on these topics."""
    calls = [CallbackRecord(0, "/reader", "subscription", "read", f"/{one}") for one in topics]
    return EXERCISES["00a"].judged(Observation(0, 0, callbacks=tuple(calls)))


def written(*articles):
    """What is said of a reporter that wrote an article every two seconds."""
    samples = [
        Sample(n * 2 * NANOSECONDS, "/sports", STRING, "/reporter", {"data": text})
        for n, text in enumerate(articles, 1)
    ]
    graph = GraphSnapshot(("/reporter",))
    seen = Observation(9 * NANOSECONDS, 0, tuple(samples), graph=graph, subject="/reporter")
    return EXERCISES["00b"].judged(seen)


@pytest.mark.parametrize(
    ("topics", "mistake"),
    [
        (["weather"] * 3, ""),
        (["weather"] * 2, "new-to-me"),
        (["weather"] * 6, "heard-twice"),
        (["sports"] * 3, "wrong-topic"),
        (["weather", "sports"] * 3, "wrong-topic"),
        ([], "no-subscription"),
    ],
)
def test_a_reader_hears_each_article_on_the_weather_once(topics, mistake):
    assert heard(*topics).mistake == mistake


@pytest.mark.parametrize(
    ("article", "mistake"), [("0", ""), (" Goal ", ""), ("", "wrong-values"), (" ", "wrong-values")]
)
def test_no_article_is_empty(article, mistake):
    assert written("Goal", "Goal", "Goal", article).mistake == mistake


def test_the_empty_article_is_shown():
    assert "at 4 s is empty" in written("Goal", "", "Goal", "Goal").evidence
