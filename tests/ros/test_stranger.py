"""The greenhouse: what there is to find in it, and that it is the same each time."""

import pytest

from rosbeat import Session
from rosbeat.ros import test_nodes

pytestmark = pytest.mark.ros


def test_two_runs_are_the_same(capfd):
    assert test_nodes.watched() == test_nodes.watched()
    assert capfd.readouterr() == ("", "")


def test_there_is_one_answer_to_each_question():
    system, parameters = test_nodes.watched()
    graph, names = system.graph, system.graph.topics()
    assert len(graph.nodes) == len(test_nodes.GREENHOUSE) == 5
    assert [one.node for one in graph.on("/moisture", "publisher")] == ["/soil_probe"]
    assert [name for name in names if not graph.on(name, "subscription")] == ["/lights"]
    assert [name for name in names if not graph.on(name, "publisher")] == ["/light"]
    assert {log.name for log in system.logs if log.level == "WARN"} == {"lamp"}
    assert parameters == {"/window open_above": 25.0, "/gardener dry_below": 35}
    assert not system.faults


def test_it_opens_the_window_and_waters():
    with Session() as ros:
        test_nodes.settle(ros)
        ros.run(seconds=10, quiet=True)
        (window,) = [node for node in ros.nodes if node.get_name() == "window"]
        assert {one.value for one in ros.messages("window_state")} == {"shut"}
        assert {one.value for one in ros.messages("watering")} == {"on", "off"}
        window.set_parameters([window.get_parameter("open_above").__class__(
            "open_above", value=22.0)])  # fmt: skip
        ros.run(seconds=1, quiet=True)
        assert ros.messages("window_state")[-1].value == "open"


def test_the_lamp_is_content_once_it_hears():
    with Session() as ros:
        test_nodes.settle(ros)
        ros.run(seconds=5, quiet=True)
        complaints = len(ros.logs("lamp"))
        ros.add(test_nodes.Lamp, remappings={"light": "lights"})
        ros.run(seconds=90, quiet=True)
        assert complaints == len(ros.logs("lamp")) == 1
