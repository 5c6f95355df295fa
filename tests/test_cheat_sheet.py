"""The cheat sheet: everything on it that can be run runs here, in its order, as one system."""

import re
from contextlib import ExitStack
from pathlib import Path

import pytest

import rosbeat
from rosbeat.ros.programs import Program, private_domain, program_environment

pytestmark = pytest.mark.ros

SHEET = (Path(__file__).parents[1] / "docs" / "cheat_sheet.md").read_text(encoding="utf-8")
NODE = "src/sensor_simulator/sensor_simulator/temperature_publisher.py"
(CODE,) = re.findall(r"```python\n(.+?)```", SHEET, re.DOTALL)
PAGE, TERMINAL, UBUNTU = range(1, 4)
PROGRAMS = "ros2 run "


def rows():
    """Each row of the table: what it is for, and the code in its columns."""
    lines = [line for line in SHEET.splitlines() if line.startswith("|")][2:]
    cells = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]
    return {row[0]: [re.findall(r"`([^`]+)`", cell) for cell in row] for row in cells}


ROWS = rows()
TYPED = {
    what: [one for one in row[TERMINAL] if not re.fullmatch("Ctrl|C", one)]
    for what, row in ROWS.items()
}


def register(workspace):
    """Add the line of the sheet to the setup.py that `ros2 pkg create` has made."""
    (line,) = re.findall(r'`("temperature_publisher = .+?",)`', SHEET)
    setup = workspace / "src" / "sensor_simulator" / "setup.py"
    text, number = re.subn(r"('console_scripts': \[)", rf"\1\n{line}", setup.read_text())
    assert number == 1
    setup.write_text(text)


def test_the_terminals_column_builds_runs_and_shows_a_system(tmp_path):
    workspace = tmp_path / "ROS2_and_RL_Tutorials"
    tasks = list(TYPED)
    run, look = tasks.index("run"), tasks.index("list nodes and topics")
    with private_domain() as domain_id, ExitStack() as stack:
        environ = {
            **program_environment(tmp_path, domain_id),
            "ROS2_WORKSPACE": str(workspace),
        }

        def start(*lines):
            script = "\n".join(["set -e", *lines])
            return stack.enter_context(Program(("bash", "-c", script), environ, tmp_path))

        def typed(what, *before):
            """Type the commands of a row, and return what they print; all end well."""
            program = start(*before, *TYPED[what])
            program.wait(lambda _: False, 90)
            done = program.finish()
            assert (done.ended_early, done.exit_code) == (True, 0), (what, done.output)
            return done.output

        for what in tasks[: tasks.index("build")]:
            typed(what)
            if what == "create a package":
                (workspace / NODE).write_text(CODE)
                register(workspace)
        here = 'cd "$ROS2_WORKSPACE"'
        built = "".join(typed(what, here) for what in tasks[tasks.index("build") : run])
        assert "sensor_simulator temperature_publisher" in built
        sources = (here, "source install/setup.bash")
        lines = [one for what in tasks[run:look] for one in TYPED[what]]
        assert len(lines) == 2
        assert all(line.startswith(PROGRAMS) for line in lines)
        nodes = [start(*sources, f"exec {line}") for line in lines]
        assert all(node.wait(lambda output: "Publishing: " in output, 60) for node in nodes)
        # Somebody listens, so nothing is amiss when it is asked why nothing arrives.
        listener = start("exec ros2 topic echo /temperature")
        assert listener.wait(lambda output: "data: " in output, 60)
        shown = "".join(typed(what) for what in tasks[look:])
        for words in ("/temperature_sensor", "/second", "/temperature", "data: 22.0"):
            assert words in shown
        ends = [node.finish() for node in nodes]
        assert [(one.ended_early, one.exit_code) for one in ends] == [(False, 0)] * 2


def test_the_pages_column_runs_on_a_page(tmp_path):
    names = {name: getattr(rosbeat, name) for name in rosbeat.__all__}
    exec(CODE, names)
    lines = [one for row in ROWS.values() for one in row[PAGE] if one.startswith("ros")]
    assert lines[0] == "ros = Session()"
    pictures = [one for row in ROWS.values() for one in row[PAGE] if one.startswith("viz.")]
    assert {"viz.graph(ros)"} < set(pictures)
    shown = {}
    for line in [*lines, "viz.graph(ros)"]:
        exec(f"shown = {line}" if " = " not in line else line, names)
        shown[line] = names.get("shown")
    names["ros"].close()
    assert len(shown['ros.messages("/temperature")']) == 3
    assert [one.text for one in shown["ros.logs()"]] == ["Publishing: 22.00C"] * 3
    assert all(hasattr(rosbeat.viz, one[4:].partition("(")[0]) for one in pictures)


def test_every_magic_of_the_sheet_is_one_of_the_course():
    magics = {one for row in ROWS.values() for one in row[PAGE] if one.startswith("%%")}
    assert {one.split()[0] for one in magics} == {"%%terminal", "%%save"}


def test_what_is_typed_on_ubuntu_is_typed_as_ros_documents_it():
    typed = [one for row in ROWS.values() for one in row[UBUNTU]]
    assert typed == [
        "source /opt/ros/jazzy/setup.bash",
        "mkdir -p ~/ros2_ws/src",
        "cd ~/ros2_ws/src",
        "cd ~/ros2_ws",
        "rosdep install -i --from-path src --rosdistro jazzy -y",
        "ros2 topic info -v /temperature",
    ]
