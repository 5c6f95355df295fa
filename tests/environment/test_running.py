"""The programs that the tool starts, and the environment that they get."""

import os
import sys
from dataclasses import replace

import pytest

from course_tool import running


@pytest.fixture
def robot(tmp_path):
    """A ROS of the system, outside /opt."""
    prefix = tmp_path / "robot" / "humble"
    index = prefix / "share" / "ament_index" / "resource_index" / "packages"
    index.mkdir(parents=True)
    (index / "rclpy").touch()
    return str(prefix)


def test_an_ordinary_environment_stays_as_it_is(layout):
    environ = {"PATH": "/usr/bin", "PYTHONPATH": "/home/ada/lib", "ROS_DOMAIN_ID": "7", "LANG": "C"}
    clean = running.cleaned(environ, layout)
    assert clean.environ == environ
    assert clean.other_ros == ()
    assert clean.notes == ()


@pytest.mark.parametrize(
    ("environ", "kept"),
    [
        # Traces of another environment's Python go.
        ({"_ROS_WHEELS_BOOTSTRAP_COMPLETE": "1", "PYTHONHOME": "/usr"}, {}),
        # A middleware that is not there would end every node at once.
        ({"RMW_IMPLEMENTATION": "rmw_cyclonedds_cpp"}, {}),
        ({"RMW_IMPLEMENTATION": "rmw_fastrtps_cpp"}, {"RMW_IMPLEMENTATION": "rmw_fastrtps_cpp"}),
        # A folder with a similar name is another folder.
        ({"AMENT_PREFIX_PATH": "ROBOT", "PATH": "ROBOT-tools/bin"}, {"PATH": "ROBOT-tools/bin"}),
    ],
)
def test_what_would_disturb_is_left_out(made, robot, environ, kept):
    (made.venv / "lib" / "librmw_fastrtps_cpp.so").touch()
    given, left = (
        {name: value.replace("ROBOT", robot) for name, value in one.items()}
        for one in (environ, kept)
    )
    clean = running.cleaned(given, made)
    assert clean.environ == left
    is_replaced = "RMW_IMPLEMENTATION" in given and not left
    assert ["is not part of this ROS" in note for note in clean.notes] == [True] * is_replaced or (
        clean.other_ros
    )


def test_a_sourced_ros_is_left_out_and_the_rest_stays(layout):
    clean = running.cleaned(
        {
            "AMENT_PREFIX_PATH": "/opt/ros/humble",
            "CMAKE_PREFIX_PATH": "/opt/ros/humble:/home/ada/cmake",
            "LD_LIBRARY_PATH": "/opt/ros/humble/opt/x/lib:/opt/ros/humble/lib:/usr/local/cuda/lib",
            "PATH": "/opt/ros/humble/bin:/usr/bin",
            "PYTHONPATH": "/opt/ros/humble/lib/python3.10/site-packages",
            "ROS_DISTRO": "humble",
            "ROS_VERSION": "2",
            "ROS_PYTHON_VERSION": "3",
            "ROS_DOMAIN_ID": "7",
        },
        layout,
    )
    assert clean.environ == {
        "CMAKE_PREFIX_PATH": "/home/ada/cmake",
        "LD_LIBRARY_PATH": "/usr/local/cuda/lib",
        "PATH": "/usr/bin",
        "ROS_DOMAIN_ID": "7",
    }
    assert clean.other_ros == ("/opt/ros/humble",)
    assert "/opt/ros/humble" in clean.notes[0]
    assert ".venv" in clean.notes[0]


def test_workspaces_on_top_of_it_go_with_it(layout, robot):
    workspace = "/home/ada/ros2_ws/install/arm"
    clean = running.cleaned(
        {
            "AMENT_PREFIX_PATH": f"{workspace}:{robot}",
            "PYTHONPATH": f"{workspace}/lib/python3.10/site-packages:/home/ada/lib",
        },
        layout,
    )
    assert clean.environ == {"PYTHONPATH": "/home/ada/lib"}
    assert set(clean.other_ros) == {workspace, robot}


def test_workspaces_of_the_course_stay(layout, robot):
    own = str(layout.root / "my_ws" / "install" / "sensor_simulator")
    path = os.pathsep.join([own, robot, str(layout.venv)])
    clean = running.cleaned({"AMENT_PREFIX_PATH": path}, layout)
    assert clean.environ["AMENT_PREFIX_PATH"] == os.pathsep.join([own, str(layout.venv)])


@pytest.mark.parametrize(("ros", "other"), [("kilted", "jazzy"), ("jazzy", "kilted")])
def test_the_environment_of_another_distribution_is_another_ros(layout, ros, other):
    """The tests on Kilted are started in a shell of the course, for one."""
    other, layout = replace(layout, ros=other).venv, replace(layout, ros=ros)
    index = other / "share" / "ament_index" / "resource_index" / "packages"
    index.mkdir(parents=True)
    (index / "rclpy").touch()
    environ = {
        "AMENT_PREFIX_PATH": str(other),
        "LD_LIBRARY_PATH": f"{other}/lib:/usr/local/cuda/lib",
        "PATH": f"{other}/bin:/usr/bin",
        "ROS_DISTRO": "the other",
        "FASTRTPS_DEFAULT_PROFILES_FILE": str(layout.root / "src" / "fastdds.xml"),
        "FASTDDS_DEFAULT_PROFILES_FILE": "/home/ada/fastdds.xml",
    }
    clean = running.cleaned(environ, layout)
    assert clean.environ == {
        "LD_LIBRARY_PATH": "/usr/local/cuda/lib",
        "PATH": "/usr/bin",
        "FASTDDS_DEFAULT_PROFILES_FILE": "/home/ada/fastdds.xml",
    }
    assert clean.notes == (
        f"Another ROS is sourced ({other}); here the course uses its own, in {layout.venv.name}.",
    )


def test_inside_the_venv_comes_first_once(layout):
    first = str(layout.venv / "bin")
    active = running.inside({"PATH": f"/usr/bin:{first}:/bin"}, layout)
    assert active["PATH"] == f"{first}:/usr/bin:/bin"
    assert active["VIRTUAL_ENV"] == str(layout.venv)
    assert active["JUPYTER_PREFER_ENV_PATH"] == "1"


def test_ros_is_set_from_the_courses_own_defaults(layout):
    complete = running.with_ros({"A": "b"}, layout)
    assert complete["A"] == "b"
    assert complete["AMENT_PREFIX_PATH"] == str(layout.venv)
    assert complete["RMW_IMPLEMENTATION"] == "rmw_fastrtps_cpp"


@pytest.mark.parametrize(
    ("code", "ok", "text"),
    [
        ("print('hello')", True, "hello\n"),
        ("import sys; sys.exit('no')", False, "no\n"),  # errors are kept, too
        ("import time; time.sleep(60)", False, "timed out"),
    ],
)
def test_a_quiet_program(code, ok, text):
    command = [sys.executable, "-I", "-S", "-c", code]
    result = running.quiet(command, os.environ, timeout=0.5 if "sleep" in code else None)
    assert result.ok is ok
    assert text in result.text


def test_a_program_that_is_not_there():
    assert not running.quiet(["/nowhere/program"], {}).ok
