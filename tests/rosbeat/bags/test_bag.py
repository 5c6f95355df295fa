"""A recording in hand: what it says, what it gives back."""

from dataclasses import replace

import pytest
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st

from any_message import ANY
from rosbeat.bags import record
from rosbeat.errors import BagError
from rosbeat.records import NANOSECONDS, Observation, Sample

STORAGES = ["mcap", "sqlite3"]


@pytest.mark.parametrize("storage", STORAGES)
def test_everything_comes_back(tmp_path, make, storage):
    run = make.run([float(at) for at in range(60)])
    bag = record(run, tmp_path / "run", storage=storage)
    assert (bag.storage, bag.topics, len(bag)) == (storage, ("/temperature",), 60)
    assert bag.types == {"/temperature": "std_msgs/msg/Float32"}
    assert (bag.start, bag.duration, bag.seconds) == (1.0, 59.0, 60.0)
    assert bag.messages("temperature") == bag.messages("/temperature") == run.samples
    assert bag.observation() == run


@settings(
    max_examples=15,
    deadline=None,
    derandomize=True,
    database=None,
    phases=[Phase.explicit, Phase.generate],  # shrinking such data takes minutes
    suppress_health_check=list(HealthCheck),
)
@given(st.data())
def test_messages_of_any_type_come_back(tmp_path_factory, same, data):
    cases = data.draw(st.lists(ANY, min_size=1, max_size=4, unique_by=lambda case: case[0]))
    times = sorted(data.draw(st.lists(st.integers(0, 2**62), max_size=8)))
    samples = []
    for at in times:
        number = data.draw(st.integers(0, len(cases) - 1))
        name, value = cases[number]
        samples.append(Sample(at, f"/t{number}", name, f"/node{number}", value))
    run = Observation(2**62, 0, tuple(samples))
    folder = tmp_path_factory.mktemp("bag")
    for storage in STORAGES:
        back = record(run, folder / storage, storage=storage).observation().samples
        assert [replace(one, data={}) for one in back] == [replace(one, data={}) for one in samples]
        assert all(same(a.data, b.data) for a, b in zip(back, samples, strict=True))


@pytest.mark.parametrize("storage", STORAGES)
def test_messages_of_one_instant_keep_their_order(tmp_path, make, storage):
    order = [f"/{letter}" for letter in "cabdbca"]
    samples = tuple(
        make.sample(at, float(number), topic)
        for at in range(300)
        for number, topic in enumerate(order)
    )
    bag = record(Observation(300 * NANOSECONDS, 0, samples), tmp_path / "run", storage=storage)
    assert bag.observation().samples == samples
    assert bag.messages("b") == tuple(one for one in samples if one.topic == "/b")


def test_several_publishers_of_a_topic_cannot_be_told_apart(tmp_path, make):
    samples = (make.sample(1, 1.0, node="/a"), make.sample(2, 2.0, node="/b"))
    bag = record(Observation(2 * NANOSECONDS, 0, samples), tmp_path / "run")
    assert [one.node for one in bag.messages("temperature")] == ["?", "?"]
    assert "from /a and /b" in str(bag)


def test_a_recording_can_be_recorded_again_in_the_other_storage(tmp_path, make):
    first = record(make.run([1.0, 2.0]), tmp_path / "first")
    second = record(first, tmp_path / "second", storage="sqlite3")
    assert second.observation() == first.observation()


def test_an_unknown_topic_gets_three_parts(tmp_path, make, says):
    bag = record(make.run([1.0]), tmp_path / "run")
    with pytest.raises(BagError) as caught:
        bag.messages("temprature")
    says(caught.value, "Did you mean '/temperature'")
    with pytest.raises(BagError) as caught:
        bag.messages(3)
    says(caught.value, "not the name of a topic")
