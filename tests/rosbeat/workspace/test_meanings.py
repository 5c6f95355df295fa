"""What is said about a command that has ended: each mistake by name is in the bank of terminals."""

import shutil

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from rosbeat.diagnosis import terminal
from rosbeat.diagnosis.mistakes import MISTAKES, Diagnosis
from rosbeat.diagnosis.packages import FLAWS, EntryPoint, Flaw, diagnose_flaw
from rosbeat.workspace import catch_up
from rosbeat.workspace.catching_up import NODES, PACKAGE, finished, run_command
from rosbeat.workspace.meanings import explain, recognise

RUN = f"ros2 run {PACKAGE} temperature_publisher"
CREATE = f"ros2 pkg create --build-type ament_python {PACKAGE} --dependencies rclpy std_msgs"
ENTRY = f"{PACKAGE}.temperature_publisher:main"
NO_FILE = "No such file or directory"
NO_EXECUTABLE = "No executable found\n"
NOT_FOUND = f"Package '{PACKAGE}' not found\n"
CREATED = "going to create a new package"
READING = "[INFO] [temperature_sensor]: Publishing: 22.00C\n"
FINE = """Starting >>> sensor_simulator
Finished <<< sensor_simulator [2.03s]

Summary: 1 package finished [2.41s]
"""
NONE = "\nSummary: 0 packages finished [0.30s]\n"
NEVER_CALLED = f"""Starting >>> sensor_simulator
RuntimeError: 'distutils.core.setup()' was never called -- perhaps 'setup.py' is not a Distutils
Failed   <<< sensor_simulator [0.30s, exited with code 1]
{NONE}"""


@pytest.fixture
def meaning(root):
    """What is said about a command; in the workspace itself if no folder is named."""

    def ask(command, output="", code=1, folder=None):
        return explain(command, output, code, folder or root, root)

    return ask


@pytest.fixture
def edit(package):
    """Replace a text in a file of the package."""

    def edit(name, old, new):
        path = package / name
        assert old in path.read_text()
        path.write_text(path.read_text().replace(old, new))

    return edit


def traceback(last, line="pass", name="main"):
    return (
        f"Traceback (most recent call last):\n"
        f'  File "/home/you/src/a.py", line 3, in {name}\n    {line}\n{last}\n'
        "[ros2run]: Process exited with failure 1\n"
    )


def mkdir(path, why=NO_FILE):
    return f"mkdir: cannot create directory ‘{path}’: {why}\n"


def chosen(word, program="colcon"):
    choices = "(choose from 'build', 'info', 'list', 'test')"
    return f"usage: x\n{program}: error: argument verb_name: invalid choice: {word} {choices}"


def refused(rest, program="colcon"):
    return f"usage: {program} [-h]\n{program}: error: unrecognized arguments: {rest}\n"


def required(names, command="ros2 pkg create"):
    return f"{command}: error: the following arguments are required: {names}"


# In any workspace.


@pytest.mark.parametrize(
    ("command", "output", "text"),
    [
        # Folders.
        ("mkdir /Documents/ROS2/", mkdir("/Documents/ROS2/"), "mkdir -p ~/Documents/ROS2/"),
        ("mkdir /Documents", mkdir("/Documents", "Permission denied"), "mkdir -p ~/Documents"),
        ("mkdir a/b", mkdir("a/b"), "The parent folder of b does"),
        ("mkdir src", mkdir("src", "File exists"), "src already exists"),
        ("mkdir -x a", "mkdir: invalid option -- 'x'", "no option -x"),
        ("cd scr", f"bash: line 1: cd: scr: {NO_FILE}", "Did you mean src?"),
        ("cd nothing_like_it", f"bash: cd: nothing_like_it: {NO_FILE}", "`pwd`"),
        ("cd../../src", f"bash: cd../../src: {NO_FILE}", "write  cd ../../src"),
        ("cd..", "bash: cd..: command not found", "A space is missing after `cd`"),
        # Programs and files.
        ("colcn build", "bash: line 1: colcn: command not found", "Did you mean `colcon`?"),
        ("rso2 run a b", "bash: rso2: command not found", "Did you mean `ros2`?"),
        ("A=1 colcn list", "bash: colcn: command not found", "`colcon`"),
        ("nano setup.py", "bash: nano: command not found", "JupyterLab"),
        ("ros2 run a b", "bash: ros2: command not found", "the course's environment"),
        ("tree", "bash: tree: command not found", "`tree` is not installed here"),
        ("screen", "bash: screen: command not found", "`screen` is not installed here"),
        ("roscore", "bash: roscore: command not found", "ROS 1"),
        ("./a.py", "bash: line 1: ./a.py: Permission denied", "chmod +x ./a.py"),
        ("source install/setup.bash", f"bash: install/setup.bash: {NO_FILE}", "not exist yet"),
        (". install/local_setup.bash", f"bash: install/local_setup.bash: {NO_FILE}", "Build in"),
        # Words.
        ("colcon biuld", chosen("'biuld'"), "Did you mean `build`?"),
        ("ros2 lits a", chosen("lits", "ros2"), "Did you mean `list`?"),  # as newer Pythons say it
        ("colcon xyzzy", chosen("'xyzzy'"), "You can choose from: build, "),
        ("colcon build --package-select a", refused("--package-select a"), "`--packages-select`"),
        ("colcon build --symlink_install", refused("--symlink_install"), "`--symlink-install`"),
        ("colcon build symlink-install", refused("symlink-install"), "`--symlink-install`"),
        ("colcon build -symlink-install", refused("-symlink-install"), "`--symlink-install`"),
        ("colcon build --xyzzy", refused("--xyzzy"), "`colcon --help`"),
        ("ros2 run a", required("executable_name, argv", "ros2 run"), "takes two names"),
        ("ros2 run a --ros-args -r b:=c", refused("--ros-args -r", "ros2"), "takes two names"),
        ("ros2 topic echo", required("topic_name, argv", "ros2 topic echo"), "topic name."),
        ("ros2 pkg create --dependencies rclpy a", required("package_name"), "takes every word"),
        # Packages.
        (CREATE, f"The directory already exists: ./{PACKAGE}",
         f"A folder {PACKAGE} already exists"),
        ("ros2 pkg create a", "'ament_cmake' is left out here", "Add that option; the rest"),
        ("ros2 pkg create --build-type ament_cmake a", "is left out here", "Write ament_python"),
        (CREATE, "'a-b' cannot be the name of a package: '-' is minus", "lower-case letters"),
        (f"{CREATE}, a", "Aborted!", "with spaces, not with commas."),
        ("colcon build", NONE, "contains a package.xml"),
        ("colcon test --packages-select a", f"ignoring unknown package 'a'{NONE}", "it tested no"),
        ("colcon build --packages-select a symlink-install",
         f"ignoring unknown package 'symlink-install' in --packages-select{NONE}", "two dashes"),
        ("python3 a.py", traceback("ModuleNotFoundError: No module named 'rclpy'"), "which py"),
    ],
)  # fmt: skip
def test_a_mistake_that_needs_no_package(meaning, command, output, text):
    assert text in meaning(command, output)


@pytest.mark.parametrize(
    ("command", "output"),
    [
        ("xyzzy", "bash: xyzzy: command not found"),
        ("sreen", "bash: sreen: command not found"),  # like `screen`, which is not here either
        ("ls nothing", f"ls: cannot access 'nothing': {NO_FILE}"),
        ("mkdir a", mkdir("a", "No space left on device")),
        ("mkdir a; cd src", f"log: {mkdir('/Documents')}"),
        ("source setup.bash", f"bash: setup.bash: {NO_FILE}"),
        ("./tool x", refused("x", "tool")),
        ("ros2 topic list", "/parameter_events\n/rosout\n"),
        ("ros2 run turtlesim x", "Package 'turtlesim' not found\n"),
        ("ros2 pkg create --build-type ament_python a --dependencies rcl+py",
         "Aborted! 'rcl+py' cannot be the name of a package to depend on.\n"),
        # What `ros2` asks itself is not asked again.
        ("ros2 lits a", f"{chosen('lits', 'ros2')}\nDid you mean 'list'?"),
        ("", ""),
        ("echo 'never closed", ""),
    ],
)  # fmt: skip
def test_nothing_is_better_than_something_wrong(meaning, command, output):
    assert meaning(command, output) is None


@pytest.mark.parametrize(
    "output",
    [
        mkdir("src", "File exists"),
        mkdir("/Documents"),
        f"bash: cd: scr: {NO_FILE}",
        "bash: cd..: command not found",
        "bash: colcn: command not found",
        "bash: ./a.py: Permission denied",
        f"bash: install/setup.bash: {NO_FILE}",
        f"chmod: cannot access 'a.py': {NO_FILE}",
        f"python3: can't open file 'a.py': [Errno 2] {NO_FILE}",
        f"The directory already exists: ./{PACKAGE}",
        NOT_FOUND,
        NO_EXECUTABLE,
        f"ignoring unknown package 'nosuch'{NONE}",
        chosen("'biuld'"),
        refused("--symlink_install"),
        required("package_name"),
        traceback("NameError: name 'x' is not defined"),
        traceback("ModuleNotFoundError: No module named 'rclpy'"),
        traceback("KeyboardInterrupt", "rclpy.spin(node)"),
    ],
)
def test_an_output_that_is_only_read(meaning, installed, output):
    for command in ("cat log.txt", "cat colcn"):
        assert meaning(command, output, 0) is None
        assert meaning(command, output, 1) is None


@pytest.mark.parametrize("path", ["/etc/a/b", "/tmp/a/b", "/home/you/a/b"])
def test_only_what_is_not_at_the_top_is_taken_for_one_s_own_folder(meaning, root, path):
    assert "~" not in meaning(f"mkdir {path}", mkdir(path))
    assert "With -p" in meaning(f"mkdir {root}/a/b", mkdir(f"{root}/a/b"))


@pytest.mark.parametrize(
    ("folder", "typed", "end"),
    [
        ("..", "~/elsewhere/ROS2_and_RL_Tutorials/src", 'cd "$ROS2_WORKSPACE"/src'),
        ("..", "ROS2_and_RL_Tutorials/srk", 'cd "$ROS2_WORKSPACE"/src'),
        ("..", "ROS2_and_RL_Tutorials/xyz", 'cd "$ROS2_WORKSPACE"'),
        ("..", "/home/ROS2_and_RL_Tutorials/my foldr", "cd \"$ROS2_WORKSPACE\"/'my folder'"),
        (".", "my foldr", "Did you mean 'my folder'?"),
        (".", "./srcc", "Did you mean src?"),
        (".", "nowhere/srcc", "`ls` lists its content."),
        (".", "fill", "`ls` lists its content."),  # a file is not proposed
        (".", "/Documents/my x", "cd ~/'Documents/my x'"),
        (".", "/Documents/xyz", "`ls ~` lists its content."),
    ],
)
def test_the_folder_that_was_meant(meaning, root, folder, typed, end):
    for path in (root / "my folder", root.parent / "Documents" / "my x"):
        path.mkdir(parents=True)
    (root / "filll").touch()
    place = (root / folder).resolve()
    assert meaning(f"cd '{typed}'", f"bash: cd: {typed}: {NO_FILE}", 1, place).endswith(end)


def test_the_folder_of_the_terminal_has_gone(meaning, root):
    gone = root / "gone"
    output = "Traceback (most recent call last):\n    os.getcwd()\nFileNotFoundError: [Errno 2] No"
    said = meaning("colcon build", output, 1, gone)
    assert said.endswith('Change to another folder: `cd "$ROS2_WORKSPACE"`')
    # A new folder has the name of the one that has gone, or the exit code is that of `tail`.
    assert meaning("colcon build", output) == said
    assert meaning("colcon build | tail -2", chosen("'build'"), 0, gone) == said
    assert meaning("cd ..", "", 0, gone) is None
    assert meaning("cd .. && false", "", 1, gone) is None
    shutil.rmtree(root)
    assert meaning("colcon build", output, 1, gone).endswith("Change to another folder: `cd`")


def test_a_file_that_lies_elsewhere(meaning, root, package):
    name = "temperature_publisher.py"
    said = meaning(f"chmod +x {name}", f"chmod: cannot access '{name}': {NO_FILE}")
    assert said.endswith('cd "$ROS2_WORKSPACE"/src/sensor_simulator/sensor_simulator')
    output = f"python3: can't open file '{root}/setup.py': [Errno 2] {NO_FILE}"
    assert "There is no setup.py in the current folder" in meaning("python3 setup.py", output, 2)
    output = f"chmod: cannot access 'temperatur_publisher.py': {NO_FILE}"
    said = meaning("chmod +x temperatur_publisher.py", output, 1, package / PACKAGE)
    assert said.endswith(f"Did you mean {name}?")


def test_source_of_a_build_that_lies_elsewhere(meaning, root, installed):
    output = f"bash: line 1: {{}}: {NO_FILE}"
    path = "install/setup.bash"
    said = meaning(f"source {path}", output.format(path), 1, root / "src")
    assert "is not in the current folder" in said
    assert said.endswith('go there first, with  cd "$ROS2_WORKSPACE"')
    path = "/home/you/a/install/setup.bash"
    assert f"{path} does not exist." in meaning(
        "source ~/a/install/setup.bash", output.format(path)
    )


# `ros2 pkg create`.


@pytest.mark.parametrize(
    ("command", "rest", "start"),
    [
        ("ament_python a rclpy std_msgs", "a rclpy std_msgs",
         "The options --build-type and --dependencies are missing."),
        ("ament_python a", "a", "The option --build-type is missing."),
        ("--build-type ament_python a rclpy", "rclpy", "The option --dependencies is missing."),
        ("--licence x a", "--licence", "`ros2` does not recognize `--licence`."),
    ],
)  # fmt: skip
def test_options_that_are_left_out(meaning, command, rest, start):
    assert meaning(f"ros2 pkg create {command}", refused(rest, "ros2"), 2).startswith(start)


def test_the_folder_of_a_new_package(meaning, root, package):
    assert meaning(CREATE, CREATED, 0, root / "src") is None
    assert meaning(f"cd src && {CREATE}", CREATED, 0) is None
    assert meaning(f"cd src\n{CREATE}", CREATED, 0, root / "src") is None
    shutil.move(package, root)
    assert meaning(CREATE, CREATED, 0).endswith("mv sensor_simulator src/")
    (root / "docs").mkdir()
    shutil.move(root / PACKAGE, root / "docs")
    assert meaning(CREATE, CREATED, 0, root / "docs").endswith('"$ROS2_WORKSPACE"/src/')


def test_a_package_for_cpp(meaning, root, edit):
    edit("package.xml", "ament_python", "ament_cmake")
    said = meaning(f"ros2 pkg create {PACKAGE}", CREATED, 0, root / "src")
    assert "CMakeLists.txt" in said
    on_purpose = f"ros2 pkg create --build-type ament_cmake {PACKAGE}"
    assert meaning(on_purpose, CREATED, 0, root / "src") is None


# `colcon build`.


SETUP, NODE = "setup.py", f"{PACKAGE}/{NODES[0]}.py"
LINE = f"'temperature_publisher = {ENTRY}',"


@pytest.mark.parametrize(
    ("name", "old", "new", "code", "output", "texts"),
    [
        (SETUP, ENTRY, ENTRY.replace("publisher:", "publishr:"), 0, FINE,
         ["Did you mean", "not detect"]),
        (SETUP, ENTRY, ENTRY.replace(":", ".py:"), 0, FINE, ["does not end in `.py`"]),
        (SETUP, ENTRY, ENTRY + "e", 0, FINE, ["function maine", "Did you mean main?"]),
        (SETUP, ENTRY, ENTRY.removesuffix(":main"), 0, FINE, ["after a colon"]),
        (SETUP, ENTRY, "xyz.xyz:main", 0, FINE, ["Compare it with the names of your files"]),
        (SETUP, ENTRY, ENTRY.replace(":main", ":xyz"), 0, FINE,
         ["Define that function, or name one that exists."]),
        (SETUP, ENTRY, ENTRY.replace(".", "/"), 1, NEVER_CALLED, ["`/`", "the previous build"]),
        (SETUP, f"{ENTRY}',", f"{ENTRY}'", 1, NEVER_CALLED,
         ["A comma is missing", "the previous build"]),
        (SETUP, f"{ENTRY}',", f"{ENTRY},", 1, "SyntaxError",
         ["cannot read the setup.py", "missing quote"]),
        (SETUP, f"publisher = {ENTRY}", f"publisher == {ENTRY}", 0, FINE, ["more than one `=`"]),
        # A part of the package is gone.
        ("setup.cfg", None, None, 0, FINE, ["$base/lib/sensor_simulator"]),
        (f"{PACKAGE}/__init__.py", None, None, 0, FINE,
         ["touch src/sensor_simulator/sensor_simulator/__init__.py"]),
        (SETUP, None, None, 0, FINE, ["no setup.py"]),
        (f"resource/{PACKAGE}", None, None, 1, FINE, ["touch resource/sensor_simulator"]),
        (f"resource/{PACKAGE}", None, None, 0, FINE, []),  # setup.py does not name it
        # A good build, and two entries for one function; a list that is computed is not blamed.
        (NODE, "22.0", "22.0", 0, FINE, []),
        (NODE, "22.0", "22.0", 1, "Failed <<< sensor_simulator [1.0s]", []),
        (SETUP, f"{PACKAGE}.temperature_subscriber:main", ENTRY, 0, FINE, []),
        *((SETUP, LINE, new, 0, FINE, []) for new in (
            f"'{{}} = {ENTRY}'.format('temperature_publisher'),",
            f"'%s = {ENTRY}' % 'temperature_publisher',",
            f"*['temperature_publisher = {ENTRY}'],")),
    ],
)  # fmt: skip
def test_a_build(meaning, package, edit, name, old, new, code, output, texts):
    edit(name, old, new) if old else (package / name).unlink()
    said = meaning("colcon build", output, code)
    assert [text for text in texts if text not in said] == []
    assert texts or said is None


def test_a_python_package_of_another_name_and_other_verbs_are_fine(meaning, package, edit):
    assert meaning("colcon list", "sensor_simulator\tsrc/sensor_simulator\n", 0) is None
    (package / PACKAGE).rename(package / "nodes")
    edit("setup.py", f"= {PACKAGE}.", "= nodes.")
    assert meaning("colcon build", FINE, 0) is None


def test_only_the_selected_package_is_spoken_about(meaning, root, package):
    other = root / "src" / "other"
    (other / "other").mkdir(parents=True)
    (other / "other" / "__init__.py").touch()
    (other / "package.xml").write_text(finished("package.xml").replace(f">{PACKAGE}<", ">other<"))
    (other / "setup.py").write_text("from setuptools import setup\nsetup(name='other')\n")
    (other / "setup.cfg").write_text("[install]\ninstall-scripts=$base/lib/other\n")
    (package / PACKAGE / "another.py").write_text("x = 1\ndef f(:\n")
    said = meaning("colcon build", FINE, 0)
    assert f"{PACKAGE}/another.py: there is a syntax error on line 2" in said
    assert meaning("colcon build --packages-select other", FINE, 0) is None


def test_a_build_in_the_wrong_folder(meaning, root, package, tmp_path):
    for name in ("build", "install", "log"):
        (root / "src" / name).mkdir()
    assert "You ran the build inside the folder src" in meaning(
        "colcon build", FINE, 0, root / "src"
    )
    assert "inside the folder src" in meaning("cd src; colcon build", FINE, 0)
    assert meaning("colcon build", FINE, 0) is None
    assert meaning("cd .. && colcon build", FINE, 0, root / "src") is None
    assert "Go to the workspace" in meaning("colcon build", NONE, 0, tmp_path)


def test_the_package_that_was_meant(meaning, root, package):
    output = f"WARNING: ignoring unknown package 'sensor_simulatr' in --packages-select\n{NONE}"
    said = meaning("colcon build --packages-select sensor_simulatr", output, 0)
    assert said.endswith(f"so it built nothing. Did you mean {PACKAGE}?")
    shutil.copytree(package, root / "docs" / "copy")
    said = meaning("colcon build", "ERROR: Duplicate package names not supported:")
    assert "docs/copy and src/sensor_simulator" in said


# `ros2 run`.


def no_executable(name, more=""):
    return f"ros2 run {PACKAGE} {name}", f"{NO_EXECUTABLE}{more}"


def run_of(output):
    return RUN, output


MODULE = "ModuleNotFoundError: No module named "
BEFORE = "started the previous build."


@pytest.mark.parametrize(
    ("old", "new", "given", "text"),
    [
        ("", "", run_of(READING), None),
        ("", "", run_of(f"{READING}^C\n"), None),
        ("", "", run_of("[INFO] [a]: NameError: name 'x' is not defined\n"), None),
        ("", "", run_of("[INFO] [a]: waiting for KeyboardInterrupt\n"), None),
        # An executable that is not there.
        ("", "", no_executable("temperature_publishr"), "Did you mean temperature_publisher?"),
        ("", "", no_executable("temperature_publisher.py"), "Did you mean temperature_publisher?"),
        ("", "", no_executable("temperature_sensor"), "the name of a node"),
        ("", "", no_executable("x"), "It has: temperature_publisher, temperature_subscriber."),
        ("", "", no_executable("x", f"Package '{PACKAGE}' has: temperature_publisher\n"), None),
        ("", "", no_executable("temperature_publishr", "Did you mean 'temperature_publisher'?\n"),
         None),
        (LINE, "", no_executable("temperature_publisher"), "setup.py has no entry point for it"),
        ("'console_scripts': [", "'console_scripts': [*more(),", no_executable("x"), None),
        # The build before runs.
        (f"{ENTRY}',", f"{ENTRY}'", run_of(READING), "A comma is missing"),
        (f"{ENTRY}',", f"{ENTRY}'", run_of(READING), BEFORE),
        (f"{ENTRY}',", f"{ENTRY},", run_of(READING), "cannot read"),
        (f"{ENTRY}',", f"{ENTRY},", run_of(READING), BEFORE),
        # An entry point that leads nowhere.
        (ENTRY, ENTRY.replace("publisher:", "publishr:"),
         run_of(traceback(f"{MODULE}'{PACKAGE}.temperature_publishr'")),
         f"Did you mean {PACKAGE}.temperature_publisher?"),
        (ENTRY, ENTRY.replace(":", ".py:"),
         run_of(traceback(f"{MODULE}'{PACKAGE}.temperature_publisher.py'; "
                          f"'{PACKAGE}.temperature_publisher' is not a package")),
         "not end in `.py`"),
        (ENTRY, ENTRY + "e", run_of(traceback(
            f"AttributeError: module '{PACKAGE}.temperature_publisher' has no attribute 'maine'. "
            "Did you mean: 'main'?")), "Did you mean main?"),
        (ENTRY, ENTRY.removesuffix(":main"),
         run_of(traceback("TypeError: 'module' object is not callable")), ":main"),
        (ENTRY, "temperature_publisher:main", run_of(traceback(f"{MODULE}'temperature_publisher'")),
         f"Did you mean {PACKAGE}.temperature_publisher?"),
    ],
)  # fmt: skip
def test_a_run(meaning, installed, edit, old, new, given, text):
    edit("setup.py", old, new)
    said = meaning(*given, int(NO_EXECUTABLE in given[1] or "Traceback" in given[1]))
    assert text in said if text else said is None
    # Page 05 asks for the entry point: the way, and not the answer.
    assert not (said and "no entry point" in said and ENTRY in said)


def test_a_package_that_is_not_found(meaning, root, installed):
    assert "in every new terminal" in meaning(RUN, NOT_FOUND)
    output = "Package 'sensor_simulatr' not found\n"
    assert f"Did you mean {PACKAGE}?" in meaning("ros2 run sensor_simulatr x", output)
    asked = f"{output}Did you mean '{PACKAGE}'?\n"
    assert meaning("ros2 run sensor_simulatr x", asked) is None
    shutil.rmtree(root / "install")
    assert "has not been built yet" in meaning(RUN, NOT_FOUND)


def test_a_syntax_error_and_one_that_is_mended_and_not_rebuilt(meaning, installed, package):
    module, output = package / PACKAGE / f"{NODES[0]}.py", traceback("SyntaxError: invalid syntax")
    module.write_text("x = 1\ndef f(:\n")
    assert "on line 2" in meaning(RUN, output)
    module.write_text("def main():\n    pass\n")
    assert "edited since the last build" in meaning(RUN, output)


def test_edited_and_not_rebuilt(meaning, installed, edit):
    edit(f"{PACKAGE}/{NODES[0]}.py", "22.0", "21.0")
    assert "the copy in install" in meaning(RUN, READING, 0)
    assert meaning(f"colcon build && {RUN}", READING, 0) is None
    assert meaning(f"ros2 run {PACKAGE} temperature_subscriber", "[INFO] ...", 0) is None
    (installed / "lib/python3.11/site-packages/sensor-simulator.egg-link").touch()
    assert meaning(RUN, READING, 0) is None


def test_a_package_that_became_a_link_after_this_terminal_was_told(meaning, installed):
    last = "importlib.metadata.PackageNotFoundError: No package metadata was found for "
    assert meaning(RUN, traceback(f"{last}sensor-simulator")) is None
    (installed / "lib/python3.11/site-packages/sensor-simulator.egg-link").touch()
    assert "a symbolic link" in meaning(RUN, traceback(f"{last}sensor-simulator"))
    assert meaning(RUN, traceback(f"{last}another")) is None


# Errors of Python, and Ctrl+C.

QOS = "TypeError: Node.create_subscription() missing 1 required positional argument: 'qos_profile'"
SUBSCRIBE = "self.create_subscription(Float32, 'temperature', {})"
WITH = "TypeError: 'NoneType' object does not support the context manager protocol"


@pytest.mark.parametrize(
    ("last", "line", "text"),
    [
        ("AssertionError: The 'data' field must be of type 'float'", "pass", "a float"),
        ("RuntimeError: Context.init() must only be called once", "pass", "twice"),
        ("NameError: name 'Nod' is not defined. Did you mean: 'Node'?", "pass", "The name Nod"),
        (QOS, SUBSCRIBE.format(10), "without the callback"),
        (QOS, SUBSCRIBE.format("self.listen"), "queue depth"),
        (WITH, "with rclpy.init(args=args):", "nothing to work with"),
        (WITH, "with self.lock:", None),
        ("ValueError: invalid literal", "pass", None),
        ("", "pass", None),
        # The end of a node.
        ("rclpy._rclpy_pybind11.RCLError: failed: rcl_shutdown already called on the given context",
         "rclpy.shutdown()", "try_shutdown"),
        ("rclpy.executors.ExternalShutdownException", "pass", "ROS was shut down while"),
        ("KeyboardInterrupt", "pass", "Ctrl+C ended the node"),
    ],
)  # fmt: skip
def test_an_error_of_a_node(meaning, last, line, text):
    said = meaning(RUN, traceback(last, line))
    assert text in said if text else said is None


def test_ctrl_c_while_a_node_starts(meaning):
    output = traceback("KeyboardInterrupt", "rclpy.init()", "__init__")
    assert "still starting" in meaning(RUN, output, 254)


def test_of_a_script_without_ros_nothing_is_said_about_ros(meaning):
    for last in ("KeyboardInterrupt", QOS.replace("Node.create_subscription", "create_view")):
        assert meaning("python3 a.py", traceback(last), 130) is None
        assert meaning("python3 a.py", traceback(last, "rclpy.spin(node)"), 130)
    assert "The name x" in meaning("./a.py", traceback("NameError: name 'x' is not defined"))


# Whatever there is.


@pytest.mark.parametrize("kind", FLAWS)
def test_each_flaw_has_words_of_two_sentences(kind):
    entry = EntryPoint("sensor = p.a:main", 26, "sensor", "p.a", "main")
    for right in ("", "right"):
        found = diagnose_flaw(Flaw(kind, entry, "wrong", right, 3))
        assert found.mistake in MISTAKES
        said = f"{found.evidence} {found.hint}"
        assert found.hint
        assert [word for word in ("Error", "None", "{") if word in said] == []


PIECES = st.sampled_from(
    [
        *("ros2 run sensor_simulator", "colcon build", "cd ", "~", "..", ";", "&&", "'", '"'),
        *("\\\n", "\n", "chmod: cannot access '", "': No such file", "bash: cd: ", f": {NO_FILE}"),
        *(": command not found", "Traceback", "SyntaxError: x", "Package '", "' not found", "**"),
        *("[", "\0", "No executable found", "invalid choice: 'a' (choose from 'b')", "é", "{0}"),
        *("/" * 300, "x" * 300),
    ]
)
TEXTS = st.lists(st.one_of(PIECES, st.text(max_size=5)), max_size=8).map("".join)


@settings(
    max_examples=60,
    deadline=None,
    database=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)
@given(command=TEXTS, output=TEXTS, code=st.integers(0, 255))
def test_it_never_raises(root, package, command, output, code):
    said = explain(command, output, code, root, root)
    assert said is None or said.strip()


@pytest.mark.parametrize(
    "command",
    [
        'cd "$ROS2_WORKSPACE"/src && cd scr',
        "cd ~/ROS2_and_RL_Tutorials\ncd scr",
        "A=1 timeout -s INT 5 cd scr",
        "cd scr 'a b",
        "cd scr; pwd",
    ],
)
def test_the_command_is_found_wherever_it_is_in_the_line(meaning, root, command):
    (root / "src" / "src").mkdir()
    said = meaning(command, f"bash: cd: scr: {NO_FILE}", folder=root.parent)
    if "~" in command or "$" in command:
        assert "Did you mean src?" in said
    else:
        assert "There is no folder scr" in said


def test_a_traceback_belongs_to_a_program_that_ran(meaning):
    output = traceback("NameError: name 'x' is not defined")
    assert meaning("cat a.py", output, 0) is None
    assert meaning("python3 a.py", output)


def test_a_file_that_vanishes_meanwhile_is_no_error(root, monkeypatch):
    def vanished(_):
        raise FileNotFoundError

    found = Diagnosis("raised", "seen", "try")
    monkeypatch.setattr(terminal, "_RULES", (vanished, lambda _: found))
    assert explain("", "", 0, root, root) == "seen try"
    assert recognise("", "", 0, root, root).mistake == "raised"


@pytest.mark.timeout(300)  # two builds, while other tests keep the machine busy
def test_from_one_mistake_to_the_next_with_the_real_programs(root, meaning):
    assert catch_up("06").complete
    setup = root / "src" / PACKAGE / "setup.py"
    right = setup.read_text()

    def after(command):
        words = ["colcon" if command.startswith("colcon") else "ros2", *command.split()[1:]]
        code, output = run_command(words, root, 250)
        return code, meaning(command, output, code)

    code, said = after(RUN)
    assert code
    assert "has not been built yet" in said

    setup.write_text(right.replace(":main',", ":main'", 1))
    code, said = after("colcon build")
    assert code
    assert "A comma is missing" in said

    setup.write_text(right.replace("publisher:main", "publishr:main", 1))
    code, said = after("colcon build --symlink-install")
    assert code == 0
    assert f"Did you mean {PACKAGE}.temperature_publisher?" in said

    code, said = after(RUN)
    assert code
    assert "in every new terminal" in said

    code, said = after("colcon biuld")
    assert code
    assert "Did you mean `build`?" in said
