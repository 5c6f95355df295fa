import pytest

from rosbeat.viz.wiring import Edge, describe, is_hidden, wiring


def test_edges_run_from_publisher_over_topic_to_subscription(make):
    shown = wiring(make.graph(make.pub("/a", "/t"), make.sub("/b", "/t")))
    assert shown.nodes == ("/a", "/b")
    assert shown.topics == {"/t": ("std_msgs/msg/Float32",)}
    assert shown.edges == (Edge("node /a", "topic /t"), Edge("topic /t", "node /b"))


def test_infrastructure_is_left_out_unless_asked_for(make):
    graph = make.graph(make.pub("/a", "/rosout"), make.pub("/a", "/parameter_events"))
    assert wiring(graph).topics == {}
    assert list(wiring(graph, infrastructure=True).topics) == ["/rosout", "/parameter_events"]


@pytest.mark.parametrize(("name", "hidden"), [("/_a", True), ("/a/_b", True), ("/a_b", False)])
def test_hidden_names(name, hidden):
    assert is_hidden(name) is hidden


def test_hidden_nodes_are_left_out_but_still_listen(make):
    shown = wiring(make.graph(make.pub("/a", "/t", -1), make.sub("/_watch", "/t", -1)))
    assert shown.nodes == ("/a",)
    assert shown.edges == (Edge("node /a", "topic /t"),)
    assert "Left out: 1 hidden node." in describe(shown)


@pytest.mark.parametrize(
    ("ends", "fault"),
    [
        (lambda m: [m.pub("/a", "/t", 0)], "nobody subscribes"),
        (lambda m: [m.pub("/a", "/t", -1)], "nobody subscribes"),
        (lambda m: [m.sub("/a", "/t", 0)], "nobody publishes"),
        (lambda m: [m.pub("/a", "/t", 0), m.sub("/b", "/t", 0)], "QoS does not match"),
        (lambda m: [m.pub("/a", "/t", 0), m.sub("/b", "/t", 0, "std_msgs/msg/String")],
         "types differ"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_said(make, ends, fault):
    shown = wiring(make.graph(*ends(make)))
    assert shown.faults("/t") == (fault,)
    assert fault in describe(shown)


def test_a_matched_or_unknown_pair_is_fine(make):
    for matched in (1, -1):
        graph = make.graph(make.pub("/a", "/t", matched), make.sub("/b", "/t", matched))
        assert wiring(graph).faults("/t") == ()


def test_what_comes_from_another_process_is_not_said_to_come_from_nobody(make):
    heard = wiring(make.graph(make.sub("/b", "/t", 1)))
    assert "published by another process, subscribed to by /b" in describe(heard)
    said = wiring(make.graph(make.pub("/a", "/t", 1)))
    assert "published by /a, subscribed to by another process" in describe(said)


def test_one_broken_reader_does_not_break_the_others(make):
    graph = make.graph(make.pub("/a", "/t"), make.sub("/b", "/t", 0), make.sub("/c", "/t"))
    assert [edge.fault for edge in wiring(graph).edges] == ["", "QoS does not match", ""]
    assert "QoS does not match for /b." in describe(wiring(graph))


def test_two_publishers_of_one_node_are_one_arrow(make):
    graph = make.graph(make.pub("/a", "/t", 0), make.pub("/a", "/t", 1), make.sub("/b", "/t"))
    assert wiring(graph).edges[0] == Edge("node /a", "topic /t")


def test_the_words_say_who_talks_to_whom(make):
    graph = make.graph(make.pub("/a", "/t"), make.sub("/b", "/t"), alone=["/c"])
    assert describe(wiring(graph)) == (
        "3 nodes and 1 topic. /t (Float32): published by /a, subscribed to by /b. /c uses no topic."
    )
