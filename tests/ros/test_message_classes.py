"""`msg = Float32` and `msg.data = 25.0` spoil the class for the whole kernel: not for long."""

import sys
from importlib.util import module_from_spec, spec_from_file_location

import pytest
from rclpy.node import Node
from std_msgs.msg import Float32, String

from nodes import Talker
from rosbeat import Session
from rosbeat.errors import NodeConstructionError
from rosbeat.ros.recording import mend_message_classes
from rosbeat.ros.scenario import observe

pytestmark = pytest.mark.ros


@pytest.fixture(autouse=True)
def _whole_again():
    yield
    mend_message_classes()


def test_a_class_that_was_written_into_is_whole_again():
    Float32.data, String.data = 25.0, "text"
    with pytest.raises(AttributeError, match="read-only"):
        Float32()
    assert sorted(mend_message_classes()) == ["Float32", "String"]
    assert Float32(data=1.0).data == 1.0
    with pytest.raises(AssertionError, match="must be of type 'float'"):
        Float32(data=1)
    assert mend_message_classes() == []


MADE = """
class Made:
    _fields_and_field_types = {"data": "float"}
    data = property()
"""


def test_a_class_of_a_module_that_came_later_is_mended(tmp_path, monkeypatch):
    mend_message_classes()
    (tmp_path / "_made.py").write_text(MADE)
    spec = spec_from_file_location("made.msg._made", tmp_path / "_made.py")
    module = module_from_spec(spec)
    monkeypatch.setitem(sys.modules, spec.name, module)
    spec.loader.exec_module(module)
    module.Made.data = 25.0
    assert mend_message_classes() == ["Made"]
    assert type(module.Made.data) is property
    assert mend_message_classes() == []


class Spoiler(Node):
    def __init__(self):
        super().__init__("spoiler")
        self.publisher_ = self.create_publisher(Float32, "temperature", 10)
        self.create_timer(1.0, self.tick)

    def tick(self):
        msg = Float32
        msg.data = 25.0
        self.publisher_.publish(msg)


class SpoilsAtOnce(Node):
    def __init__(self):
        super().__init__("spoiler")
        Float32.data = 25.0
        raise ValueError("boom")


class SpoilsQuietly(Node):
    def __init__(self):
        super().__init__("spoiler")
        Float32.data = 25.0


def test_the_next_run_of_a_node_that_was_put_right_works(ros, capsys):
    ros.add(Spoiler)
    ros.run(1)
    assert Float32(data=2.0).data == 2.0
    with pytest.raises(NodeConstructionError):
        ros.add(SpoilsAtOnce)
    assert Float32(data=2.0).data == 2.0
    capsys.readouterr()


def test_one_check_does_not_spoil_the_next():
    assert observe(Spoiler, 1).faults
    assert not observe(SpoilsQuietly, 1).faults
    observation = observe(Talker, 2)
    assert observation.samples
    assert not observation.faults
    assert Float32(data=3.0).data == 3.0


def test_a_new_session_begins_with_whole_classes():
    Float32.data = 25.0
    with Session():
        assert Float32(data=4.0).data == 4.0
