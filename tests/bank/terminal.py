"""What goes wrong in a terminal: rows 20 to 29 of the table of mistakes, and slips of typing.

A case without an output is run for real. The outputs of the others are those of colcon, of the
course's `ros2` and of Python, as they printed them once.
"""

from dataclasses import dataclass

from bank.workspaces import BUILT

_P = "src/sensor_simulator"
_N = f"{_P}/sensor_simulator"
_RUN = "ros2 run sensor_simulator temperature_publisher"
_BUILD = "colcon build"
_CREATE = "ros2 pkg create --build-type ament_python"
_FINE = (
    "Starting >>> sensor_simulator\nFinished <<< sensor_simulator [0.96s]\n\n"
    "Summary: 1 package finished [1.06s]"
)
_NEVER = (
    "Starting >>> sensor_simulator\n"
    "RuntimeError: 'distutils.core.setup()' was never called -- perhaps 'setup.py' is not a "
    "Distutils setup script?\nFailed   <<< sensor_simulator [0.30s, exited with code 1]\n\n"
    "Summary: 0 packages finished [0.60s]\n  1 package failed: sensor_simulator"
)
_NOTHING = "\nSummary: 0 packages finished [0.09s]"
_READING = "[INFO] [temperature_sensor]: Publishing: 22.00C"
_NO_EXECUTABLE = (
    "No executable found\n# Package 'sensor_simulator' has no executables at all: "
    "/home/you/install/sensor_simulator/lib/sensor_simulator is empty or missing.\n"
    "# A Python package needs an entry point in setup.py, and `colcon build` after that."
)
_ASKED = "No executable found\n# Did you mean 'temperature_publisher'?"
_MODULE = "sensor_simulator.temperature_publisher"


def _traceback(last: str) -> str:
    return (
        "Traceback (most recent call last):\n"
        '  File "/home/you/install/sensor_simulator/lib/sensor_simulator/temperature_publisher", '
        "line 33, in <module>\n    sys.exit(load_entry_point('sensor-simulator==0.0.0', "
        f"'console_scripts', 'temperature_publisher')())\n{last}\n"
        "[ros2run]: Process exited with failure 1"
    )


_NO_METADATA = _traceback(
    "importlib.metadata.PackageNotFoundError: No package metadata was found for sensor-simulator"
)
_LINKED = "touch install/sensor_simulator/lib/python3.11/site-packages/sensor-simulator.egg-link\n"


def _edit(old: str, new: str) -> str:
    return f'sed -i "s/{old}/{new}/" {_P}/setup.py\n'


@dataclass(frozen=True)
class Case:
    """A command of a terminal, and the mistake behind what came of it.

    Attributes:
        name: What it is about.
        mistake: Id of the mistake; empty if nothing is wrong, or nothing is known for sure.
        command: What is typed.
        output: What it prints; None to run it.
        code: Its exit code, if it is not run.
        before: What was typed before it; that is run.
        place: Where it is typed, relative to the workspace.
    """

    name: str
    mistake: str
    command: str
    output: str | None = None
    code: int = 1
    before: str = ""
    place: str = "."


_WRONG_TARGETS = (
    ("a letter in the module", "publisher:main", "publishr:main",
     f"ModuleNotFoundError: No module named '{_MODULE[:-6]}blishr'"),
    ("a file", "publisher:main", "publisher.py:main",
     f"ModuleNotFoundError: No module named '{_MODULE}.py'; '{_MODULE}' is not a package"),
    ("a letter in the function", "publisher:main", "publisher:maine",
     f"AttributeError: module '{_MODULE}' has no attribute 'maine'. Did you mean: 'main'?"),
    ("no function", "publisher:main", "publisher", "TypeError: 'module' object is not callable"),
)  # fmt: skip

ROWS = (
    Case("20 no entry", "entry-point-missing", _RUN, _NO_EXECUTABLE, 1,
         BUILT + _edit(".*_publisher:main.,", "")),
    Case("20 no entry at all", "entry-point-missing", _RUN, _NO_EXECUTABLE, 1,
         BUILT + _edit(".*:main.,", "")),
    Case("20 a letter wrong", "executable-misspelled", f"{_RUN[:-2]}r", _ASKED, 1, BUILT),
    Case("20 the node's name", "executable-misspelled",
         "ros2 run sensor_simulator temperature_sensor", _ASKED, 1, BUILT),
    Case("20 the file", "executable-misspelled", f"{_RUN}.py", _ASKED, 1, BUILT),
    *(Case(f"21 built: {name}", "entry-point-target", _BUILD, _FINE, 0, _edit(old, new))
      for name, old, new, _ in _WRONG_TARGETS),
    *(Case(f"21 run: {name}", "entry-point-target", _RUN, _traceback(last), 1,
           BUILT + _edit(old, new)) for name, old, new, last in _WRONG_TARGETS),
    Case("22 built: no comma", "comma-missing", _BUILD, _NEVER, 1,
         _edit("publisher:main',", "publisher:main'")),
    Case("22 built: a slash", "slash-in-module", _BUILD, _NEVER, 1, _edit("or.temp", "or\\/temp")),
    Case("22 run: no comma", "comma-missing", _RUN, _READING, 0,
         BUILT + _edit("publisher:main',", "publisher:main'")),
    Case("22 run: a slash", "slash-in-module", _RUN, _READING, 0,
         BUILT + _edit("or.temp", "or\\/temp")),
    Case("22 run: a link that could not be built", "comma-missing", _RUN, _NO_METADATA, 1,
         BUILT + _LINKED + _edit("publisher:main',", "publisher:main'")),
    Case("22 no executable: no comma", "comma-missing", _RUN, _NO_EXECUTABLE, 1,
         BUILT + _edit("publisher:main',", "publisher:main'")),
    Case("a package.xml in src", "wrong-folder", _BUILD, before=f"cp {_P}/package.xml src/"),
    Case("sed finds nothing", "nothing-replaced",
         f"sed -i 's/Node Begun/Version 2/' {_N}/temperature_subscriber.py"),
    Case("sed finds something", "",
         f"sed -i 's/Node Started/Version 2/' {_N}/temperature_subscriber.py"),
    Case("a file hides a module", "not-importable", "python3 go.py", before=(
        "echo 'import random; random.uniform(0, 1)' > go.py\necho > random.py")),
    Case("a file hides a package", "not-importable", "python3 go.py", before=(
        "echo 'from rclpy.node import Node' > go.py\necho > rclpy.py")),
    Case("a file beside the node", "not-importable", _RUN,
         _traceback("ModuleNotFoundError: No module named 'helper'"), 1,
         BUILT + f"echo > {_N}/helper.py"),
    Case("a file that is not built", "not-rebuilt", _RUN,
         _traceback("ModuleNotFoundError: No module named 'sensor_simulator.helper'"), 1,
         BUILT + f"echo > {_N}/helper.py"),
    Case("ROS 1", "not-importable", "python3 -c 'import rospy'"),
    Case("not from pip", "not-importable", "python3 -c 'from turtlesim.msg import Pose'"),
    Case("not from pip, to run", "not-importable", "ros2 run turtlesim turtlesim_node"),
    Case("23 not sourced", "not-sourced", _RUN, before=BUILT),
    Case("23 run and not sourced", "not-sourced", "install/setup.bash", before=BUILT),
    Case("23 run from here", "not-sourced", "./install/setup.bash", before=BUILT),
    Case("23 a link since", "not-sourced", _RUN,
         _NO_METADATA, 1, BUILT + _LINKED),
    Case("23 a link that failed", "not-built", _RUN, _NO_METADATA, 1,
         BUILT + _LINKED.rstrip() + " install/sensor_simulator/share/sensor_simulator/package.dsv"),
    Case("23 not built", "not-built", _RUN),
    Case("23 nothing to source", "not-built", "source install/setup.bash"),
    Case("24 edited", "not-rebuilt", _RUN, _READING, 0,
         BUILT + f"echo '# more' >> {_N}/temperature_publisher.py"),
    Case("24 a new entry", "not-rebuilt", _RUN, _NO_EXECUTABLE, 1,
         BUILT + "rm install/sensor_simulator/lib/sensor_simulator/*"),
    Case("20 renamed since a build", "entry-point-missing", _RUN, _traceback(
             "           ^^^^\n  File \"/home/you/x\", line 25, in importlib_load_entry_point\n"
             "    return next(matches).load()\nStopIteration"), 1,
         BUILT + _edit("temperature_publisher = ", "talk = ")),
    Case("25 left out", "build-type", "ros2 pkg create other", place="src"),
    Case("25 for C++", "build-type", "ros2 pkg create --build-type ament_cmake other", place="src"),
    Case("25 a letter wrong", "build-type", "ros2 pkg create --build-type ament_pyhton other",
         place="src"),
    Case("25 built", "build-type", _BUILD,
         "Starting >>> sensor_simulator\nCMake Error: The source directory does not appear to "
         "contain CMakeLists.txt.\nFailed   <<< sensor_simulator [0.21s, exited with code 1]", 1,
         f"sed -i s/ament_python/ament_cmake/ {_P}/package.xml"),
    Case("25 run", "build-type", _RUN, _NO_EXECUTABLE, 1,
         f"{BUILT}sed -i s/ament_python/ament_cmake/ {_P}/package.xml"),
    Case("26 it exists", "package-exists", f"{_CREATE} sensor_simulator", place="src"),
    Case("26 in the workspace", "wrong-folder", f"{_CREATE} other"),
    Case("26 in docs", "wrong-folder", f"{_CREATE} other", place="docs"),
    Case("26 in a package", "wrong-folder", f"{_CREATE} other", place=_P),
    Case("26 built in src", "wrong-folder", _BUILD, _FINE, 0,
         "mkdir src/build src/install src/log", "src"),
    Case("26 built in docs", "wrong-folder", _BUILD, _NOTHING, 0, place="docs"),
    Case("26 sourced in src", "wrong-folder", "source install/setup.bash", before=BUILT,
         place="src"),
    Case("26 chmod elsewhere", "wrong-folder", "chmod +x temperature_publisher.py"),
    Case("26 python elsewhere", "wrong-folder", "python3 temperature_publisher.py"),
    Case("27 built: no setup.cfg", "marker-missing", _BUILD, _FINE, 0, f"rm {_P}/setup.cfg"),
    Case("27 built: no __init__", "marker-missing", _BUILD, _FINE, 0, f"rm {_N}/__init__.py"),
    Case("27 built: no marker", "marker-missing", _BUILD,
         "error: can't copy 'resource/sensor_simulator': doesn't exist or not a regular file\n"
         "Failed   <<< sensor_simulator [0.5s, exited with code 1]", 1, f"rm -r {_P}/resource"),
    Case("27 run: no setup.cfg", "marker-missing", _RUN, _NO_EXECUTABLE, 1,
         f"{BUILT}rm {_P}/setup.cfg"),
    Case("27 run: no __init__", "marker-missing", _RUN,
         _traceback("ModuleNotFoundError: No module named 'sensor_simulator'"), 1,
         f"{BUILT}rm {_N}/__init__.py"),
    Case("28 built", "syntax-error", _BUILD, _FINE, 0,
         f"echo 'def f(:' >> {_N}/temperature_publisher.py"),
    Case("28 run", "syntax-error", _RUN, _traceback("SyntaxError: invalid syntax"), 1,
         f"echo 'def f(:' >> {_N}/temperature_publisher.py\n{BUILT}"),
    Case("28 setup.py", "syntax-error", _BUILD, "SyntaxError: '[' was never closed", 1,
         _edit("],$", "")),
    Case("29 shut down twice", "ctrl-c-traceback", _RUN, _traceback(
        "rclpy._rclpy_pybind11.RCLError: failed to shutdown: rcl_shutdown already called on the "
        "given context, at ./src/rcl/init.c:333"), 1, BUILT),
    Case("29 not expected", "ctrl-c-traceback", _RUN,
         _traceback("rclpy.executors.ExternalShutdownException"), 1, BUILT),
    Case("29 not caught", "ctrl-c-traceback", _RUN, _traceback("KeyboardInterrupt"), 254, BUILT),
)  # fmt: skip

SLIPS = (
    Case("the tilde", "tilde-missing", "mkdir /Documents/ROS2_and_RL_Tutorials/"),
    Case("no parents", "parents-missing", "mkdir resources/maps/kitchen"),
    Case("there already", "folder-exists", "mkdir src"),
    Case("a capital option", "option-misspelled", "mkdir -P resources/maps/kitchen"),
    Case("nothing to make", "word-missing", "mkdir"),
    Case("a letter in a folder", "folder-not-found", "cd scr"),
    Case("one's own folder", "tilde-missing", "cd /Documents/ROS"),
    Case("no blank", "space-missing", "cd.."),
    Case("a blank too many", "space-too-many", "cd .. src"),
    Case("backslashes", "path-separator", r"cd ..\..\src"),
    Case("a file", "not-a-folder", f"cd {_P}/setup.py"),
    Case("a letter in a command", "command-misspelled", "colcn build"),
    Case("a capital command", "command-misspelled", "Ros2 run a b"),
    Case("the prompt", "prompt-typed", "$ ls"),
    Case("ROS 1", "ros-1-command", "roscore"),
    Case("no dot and slash", "dot-slash-missing", "setup.py", place=_P),
    Case("not executable", "not-executable", "./setup.py", place=_P),
    Case("no plus", "word-misspelled", "chmod x setup.py", place=_P),
    Case("no file", "word-missing", "chmod +x"),
    Case("a letter in a file", "file-not-found", "chmod +x setupp.py", place=_P),
    Case("a folder, from outside", "wrong-folder", f"ls {_P}", place=".."),
    Case("a file, from outside", "wrong-folder", f"cat {_P}/setup.py", place=".."),
    Case("a file to edit", "wrong-folder", f"sed -i s/a/b/ {_P}/setup.py", place="docs"),
    Case("a file to copy", "wrong-folder", f"cp {_P}/setup.py .", place=".."),
    Case("a letter in a folder", "file-not-found", "ls doc"),
    Case("a letter in a file to read", "file-not-found", "cat setup.pi", place=_P),
    Case("rm of a folder", "is-a-folder", "rm docs"),
    Case("ROS elsewhere", "ros-elsewhere", "source /opt/ros/jazzy/setup.bash"),
    Case("the removed folder", "folder-gone", "colcon build", "", 1, "rm -r docs", "docs"),
    Case("a letter in a verb", "word-misspelled", "ros2 pkg creat other"),
    Case("a letter in colcon's verb", "word-misspelled", "colcon biuld"),
    Case("a letter in an option", "option-misspelled", "colcon build --symlink_install"),
    Case("a letter in a package", "package-misspelled", "ros2 run sensor_simulatr talk"),
    Case("one name", "word-missing", "ros2 run sensor_simulator"),
    Case("no options", "option-missing", f"{_CREATE} room_display rclpy sensor_msgs", place="src"),
    Case("commas", "commas-between-names", f"{_CREATE} a --dependencies rclpy,sensor_msgs",
         place="src"),
    Case("a bad name", "package-name", f"{_CREATE} Sensor-Sim", place="src"),
    Case("no name", "word-missing", "ros2 pkg create --dependencies rclpy a", place="src"),
    Case("twice the same", "package-twice", _BUILD,
         "ERROR:colcon:colcon build: Duplicate package names not supported:", 1,
         f"cp -r {_P} docs/"),
    Case("no packages", "no-packages", _BUILD, _NOTHING, 0, f"rm -r {_P}"),
    Case("an unknown package", "package-misspelled", f"{_BUILD} --packages-select sensor_simulatr",
         "WARNING:colcon:ignoring unknown package 'sensor_simulatr' in --packages-select"
         f"{_NOTHING}", 0),
    Case("built: no packages installed", "packages-missing", _BUILD, _FINE, 0,
         _edit("packages=.*", "packages=[],")),
    Case("run: no packages installed", "packages-missing", _RUN,
         _traceback("ModuleNotFoundError: No module named 'sensor_simulator'"), 1,
         BUILT + _edit("packages=.*", "packages=[],")),
    Case("no call", "no-setup-call", _BUILD, _NEVER, 1, _edit("^setup(", "dict(")),
    Case("a letter in the group", "group-misspelled", _RUN, _NO_EXECUTABLE, 1,
         BUILT + _edit("console_scripts", "console_script")),
)  # fmt: skip

#: Nothing is wrong, or nothing is known for sure.
FINE = (
    Case("a good build", "", _BUILD, _FINE, 0),
    Case("a good run", "", _RUN, _READING, 0, BUILT),
    Case("a clean end", "", _RUN, f"{_READING}\n^C", 0, BUILT),
    Case("a new folder", "", "mkdir -p resources/maps/kitchen"),
    Case("a good way", "", "cd src"),
    Case("a good package", "", f"{_CREATE} other --dependencies rclpy", place="src"),
    Case("a list", "", "ls"),
    Case("a file that is not there", "", "cat nothing_like_it"),
    Case("a command of nobody", "", "xyzzy"),
    Case("a package of others", "", "ros2 run turtlesim_of_others x"),
    Case("a failure of another kind", "", _BUILD, "Failed   <<< sensor_simulator [1.0s]", 1),
    Case("an output that is only read", "", "cat log.txt", _NO_EXECUTABLE, 0, BUILT),
)  # fmt: skip

CASES = (*ROWS, *SLIPS, *FINE)
