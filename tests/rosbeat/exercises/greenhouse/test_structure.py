"""Which topics lead where."""

from rosbeat.exercises.greenhouse.structure import reached
from rosbeat.records import Endpoint, GraphSnapshot, QoS


def graph(*ends):
    points = tuple(Endpoint(node, name, "x", kind, QoS()) for node, name, kind in ends)
    return GraphSnapshot(tuple(sorted({end.node for end in points})), points)


def test_a_topic_leads_through_nodes_and_services():
    found = graph(
        ("/a", "/in", "subscription"), ("/a", "/middle", "publisher"),
        ("/b", "/middle", "subscription"), ("/b", "/ask", "server"),
        ("/c", "/ask", "client"), ("/c", "/out", "publisher"),
        ("/d", "/else", "subscription"), ("/d", "/other", "publisher"),
    )  # fmt: skip
    assert reached(found, "/in") == {"/in", "/middle", "/ask", "/out"}
    assert reached(found, "/else") == {"/else", "/other"}


def test_publishing_leads_nowhere_back():
    found = graph(
        ("/a", "/in", "subscription"), ("/b", "/in", "publisher"), ("/b", "/x", "publisher")
    )
    assert reached(found, "/in") == {"/in"}
