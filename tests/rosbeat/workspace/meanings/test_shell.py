import pytest

NO_FILE = "No such file or directory"


@pytest.mark.parametrize(
    ("command", "output", "text"),
    [
        ("colcn build", "bash: line 1: colcn: command not found", "`colcon`"),
        ("rso2 run a b", "bash: rso2: command not found", "`ros2`"),
        ("mkdri x", "mkdri: command not found", "`mkdir`"),
        ("nano setup.py", "bash: nano: command not found", "JupyterLab"),
        ("ros2 run a b", "bash: ros2: command not found", "environment of the course"),
        ("mkdir /Documents/ROS2_and_RL_Tutorials/",
         f"mkdir: cannot create directory ‘/Documents/ROS2_and_RL_Tutorials/’: {NO_FILE}",
         "mkdir -p ~/Documents/ROS2_and_RL_Tutorials/"),
        ("mkdir /Documents", "mkdir: cannot create directory '/Documents': Permission denied",
         "mkdir -p ~/Documents"),
        ("mkdir a/b", f"mkdir: cannot create directory ‘a/b’: {NO_FILE}", "With -p"),
        ("mkdir src", "mkdir: cannot create directory ‘src’: File exists", "there already"),
        ("cd /Documents/x", f"bash: cd: /Documents/x: {NO_FILE}", "cd ~/Documents/x"),
        ("cd scr", f"bash: line 1: cd: scr: {NO_FILE}", "Did you mean src?"),
        ("cd nothing_like_it", f"bash: cd: nothing_like_it: {NO_FILE}", "`pwd`"),
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
        ("python3 -c 'raise ValueError'", "Traceback ...\nValueError"),
        ("ros2 topic list", "/parameter_events\n/rosout\n"),
        ("", ""),
        ("echo 'never closed", ""),
    ],
)
def test_nothing_is_better_than_something_wrong(meaning, command, output):
    assert meaning(command, output) is None


def test_cd_to_a_workspace_that_lies_elsewhere(meaning, root):
    path = "/home/you/Documents/ROS2_and_RL_Tutorials/src"
    said = meaning("cd ~/Documents/ROS2_and_RL_Tutorials/src", f"bash: cd: {path}: {NO_FILE}")
    assert said.endswith("/ROS2_and_RL_Tutorials/src")
    assert root.parent.name in said


def test_chmod_of_a_file_that_lies_elsewhere(meaning, package):
    said = meaning(
        "chmod +x temperature_publisher.py",
        f"chmod: cannot access 'temperature_publisher.py': {NO_FILE}",
    )
    assert "src/sensor_simulator/sensor_simulator" in said


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
    assert "go there first" in said
