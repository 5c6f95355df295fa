"""Say why Python does not find a module, or finds a file of the learner's in its place."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterable, Sequence
from pathlib import Path

from rosbeat.diagnosis.mistakes import Diagnosis

_ID = "not-importable"

# What the name alone tells.

#: ROS 1, by its packages for Python.
_ROS_1 = {"rospy", "roslib", "roslaunch", "rosbag", "rostopic", "rosnode", "tf", "actionlib"}
#: Packages of ROS 2 that no registry of Python packages offers; a name that ends in `_` begins one.
_NOT_FROM_PIP = (
    *("turtlesim", "cv_bridge", "image_transport", "image_geometry", "message_filters", "tf2_"),
    *("tf_transformations", "rosbag2_", "demo_nodes_", "action_tutorials", "nav2_", "moveit"),
    *("gazebo", "ros_gz", "control_msgs", "controller_", "robot_", "laser_geometry", "pcl_"),
    *("example_interfaces", "tutorial_interfaces", "launch_testing", "launch_testing_"),
    *("launch_pytest", "ros2_control", "slam_"),
    *("rqt_", "rviz", "usb_cam", "joint_state_publisher", "xacro", "urdf", "rclcpp", "examples_"),
)
#: What the course has in the place of such a package.
_INSTEAD = {
    "example_interfaces": "`./environment/course add messages` brings rosie_interfaces, which has "
    "AddTwoInts and Fibonacci; SetBool is in std_srvs.",
    "turtlesim": "The package rosie is in its place: `ros2 run rosie rover`.",
    "demo_nodes_py": "The package rosie is in its place: `ros2 run rosie thermometer`.",
}
_PREFIXES = tuple(name for name in _NOT_FROM_PIP if name.endswith("_"))
_SHIPPED = "`ros2 pkg list` in a terminal lists the packages that are here"


def about_name(module: str) -> Diagnosis | None:
    """Return what is known of a module that is not here, by its name; None if nothing is.

    Args:
        module: Its name, such as `rospy` or `turtlesim.msg`.
    """
    name = module.partition(".")[0]
    if name in _ROS_1:
        return Diagnosis(
            _ID,
            f"{name} belongs to ROS 1, and this course uses ROS 2, which does not have it.",
            "The Python library of ROS 2 is rclpy: its nodes are classes, derived from "
            "rclpy.node.Node. Code for ROS 1 has to be rewritten.",
        )
    if name in _NOT_FROM_PIP or name.startswith(_PREFIXES):
        return Diagnosis(
            _ID,
            f"{name} is a package of ROS 2 that is not installed here: the course installs ROS "
            "with pip, which offers only a part of it.",
            f"{_SHIPPED}. {_INSTEAD.get(name) or f'Nothing in the course needs {name}.'} A full "
            "installation of ROS 2 has it.",
        )
    return None


# What files tell.

#: Modules that an own file may hide: those of Python, and those that the pages import.
_OTHERS = {"rclpy", "rosbeat", "numpy", "matplotlib", "setuptools", "std_msgs", "sensor_msgs"}
_HIDDEN = re.compile(
    r"No module named '(?P<whole>\w+)\.[\w.]+'; '(?P=whole)' is not a package"
    r"|cannot import name '\w+' from (?:partially initialized module )?'(?P<source>\w+)[.\w]*'"
    r"|(?:partially initialized )?module '(?P<owner>\w+)' has no attribute '\w+'"
)


def about_hidden(text: str, folders: Iterable[Path], then: str = "") -> Diagnosis | None:
    """Recognize that a file of the learner's hides a module of the same name.

    Args:
        text: The error's text.
        folders: Where Python looks before it looks at what is installed.
        then: What to do after renaming the file, as a sentence; may be empty.
    """
    hidden = _HIDDEN.search(text)
    if not hidden:
        return None
    name = str(hidden["whole"] or hidden["source"] or hidden["owner"])
    paths = (folder / f"{name}.py" for folder in folders)
    file = next((path for path in paths if path.is_file()), None)
    if file is None or name not in sys.stdlib_module_names | _OTHERS:
        return None
    return Diagnosis(
        _ID,
        f"Your own file {name}.py, in the folder {file.parent.name or '/'}, hides the module "
        f"{name}: Python looks there first.",
        f"Give the file another name, such as my_{name}.py. {then}".strip(),
    )


def about_neighbor(text: str, modules: Sequence[tuple[str, str]]) -> Diagnosis | None:
    """Recognize the import of a module of a package by the file's name alone.

    Args:
        text: The error's text.
        modules: The packages of the workspace, each with a module that it has.
    """
    missing = re.search(r"No module named '(\w+)'", text)
    name = missing[1] if missing else ""
    package = next((package for package, module in modules if module == name), "")
    if not package:
        return None
    return Diagnosis(
        _ID,
        f"{name}.py is there, in the package {package}, but Python finds it only by the package's "
        "name.",
        f"Write `from {package}.{name} import ...`. The package has to be built and the workspace "
        "sourced; then `ros2 run` starts the node.",
    )


def about_relative(text: str) -> Diagnosis | None:
    """Recognize `from .helper import ...` in a file that is started by itself, or in a cell.

    Args:
        text: The error's text.
    """
    if "attempted relative import with no known parent package" not in text:
        return None
    return Diagnosis(
        _ID,
        "The dot in `from .name import ...` stands for the package of this file, and code that is "
        "started by itself belongs to no package.",
        "Write the package's name in front of the dot, as in `from my_package.name import ...`, "
        "and start the node with `ros2 run`.",
    )
