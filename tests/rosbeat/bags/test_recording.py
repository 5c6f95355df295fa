"""What `record` writes, byte for byte, what comes back, and what is refused."""

import hashlib
import subprocess
import sys
from dataclasses import replace
from itertools import product

import pytest
from rosbags.rosbag2 import Reader

import rosbeat.bags
from nodes import Talker
from record_builders import FLOAT, at, pub, run_of, sample
from rosbeat import Session
from rosbeat.bags import Bag, record
from rosbeat.errors import BagError
from rosbeat.records import GraphSnapshot, Observation, QoS

BOOL = "std_msgs/msg/Bool"
STORAGES = ["mcap", "sqlite3"]
LOCK = sample(1, True, "/door", "/lock", BOOL)
WITH_DOOR = replace(run_of([1.0]), samples=(*run_of([1.0]).samples, LOCK))


def digest(folder):
    """One number for every name and every byte in a folder."""
    found = hashlib.sha256()
    for path in sorted(folder.rglob("*")):
        found.update(path.name.encode())
        found.update(path.read_bytes())
    return found.hexdigest()


# What comes back.


@pytest.mark.parametrize("storage", STORAGES)
def test_everything_comes_back(tmp_path, storage):
    run = run_of([float(at) for at in range(60)])
    bag = record(run, tmp_path / "run", storage=storage)
    assert (bag.storage, bag.topics, len(bag)) == (storage, ("/temperature",), 60)
    assert bag.types == {"/temperature": FLOAT}
    assert (bag.start, bag.duration, bag.seconds) == (1.0, 59.0, 60.0)
    assert bag.messages("temperature") == bag.messages("/temperature") == run.samples
    assert bag.observation() == run
    # A recording can be recorded again, in the other storage.
    other = STORAGES[1 - STORAGES.index(storage)]
    assert record(bag, tmp_path / "second", storage=other).observation() == run


@pytest.mark.parametrize("storage", STORAGES)
def test_messages_of_one_instant_keep_their_order(tmp_path, storage):
    order = [f"/{letter}" for letter in "cabdbca"]
    samples = tuple(
        sample(time, float(number), topic)
        for time in range(300)
        for number, topic in enumerate(order)
    )
    bag = record(Observation(300 * at(1), 0, samples), tmp_path / "run", storage=storage)
    assert bag.observation().samples == samples
    assert bag.messages("b") == tuple(one for one in samples if one.topic == "/b")


def test_several_publishers_of_a_topic_cannot_be_told_apart(tmp_path):
    samples = (sample(1, 1.0, node="/a"), sample(2, 2.0, node="/b"))
    bag = record(Observation(2 * at(1), 0, samples), tmp_path / "run")
    assert [one.node for one in bag.messages("temperature")] == ["?", "?"]
    assert "from /a and /b" in str(bag)


OFFERED = [
    *(QoS(*words, 5) for words in product(
        ["RELIABLE", "BEST_EFFORT"], ["VOLATILE", "TRANSIENT_LOCAL"], ["KEEP_LAST", "KEEP_ALL"])),
    *(QoS(depth=depth) for depth in (0, 1, 1000)),
    # What another process does not tell stays unknown, and no limit is no limit.
    QoS(history="UNKNOWN", depth=0),
    *(QoS(depth=10, deadline_ns=deadline, lifespan_ns=lifespan) for deadline, lifespan in
      [(0, 0), (1_500_000_000, 0), (0, 7), (10**9, 2 * 10**9)]),
]  # fmt: skip


@pytest.mark.parametrize("storage", STORAGES)
def test_quality_of_service_comes_back(tmp_path, storage):
    ends = [pub("/sensor", f"/topic{number}", -1, qos=qos) for number, qos in enumerate(OFFERED)]
    bag = record(Observation(1, 0, graph=GraphSnapshot(("/sensor",), tuple(ends))),
                 tmp_path / "run", storage=storage)  # fmt: skip
    assert [bag.qos[end.name] for end in ends] == [(qos,) for qos in OFFERED]
    # No limit is written as ROS writes it.
    text = (tmp_path / "run" / "metadata.yaml").read_text()
    assert "sec: 9223372036\n" in text
    assert "nsec: 854775807\n" in text


def test_it_describes_itself(tmp_path):
    run = run_of([1.0, 2.0])
    door = pub("/lock", "/door", -1, BOOL)
    run = replace(run, graph=GraphSnapshot((), (*run.graph.endpoints, door)))
    assert str(record(run, tmp_path / "run")) == (
        "Recording run, stored as MCAP: 2 messages on 2 topics.\n"
        "The session ran for 2 s of virtual time and published messages from 1 s to 2 s.\n"
        "  /temperature: 2 messages of type std_msgs/msg/Float32 from /sensor (reliable, volatile, "
        "keep last 10)\n"
        "  /door: no messages of type std_msgs/msg/Bool from /lock (reliable, volatile, "
        "keep last 10)"
    )
    silent = record(Observation(1_500_000_000, 0), tmp_path / "silent", storage="sqlite3")
    assert str(silent) == (
        "Recording silent, stored as SQLite: no messages on no topics.\n"
        "The session ran for 1.5 s of virtual time."
    )


# What is written.


@pytest.mark.parametrize("storage", STORAGES)
def test_the_same_observation_gives_the_same_bytes(tmp_path, storage):
    run = run_of([20.0 + time % 7 for time in range(500)])
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
def test_stamps_are_virtual_and_definitions_are_included(tmp_path, storage):
    record(run_of([1.0, 2.0]), tmp_path / "run", storage=storage)
    with Reader(tmp_path / "run") as reader:
        (found,) = reader.connections
        assert [stamp for _, stamp, _ in reader.messages([found])] == [10**9, 2 * 10**9]
    assert (found.msgtype, found.msgdef.data) == ("std_msgs/msg/Float32", "float32 data\n")
    assert found.digest.startswith("RIHS01_")


# Where, and which topics.


def test_an_older_recording_is_not_overwritten(tmp_path, says):
    record(run_of([1.0]), tmp_path / "run")
    before = digest(tmp_path / "run")
    with pytest.raises(BagError) as caught:
        record(run_of([2.0]), tmp_path / "run")
    says(caught.value, "already exists", "keep_old=True")
    assert digest(tmp_path / "run") == before
    assert [path.name for path in tmp_path.iterdir()] == ["run"]


def test_an_older_recording_is_kept_aside_when_asked(tmp_path):
    for value in (1.0, 2.0, 3.0):
        record(run_of([value]), tmp_path / "run", keep_old=True)
    found = {path.name: Bag(path).messages("temperature")[0].value for path in tmp_path.iterdir()}
    assert found == {"run-1": 1.0, "run-2": 2.0, "run": 3.0}


@pytest.mark.parametrize("kind", ["file", "dangling link", "empty folder"])
def test_nothing_else_is_overwritten_either(tmp_path, says, kind):
    place = tmp_path / "run"
    {
        "file": lambda: place.write_text("mine"),
        "dangling link": lambda: place.symlink_to(tmp_path / "nowhere"),
        "empty folder": place.mkdir,
    }[kind]()
    with pytest.raises(BagError) as caught:
        record(run_of([1.0]), place)
    says(caught.value, "already exists")
    assert kind != "file" or place.read_text() == "mine"


@pytest.mark.parametrize(
    ("run", "topics", "recorded"),
    [
        (WITH_DOOR, None, ("/temperature", "/door")),
        (WITH_DOOR, "door", ("/door",)),
        (WITH_DOOR, ["/door", "temperature"], ("/door", "/temperature")),
        (WITH_DOOR, ["door", "/door"], ("/door",)),
        # Infrastructure is left out unless asked for.
        (Observation(1, 0, graph=GraphSnapshot((), (pub("/sensor", "/rosout"),))), None, ()),
        (Observation(1, 0, graph=GraphSnapshot((), (pub("/sensor", "/rosout"),))), "rosout",
         ("/rosout",)),
        # A topic without messages, and a run without anything.
        (run_of([], seconds=3), None, ("/temperature",)),
        (Observation(0, 0), None, ()),
    ],
)  # fmt: skip
def test_which_topics_are_recorded(tmp_path, run, topics, recorded):
    counts = {topic: sum(one.topic == topic for one in run.samples) for topic in recorded}
    for storage in ["mcap"] if run.samples else STORAGES:
        bag = record(run, tmp_path / storage, topics=topics, storage=storage)
        assert (bag.topics, bag.counts, len(bag)) == (recorded, counts, sum(counts.values()))
        assert bag.seconds == run.time_ns / 1e9
        assert bag.observation().samples == tuple(
            one for one in run.samples if one.topic in recorded
        )


@pytest.mark.parametrize("storage", STORAGES)
@pytest.mark.parametrize("name", ["C# run", "what?", "50%20", "grün 🌡", "a'b\"c", "a.b", "~x"])
def test_any_name_will_do(tmp_path, storage, name):
    run = run_of([1.0, 2.0])
    record(run, tmp_path / name / name, storage=storage)
    assert Bag(tmp_path / name / name).messages("temperature") == run.samples


def test_a_name_may_be_relative_or_at_home(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("HOME", str(tmp_path))
    record(run_of([1.0]), "run")
    assert Bag("run").counts == Bag("~/run").counts == {"/temperature": 1}
    assert [path.name for path in tmp_path.iterdir()] == ["run"]


# What is refused.


class Watcher:
    def observation(self):
        return run_of([1.0])


def test_an_observer_is_asked(tmp_path):
    assert record(Watcher(), tmp_path / "run").observation() == run_of([1.0])


TWO_TYPES = replace(
    WITH_DOOR, samples=(*WITH_DOOR.samples, sample(2, "warm", kind="std_msgs/msg/String"))
)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"storage": "rosbag"}, "cannot be stored as 'rosbag'"),
        ({"topics": "temprature"}, "Did you mean '/temperature'"),
        ({"topics": [3]}, "not the name of a topic"),
        *(({"folder": folder}, "not the name of a folder")
          for folder in ("", "  ", None, 3, b"run", "a\0b")),
        *(({"source": source}, "is not a run") for source in (3, Session, Watcher)),
        ({"source": TWO_TYPES}, "The topic /temperature has messages of two types"),
        *(({"source": run_of([1.0, "warm"]), "storage": storage},
           "Message 2 on /temperature is not a std_msgs/msg/Float32: 'warm' is not")
          for storage in STORAGES),
    ],
)  # fmt: skip
def test_bad_input_gets_three_parts_and_leaves_nothing_behind(tmp_path, says, change, words):
    given = {"source": run_of([1.0]), "folder": tmp_path / "run", **change}
    with pytest.raises(BagError) as caught:
        record(given.pop("source"), given.pop("folder"), **given)
    says(caught.value, words)
    assert list(tmp_path.iterdir()) == []


def test_a_place_inside_a_file_gets_three_parts(tmp_path, says):
    (tmp_path / "file").write_text("mine")
    with pytest.raises(BagError) as caught:
        record(run_of([1.0]), tmp_path / "file" / "run")
    says(caught.value, "could not be written")


# The package.


def test_every_public_name_is_there_and_only_replay_needs_ros():
    assert sorted(dir(rosbeat.bags)) == sorted(rosbeat.bags.__all__)
    assert all(getattr(rosbeat.bags, name).__doc__ for name in rosbeat.bags.__all__)
    with pytest.raises(AttributeError, match="has no attribute 'rewind'"):
        _ = rosbeat.bags.rewind
    code = (
        "import sys; from rosbeat.bags import Bag, compare, inject, record, stuck; "
        "assert 'rclpy' not in sys.modules; from rosbeat.bags import replay; "
        "assert 'rclpy' in sys.modules"
    )
    subprocess.run([sys.executable, "-c", code], check=True, timeout=100)
