import time

import pytest
from ros2_command.errors import CommandError
from ros2_command.graph import SAME_LOOKS, Graph, count_participants, has_gaps
from ros2_command.names import check_name, full_name, is_hidden, nearest
from ros2_command.packages import nested_type
from ros2_command.verbs.completion import candidates
from ros2_command.verbs.doctor import Finding, report, summarize
from ros2_command.verbs.param import flat, nested
from ros2_command.verbs.topic import Bandwidth, Delays, Rates


def test_the_nearest_name():
    assert nearest("Temprature", ["/humidity", "Temperature"]) == "Temperature"
    assert nearest("temperature", ["/robot/left/arm/temperature"]) == "/robot/left/arm/temperature"
    assert nearest("xyz", ["abc"]) is None
    assert nearest("std_msgs/msg/Nope", ["std_msgs/msg/Int8"]) is None
    assert nearest("std_msgs/msg/Flot32", ["std_msgs/msg/Int8", "std_msgs/msg/Float32"])[-7:] == (
        "Float32"
    )


def test_names():
    assert [is_hidden(name) for name in ("/a/b_", "/a/_b/c", "/_x")] == [False, True, True]
    assert (full_name("a", "/"), full_name("a", "/b")) == ("/a", "/b/a")
    check_name("topic", "~/a/b_1")
    for name in ("", "a//b", "a/", "1a", "a b", "/a/2"):
        with pytest.raises(CommandError):
            check_name("topic", name)


def test_participants_are_counted_by_their_ports():
    def row(port, user, address="00000000"):
        return f" 1: {address}:{port:04X} 00000000:0000 07 0:0 00:0 0 {user} 0 21 2 0 0"

    first = 7400 + 250 * 91 + 10
    rows = [row(first, 1), row(first + 1, 1), row(first + 2, 2), row(first + 2, 2, "0100007F"),
            row(first + 3, 2), row(7410, 1), row(7411, 1)]  # fmt: skip
    others = [row(first + 4, 1), row(first + 5, 2), row(first + 6, 1)]  # of no participant
    head = "  sl  local_address rem_address"
    text = "\n".join([head, *rows, *others])
    assert [count_participants(domain, text) for domain in (91, 0, 5)] == [2, 1, 0]
    assert count_participants(5, "") == 0


def test_rates():
    rates = Rates(window=100)
    assert rates.report() is None
    for now in (0.0, 1.0, 2.0):
        rates.arrived(now)
    text = "average rate: 1.000\n\tmin: 1.000s max: 1.000s std dev: 0.00000s window: 3"
    assert rates.report() == text
    assert rates.report() is None


def test_bandwidth():
    bandwidth = Bandwidth(window=100)
    bandwidth.arrived(0.0, 8)
    assert bandwidth.report(1.0) is None
    bandwidth.arrived(0.5, 8)
    text = "16 B/s from 2 messages\n\tMessage size mean: 8 B min: 8 B max: 8 B"
    assert bandwidth.report(1.0) == text
    large = Bandwidth(window=2)
    for now in (-1.0, 0.0, 0.5):
        large.arrived(now, 5080)
    assert large.report(1.0).splitlines()[0] == "10.16 KB/s from 2 messages"
    assert large.report(-2.0) is None


def test_delays():
    delays = Delays(window=100)
    delays.arrived(10.0, 1.0)  # starts the clock
    assert delays.report() is None
    delays.arrived(11.0, 10.9)
    delays.arrived(12.0, 11.7)
    text = "average delay: 0.200\n\tmin: 0.100s max: 0.300s std dev: 0.10000s window: 2"
    assert delays.report() == text
    assert delays.report() is None


def test_dots_in_names_of_parameters():
    assert nested({"a.b": 1, "a.c": 2, "d": 3}) == {"a": {"b": 1, "c": 2}, "d": 3}
    assert nested({"a": 1, "a.b": 2}) == {"a": 1, "a.b": 2}
    assert flat({"a": {"b": 1, "c": {"d": 2}}, "e.f": 3}) == {"a.b": 1, "a.c.d": 2, "e.f": 3}


@pytest.mark.parametrize(
    ("line", "name"),
    [
        ("Pose pose", "geometry_msgs/msg/Pose"),
        ("Header header # x", "std_msgs/msg/Header"),
        ("builtin_interfaces/Time stamp", "builtin_interfaces/msg/Time"),
        ("BasicTypes[3] x", "geometry_msgs/msg/BasicTypes"),
        ("float64 w 1", None),
        ("string<=10 s", None),
        ("# Pose pose", None),
        ("---", None),
    ],
)
def test_fields_that_are_messages(line, name):
    assert nested_type(line, "geometry_msgs") == name


def test_the_verdict_of_the_doctor(capsys):
    assert summarize({"topic": [], "network": []}, False) == []
    assert capsys.readouterr().out == "\nAll 2 checks passed\n\n"
    found = {"topic": [Finding("a"), Finding("b", True)], "network": [Finding("c")]}
    assert summarize(found, False) == ["topic"]
    text = "\n1/2 check(s) failed\n\nFailed modules: topic\n"
    assert capsys.readouterr() == (text, "WARNING: a\nERROR: b\nWARNING: c\n")
    assert summarize(found, True) == ["topic", "network"]
    assert report([("A", [("k", "v"), ("key", "w")])]) == "\n   A\nk   : v\nkey : w"


def test_completion():
    assert candidates(["to"]) == ["topic"]
    assert candidates(["topic", "e"]) == ["echo"]
    assert candidates(["topic", "echo", "--fi"]) == ["--field", "--filter"]
    assert candidates(["nosuch", ""]) == []
    assert candidates(["bag", ""]) == ["info", "play", "record"]
    goal = ["action", "send_goal", "/fibonacci", "test_msgs/action/F"]
    assert candidates(goal) == ["test_msgs/action/Fibonacci"]
    assert candidates(["interface", "show", "std_srvs/srv/Tri"]) == ["std_srvs/srv/Trigger"]


class ToldGraph(Graph):
    """Sees what it is told to see, one after the other, and then the last for ever."""

    def __init__(self, looks, complete):
        self._looks, self._complete = list(looks), complete
        self._spin_time, self._born = None, time.monotonic()
        self.count = 0

    def _look(self):
        self.count += 1
        return self._looks.pop(0) if len(self._looks) > 1 else self._looks[0]

    def _is_complete(self):
        return self._complete

    def _has_no_gaps(self, since):
        return True

    def _processes(self):
        return {b"one"}, {b"one"}


def test_a_graph_is_believed_when_it_stays_the_same(monkeypatch):
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    assert ToldGraph([0], True).settle().count == SAME_LOOKS
    assert ToldGraph([0, 1, 1, 2, 3], True).settle().count == 4 + SAME_LOOKS
    assert ToldGraph([0], False).settle(lambda: True).count == 0


def test_a_missing_process_is_waited_for_while_there_is_news(monkeypatch):
    monkeypatch.setattr("ros2_command.graph.NO_NEWS", 0.3)
    monkeypatch.setattr("ros2_command.graph.AT_MOST", 60.0)
    graph = ToldGraph([*range(40)], False)
    graph.settle()
    assert graph.age > 39 * 0.02 + 0.3  # 40 looks, so 39 pauses
    monkeypatch.setattr("ros2_command.graph.AT_MOST", 0.1)
    assert ToldGraph([*range(1000)], False).settle().count < 1000


def test_a_long_wait_says_for_what(monkeypatch, capsys):
    monkeypatch.delenv("ROS2_COMMAND_NO_NOTES", raising=False)
    monkeypatch.setattr("ros2_command.graph.SILENT_FOR", 0.1)
    monkeypatch.setattr("ros2_command.graph.NO_NEWS", 0.5)
    monkeypatch.setattr("ros2_command.graph.count_participants", lambda domain: 3)
    ToldGraph([0], True).settle()
    assert capsys.readouterr().err == ""
    ToldGraph([0], False).settle()
    error = capsys.readouterr().err
    assert error == (
        "Waiting for a complete answer: 2 of 3 ROS processes on this machine have not answered "
        "yet.\n"
    )
    monkeypatch.setenv("ROS2_COMMAND_NO_NOTES", "1")
    ToldGraph([0], False).settle()
    assert capsys.readouterr().err == ""


def test_gaps_in_the_numbers_of_endpoints():
    def address(process, number, kind=3):
        return bytes([process] * 12) + number.to_bytes(3, "big") + bytes([kind])

    whole = [address(1, 1), address(1, 2, 4), address(1, 3), address(2, 1)]
    assert not has_gaps(whole)
    assert has_gaps(whole[1:])
    assert has_gaps([*whole, address(2, 3)])
    assert not has_gaps([])
