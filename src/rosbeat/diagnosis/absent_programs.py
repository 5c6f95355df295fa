"""Say what a program is that is not installed here, and what the course has in its place."""

from __future__ import annotations

import re

from rosbeat.diagnosis.mistakes import Diagnosis

_EDITS = "JupyterLab has an editor: double-click a file in its file browser."
_INSTALLS = "Nothing of the course has to be installed that way, so leave the line out."
_HAS_PACKAGES = "All Python packages of the course are installed; its pages need no others."
_SEES_NODES = "On a page, `viz.graph(ros)` draws the nodes and topics of a session."
_SHOWS_VALUES = (
    "`ros2 topic echo` prints the messages of a topic, and pages plot what a session has recorded."
)
_LISTS = "The file browser on the left shows folders; in a terminal, `ls -R` lists them."
_TABS = "Each terminal of a page has a name, so open a second one beside it: `%%terminal two`."
#: What each program is, and what to use here. Names that mean the same are in one entry.
_PROGRAMS = {
    "rosdep": (
        "It installs the packages that a workspace depends on.",
        "What the packages of the course depend on is installed already, so leave the line out.",
    ),
    "rqt_graph": ("It draws nodes and topics, and comes with a full ROS 2.", _SEES_NODES),
    "rqt rqt_console rqt_topic": (
        "It is a window with tools for ROS, and comes with a full ROS 2.",
        "The `ros2` command tells the same in a terminal: `ros2 topic`, `ros2 node`, `ros2 param`.",
    ),
    "rqt_plot plotjuggler": ("It plots the values on a topic.", _SHOWS_VALUES),
    "rviz2 rviz foxglove-studio": (
        "It shows in 3D what a robot senses, and comes with a full ROS 2.",
        "`ros2 topic echo` prints the same messages as text.",
    ),
    "gazebo gz ign": (
        "It simulates robots and their surroundings, and comes with a full ROS 2.",
        "The robot of this course is `ros2 run rosie rover`.",
    ),
    "xacro check_urdf": (
        "It handles descriptions of a robot's body, and comes with a full ROS 2.",
        "No page of the course needs such a description.",
    ),
    "vcs wstool": ("It fetches repositories into a workspace.", "`git clone` fetches one."),
    "ament ament_tools catkin": (
        "It built workspaces before colcon did.",
        "In ROS 2, build with `colcon build` in the workspace.",
    ),
    "conda mamba micromamba": (
        "It makes Python environments. The course has its own, which this terminal uses.",
        _HAS_PACKAGES,
    ),
    "pip pip3 pipx uv poetry": ("It installs Python packages.", _HAS_PACKAGES),
    "apt apt-get dpkg snap brew dnf yum pacman": ("It installs packages of a system.", _INSTALLS),
    "sudo su doas": (
        "It runs a command as the administrator of the machine.",
        "Your folder and the course's environment are your own, so no command of the course needs "
        "it. Type the command without that word.",
    ),
    "curl wget": (
        "It fetches files from a network.",
        "The course has all its files here; for others, use the browser, and drag the file into "
        "JupyterLab's file browser.",
    ),
    "git": ("It keeps versions of files.", "No page of the course needs it."),
    "tree": ("It draws folders with what is in them.", _LISTS),
    "nano vi vim nvim gedit emacs code subl kate mousepad": ("It is an editor.", _EDITS),
    "xdg-open open nautilus explorer.exe": ("It opens files in windows.", _EDITS),
    "gnome-terminal terminator xterm konsole tmux screen": ("It opens terminals.", _TABS),
    "htop": ("It shows what the machine is doing.", "`top -bn1` prints that once."),
    "docker podman": ("It runs containers.", "The course runs without one."),
    "cmake make ninja gcc g++ c++ cc clang": (
        "It builds programs in C and C++.",
        "Nodes in Python need no build of that kind. For messages of your own, "
        "`./environment/course add messages` brings what builds them.",
    ),
    "python": ("Here the program has another name.", "Write `python3`."),
}
_BY_NAME = {name: entry for names, entry in _PROGRAMS.items() for name in names.split()}
_BUILD, _RUN = "`colcon build`", "`ros2 run`"
#: Commands of ROS 1, each with what takes its place. Those that begin like these have none.
_ROS_1 = {
    "roscore": "Nodes of ROS 2 find each other without a master, so leave the line out.",
    "rosmaster": "Nodes of ROS 2 find each other without a master, so leave the line out.",
    "rosrun": f"In ROS 2, it is {_RUN}.",
    "roslaunch": "In ROS 2, it is `ros2 launch`.",
    "rosnode": "In ROS 2, it is `ros2 node`.",
    "rostopic": "In ROS 2, it is `ros2 topic`.",
    "rosservice": "In ROS 2, it is `ros2 service`.",
    "rosparam": "In ROS 2, it is `ros2 param`.",
    "rosmsg": "In ROS 2, it is `ros2 interface show`.",
    "rossrv": "In ROS 2, it is `ros2 interface show`.",
    "rosbag": "In ROS 2, it is `ros2 bag`.",
    "rospack": "In ROS 2, it is `ros2 pkg`.",
    "roscd": "In ROS 2, `ros2 pkg prefix` says where a package is installed.",
    "rosls": "In ROS 2, `ros2 pkg prefix` says where a package is installed.",
    "roswtf": "In ROS 2, it is `ros2 doctor`.",
    "catkin_make": f"In ROS 2, build with {_BUILD} in the workspace.",
    "catkin_make_isolated": f"In ROS 2, build with {_BUILD} in the workspace.",
    "catkin_create_pkg": "In ROS 2, it is `ros2 pkg create --build-type ament_python`.",
    "catkin_init_workspace": "In ROS 2, a workspace is a folder with a folder `src` in it.",
    "rosmake": f"In ROS 2, build with {_BUILD} in the workspace.",
}
PATTERN = "|".join(map(re.escape, [*_BY_NAME, *_ROS_1]))
"""Matches the names of all these programs."""


def about_program(name: str) -> Diagnosis:
    """Return what a program of the table is, and what to use here.

    Args:
        name: Its name, which `PATTERN` matches.
    """
    if name in _ROS_1:
        return Diagnosis("ros-1-command", f"`{name}` belongs to ROS 1.", _ROS_1[name])
    what, instead = _BY_NAME[name]
    return Diagnosis("not-installed", f"`{name}` is not installed here. {what}", instead)
