"""ROS arguments of a program and of a node: in a session as on rclpy."""

import pytest
import rclpy
from rclpy.context import Context
from rclpy.node import Node
from std_msgs.msg import Int32

from rosbeat.domains import lease_domain

pytestmark = pytest.mark.ros

NAMED = ["-r", "__node:=renamed", "-r", "__ns:=/room"]
TOPICS = ["-r", "count:=number"]
VALUES = ["-p", "size:=5", "-p", "speed:=7.5"]


class Sized(Node):
    """Says what became of its names and parameters."""

    def __init__(self, **options):
        super().__init__("sized", **options)
        self.publisher = self.create_publisher(Int32, "count", 10)
        self.declare_parameter("size", 1)
        self.declare_parameter("speed", 0.5)

    def state(self):
        return (
            self.get_fully_qualified_name(),
            self.publisher.topic_name,
            self.get_parameter("size").value,
            self.get_parameter("speed").value,
        )


@pytest.fixture(scope="module")
def domain():
    lease = lease_domain()
    yield lease.domain_id
    lease.release()


def ros_args(*words):
    return ["--ros-args", *words]


#: What `rclpy.init` is given, and what the node.
CASES = [
    ([], {}),
    (ros_args(*NAMED, *TOPICS, *VALUES), {}),
    (["program", "--own", *ros_args(*NAMED), "--", "rest", *ros_args(*VALUES, "--")], {}),
    (ros_args("-r", "sized:count:=own", "-p", "sized:size:=3", "-p", "other:size:=4"), {}),
    (ros_args(*NAMED, *VALUES), {"use_global_arguments": False}),
    ([], {"cli_args": ros_args(*NAMED, *TOPICS, *VALUES)}),
    (ros_args(*NAMED, *VALUES), {"cli_args": ros_args("-r", "__node:=own", "-p", "size:=9")}),
    (ros_args(*TOPICS, "-p", "speed:=1.0"), {"cli_args": ros_args("-r", "count:=own", "--")}),
    (ros_args(*VALUES), {"cli_args": ros_args(*TOPICS), "use_global_arguments": False}),
]


@pytest.mark.parametrize(("words", "options"), CASES)
def test_what_counts_in_a_program_counts_here(ros, domain, words, options):
    context = Context()
    context.init(list(words), domain_id=domain)
    node = Sized(context=context, **options)
    expected = node.state()
    node.destroy_node()
    context.shutdown()

    states = []

    def main():
        rclpy.init(args=words)
        states.append(Sized(**options).state())

    program = ros.spawn(main, *ros_args("-r", "__node:=ignored"))
    assert (program.returncode, states) == (0, [expected])


def test_without_a_list_the_command_line_counts(ros):
    states = []

    def main():
        rclpy.init()
        states.append(Sized().state())

    ros.spawn(main, *ros_args(*NAMED, *VALUES))
    assert states == [("/room/renamed", "/room/count", 5, 7.5)]


def test_a_second_context_has_its_own_arguments(ros):
    states = []

    def main():
        for words in (ros_args(*NAMED), None):
            rclpy.init(args=words)
            node = Sized()
            states.append(node.get_name())
            node.destroy_node()
            rclpy.shutdown()

    ros.spawn(main)
    assert states == ["renamed", "sized"]


def test_arguments_that_are_none_are_refused_as_in_rclpy(ros, capsys):
    program = ros.spawn(lambda: rclpy.init(args=ros_args("-r", "no rule")))
    assert program.returncode == 1
    assert "Couldn't parse remap rule" in program.stderr
    capsys.readouterr()


def test_a_node_that_refuses_arguments_is_started_without_them(ros):
    (made,) = [ros.add(lambda: Sized(use_global_arguments=False), name="other")]
    assert made.get_name() == "sized"
