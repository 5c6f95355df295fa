"""Bags of others, and bags that are broken."""

import random
import re
import sqlite3
from textwrap import dedent

import pytest
from mcap.writer import Writer

from record_builders import run_of
from rosbeat.bags import Bag, record
from rosbeat.errors import BagError
from rosbeat.records import QoS

#: How a robot's clock stamps: nanoseconds since 1970.
NOW = 1_700_000_000_123_456_789
WIRE = {value: bytes.fromhex(f"00010000{text}") for value, text in
        ((0.5, "0000003f"), (1.0, "0000803f"), (2.0, "00000040"))}  # fmt: skip
METADATA = """
    rosbag2_bagfile_information:
      version: {version}
      storage_identifier: {storage}
      duration:
        nanoseconds: 1500000000
      starting_time:
        nanoseconds_since_epoch: {now}
      message_count: 3
      topics_with_message_count:
        - topic_metadata:
            name: /temperature
            type: std_msgs/msg/Float32
            serialization_format: cdr
            offered_qos_profiles: {qos}
          message_count: 3
      compression_format: ""
      compression_mode: ""
      relative_file_paths:
        - rosbag2_2023_11_14-22_13_20_0.{ending}
      files:
        - path: rosbag2_2023_11_14-22_13_20_0.{ending}
          starting_time:
            nanoseconds_since_epoch: {now}
          duration:
            nanoseconds: 1500000000
          message_count: 3
"""
OLD_QOS = (
    '"- history: 1\\n  depth: 5\\n  reliability: 2\\n  durability: 2\\n  deadline:\\n    sec: 0\\n'
    "    nsec: 0\\n  lifespan:\\n    sec: 0\\n    nsec: 0\\n  liveliness: 1\\n"
    "  liveliness_lease_duration:\\n    sec: 0\\n    nsec: 0\\n"
    '  avoid_ros_namespace_conventions: false"'
)
NEW_QOS = """
              - history: keep_last
                depth: 5
                reliability: best_effort
                durability: volatile
                deadline: {sec: 9223372036, nsec: 854775807}
                lifespan: {sec: 2147483647, nsec: 999999999}
                liveliness: automatic
                liveliness_lease_duration: {sec: 9223372036, nsec: 854775807}
                avoid_ros_namespace_conventions: false"""
NOTES = "  custom_data: ~\n  ros_distro: jazzy\n"
MESSAGES = [(NOW, 0.5), (NOW + 10**9, 1.0), (NOW + 1_500_000_000, 2.0)]


def metadata(folder, version, storage, ending):
    folder.mkdir()
    qos = NEW_QOS if version == 9 else OLD_QOS
    text = dedent(METADATA).lstrip().format(
        version=version, storage=storage, ending=ending, now=NOW, qos="QOS"
    )  # fmt: skip
    text = text.replace("QOS", dedent(qos) if version < 9 else qos.replace("\n    ", "\n"))
    notes = NOTES if version >= 8 else ""
    (folder / "metadata.yaml").write_text(text + notes)
    return folder / f"rosbag2_2023_11_14-22_13_20_0.{ending}"


def old_qos():
    """Quality of service as it is in the data of older bags: YAML without quotation marks."""
    return OLD_QOS.strip('"').replace("\\n", "\n")


def humble(folder):
    """A bag as ROS 2 Humble writes it: SQLite without definitions."""
    database = sqlite3.connect(metadata(folder, 5, "sqlite3", "db3"))
    database.executescript("""
        CREATE TABLE schema(schema_version INTEGER PRIMARY KEY, ros_distro TEXT NOT NULL);
        CREATE TABLE metadata(id INTEGER PRIMARY KEY, metadata_version INTEGER NOT NULL,
            metadata TEXT NOT NULL);
        CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL,
            serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL);
        CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL,
            timestamp INTEGER NOT NULL, data BLOB NOT NULL);
        CREATE INDEX timestamp_idx ON messages (timestamp ASC);
        INSERT INTO schema VALUES (3, 'humble');
    """)
    row = (1, "/temperature", "std_msgs/msg/Float32", "cdr", old_qos())
    database.execute("INSERT INTO topics VALUES (?, ?, ?, ?, ?)", row)
    for at, value in MESSAGES:
        row = (1, at, WIRE[value])
        database.execute("INSERT INTO messages(topic_id, timestamp, data) VALUES (?, ?, ?)", row)
    database.commit()
    database.close()


def jazzy(folder):
    """A bag as ROS 2 Jazzy writes it, made with the library of MCAP's makers."""
    with metadata(folder, 9, "mcap", "mcap").open("wb") as file:
        writer = Writer(file)
        writer.start(profile="ros2", library="libmcap 1.3.0")
        schema = writer.register_schema("std_msgs/msg/Float32", "ros2msg", b"float32 data\n")
        qos = NEW_QOS.replace("\n              ", "\n").strip()
        more = {"offered_qos_profiles": qos, "topic_type_hash": "RIHS01_0"}
        channel = writer.register_channel("/temperature", "cdr", schema, more)
        for number, (at, value) in enumerate(MESSAGES):
            writer.add_message(channel, at, WIRE[value], at, number)
        writer.finish()


MADE = {"humble": humble, "jazzy": jazzy}


@pytest.mark.parametrize("who", MADE)
def test_a_bag_of_somebody_else_is_read(tmp_path, who):
    MADE[who](tmp_path / "bag")
    bag = Bag(tmp_path / "bag")
    assert (bag.topics, bag.counts) == (("/temperature",), {"/temperature": 3})
    assert bag.qos["/temperature"] == (QoS("BEST_EFFORT", "VOLATILE", "KEEP_LAST", 5),)
    assert (bag.start, bag.duration, bag.seconds) == (NOW / 1e9, 1.5, 1.5)
    found = [(one.time, one.value, one.node) for one in bag.messages("temperature")]
    assert found == [(0.0, 0.5, "?"), (1.0, 1.0, "?"), (1.5, 2.0, "?")]
    assert "It lasts 1.5 s and begins at 2023-11-14 22:13:20 UTC." in str(bag)
    assert bag.observation().graph.nodes == ()


@pytest.mark.parametrize("ending", ["mcap", "db3"])
def test_a_single_file_is_read(tmp_path, ending):
    record(run_of([1.0, 2.0]), tmp_path / "run", storage="mcap" if ending == "mcap" else "sqlite3")
    bag = Bag(tmp_path / "run" / f"messages.{ending}")
    assert [one.value for one in bag.messages("temperature")] == [1.0, 2.0]


def damaged_by(name, text):
    return lambda folder: (folder / name).write_text(text)


@pytest.mark.parametrize(
    ("spoil", "words"),
    [
        (lambda folder: folder.rename(folder.parent / "elsewhere"), "no recording"),
        (lambda folder: [path.unlink() for path in folder.iterdir()], "no recording"),
        (lambda folder: (folder / "messages.mcap").unlink(), "missing"),
        *((damaged_by("metadata.yaml", text), "cannot be read") for text in (
            "", "{", "[]", "rosbag2_bagfile_information: 3",
            "rosbag2_bagfile_information: {version: 99}",
            "rosbag2_bagfile_information: {version: ~}", "\0", "a: !!python/object:os.system {}")),
    ],
)  # fmt: skip
def test_what_is_no_recording_gets_three_parts(tmp_path, says, spoil, words):
    record(run_of([1.0]), tmp_path / "run")
    spoil(tmp_path / "run")
    with pytest.raises(BagError) as caught:
        Bag(tmp_path / "run")
    says(caught.value, words)


def test_a_file_that_is_none_and_data_that_are_gone_get_three_parts(tmp_path, says):
    (tmp_path / "file.txt").write_text("a letter")
    record(run_of([1.0]), tmp_path / "run", storage="sqlite3")
    (tmp_path / "run" / "messages.db3").unlink()
    for name in ("file.txt", "run"):
        with pytest.raises(BagError) as caught:
            Bag(tmp_path / name)
        says(caught.value, "cannot be read")


@pytest.mark.parametrize("asked", ["temprature", 3])
def test_an_unknown_topic_gets_three_parts(tmp_path, says, asked):
    bag = record(run_of([1.0]), tmp_path / "run")
    with pytest.raises(BagError) as caught:
        bag.messages(asked)
    says(caught.value, "not the name of a topic" if asked == 3 else "Did you mean '/temperature'")


@pytest.mark.parametrize("note", ["rosbeat.session_ns", "rosbeat.seed", "rosbeat.publishers"])
@pytest.mark.parametrize("value", ["", "'['", "'null'", "'\"a\"'", "'{\"/a\": 3}'"])
def test_notes_that_were_edited_do_no_harm(tmp_path, note, value):
    record(run_of([1.0, 2.0]), tmp_path / "run")
    path = tmp_path / "run" / "metadata.yaml"
    text, changed = re.subn(f"{note}: .*", f"{note}: {value}", path.read_text())
    assert changed == 1
    path.write_text(text)
    # It is read as a bag of somebody else, which begins at its first message.
    found = [(one.time, one.node) for one in Bag(tmp_path / "run").messages("temperature")]
    assert found == [(0.0, "?"), (1.0, "?")]


def test_messages_that_cannot_be_found_are_missed(tmp_path, says):
    # The library drops what has another quality of service in the data than in metadata.yaml.
    record(run_of([1.0, 2.0]), tmp_path / "run")
    path = tmp_path / "run" / "metadata.yaml"
    path.write_text(path.read_text().replace("reliability: reliable", "reliability: best_effort"))
    with pytest.raises(BagError) as caught:
        Bag(tmp_path / "run").messages("temperature")
    says(caught.value, "its metadata lists 2 messages, but the data contains 0")


def damage(data, dice):
    """A file as a bad disk or a broken copy leaves it."""
    at, long = dice.randrange(len(data)), dice.randrange(1, 40)
    return dice.choice([
        lambda: data[:at],
        lambda: data[:at] + bytes(dice.randrange(256) for _ in range(long)) + data[at + long :],
        lambda: data[:at] + bytes(long) + data[at + long :],
        lambda: data[:at] + data[at + long :],
    ])()  # fmt: skip


@pytest.mark.parametrize("name", ["messages.mcap", "messages.db3", "metadata.yaml"])
def test_whatever_is_damaged_it_is_read_or_explained(tmp_path, says, name):
    storage = "sqlite3" if name.endswith("db3") else "mcap"
    run = run_of([20.0 + at for at in range(50)])
    record(run, tmp_path / "run", storage=storage)
    whole, dice, refused = (tmp_path / "run" / name).read_bytes(), random.Random(4), 0
    for _ in range(40):
        (tmp_path / "run" / name).write_bytes(damage(whole, dice))
        try:
            Bag(tmp_path / "run").observation()
        except BagError as error:
            says(error)
            refused += 1
    assert refused > 5
    (tmp_path / "run" / name).write_bytes(whole)
    assert Bag(tmp_path / "run").observation() == run
