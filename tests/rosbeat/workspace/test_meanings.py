"""What is said about a command that has ended: each mistake by name is in the bank of terminals."""

import shutil

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from rosbeat.diagnosis import absent_programs
from rosbeat.workspace import catch_up
from rosbeat.workspace.commands import explain
from rosbeat.workspace.prerequisites import NODES, PACKAGE, finished, run_command

RUN = f"ros2 run {PACKAGE} temperature_publisher"
ENTRY = f"{PACKAGE}.temperature_publisher:main"
NO_FILE = "No such file or directory"
NO_EXECUTABLE = "No executable found\n"
NOT_FOUND = f"Package '{PACKAGE}' not found\n"
READING = "[INFO] [temperature_sensor]: Publishing: 22.00C\n"
FINE = """Starting >>> sensor_simulator
Finished <<< sensor_simulator [2.03s]

Summary: 1 package finished [2.41s]
"""
NONE = "\nSummary: 0 packages finished [0.30s]\n"


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
        ("cd nothing_like_it", f"bash: cd: nothing_like_it: {NO_FILE}", "`pwd`"),
        ("cd../../src", f"bash: cd../../src: {NO_FILE}", "write  cd ../../src"),
        # Programs and files.
        ("A=1 colcn list", "bash: colcn: command not found", "`colcon`"),
        ("nano setup.py", "bash: nano: command not found", "JupyterLab"),
        ("ros2 run a b", "bash: ros2: command not found", "the course's environment"),
        ("tree", "bash: tree: command not found", "`tree` is not installed here"),
        # Words.
        ("ros2 lits a", chosen("lits", "ros2"), "Did you mean `list`?"),  # as newer Pythons say it
        ("colcon xyzzy", chosen("'xyzzy'"), "You can choose from: build, "),
        ("colcon build --package-select a", refused("--package-select a"), "`--packages-select`"),
        ("colcon build symlink-install", refused("symlink-install"), "`--symlink-install`"),
        ("colcon build -symlink-install", refused("-symlink-install"), "`--symlink-install`"),
        ("colcon build --xyzzy", refused("--xyzzy"), "`colcon --help`"),
        ("ros2 run a", required("executable_name, argv", "ros2 run"), "takes two names"),
        ("ros2 topic echo", required("topic_name, argv", "ros2 topic echo"), "topic name."),
        # Packages.
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
        ("ros2 run nothing_like_it x", "Package 'nothing_like_it' not found\n"),
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
        ("..", "~/elsewhere/ROS2_and_RL_Tutorials/src", 'cd "$ROS2_WORKSPACE"'),
        (".", "my foldr", "Did you mean 'my folder'?"),
        (".", "./srcc", "Did you mean src?"),
        (".", "nowhere/srcc", "`ls` lists its content."),
        (".", "fill", "`ls` lists its content."),  # a file is not proposed
        (".", "/Documents/my x", "cd ~/'Documents/my x'"),
    ],
)
def test_the_folder_that_was_meant(meaning, root, folder, typed, end):
    for path in (root / "my folder", root.parent / "Documents" / "my x"):
        path.mkdir(parents=True)
    (root / "filll").touch()
    place = (root / folder).resolve()
    assert meaning(f"cd '{typed}'", f"bash: cd: {typed}: {NO_FILE}", 1, place).endswith(end)


def test_a_workspace_that_is_not_there_is_not_where_to_go(meaning, root):
    shutil.rmtree(root)
    for typed, shown in (('"$ROS2_WORKSPACE"', root), ('"$ROS2_WORKSPACE"/src', root / "src")):
        said = meaning(f"cd {typed}", f"bash: cd: {shown}: {NO_FILE}", 1, root.parent)
        assert said.startswith(f"There is no folder {shown}.")
        assert said.endswith('Page 01 creates it:  mkdir -p "$ROS2_WORKSPACE/src"')


# Programs that are not here.


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("rosdep", "is installed already, so leave the line out"),
        ("rqt_graph", "`viz.graph(ros)`"),
        ("rviz2", "in 3D"),
        ("conda", "the course has its own, which this terminal uses".capitalize()),
        ("pip", "All Python packages of the course are installed"),
        ("sudo", "as the administrator"),
        ("apt-get", "leave the line out"),
        ("curl", "use the browser"),
        ("nano", "double-click a file"),
        ("tmux", "`%%terminal two`"),
        ("cmake", "./environment/course add messages"),
        ("python", "`python3`"),
        ("roscore", "without a master"),
        ("rostopic", "`ros2 topic`"),
        ("catkin_make", "`colcon build`"),
        ("roslaunch", "`ros2 launch`"),
    ],
)
def test_a_program_that_is_not_here_is_named_for_what_it_is(meaning, name, text):
    said = meaning(f"{name} x", f"bash: {name}: command not found\n", 127)
    assert f"`{name}`" in said
    assert text in said
    assert meaning(f"echo {name}", f"bash: {name}: command not found\n", 0) is None


def test_no_program_is_said_to_be_two_things():
    names = [name for names in absent_programs._PROGRAMS for name in names.split()]
    assert len({*names, *absent_programs._ROS_1}) == len(names) + len(absent_programs._ROS_1)


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


# `ros2 pkg create`.


# `colcon build`.


SETUP, NODE = "setup.py", f"{PACKAGE}/{NODES[0]}.py"
LINE = f"'temperature_publisher = {ENTRY}',"


@pytest.mark.parametrize(
    ("name", "old", "new", "code", "output", "texts"),
    [
        (SETUP, ENTRY, "xyz.xyz:main", 0, FINE, ["Compare it with the names of your files"]),
        (SETUP, ENTRY, ENTRY.replace(":main", ":xyz"), 0, FINE,
         ["Define that function, or name one that exists."]),
        (SETUP, f"publisher = {ENTRY}", f"publisher == {ENTRY}", 0, FINE, ["a single `=`"]),
        (SETUP, None, None, 0, FINE, ["no setup.py"]),
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


# `ros2 run`.


def no_executable(name, more=""):
    return f"ros2 run {PACKAGE} {name}", f"{NO_EXECUTABLE}{more}"


def run_of(output):
    return RUN, output


@pytest.mark.parametrize(
    ("old", "new", "given", "text"),
    [
        ("", "", run_of(READING), None),
        ("", "", run_of(f"{READING}^C\n"), None),
        ("", "", run_of("[INFO] [a]: NameError: name 'x' is not defined\n"), None),
        ("", "", run_of("[INFO] [a]: waiting for KeyboardInterrupt\n"), None),
        # An executable that is not there.
        ("", "", no_executable("x"), "It has: temperature_publisher, temperature_subscriber."),
        ("", "", no_executable("x", f"Package '{PACKAGE}' has: temperature_publisher\n"), None),
        ("", "", no_executable("temperature_publishr", "Did you mean 'temperature_publisher'?\n"),
         None),
        (LINE, "", no_executable("temperature_publisher"), "setup.py has no entry point for it"),
        ("'console_scripts': [", "'console_scripts': [*more(),", no_executable("x"), None),
    ],
)  # fmt: skip
def test_a_run(meaning, installed, edit, old, new, given, text):
    edit("setup.py", old, new)
    said = meaning(*given, int(NO_EXECUTABLE in given[1] or "Traceback" in given[1]))
    assert text in said if text else said is None
    # Page 05 asks for the entry point: the way, and not the answer.
    assert not (said and "no entry point" in said and ENTRY in said)


def test_a_package_that_pip_lacks_is_not_a_slip_of_typing(meaning):
    shown = "Unknown package 'example_interfaces'\n# Did you mean 'rcl_interfaces'?\n"
    said = meaning("ros2 interface show example_interfaces/srv/AddTwoInts", shown)
    assert "example_interfaces is a package of ROS 2 that is not installed here" in said
    assert "rosie_interfaces, which has AddTwoInts" in said
    last = "ModuleNotFoundError: No module named 'example_interfaces'"
    assert meaning("python3 client.py", traceback(last)) == said


STOP = """  File "/home/you/temperature_publisher", line 25, in importlib_load_entry_point
    return next(matches).load()
StopIteration"""


@pytest.mark.parametrize(
    ("old", "new", "texts"),
    [
        ("'temperature_publisher = ", "'temperature_pub = ",
         ["no longer has an entry point temperature_publisher",
          "It has: temperature_pub, temperature_subscriber.",
          'rm -r "$ROS2_WORKSPACE"/install/sensor_simulator']),
        ("entry_points=", "entry_point=", ["entry points under entry_point,"]),
        ("'console_scripts'", "'console_script'", ["entry points under console_script,"]),
        ("", "", ["The build in install does not have the entry point", "colcon build"]),
        ("'console_scripts': [", "'console_scripts': [*more(),", []),
    ],
)  # fmt: skip
def test_an_old_program_whose_entry_point_has_gone(meaning, installed, edit, old, new, texts):
    edit("setup.py", old, new)
    said = meaning(RUN, traceback(STOP))
    assert [text for text in texts if text not in said] == []
    assert texts or said is None
    assert meaning("cat notes.txt", traceback(STOP), 0) is None
    assert meaning(RUN, traceback("StopIteration"), 1) is None  # of the node's own


# Packages for CMake.

NO_CMAKE = {
    "no package": '  By not providing "Findament_cmake.cmake" in CMAKE_MODULE_PATH this project',
    "no cmake": "RuntimeError: Could not find 'cmake' executable",
    "no compiler": "CMake Error: CMAKE_CXX_COMPILER not set, after EnableLanguage",
}


@pytest.fixture
def with_cmake(root):
    """A package that CMake builds, with or without messages of its own."""

    def make(*definitions):
        folder = root / "src" / "tutorial_interfaces"
        for path in definitions:
            (folder / path).parent.mkdir(parents=True, exist_ok=True)
            (folder / path).touch()
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "package.xml").write_text(
            "<package format='3'><name>tutorial_interfaces</name><export>"
            "<build_type>ament_cmake</build_type></export></package>"
        )

    return make


@pytest.mark.parametrize("output", NO_CMAKE.values(), ids=NO_CMAKE)
@pytest.mark.parametrize("path", ["msg/Num.msg", "srv/Add.srv", "action/Go.action"])
def test_a_package_of_messages_is_told_what_builds_it(meaning, with_cmake, path, output):
    with_cmake(path)
    failed = f"{output}\nFailed   <<< tutorial_interfaces [0.5s, exited with code 1]\n"
    said = meaning("colcon build", failed)
    assert "tutorial_interfaces defines messages of its own" in said
    assert "./environment/course add messages" in said
    assert "ament_python" not in said
    said = meaning("ros2 run tutorial_interfaces num", NO_EXECUTABLE)
    assert "has no programs to run" in said


def test_nothing_is_said_of_a_package_of_messages_that_fails_for_another_reason(
    meaning, with_cmake
):
    with_cmake("msg/Num.msg")
    failed = (
        "InvalidFieldDefinition: 1x\nFailed   <<< tutorial_interfaces [2s, exited with code 1]\n"
    )
    assert meaning("colcon build", failed) is None


def test_a_package_of_messages_and_nodes_in_cpp_is_told_what_pip_lacks(meaning, with_cmake):
    with_cmake("msg/Num.msg")
    failed = 'providing "Findrclcpp.cmake"\nFailed   <<< tutorial_interfaces [0.5s, exited]\n'
    said = meaning("colcon build", failed)
    assert said.startswith("tutorial_interfaces needs rclcpp, the library for nodes in C++")
    assert "add messages" not in said


def test_a_package_in_cpp_is_told_the_build_type_of_python(meaning, with_cmake):
    with_cmake()
    failed = f"{NO_CMAKE['no package']}\nFailed   <<< tutorial_interfaces [0.5s, exited]\n"
    assert "`--build-type ament_python`" in meaning("colcon build", failed)


def test_edited_and_not_rebuilt(meaning, installed, edit):
    edit(f"{PACKAGE}/{NODES[0]}.py", "22.0", "21.0")
    assert "the copy in install" in meaning(RUN, READING, 0)
    assert meaning(f"colcon build && {RUN}", READING, 0) is None
    assert meaning(f"ros2 run {PACKAGE} temperature_subscriber", "[INFO] ...", 0) is None
    (installed / "lib/python3.11/site-packages/sensor-simulator.egg-link").touch()
    assert meaning(RUN, READING, 0) is None


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
         "rclpy.shutdown()", "Ctrl+C has already shut ROS down"),
        ("rclpy.executors.ExternalShutdownException", "pass", "Ctrl+C ended the program"),
        ("KeyboardInterrupt", "pass", "Ctrl+C ended the program"),
    ],
)  # fmt: skip
def test_an_error_of_a_node(meaning, last, line, text):
    said = meaning(RUN, traceback(last, line))
    assert text in said if text else said is None


def test_of_a_script_without_ros_nothing_is_said_about_ros(meaning):
    for last in ("KeyboardInterrupt", QOS.replace("Node.create_subscription", "create_view")):
        assert meaning("python3 a.py", traceback(last), 130) is None
        assert meaning("python3 a.py", traceback(last, "rclpy.spin(node)"), 130)
    assert "The name x" in meaning("./a.py", traceback("NameError: name 'x' is not defined"))


# Whatever there is.


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
    max_examples=25,
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
