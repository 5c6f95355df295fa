import os
import re
import signal
from pathlib import Path

import pytest

pytestmark = pytest.mark.ros

INFO = """\
/one
  Subscribers:
    /one/in: std_msgs/msg/Float32
  Publishers:
    /parameter_events: rcl_interfaces/msg/ParameterEvent
    /rosout: rcl_interfaces/msg/Log
    /temperature: std_msgs/msg/Float32
  Service Servers:
    /one/describe_parameters: rcl_interfaces/srv/DescribeParameters
    /one/enable: std_srvs/srv/SetBool
    /one/get_parameter_types: rcl_interfaces/srv/GetParameterTypes
    /one/get_parameters: rcl_interfaces/srv/GetParameters
    /one/get_type_description: type_description_interfaces/srv/GetTypeDescription
    /one/list_parameters: rcl_interfaces/srv/ListParameters
    /one/set_parameters: rcl_interfaces/srv/SetParameters
    /one/set_parameters_atomically: rcl_interfaces/srv/SetParametersAtomically
  Service Clients:

  Action Servers:

  Action Clients:

"""


def test_list_is_complete_each_time(graph):
    for _ in range(3):
        assert graph.out("node", "list") == "/ns_two\n/one\n"
    assert graph.out("node", "list", "-c", "--no-daemon") == "2\n"
    assert graph.out("node", "list", "--spin-time", "2") == "/ns_two\n/one\n"


def test_list_is_complete_without_the_discovery_profile(graph, tmp_path):
    """A profile that changes nothing: every process waits for the others as by default."""
    plain = tmp_path / "plain.xml"
    plain.write_text('<dds xmlns="http://www.eprosima.com/XMLSchemas/fastRTPS_Profiles"/>\n')
    out = graph.out("node", "list", FASTRTPS_DEFAULT_PROFILES_FILE=str(plain))
    assert out == "/ns_two\n/one\n"


def test_info(graph):
    assert graph.out("node", "info", "/one") == INFO
    error = graph.error("node", "info", "one")  # the original wants the slash
    assert error == "Unable to find node 'one'\n# Did you mean '/one'?\n"
    error = graph.error("node", "info", "/onn")
    assert error == "Unable to find node '/onn'\n# Did you mean '/one'?\n"


def test_a_second_node_of_the_same_name(graph, another_node):
    with another_node(graph, "one", "temperature", 1.0):
        done = graph("node", "list")
        assert done.stdout == "/ns_two\n/one\n/one\n"
        assert done.stderr.startswith("WARNING: Be aware that there are nodes in the graph")
        assert "There are 2 nodes in the graph" in graph("node", "info", "/one").stderr


@pytest.mark.parametrize("value", ["abc", "-1", "233"])
def test_a_bad_domain_id(ros2, value):
    error = ros2.error("node", "list", ROS_DOMAIN_ID=value)
    assert error.startswith(f"ROS_DOMAIN_ID is '{value}', which is not a domain id.\n")


def shared_memory(process):
    """The shared memory of the middleware that a process uses, by name."""
    maps = Path(f"/proc/{process.pid}/maps").read_text()
    return set(re.findall(r"/dev/shm/(fastrtps_[0-9a-f]{8,})$", maps, re.MULTILINE))


def test_nothing_is_left_behind(graph):
    before = set(os.listdir("/dev/shm"))
    with graph.running("topic", "echo", "/temperature") as process:
        assert process.stdout.readline() == "data: 25.5\n"
        own = shared_memory(process) - before
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=60)
    assert own
    assert not own & set(os.listdir("/dev/shm"))
