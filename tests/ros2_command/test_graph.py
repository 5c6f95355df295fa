"""When the graph is believed, and what must be in it."""

import time

from ros2_command.graph import SAME_LOOKS, Graph, count_participants, has_gaps


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
        "# Waiting for a complete answer: 2 of 3 ROS processes on this machine have not answered "
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
