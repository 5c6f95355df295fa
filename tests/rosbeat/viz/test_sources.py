import pytest

from rosbeat.errors import PictureError
from rosbeat.records import GraphSnapshot, Observation
from rosbeat.viz import sources

SEEN = Observation(0, 7)


class Session:
    def observation(self):
        return SEEN


@pytest.mark.parametrize("source", [SEEN, Session()])
def test_an_observation_and_a_session_do(source):
    assert sources.observed(source) is SEEN
    assert sources.snapshot(source) is SEEN.graph
    assert sources.samples(source) == ()


def test_a_graph_does_for_a_graph():
    graph = GraphSnapshot(("/a",))
    assert sources.snapshot(graph) is graph


def test_samples_may_come_one_by_one(make):
    one = make.sample(1, 2.0)
    assert sources.samples([one]) == (one,)
    assert sources.samples(iter([one])) == (one,)


@pytest.mark.parametrize("reader", [sources.observed, sources.snapshot, sources.samples])
@pytest.mark.parametrize("wrong", [None, 3, "text", Session, [1]])
def test_anything_else_gets_three_parts(reader, wrong):
    with pytest.raises(PictureError) as caught:
        reader(wrong)
    assert type(wrong).__name__ in caught.value.what
    assert caught.value.means
    assert caught.value.to_try


def test_topic_names_forgive_the_slash_and_repetition():
    known = ("/rosout", "/temperature", "/alert")
    assert sources.topic_names("temperature", known) == ("/temperature",)
    assert sources.topic_names(["alert", "/alert"], known) == ("/alert",)
    assert sources.topic_names(None, known) == ("/temperature", "/alert")


def test_an_unknown_name_gets_the_nearest():
    with pytest.raises(PictureError, match=r"Did you mean '/temperature'\?"):
        sources.topic_names("/temprature", ("/temperature", "/alert"))


def test_an_unknown_name_unlike_any_gets_advice():
    with pytest.raises(PictureError, match="Check the name"):
        sources.known_name("zzz", (), "topic")
