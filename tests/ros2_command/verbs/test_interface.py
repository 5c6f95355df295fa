import pytest
from ros2_command.packages import nested_type


def test_show(ros2):
    everything = ros2.out("interface", "show", "--all-comments", "sensor_msgs/msg/Temperature")
    default = ros2.out("interface", "show", "-", stdin="sensor_msgs/msg/Temperature\n")
    assert "\t# " in everything
    assert "\t# " not in default
    assert "# Single temperature reading." in default
    assert "\n---\n" in ros2.out("interface", "show", "std_srvs/srv/SetBool")
    assert ros2.out("interface", "show", "std_msgs/msg/Empty") == ""


def test_show_of_what_does_not_exist(ros2):
    assert ros2.error("interface", "show", "std_msgs/Float32") == (
        "Invalid name 'std_msgs/Float32'. Expected three parts separated by '/'\n"
        "# Did you mean 'std_msgs/msg/Float32'?\n"
    )
    error = ros2.error("interface", "show", "std_msgs/msg/Flot32").splitlines()
    assert error[0].startswith("Could not find the interface '/")
    assert error[0].endswith("/share/std_msgs/msg/Flot32.idl'")
    assert error[1] == "# Did you mean 'std_msgs/msg/Float32'?"
    assert len(ros2.error("interface", "show", "std_msgs/msg/Nope").splitlines()) == 1
    assert ros2.error("interface", "show", "no_msgs/msg/X").startswith(
        "Unknown package 'no_msgs'\n"
    )
    assert "the passed value is empty" in ros2.error("interface", "show", "-", stdin="", code=2)


def test_lists(ros2):
    lines = ros2.out("interface", "list").splitlines()
    heads = [line for line in lines if not line.startswith(" ")]
    assert heads == ["Messages:", "Services:", "Actions:"]
    assert "    std_msgs/msg/Float32" in lines
    assert ros2.out("interface", "list", "-s").startswith("Services:\n    ")
    package = ros2.out("interface", "package", "std_srvs").splitlines()
    assert package == ["std_srvs/srv/Empty", "std_srvs/srv/SetBool", "std_srvs/srv/Trigger"]
    assert "std_srvs" not in ros2.out("interface", "packages", "-m").split()
    assert ros2.error("interface", "package", "std_msg").startswith("Unknown package 'std_msg'\n")


def test_proto(ros2):
    assert ros2.out("interface", "proto", "std_srvs/srv/SetBool") == '"data: false\n"\n'
    bare = ros2.out("interface", "proto", "--no-quotes", "geometry_msgs/msg/Point")
    assert bare == "x: 0.0\ny: 0.0\nz: 0.0\n\n"
    assert ros2.out("interface", "proto", "std_msgs/msg/Empty") == '"{}\n"\n'


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
