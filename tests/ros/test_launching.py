"""Launch files in a session: nodes as simulated programs, timers and events in virtual time."""

import os
import signal
import subprocess
import sys
import textwrap

import pytest

from rosbeat.errors import SessionError
from rosbeat.testing import ExitCodeError, TestSession

pytestmark = pytest.mark.ros

TALKER = """
import os
import sys
import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_msgs.msg import String


class Talker(Node):
    def __init__(self):
        super().__init__("talker")
        period = self.declare_parameter("period", 1.0).value
        self.publisher = self.create_publisher(String, "chatter", 10)
        self.create_timer(period, self.talk)
        self.get_logger().info(f"{self.declare_parameter('word', 'hello').value} "
                               f"{os.environ.get('OF_LAUNCH', '-')} {sys.argv[1:2]}")

    def talk(self):
        self.publisher.publish(String(data="x"))


def main():
    rclpy.init()
    try:
        rclpy.spin(Talker())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass


def other():
    main()
"""
HEAD = """\
from launch import LaunchDescription
from launch.actions import *
from launch.conditions import *
from launch.event_handlers import *
from launch.substitutions import *
from launch_ros.actions import *
from launch_ros.substitutions import *


def generate_launch_description():
    return LaunchDescription([
"""


@pytest.fixture
def demo(tmp_path, monkeypatch):
    """A workspace with the package `demo`, installed as colcon does; writes launch files."""
    prefix = tmp_path / "install" / "demo"
    index = prefix / "share" / "ament_index" / "resource_index" / "packages" / "demo"
    site = prefix / "lib" / f"python3.{sys.version_info.minor}" / "site-packages"
    files = {
        tmp_path / "install" / ".colcon_install_layout": "isolated\n",
        index: "",
        site / "demo" / "__init__.py": "",
        site / "demo" / "talker.py": TALKER,
        site / "demo-0.0.0.egg-info" / "entry_points.txt":
            "[console_scripts]\ntalker = demo.talker:main\nother = demo.talker:other\n"
            "lost = demo.lost:main\n",
        site / "demo-0.0.0.egg-info" / "PKG-INFO": "Name: demo\nVersion: 0.0.0\n",
        prefix / "lib" / "demo" / "plain": f"#!{sys.executable}\n{TALKER}\nmain()\n",
        prefix / "lib" / "demo" / "binary": "#!/bin/sh\n",
        prefix / "lib" / "demo" / "die": f"#!{sys.executable}\nraise SystemExit(3)\n",
    }  # fmt: skip
    for name in ("talker", "other", "lost"):
        files[prefix / "lib" / "demo" / name] = (
            f"#!{sys.executable}\nraise SystemExit('a script')\n"
        )
    for path, text in files.items():
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        path.chmod(0o755)
    monkeypatch.delenv("OF_LAUNCH", raising=False)

    def write(text, name="x.launch.py"):
        path = tmp_path / "src" / "demo" / "launch" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        inside = textwrap.indent(textwrap.dedent(text), " " * 8)
        path.write_text(f"{HEAD}{inside}\n    ])\n" if name.endswith(".py") else text)
        return path

    return write


def counts(ros):
    """How many messages there were on each topic of the talkers."""
    topics = [sample.topic for sample in ros.observation().samples]
    return {name: topics.count(name) for name in topics if name.endswith(("chatter", "words"))}


def texts(ros, name):
    return [record.text for record in ros.logs(name)]


@pytest.fixture
def ros():
    with TestSession() as session:
        yield session


def test_nodes_get_their_names_parameters_and_remappings(ros, demo):
    path = demo("""
        DeclareLaunchArgument("period", default_value="1.0"),
        SetEnvironmentVariable("OF_LAUNCH", "set"),
        PushRosNamespace("house"),
        Node(package="demo", executable="talker", name="first", arguments=["a word"],
             parameters=[{"period": LaunchConfiguration("period"), "word": "hi"}]),
        Node(package="demo", executable="other", namespace="room",
             remappings=[("chatter", "words")]),
        Node(package="demo", executable="plain", name="third", namespace="/far"),
    """)
    launched = ros.launch(path, {"period": 0.5})
    ros.run(10)
    assert counts(ros) == {"/house/chatter": 20, "/house/room/words": 10, "/far/chatter": 10}
    assert texts(ros, "house.first") == ["hi set ['a word']"]
    assert list(launched.programs) == ["talker-1", "other-2", "plain-3"]
    assert launched.returncode is None
    assert "OF_LAUNCH" not in os.environ
    assert "process started with pid [1]" in texts(ros, "talker-1")


def test_ctrl_c_ends_all(ros, demo):
    launched = ros.launch(demo('Node(package="demo", executable="talker"),'))
    ros.run(3)
    launched.send_signal(signal.SIGINT)
    assert launched.programs["talker-1"].returncode == 0
    assert launched.returncode == 0
    ros.run(3)
    assert counts(ros) == {"/chatter": 3}
    assert texts(ros, "talker-1")[-1] == "process has finished cleanly [pid 1]"


def test_sigterm_ends_all_with_an_exit_code(ros, demo):
    launched = ros.launch(demo('Node(package="demo", executable="talker"),'), check=False)
    launched.terminate()
    assert launched.returncode == 1
    assert launched.programs["talker-1"].returncode == 0


def test_timers_and_events_count_in_virtual_time(ros, demo):
    path = demo("""
        first := Node(package="demo", executable="talker", name="first"),
        TimerAction(period=5.0, actions=[Node(package="demo", executable="talker", name="second",
                                              remappings=[("chatter", "words")])]),
        RegisterEventHandler(OnProcessStart(on_start=lambda event, context:
            LogInfo(msg=f"start {event.process_name}"))),
        RegisterEventHandler(OnProcessExit(target_action=first, on_exit=[
            LogInfo(msg="exit"), TimerAction(period=2.5, actions=[Shutdown(reason="enough")])])),
        RegisterEventHandler(OnShutdown(on_shutdown=[
            LogInfo(msg=LocalSubstitution("event.reason"))])),
    """)
    launched = ros.launch(path)
    ros.run(10)
    assert counts(ros) == {"/chatter": 10, "/words": 5}
    launched.programs["talker-1"].send_signal(signal.SIGINT)
    ros.run(10)
    records = [(record.time, record.text) for record in ros.logs("launch.user")]
    assert records == [
        (0.0, "start talker-1"), (5.0, "start talker-2"), (10.0, "exit"), (12.5, "enough"),
    ]  # fmt: skip
    assert launched.returncode == 0
    assert counts(ros) == {"/chatter": 10, "/words": 7}


def test_respawn(ros, demo):
    path = demo('Node(package="demo", executable="talker", respawn=True, respawn_delay=2.0),')
    launched = ros.launch(path)
    ros.run(3)
    launched.programs["talker-1"].send_signal(signal.SIGINT)
    ros.run(6)
    assert counts(ros) == {"/chatter": 3 + 4}
    assert launched.returncode is None


def test_a_node_that_dies_fails_the_test(ros, demo):
    path = demo('TimerAction(period=2.0, actions=[Node(package="demo", executable="die")]),')
    ros.launch(path)
    with pytest.raises(ExitCodeError, match="die"):
        ros.run(5)
    ros.launch(demo('Node(package="demo", executable="die"),'), check=False)
    assert "process has died [pid 1, exit code 3" in texts(ros, "die-1")[-1]


def test_xml_and_descriptions(ros, demo):
    path = demo(
        '<launch><node pkg="demo" exec="talker"><param name="period" value="2.0"/></node></launch>',
        "x.launch.xml",
    )
    ros.launch(path)
    ros.run(4)
    assert counts(ros) == {"/chatter": 2}


def test_a_description_with_a_file(ros, tmp_path):
    from launch import LaunchDescription
    from launch_ros.actions import Node

    file = tmp_path / "talker.py"
    file.write_text(TALKER)
    ros.launch(LaunchDescription([Node(executable=str(file), parameters=[{"period": 0.1}])]))
    ros.run(1)
    assert counts(ros) == {"/chatter": 10}


REFUSED = {
    'ExecuteProcess(cmd=["echo", "x"]),': "A session cannot start `echo x`.",
    'Node(package="demo", executable="binary"),': "A session cannot start the program `binary`.",
    'Node(package="demo", executable="lost"),': "wants the module `demo.lost`",
    'Node(package="demo", executable="tlaker"),': "executable 'tlaker' not found",
    'LogInfo(msg=LaunchConfiguration("nope")),': "launch configuration 'nope' does not exist",
    'Node(package="demo", executable="die", respawn=True),': "was started 100 times at one instant",
    "1 / 0,": "ZeroDivisionError: division by zero",
}


@pytest.mark.parametrize("text", REFUSED)
def test_what_cannot_be_launched(ros, demo, capsys, text):
    path = demo(f'Node(package="demo", executable="talker"),\n{text}')
    with pytest.raises(SessionError, match=REFUSED[text]) as error:
        ros.launch(path)
    assert error.value.means
    assert error.value.to_try
    assert capsys.readouterr().err == ""
    ros.run(5)
    assert ros.nodes == ()  # the talker has been ended


def test_a_failure_later_ends_the_launch(ros, demo, capsys):
    launched = ros.launch(
        demo("""
        Node(package="demo", executable="talker"),
        TimerAction(period=2.0, actions=[ExecuteProcess(cmd=["echo", "x"])]),
    """)
    )
    with pytest.raises(ExitCodeError, match=r"x\.launch\.py"):
        ros.run(5)
    assert launched.returncode == 1
    assert "A session cannot start `echo x`." in texts(ros, "launch")[-1]
    assert capsys.readouterr().err.startswith("# In a session, the nodes of a launch file are")


def test_calls_that_do_not_fit(ros, tmp_path):
    with pytest.raises(SessionError, match=r"There is no launch file 'nope\.launch\.py'"):
        ros.launch("nope.launch.py")
    with pytest.raises(SessionError, match="There is no launch file 3"):
        ros.launch(3)
    ros.start()
    with pytest.raises(SessionError, match="live"):
        ros.launch("nope.launch.py")
    ros.stop()


def test_another_launch_is_refused(tmp_path):
    """A sourced ROS has its own `launch`, which knows nothing of sessions."""
    (tmp_path / "launch").mkdir()
    (tmp_path / "launch" / "__init__.py").touch()
    program = (
        "from rosbeat.ros.session import Session\n"
        "with Session() as ros:\n"
        "    try:\n        ros.launch('x')\n"
        "    except Exception as error:\n        print(error)\n"
    )
    path = os.pathsep.join([str(tmp_path), os.environ.get("PYTHONPATH", "")])
    done = subprocess.run(
        [sys.executable, "-c", program], env={**os.environ, "PYTHONPATH": path},
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    assert done.stdout.startswith(f"Python finds another `launch`, in {tmp_path / 'launch'}.")
