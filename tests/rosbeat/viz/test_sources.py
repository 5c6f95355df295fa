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


# The number in a message.


@pytest.mark.parametrize(("value", "number"), [(True, 1.0), (7, 7.0), (2.5, 2.5)])
def test_numbers_and_truth_values(make, value, number):
    assert sources.number_in(make.sample(1, value)) == number


def test_nested_fields(make):
    pose = {"header": {"frame_id": "map"}, "position": {"x": 1.5, "y": 2.0}}
    assert sources.number_in(make.sample(1, pose), "position.x") == 1.5
    assert [name for name, _ in sources.paths(pose)] == [
        "header.frame_id",
        "position.x",
        "position.y",
    ]


def test_a_message_with_fields_names_those_that_are_numbers(make):
    with pytest.raises(PictureError, match="Choose a field: 'x' or 'y'"):
        sources.number_in(make.sample(1, {"x": 1.0, "y": 2.0, "name": "a"}))


@pytest.mark.parametrize("value", ["warm", [1.0, 2.0], None, "long " * 20])
def test_what_is_not_a_number_is_refused(make, value):
    with pytest.raises(PictureError, match="is not a number") as caught:
        sources.number_in(make.sample(1, value))
    assert "Choose a topic that carries numbers." in str(caught.value)


@pytest.mark.parametrize("field", ["dta", "data.x"])
def test_an_unknown_field_names_the_known(make, field):
    with pytest.raises(PictureError, match="have no field") as caught:
        sources.number_in(make.sample(1, 1.0), field)
    assert "'data'" in caught.value.means
