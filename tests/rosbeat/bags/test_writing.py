"""What is written, byte for byte, and what is refused."""

import hashlib
from dataclasses import replace

import pytest
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rosbags.rosbag2 import Reader

from nodes import Talker
from rosbeat import Session
from rosbeat.bags import Bag, record
from rosbeat.errors import BagError
from rosbeat.records import GraphSnapshot, Observation, QoS

STORAGES = ["mcap", "sqlite3"]


def digest(folder):
    """One number for every name and every byte in a folder."""
    found = hashlib.sha256()
    for path in sorted(folder.rglob("*")):
        found.update(path.name.encode())
        found.update(path.read_bytes())
    return found.hexdigest()


@pytest.mark.parametrize("storage", STORAGES)
def test_the_same_observation_gives_the_same_bytes(tmp_path, make, storage):
    run = make.run([20.0 + at % 7 for at in range(500)])
    folders = [tmp_path / "one", tmp_path / "deep" / "er" / "other"]
    for folder in folders:
        record(run, folder, storage=storage)
    assert len({digest(folder) for folder in folders}) == 1
    record(replace(run, seed=8), tmp_path / "third", storage=storage)
    assert digest(tmp_path / "third") != digest(folders[0])


@pytest.mark.ros
def test_two_sessions_with_one_seed_give_the_same_bytes(tmp_path):
    for name in "ab":
        with Session(seed=5) as ros:
            ros.add(Talker)
            ros.run(5)
            record(ros, tmp_path / name)
    assert digest(tmp_path / "a") == digest(tmp_path / "b")


@pytest.mark.parametrize("storage", STORAGES)
def test_stamps_are_virtual_and_definitions_are_included(tmp_path, make, storage):
    record(make.run([1.0, 2.0]), tmp_path / "run", storage=storage)
    with Reader(tmp_path / "run") as reader:
        (found,) = reader.connections
        assert [stamp for _, stamp, _ in reader.messages([found])] == [10**9, 2 * 10**9]
    assert (found.msgtype, found.msgdef.data) == ("std_msgs/msg/Float32", "float32 data\n")
    assert found.digest.startswith("RIHS01_")


@pytest.mark.ros
@pytest.mark.parametrize("storage", STORAGES)
def test_what_the_publishers_offered_is_in_the_metadata(tmp_path, storage):
    stored = QoSProfile(depth=3, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    hasty = QoSProfile(depth=7, reliability=ReliabilityPolicy.BEST_EFFORT)
    with Session() as ros:
        ros.add(lambda: Talker("one", qos=stored))
        ros.add(lambda: Talker("two", qos=hasty))
        ros.run(2)
        bag = record(ros, tmp_path / "run", storage=storage)
    assert bag.qos == {
        "/count": (
            QoS("RELIABLE", "TRANSIENT_LOCAL", "KEEP_LAST", 3),
            QoS("BEST_EFFORT", "VOLATILE", "KEEP_LAST", 7),
        )
    }
    text = (tmp_path / "run" / "metadata.yaml").read_text()
    assert "version: 9" in text
    assert "durability: transient_local" in text


def test_an_older_recording_is_not_overwritten(tmp_path, make, says):
    record(make.run([1.0]), tmp_path / "run")
    before = digest(tmp_path / "run")
    with pytest.raises(BagError) as caught:
        record(make.run([2.0]), tmp_path / "run")
    says(caught.value, "something at", "keep_old=True")
    assert digest(tmp_path / "run") == before
    assert [path.name for path in tmp_path.iterdir()] == ["run"]


def test_an_older_recording_is_kept_aside_when_asked(tmp_path, make):
    for value in (1.0, 2.0, 3.0):
        record(make.run([value]), tmp_path / "run", keep_old=True)
    found = {path.name: Bag(path).messages("temperature")[0].value for path in tmp_path.iterdir()}
    assert found == {"run-1": 1.0, "run-2": 2.0, "run": 3.0}


@pytest.mark.parametrize("kind", ["file", "dangling link", "empty folder"])
def test_nothing_else_is_overwritten_either(tmp_path, make, says, kind):
    place = tmp_path / "run"
    {
        "file": lambda: place.write_text("mine"),
        "dangling link": lambda: place.symlink_to(tmp_path / "nowhere"),
        "empty folder": place.mkdir,
    }[kind]()
    with pytest.raises(BagError) as caught:
        record(make.run([1.0]), place)
    says(caught.value, "something at")
    assert kind != "file" or place.read_text() == "mine"


def test_only_the_topics_asked_for_are_recorded(tmp_path, make):
    run = make.run([1.0])
    more = (make.sample(1, True, "/door", "/lock", "std_msgs/msg/Bool"),)
    run = replace(run, samples=run.samples + more)
    assert record(run, tmp_path / "all").topics == ("/temperature", "/door")
    assert record(run, tmp_path / "one", topics="door").topics == ("/door",)
    assert record(run, tmp_path / "two", topics=["/door", "temperature"]).topics == (
        *("/door", "/temperature"),
    )


def test_a_topic_without_messages_and_a_run_without_anything_are_recorded(tmp_path, make):
    for storage in STORAGES:
        silent = record(make.run([], seconds=3), tmp_path / f"silent {storage}", storage=storage)
        assert (silent.counts, silent.seconds, silent.start) == ({"/temperature": 0}, 3.0, 0.0)
        assert silent.messages("temperature") == ()
        empty = record(Observation(0, 0), tmp_path / f"empty {storage}", storage=storage)
        assert (empty.topics, len(empty), empty.observation()) == ((), 0, Observation(0, 0))


def test_infrastructure_is_left_out_unless_asked_for(tmp_path, make):
    log = make.publisher("/rosout", kind="rcl_interfaces/msg/Log")
    run = Observation(1, 0, graph=GraphSnapshot(("/sensor",), (log,)))
    assert record(run, tmp_path / "a").topics == ()
    assert record(run, tmp_path / "b", topics="rosout").topics == ("/rosout",)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"storage": "rosbag"}, "cannot be stored as 'rosbag'"),
        ({"topics": "temprature"}, "Did you mean '/temperature'"),
        ({"topics": [3]}, "not the name of a topic"),
        ({"folder": ""}, "not the name of a folder"),
        ({"folder": None}, "not the name of a folder"),
        ({"folder": "a\0b"}, "not the name of a folder"),
        ({"source": 3}, "is not a run"),
        ({"source": Session}, "is not a run"),
    ],
)
def test_bad_input_gets_three_parts(tmp_path, make, says, change, words):
    given = {"source": make.run([1.0]), "folder": tmp_path / "run", **change}
    with pytest.raises(BagError) as caught:
        record(given.pop("source"), given.pop("folder"), **given)
    says(caught.value, words)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("storage", STORAGES)
def test_a_message_that_does_not_fit_leaves_nothing_behind(tmp_path, make, says, storage):
    with pytest.raises(BagError) as caught:
        record(make.run([1.0, "warm"]), tmp_path / "run", storage=storage)
    says(caught.value, "Message 2 on /temperature is not a std_msgs/msg/Float32: 'warm' is not")
    assert list(tmp_path.iterdir()) == []


def test_two_types_on_a_topic_are_refused(tmp_path, make, says):
    run = make.run([1.0])
    other = make.sample(2, "warm", kind="std_msgs/msg/String")
    with pytest.raises(BagError) as caught:
        record(replace(run, samples=(*run.samples, other)), tmp_path / "run")
    says(caught.value, "Messages of two types are on /temperature")


def test_a_place_inside_a_file_gets_three_parts(tmp_path, make, says):
    (tmp_path / "file").write_text("mine")
    with pytest.raises(BagError) as caught:
        record(make.run([1.0]), tmp_path / "file" / "run")
    says(caught.value, "could not be written")


@pytest.mark.parametrize("storage", STORAGES)
@pytest.mark.parametrize("name", ["C# run", "what?", "50%20", "grün 🌡", "a'b\"c", "a.b", "~x"])
def test_any_name_will_do(tmp_path, make, storage, name):
    run = make.run([1.0, 2.0])
    record(run, tmp_path / name / name, storage=storage)
    assert Bag(tmp_path / name / name).messages("temperature") == run.samples


def test_a_name_may_be_relative(tmp_path, make, monkeypatch):
    monkeypatch.chdir(tmp_path)
    record(make.run([1.0]), "run")
    assert Bag("run").counts == {"/temperature": 1}
    assert [path.name for path in tmp_path.iterdir()] == ["run"]
