import os
import re
import signal
import time
from contextlib import contextmanager

import pytest

from rosbeat.bags import Bag

DISTRO = os.environ.get("ROS_DISTRO", "jazzy")
INFO = """\

Files:             run_0.mcap
Bag size:          <size>
Storage id:        mcap
ROS Distro:        {distro}
Duration:          <time>s
Start:             <date>
End:               <date>
Messages:          {count}
Topic information: Topic: /house/number | Type: std_msgs/msg/Int32 | Count: {count} | \
Serialization Format: cdr
Service:           0
Service information: 

"""  # noqa: W291


@contextmanager
def recording(ros2, folder, *words, seconds=0.3):
    """Record for some time after the first message; the recorder is still running then."""
    debug = ("--log-level", "debug")
    with ros2.running("bag", "record", "-o", folder, *debug, *words) as process:
        while "The first message on" not in (line := process.stderr.readline()):
            assert line, "the recorder has ended"
        time.sleep(seconds)
        yield process


def values_of(folder, topic):
    return [one.data["data"] for one in Bag(folder).messages(topic)]


def ended(process, number=signal.SIGINT):
    process.send_signal(number)
    out, error = process.communicate(timeout=60)
    return process.returncode, out, error


#: Named, so that `echo` waits for a player that has not begun, and does not ask for its type.
NUMBER = "std_msgs/msg/Int32"


@pytest.mark.ros
def test_record_and_info(rich, tmp_path):
    folder = tmp_path / "run"
    with recording(rich, folder, "house/number") as process:
        code, out, error = ended(process)
    assert (code, out) == (0, "")
    assert error.endswith("[rosbag2_recorder]: Recording stopped\n")
    bag = Bag(folder)
    values = values_of(folder, "/house/number")
    assert values == list(range(values[0], values[0] + len(values)))
    assert (bag.storage, bag.types) == ("mcap", {"/house/number": "std_msgs/msg/Int32"})
    assert bag.qos["/house/number"][0].reliability == "RELIABLE"
    shown = re.sub(r"\d+\.\d{9}s", "<time>s", rich.out("bag", "info", folder))
    date = r"[A-Z][a-z]{2} [ \d]\d \d{4} [\d:]{8}\.\d{9} \(\d+\.\d{9}\)"
    shown = re.sub(
        r"Bag size:          .*", "Bag size:          <size>", re.sub(date, "<date>", shown)
    )
    assert shown == INFO.format(count=len(values), distro=DISTRO)
    assert rich.out("bag", "info", "-t", folder) == "/house/number\n"
    alone = rich.out("bag", "info", folder / "run_0.mcap")
    assert f"ROS Distro:        {DISTRO}\n" in alone


@pytest.mark.ros
def test_record_all_as_sqlite(rich, tmp_path):
    folder = tmp_path / "run"
    words = ("-a", "-s", "sqlite3", "--exclude-regex", "/parameter|rosout", "--exclude-topics",
             "/clock", "--use-sim-time")  # fmt: skip
    with recording(rich, folder, *words, seconds=1.0) as process:
        assert ended(process)[0] == 0
    bag = Bag(folder)
    assert bag.storage == "sqlite3"
    assert (folder / "run_0.db3").is_file()
    assert bag.topics == ("/house/bounded", "/house/number", "/house/point")
    assert bag.start < 3600  # simulated time begins at 0
    assert any(bag.counts.values())


@pytest.mark.ros
def test_what_actions_and_services_have_on_topics_is_recorded(rich, tmp_path):
    topics = ("/house/enable/_service_event", "/house/fibonacci/_action/feedback")
    words = ("--include-hidden-topics", "--topics", *topics)
    with rich.running("bag", "record", "-o", tmp_path / "run", *words) as process:
        for _ in topics:
            while "Subscribed to topic" not in (line := process.stderr.readline()):
                assert line
        rich("service", "call", "/house/enable", "std_srvs/srv/SetBool")
        rich("action", "send_goal", "/house/fibonacci", "test_msgs/action/Fibonacci", "{order: 5}")
        code, _, error = ended(process)
    assert (code, "cannot be recorded" in error) == (0, False)
    bag = Bag(tmp_path / "run")
    assert set(bag.topics) == set(topics)
    assert bag.counts[topics[0]] == 2
    (last,) = bag.messages(topics[1])[-1:]
    assert list(last.data["feedback"]["sequence"]) == [0, 1, 1, 2, 3, 5]


@pytest.mark.ros
def test_sigterm_leaves_a_whole_bag(rich, tmp_path):
    with recording(rich, tmp_path / "run", "--topics", "/house/number") as process:
        assert ended(process, signal.SIGTERM)[0] == 0
    assert Bag(tmp_path / "run").counts["/house/number"]


@pytest.mark.ros
def test_play(rich, tmp_path):
    folder = tmp_path / "run"
    with recording(rich, folder, "/house/number", seconds=1.0) as process:
        ended(process)
    values = values_of(folder, "/house/number")
    with recording(rich, tmp_path / "again", "--topics", "/house/number", "/again") as process:
        rich("bag", "play", folder, "-m", "/house/number:=/again", "--rate", "2", "--delay", "1")
        ended(process)
    played = values_of(tmp_path / "again", "/again")
    assert played == values[-len(played) :]


@pytest.mark.ros
def test_play_tells_the_time_and_ends_at_ctrl_c(rich, tmp_path):
    with recording(rich, tmp_path / "run", "--regex", "numb|point", seconds=1.0) as process:
        ended(process)
    words = ("--loop", "--topics", "/house/number", "--clock", "50", "-m", "/house/number:=/again")
    with rich.running("bag", "play", tmp_path / "run", *words) as process:
        assert rich.out("topic", "echo", "--once", "/again", NUMBER).startswith("data: ")
        assert "/clock: rosgraph_msgs/msg/Clock" in rich.out("node", "info", "/rosbag2_player")
        code, out, error = ended(process)
    assert (code, out) == (0, "")
    said = [line.partition("[rosbag2_player]: ")[2] for line in error.splitlines()]
    assert said == ["Set rate to 1", "Playback until timestamp: -1"]


@pytest.mark.ros
def test_nothing_comes(rich, tmp_path):
    with rich.running("bag", "record", "-o", tmp_path / "run", "/house/numbr") as process:
        assert "Listening for topics" in process.stderr.readline()
        time.sleep(1.5)
        code, _, error = ended(process)
    assert (code, error.splitlines()[-1]) == (
        0, "# No message was recorded. Did you mean '/house/number'?",
    )  # fmt: skip
    assert "Messages:          0\n" in rich.out("bag", "info", tmp_path / "run")


@pytest.mark.parametrize(
    ("words", "said", "code"),
    [
        (("record",), "Need to specify at least one option out of --all", 1),
        (("record", "-o", "full", "-a"), "Output folder 'full' already exists.", 1),
        (("record", "-a", "--snapshot-mode"), "--snapshot-mode' is left out here", 1),
        (("record", "--max-bag-size", "3", "-a"), "one plain file here", 1),
        (("record", "-e", "("), "is not a regular expression", 2),
        (("record", "a b"), "topic name 'a b' is invalid", 1),
        (("info", "nothing"), "Bag path 'nothing' does not exist!", 2),
        (("info", "full"), "Was the recording ended with Ctrl+C?", 1),
        (("play", "full"), "'full' cannot be read", 1),
        (("play", "full", "-r", "0"), "not in the valid range", 2),
        (("play", "full", "-m", "x"), "'x' is no remapping.", 1),
        (("play", "full", "-p"), "'ros2 bag play -p' is left out here", 1),
    ],
)
def test_what_is_refused(ros2, tmp_path, words, said, code):
    (tmp_path / "full").mkdir()
    (tmp_path / "full" / "full.mcap").write_bytes(b"")
    assert said in ros2.error("bag", *words, code=code, cwd=tmp_path)
    assert sorted(one.name for one in tmp_path.iterdir()) == ["full"]
