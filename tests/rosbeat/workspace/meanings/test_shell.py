import pytest

NO_FILE = "No such file or directory"


@pytest.mark.parametrize(
    ("command", "output", "text"),
    [
        ("colcn build", "bash: line 1: colcn: command not found", "`colcon`"),
        ("rso2 run a b", "bash: rso2: command not found", "`ros2`"),
        ("mkdri x", "bash: mkdri: command not found", "`mkdir`"),
        ("nano setup.py", "bash: nano: command not found", "JupyterLab"),
        ("ros2 run a b", "bash: ros2: command not found", "environment of the course"),
        ("tree", "bash: tree: command not found", "`tree` is not installed here"),
        ("roscore", "bash: roscore: command not found", "ROS 1"),
        ("screen", "bash: screen: command not found", "`screen` is not installed here"),
        ("A=1 colcn list", "bash: colcn: command not found", "`colcon`"),
        ("source /opt/ros/jazzy/setup.bash",
         f"bash: /opt/ros/jazzy/setup.bash: {NO_FILE}", "leave the line out"),
        ("./a.py", "bash: line 1: ./a.py: Permission denied", "chmod +x ./a.py"),
    ],
)  # fmt: skip
def test_the_shell_s_own_complaints(meaning, command, output, text):
    assert text in meaning(command, output)


@pytest.mark.parametrize(
    ("command", "output"),
    [
        ("xyzzy", "bash: xyzzy: command not found"),
        ("ls nothing", f"ls: cannot access 'nothing': {NO_FILE}"),
        ("mkdir a", "mkdir: cannot create directory 'a': No space left on device"),
        ("echo command not found", "command not found"),
        ("cat log.txt", "bash: colcn: command not found"),
        ("cat colcn", "bash: colcn: command not found"),
        ("tail log.txt", "bash: ./a.py: Permission denied"),
        ("cat log.txt", "chmod: cannot access 'a.py': No such file or directory"),
        ("cat log.txt", f"python3: can't open file 'a.py': [Errno 2] {NO_FILE}"),
        ("head log.txt", f"bash: install/setup.bash: {NO_FILE}"),
        ("source setup.bash", f"bash: setup.bash: {NO_FILE}"),
        ("source nothing.bash", f"bash: nothing.bash: {NO_FILE}"),
        ("python3 -c 'raise ValueError'", "Traceback ...\nValueError"),
        ("ros2 topic list", "/parameter_events\n/rosout\n"),
        ("", ""),
        ("echo 'never closed", ""),
    ],
)
def test_nothing_is_better_than_something_wrong(meaning, command, output):
    assert meaning(command, output) is None


def test_chmod_of_a_file_that_lies_elsewhere(meaning, package):
    said = meaning(
        "chmod +x temperature_publisher.py",
        f"chmod: cannot access 'temperature_publisher.py': {NO_FILE}",
    )
    assert 'cd "$ROS2_WORKSPACE"/src/sensor_simulator/sensor_simulator' in said


def test_chmod_of_a_misspelt_file(meaning, package):
    said = meaning(
        "chmod +x temperatur_publisher.py",
        f"chmod: cannot access 'temperatur_publisher.py': {NO_FILE}",
        folder=package / "sensor_simulator",
    )
    assert "Did you mean temperature_publisher.py?" in said


def test_python_is_asked_for_a_file_that_lies_elsewhere(meaning, package, root):
    output = f"python3: can't open file '{root}/setup.py': [Errno 2] {NO_FILE}"
    assert "src/sensor_simulator" in meaning("python3 setup.py", output, 2)


def test_source_before_a_build_and_from_elsewhere(meaning, root):
    output = f"bash: line 1: install/setup.bash: {NO_FILE}"
    assert "does not exist yet" in meaning("source install/setup.bash", output)
    (root / "install").mkdir()
    (root / "install" / "setup.bash").touch()
    said = meaning("source install/setup.bash", output, folder=root / "src")
    assert said.endswith('go there first, with  cd "$ROS2_WORKSPACE"')


def test_source_of_a_build_by_a_whole_path_does_not_speak_of_here(meaning, root):
    (root / "install").mkdir()
    (root / "install" / "setup.bash").touch()
    output = f"bash: /home/you/a/install/setup.bash: {NO_FILE}"
    said = meaning("source ~/a/install/setup.bash", output)
    assert "$ROS2_WORKSPACE" in said
    assert "where this terminal is" not in said


def test_a_program_like_none_that_is_known(meaning):
    assert meaning("sreen", "bash: sreen: command not found") is None
