"""`ros2 launch` with real processes: what it starts, prints and ends, and what it refuses."""

import os
import re
import signal
import sys
import textwrap
import time
from pathlib import Path

import pytest
import yaml

SAY = '#!/bin/sh\necho "$@"\necho wrong >&2\n'
WAIT = """#!/bin/sh
case $1 in [0-9]*) code=$1;; esac
trap 'echo interrupted; exit ${code:-0}' INT
echo waiting
while :; do sleep 0.01; done
"""
DEAF = "#!/bin/sh\ntrap '' INT TERM\necho deaf\nwhile :; do sleep 0.01; done\n"
HEAD = """\
import os
from launch import LaunchDescription
from launch.actions import *
from launch.conditions import *
from launch.event_handlers import *
from launch.events import Shutdown as ShutdownEvent
from launch.launch_description_sources import *
from launch.substitutions import *
from launch_ros.actions import *
from launch_ros.parameter_descriptions import *
from launch_ros.substitutions import *

HERE = os.path.dirname(__file__)


def generate_launch_description():
    return LaunchDescription([
"""


class Demo:
    """The package `demo`, with programs and launch files."""

    def __init__(self, prefix):
        self.prefix, self.share = prefix, prefix / "share" / "demo"
        index = prefix / "share" / "ament_index" / "resource_index" / "packages"
        index.mkdir(parents=True)
        (index / "demo").touch()
        (self.share / "launch").mkdir(parents=True)
        for name, text in (("say", SAY), ("wait", WAIT), ("deaf", DEAF), ("die", "exit 3\n")):
            self.program(name, text if text.startswith("#!") else f"#!/bin/sh\n{text}")

    def program(self, name, text):
        path = self.prefix / "lib" / "demo" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        path.chmod(0o755)

    def file(self, text, name="x.launch.py"):
        """Write a launch file, in Python with these actions, and return its path."""
        path = self.share / "launch" / name
        inside = textwrap.indent(textwrap.dedent(text), " " * 8)
        path.write_text(f"{HEAD}{inside}\n    ])\n" if name.endswith(".py") else text)
        return path


def running_in(folder):
    """The processes whose command line names a folder."""
    found = []
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit() and int(entry.name) != os.getpid():
            try:
                words = (entry / "cmdline").read_bytes()
            except OSError:  # it has just ended
                continue
            if os.fsencode(str(folder)) + b"/lib/" in words:
                found.append(words)
    return found


@pytest.fixture
def demo(ros2, tmp_path, monkeypatch):
    """The package `demo`; at the end none of its programs runs."""
    made = Demo(tmp_path / "prefix")
    monkeypatch.setitem(ros2.environment, "AMENT_PREFIX_PATH", str(made.prefix))
    monkeypatch.setitem(ros2.environment, "ROS_LOG_DIR", str(tmp_path / "log"))
    yield made
    deadline = time.monotonic() + 10
    while (left := running_in(made.prefix)) and time.monotonic() < deadline:
        time.sleep(0.01)
    assert not left


def lines(text):
    """What a launch prints, without what differs from run to run and how every launch begins."""
    text = re.sub(r"pid \[?\d+\]?", "pid N", text)
    shown = re.sub(r"\S+/launch_params_\w+/(\d+)\.yaml", r"FILE\1", text).splitlines()
    assert shown[0].startswith("[INFO] [launch]: All log files can be found below ")
    assert shown[1] == "[INFO] [launch]: Default logging verbosity is set to INFO"
    return shown[2:]


def outputs(shown, name):
    """What one process has printed."""
    return [line.removeprefix(f"[{name}] ") for line in shown if line.startswith(f"[{name}] ")]


# What is started.


def test_a_node_gets_its_arguments(ros2, demo):
    demo.file("""
        Node(package="demo", executable="say", name="n", namespace="ns", arguments=["a b", "c"],
             ros_arguments=["--log-level", "debug"], remappings=[("from", "to")],
             parameters=[{"p": 1}], output="screen"),
        LogInfo(msg="hello"),
    """)
    shown = lines(ros2.out("launch", "demo", "x.launch.py"))
    assert shown[:2] == [
        "[INFO] [launch.user]: hello",
        "[INFO] [say-1]: process started with pid N",
    ]
    words = "a b c --ros-args --log-level debug --ros-args -r __node:=n -r __ns:=/ns"
    assert f"[say-1] {words} --params-file FILE1 -r from:=to" in shown
    assert "[say-1] wrong" in shown
    assert shown[-1] == "[INFO] [say-1]: process has finished cleanly [pid N"


def test_parameters_become_a_file_of_their_node(ros2, demo):
    demo.program(
        "show",
        '#!/bin/sh\nwhile [ $# -gt 0 ]; do [ "$1" = --params-file ] && cat "$2"; shift; done\n',
    )
    own = demo.share / "own.yaml"
    own.write_text("/**: {ros__parameters: {from: file}}\n")
    demo.file(f"""
        DeclareLaunchArgument("num", default_value="5"),
        Node(package="demo", executable="show", name="n", namespace="ns", output="screen",
             parameters=[{{
            "list": [1, 2.5], "text": "12", "group": {{"inner": True}}, "names": ["a", "b"],
            "var": LaunchConfiguration("num"),
            "str": ParameterValue(LaunchConfiguration("num"), value_type=str),
            "joined": [LaunchConfiguration("num"), "k"],
        }}, {str(own)!r}]),
        Node(package="demo", executable="show", output="screen", parameters=[{{"a": 1}}]),
    """)
    shown = lines(ros2.out("launch", "demo", "x.launch.py"))
    first = yaml.safe_load("\n".join(outputs(shown, "show-1")[:-1]))
    assert first["/ns/n"]["ros__parameters"] == {
        "list": [1.0, 2.5], "text": "12", "group.inner": True, "var": 5, "str": "5",
        "names": ["a", "b"], "joined": "5k",
    }  # fmt: skip
    assert outputs(shown, "show-1")[-1] == "/**: {ros__parameters: {from: file}}"
    assert yaml.safe_load("\n".join(outputs(shown, "show-2"))) == {
        "/**": {"ros__parameters": {"a": 1}}
    }


def test_groups_have_a_scope(ros2, demo):
    demo.file("""
        SetLaunchConfiguration("a", "1"),
        GroupAction([
            PushRosNamespace("g"), SetParameter("p", 2), SetRemap("s", "t"),
            SetLaunchConfiguration("a", "2"), SetEnvironmentVariable("OF_GROUP", "yes"),
            LogInfo(msg=["in ", LaunchConfiguration("a"), EnvironmentVariable("OF_GROUP")]),
            Node(package="demo", executable="say", namespace="h", output="screen"),
        ]),
        LogInfo(msg=["out ", LaunchConfiguration("a"),
                     EnvironmentVariable("OF_GROUP", default_value=" no")]),
        Node(package="demo", executable="say", output="screen"),
    """)
    shown = lines(ros2.out("launch", "demo", "x.launch.py"))
    assert shown[:2] == ["[INFO] [launch.user]: in 2yes", "[INFO] [launch.user]: out 1 no"]
    assert outputs(shown, "say-1")[0] == "--ros-args -r __ns:=/g/h -p p:=2 -r s:=t"
    assert outputs(shown, "say-2")[0] == "--ros-args"


SUBSTITUTIONS = {
    'PythonExpression(["1 + ", LaunchConfiguration("two")])': "3",
    'PathJoinSubstitution(["/a", ["b", LaunchConfiguration("two")]])': "/a/b2",
    'FindPackageShare("demo")': "SHARE",
    'Command("echo hi")': "hi",
    'EqualsSubstitution(LaunchConfiguration("two"), 2.0)': "true",
    'IfElseSubstitution("false", "x", "y")': "y",
    'AndSubstitution("true", NotSubstitution("false"))': "true",
    "ThisLaunchFileDir()": "SHARE/launch",
    'EnvironmentVariable("NOPE", default_value="none")': "none",
    'LaunchConfiguration("nope", default=["a", TextSubstitution(text="b")])': "ab",
}


def test_substitutions(ros2, demo):
    logs = "".join(f"LogInfo(msg={text}),\n" for text in SUBSTITUTIONS)
    path = demo.file(f'SetLaunchConfiguration("two", "2"),\n{logs}')
    shown = [line for line in lines(ros2.out("launch", path)) if line]
    expected = [text.replace("SHARE", str(demo.share)) for text in SUBSTITUTIONS.values()]
    assert shown == [f"[INFO] [launch.user]: {text}" for text in expected]


def test_conditions_and_functions(ros2, demo):
    path = demo.file("""
        DeclareLaunchArgument("on", default_value="false"),
        LogInfo(msg="if", condition=IfCondition(LaunchConfiguration("on"))),
        LogInfo(msg="unless", condition=UnlessCondition(LaunchConfiguration("on"))),
        OpaqueFunction(function=lambda context, more: [
            LogInfo(msg=f"{context.launch_configurations['on']} {more}")], args=["more"]),
    """)
    start = "[INFO] [launch.user]: "
    assert lines(ros2.out("launch", path)) == [f"{start}unless", f"{start}false more"]
    assert lines(ros2.out("launch", path, "on:=true")) == [f"{start}if", f"{start}true more"]


def test_includes_have_arguments_and_a_folder(ros2, demo):
    demo.file("""
        DeclareLaunchArgument("who"), LogInfo(msg=["hello ", LaunchConfiguration("who")]),
    """, "inner.launch.py")  # fmt: skip
    path = demo.file("""
        IncludeLaunchDescription(PythonLaunchDescriptionSource([FindPackageShare("demo"),
            "/launch/inner.launch.py"]), launch_arguments={"who": "Rosie"}.items()),
        IncludeLaunchDescription(PathJoinSubstitution([ThisLaunchFileDir(), "inner.launch.py"]),
            launch_arguments=[("who", "all")]),
    """)
    assert lines(ros2.out("launch", path)) == [
        "[INFO] [launch.user]: hello Rosie",
        "[INFO] [launch.user]: hello all",
    ]


def test_the_forms_of_launch_files_agree(ros2, demo):
    demo.file("""
        DeclareLaunchArgument("who", default_value="world"),
        GroupAction([PushRosNamespace("g"), Node(
            package="demo", executable="say", name="n", output="screen",
            arguments=["one", ["--who=", LaunchConfiguration("who")], "two three"],
            parameters=[{"i": 1}], remappings=[("a", LaunchConfiguration("who"))])]),
    """)
    demo.file("""\
<launch>
  <arg name="who" default="world"/>
  <group>
    <push_ros_namespace namespace="g"/>
    <node pkg="demo" exec="say" name="n" output="screen" args="one --who=$(var who) 'two three'">
      <param name="i" value="1"/>
      <remap from="a" to="$(var who)"/>
    </node>
  </group>
</launch>
""", "x.launch.xml")  # fmt: skip
    demo.file("""\
launch:
- arg: {name: who, default: world}
- group:
  - push_ros_namespace: {namespace: g}
  - node:
      pkg: demo
      exec: say
      name: n
      output: screen
      args: "one --who=$(var who) 'two three'"
      param: [{name: i, value: 1}]
      remap: [{from: a, to: $(var who)}]
""", "x.launch.yaml")  # fmt: skip
    found = [
        lines(ros2.out("launch", "demo", f"x.launch.{form}")) for form in ("py", "xml", "yaml")
    ]
    assert (
        "two three --ros-args -r __node:=n -r __ns:=/g --params-file FILE1 -r a:=world"
        in (outputs(found[0], "say-1")[0])
    )
    assert sorted(found[0]) == sorted(found[1]) == sorted(found[2])


@pytest.mark.parametrize(
    "text", ['<launch><log message="x"/></launch>', "launch: [log: {message: x}]"]
)
def test_a_name_may_leave_the_form_open(ros2, demo, text):
    assert lines(ros2.out("launch", demo.file(text, "x.launch"))) == ["[INFO] [launch.user]: x"]


def test_xml_has_the_other_tags(ros2, demo):
    path = demo.file("""\
<launch>
  <let name="x" value="3"/>
  <set_env name="MINE" value="v"/>
  <log message="$(var x) \\$(var x) $(env MINE) $(env NOPE none) $(eval '$(var x) + 1')"/>
  <log message="$(find-pkg-share demo) $(dirname)" if="$(equals $(var x) 3)"/>
  <log message="never" unless="true"/>
  <timer period="0.01"><log message="later"/></timer>
  <executable cmd="echo $(var x) 'a b'" output="screen"/>
</launch>
""", "x.launch.xml")  # fmt: skip
    shown = lines(ros2.out("launch", path))
    assert shown[:2] == [
        "[INFO] [launch.user]: 3 $(var x) v none 4",
        f"[INFO] [launch.user]: {demo.share} {demo.share}/launch",
    ]
    assert "[echo-1] 3 a b" in shown
    assert "[INFO] [launch.user]: later" in shown
    assert len(shown) == 6


# What happens while they run.


def test_event_handlers_and_timers(ros2, demo):
    path = demo.file("""
        first := Node(package="demo", executable="say"),
        second := ExecuteProcess(cmd=["sleep", "0.01"], name="second"),
        RegisterEventHandler(OnProcessStart(target_action=first, on_start=[
            LogInfo(msg="started")])),
        RegisterEventHandler(OnProcessIO(target_action=first, on_stderr=lambda event:
            LogInfo(msg="io " + event.text.decode().strip()))),
        RegisterEventHandler(OnProcessExit(target_action=second, on_exit=lambda event, context: [
            LogInfo(msg=f"exit {event.returncode}"),
            EmitEvent(event=ShutdownEvent(reason="done"))])),
        RegisterEventHandler(OnShutdown(on_shutdown=[
            LogInfo(msg=["shutdown ", LocalSubstitution("event.reason")])])),
        TimerAction(period=60.0, actions=[LogInfo(msg="never")]),
    """)
    shown = lines(ros2.out("launch", path))
    logs = [line.partition("[launch.user]: ")[2] for line in shown if "[launch.user]" in line]
    assert sorted(logs) == ["exit 0", "io wrong", "shutdown done", "started"]
    assert logs.index("exit 0") + 1 == logs.index("shutdown done")


def test_respawn(ros2, demo):
    path = demo.file("""
        Node(package="demo", executable="die", respawn=True, respawn_max_retries=2,
             on_exit=[LogInfo(msg="again")]),
    """)
    shown = lines(ros2.out("launch", path))
    assert sum("process started" in line for line in shown) == 3
    assert sum("again" in line for line in shown) == 3
    died = "[ERROR] [die-1]: process has died [pid N, exit code 3, cmd '"
    assert sum(line.startswith(died) for line in shown) == 3


def test_the_end_of_a_node_can_end_the_launch(ros2, demo):
    path = demo.file("""
        Node(package="demo", executable="wait", output="screen"),
        first := Node(package="demo", executable="die", on_exit=Shutdown()),
    """)
    shown = lines(ros2.out("launch", path, timeout=30))
    assert "[INFO] [launch]: process[die-2] was required: shutting down launched system" in shown
    assert "[INFO] [wait-1]: sending signal 'SIGINT' to process[wait-1]" in shown


def test_where_output_goes(ros2, demo, tmp_path):
    path = demo.file("""
        Node(package="demo", executable="say", arguments=["silent"]),
        Node(package="demo", executable="say", arguments=["own"], output="own_log"),
        Node(package="demo", executable="say", arguments=["loud"], output={"stdout": "screen"}),
        Node(package="demo", executable="say", arguments=["tty"], output="screen",
             emulate_tty=True),
    """)
    shown = lines(ros2.out("launch", path))
    assert outputs(shown, "say-1") == ["wrong"]
    assert outputs(shown, "say-2") == []
    assert outputs(shown, "say-3") == ["loud --ros-args"]
    assert sorted(outputs(shown, "say-4")) == ["tty --ros-args", "wrong"]
    (folder,) = (entry for entry in (tmp_path / "log").iterdir() if not entry.is_symlink())
    assert (tmp_path / "log" / "latest").resolve() == folder
    assert "[say-1] silent --ros-args" in (folder / "launch.log").read_text()
    assert (folder / "say-2-stdout.log").read_text() == "[say-2] own --ros-args\n"
    assert "silent" in "".join(lines(ros2.out("launch", "-a", path)))


def ended_by(ros2, demo, number, *words, signal_group=False):
    """What a launch of `x.launch.py` prints that gets a signal as soon as its node waits."""
    with ros2.running("launch", "demo", "x.launch.py", *words) as process:
        begun = []
        while not begun or not begun[-1].endswith(("waiting\n", "deaf\n")):
            begun.append(process.stdout.readline())
            assert begun[-1]
        (os.killpg if signal_group else os.kill)(process.pid, number)
        out, error = process.communicate(timeout=60)
    return process.returncode, lines("".join(begun) + out), error


def test_ctrl_c_ends_all(ros2, demo):
    demo.file('Node(package="demo", executable="wait", arguments=["4"], output="screen"),')
    code, shown, error = ended_by(ros2, demo, signal.SIGINT)
    assert (code, error) == (0, "")
    assert "[WARNING] [launch]: user interrupted with ctrl-c (SIGINT)" in shown
    assert "[wait-1] interrupted" in shown
    assert shown[-1].startswith("[ERROR] [wait-1]: process has died [pid N, exit code 4, cmd '")


def test_a_signal_for_the_group_reaches_a_node_once(ros2, demo):
    demo.program(
        "count",
        """#!/bin/sh
trap 'echo interrupted; left=20' INT
echo waiting
while [ "${left:=-1}" != 0 ]; do sleep 0.01; [ "$left" -lt 0 ] || left=$((left - 1)); done
""",
    )
    demo.file('Node(package="demo", executable="count", output="screen"),')
    code, shown, _ = ended_by(ros2, demo, signal.SIGINT, signal_group=True)
    assert code == 0
    assert outputs(shown, "count-1") == ["waiting", "interrupted"]


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGHUP])
def test_other_signals_leave_nothing_running(ros2, demo, number):
    demo.file('Node(package="demo", executable="wait", output="screen"),')
    code, shown, _ = ended_by(ros2, demo, number)
    assert code == 1
    assert "[INFO] [wait-1]: sending signal 'SIGINT' to process[wait-1]" in shown
    assert shown[-1] == "[INFO] [wait-1]: process has finished cleanly [pid N"


def test_a_deaf_node_is_killed(ros2, demo):
    demo.file("""
        Node(package="demo", executable="deaf", output="screen", sigterm_timeout="0.1"),
        DeclareLaunchArgument("sigkill_timeout", default_value="0.2"),
    """)
    code, shown, _ = ended_by(ros2, demo, signal.SIGINT)
    assert code == 0
    text = (
        "process[deaf-1] failed to terminate '{}' seconds after receiving '{}', escalating to '{}'"
    )
    for place, step in (
        (-5, text.format("0.1", "SIGINT", "SIGTERM")),
        (-4, "sending signal 'SIGTERM' to process[deaf-1]"),
        (-3, text.format("0.30000000000000004", "SIGTERM", "SIGKILL")),
        (-2, "sending signal 'SIGKILL' to process[deaf-1]"),
        (-1, "process has died [pid N, exit code -9"),
    ):
        assert step in shown[place]


def test_a_closed_pipe_ends_all(ros2, demo):
    demo.file('Node(package="demo", executable="wait", output="screen"),')
    with ros2.running("launch", "demo", "x.launch.py") as process:
        assert process.stdout.readline()
        process.stdout.close()
        assert process.wait(60) == 0


# What is shown only.


def test_arguments_are_shown(ros2, demo):
    demo.file("""
        DeclareLaunchArgument("speed", default_value=["1", TextSubstitution(text="0")],
                              description="how fast"),
        DeclareLaunchArgument("mode", choices=["a", "b"]),
        DeclareLaunchArgument("more", condition=IfCondition("false")),
    """)
    assert ros2.out("launch", "demo", "x.launch.py", "--show-args") == (
        "Arguments (pass arguments as '<name>:=<value>'):\n"
        "\n    'speed':\n        how fast\n        (default: '1' + '0')\n"
        "\n    'mode':\n        One of: ['a', 'b']\n"
        "\n    'more':*\n        no description given\n"
        "\n* argument(s) which are only used if specific conditions occur\n"
    )
    path = demo.file("", "none.launch.py")
    assert ros2.out("launch", "-s", path).endswith(":\n\n  No arguments.\n")


def test_a_description_is_shown(ros2, demo):
    path = demo.file("""
        node := Node(package="demo", executable="say", name="n"),
        RegisterEventHandler(OnProcessExit(target_action=node, on_exit=[Shutdown()])),
        LogInfo(msg=["a", LaunchConfiguration("b")]),
    """)
    shown = re.sub(r"<\S* object at \w+>", "OBJECT", ros2.out("launch", "--print", path))
    assert shown == (
        "OBJECT\n"
        "├── ExecuteProcess(cmd=[ExecInPkg(pkg='demo', exec='say'), '--ros-args', '-r', "
        "LocalVar('node name')], cwd=None, env=None, shell=False)\n"
        "├── RegisterEventHandler('OBJECT'):\n"
        "│   ├── OnProcessExit(matcher='event == ProcessExited and ExecuteLocal(event.action)', "
        "handler='<actions>', handle_once=False)\n"
        "│       └── EmitEvent(event='launch.events.Shutdown')\n"
        "└── LogInfo('a' + LaunchConfig('b'))\n"
    )


def test_completion(ros2, demo):
    path = demo.file('DeclareLaunchArgument("speed"), DeclareLaunchArgument("size"),')
    demo.file("<launch/>", "y.launch.xml")

    def offered(*words):
        return ros2.out("completion", "words", "launch", *words).split()

    assert "demo" in offered("de")
    assert offered("demo", "") == ["x.launch.py", "y.launch.xml"]
    assert offered("demo", "x.launch.py", "") == ["size:=", "speed:="]
    assert offered(str(path), "sp") == ["speed:="]
    assert "--show-args" in offered("--s")


# What is refused.


def refusal(ros2, *words):
    """The first line of the error that ends a launch, and what it means and what to try."""
    done = ros2("launch", *words, code=1)
    (first,) = (line for line in done.stdout.splitlines() if "Caught exception in launch" in line)
    after = done.stdout.partition(f"{first}\n")[2].splitlines()
    return [first.partition("traceback): ")[2], *after], done.stderr.splitlines()


BROKEN = {
    "unknown package": (
        'Node(package="demmo", executable="say"),',
        "\"package 'demmo' not found, searching: [",
        "# Did you mean 'demo'?",
    ),
    "unknown executable": (
        'Node(package="demo", executable="sya"),',
        "executable 'sya' not found on the libexec directory '",
        "# Did you mean 'say'?",
    ),
    "missing argument": (
        'DeclareLaunchArgument("speed", description="how fast"),',
        "Included launch description missing required argument 'speed' (description: 'how fast')",
        "# Type its value behind the launch file:  speed:=VALUE",
    ),
    "unknown configuration": (
        'LogInfo(msg=LaunchConfiguration("nope")),',
        "launch configuration 'nope' does not exist",
        "# Add DeclareLaunchArgument('nope', default_value=...) in front of it",
    ),
    "bad condition": (
        'LogInfo(msg="x", condition=IfCondition("maybe")),',
        "invalid condition expression, expected one of [true, 1, false, 0] but got 'maybe'",
        "# Write true or false",
    ),
    "bad expression": (
        'LogInfo(msg=PythonExpression("nope == 1")),',
        "name 'nope' is not defined",
        "# Put quotes around a text within it",
    ),
    "bad name": (
        'Node(package="demo", executable="say", name="my node"),',
        "Invalid node name: 'my node'",
        "# Write it as my_node",
    ),
    "an include that is not there": (
        'IncludeLaunchDescription("/nowhere/x.launch.py"),',
        "[Errno 2] No such file or directory: '/nowhere/x.launch.py'",
        "# Compare the path",
    ),
    "no output": (
        'Node(package="demo", executable="say", output="scren"),',
        'scren is not a valid standard output config i.e. "screen", "log" or "both"',
        "# Write 'screen' to see them",
    ),
    "a mixed list": (
        'Node(package="demo", executable="say", parameters=[{"l": [1, "a"]}]),',
        "Expected a non-empty sequence, with items of uniform type.",
        "# Correct the value.",
    ),
    "a function that fails": (
        "OpaqueFunction(function=lambda context: 1 / 0),",
        "division by zero",
        "# Correct the launch file there",
    ),
}


@pytest.mark.parametrize("case", BROKEN)
def test_a_launch_that_fails_says_why_and_ends_what_runs(ros2, demo, case):
    """The failure comes last, when a node has been asked for, and perhaps while it runs."""
    text, what, advice = BROKEN[case]
    path = demo.file(f'Node(package="demo", executable="wait"),\n{text}')
    shown, error = refusal(ros2, path)
    assert shown[0].startswith(what)
    assert all(line.startswith("# ") for line in error)
    assert len(error) >= 2
    assert error[-1].startswith(advice)


def test_a_failure_in_the_middle_ends_what_runs(ros2, demo):
    path = demo.file("""
        waiting := Node(package="demo", executable="wait", output="screen"),
        RegisterEventHandler(OnProcessIO(target_action=waiting, on_stdout=lambda event:
            LogInfo(msg=LaunchConfiguration("nope")), handle_once=True)),
    """)
    (first, *rest), error = refusal(ros2, path)
    assert first == "launch configuration 'nope' does not exist"
    assert "[INFO] [wait-1]: sending signal 'SIGINT' to process[wait-1]" in rest
    assert len(error) == 2


UNREADABLE = {
    "syntax.launch.py": (
        "def generate_launch_description(:\n",
        " - SyntaxError: invalid syntax",
        "# Look there, and in the line before, for a bracket or comma that is missing.",
    ),
    "raises.launch.py": (
        "1 / 0\n",
        " - ZeroDivisionError: division by zero",
        "# Correct the launch file there",
    ),
    "module.launch.py": (
        "import nav2_common.launch\n",
        " - ModuleNotFoundError: No module named 'nav2_common'",
        "# Install it, or source the workspace that has it",
    ),
    "keyword.launch.py": (
        f"{HEAD}Node(package='demo', executable='say', nmae='x')])\n",
        " - TypeError: Action.__init__() got an unexpected keyword argument 'nmae'",
        "# Did you mean 'name'?",
    ),
    "function.launch.py": (
        "x = 1\n",
        "does not contain the required function 'generate_launch_description()'",
        "# Add it:  def generate_launch_description()",
    ),
    "nothing.launch.py": (
        "def generate_launch_description():\n    pass\n",
        "returned 'NoneType'",
        "# End the function with:  return LaunchDescription([...])",
    ),
    "attribute.launch.xml": (
        '<launch><node pkg="demo" exec="say" nmae="x"/></launch>',
        " - ValueError: Unexpected attribute(s) found in `node`: {'nmae'}",
        "# Did you mean 'name'?",
    ),
    "tag.launch.xml": (
        '<launch><nodee pkg="demo" exec="say"/></launch>',
        " - RuntimeError: Unrecognized entity of the type: nodee",
        "# Did you mean 'node'?",
    ),
    "inner.launch.xml": (
        '<launch><node pkg="demo" exec="say"><parm name="a" value="1"/></node></launch>',
        " - ValueError: Unexpected nested tag(s) found in `node`: {'parm'}",
        "# Did you mean 'param'?",
    ),
    "required.launch.xml": (
        '<launch><node pkg="demo"/></launch>',
        " - AttributeError: Attribute 'exec' of type '<class 'str'>' not found in Entity 'node'",
        '# Add it, as in <node exec="...">',
    ),
    "broken.launch.xml": (
        "<launch>\n<node></launch>",
        " - ParseError: mismatched tag: line 2, column 8",
        "# Compare the tags",
    ),
    "substitution.launch.xml": (
        '<launch><log message="$(vra x)"/></launch>',
        " - Unknown substitution: vra",
        "# Did you mean 'var'?",
    ),
    "open.launch.xml": (
        '<launch><log message="$(var x"/></launch>',
        " - UnexpectedCharacters: '$(var x' cannot be read from column 1 on",
        "# Write $(name argument)",
    ),
    "root.launch.yaml": (
        "lanch:\n- log: {message: x}\n",
        " - RuntimeError: Expected 'launch' as root tag",
        "# Put all of it into `launch:`.",
    ),
    "broken.launch.yaml": (
        "launch:\n- node:\n    pkg: demo\n   exec: say\n",
        " - ParserError: while parsing a block mapping",
        "# Compare the indentation",
    ),
    "key.launch.yaml": (
        "launch:\n- node: {pkg: demo, exec: say, nmae: x}\n",
        " - ValueError: Unexpected key(s) found in `node`: {'nmae'}",
        "# Did you mean 'name'?",
    ),
    "type.launch.yaml": (
        "launch:\n- let: {name: x, value: 3}\n",
        " - TypeError: Attribute 'value' of Entity 'let' expected to be of type",
        '# Write it in quotes:  value: "3"',
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", UNREADABLE)
def test_a_file_that_cannot_be_read(ros2, demo, name):
    text, what, advice = UNREADABLE[name]
    path = demo.share / "launch" / name
    path.write_text(text)
    shown, error = refusal(ros2, path)
    assert any(what in line for line in shown)
    assert len(error) == 2
    assert error[-1].startswith(advice)
    printed = ros2.error("launch", "--print", path)
    assert what in printed
    assert error == [line for line in printed.splitlines() if line.startswith("# ")]


def test_files_that_include_each_other(ros2, demo):
    demo.file('IncludeLaunchDescription([HERE, "/b.launch.py"]),', "a.launch.py")
    demo.file('IncludeLaunchDescription([HERE, "/a.launch.py"]),', "b.launch.py")
    (first, *_), error = refusal(ros2, "demo", "a.launch.py")
    assert first.startswith("maximum recursion depth exceeded")
    assert "a.launch.py -> b.launch.py -> a.launch.py" in error[0]
    assert "No arguments." in ros2.out("launch", "demo", "a.launch.py", "--show-args")


def test_a_parameter_file_that_is_none(ros2, demo):
    (demo.share / "list.yaml").write_text("speed: 1\n")
    (demo.share / "broken.yaml").write_text("a: [1\n")
    path = demo.file("""
        Node(package="demo", executable="say", parameters=["/nowhere.yaml"]),
        Node(package="demo", executable="say", parameters=[HERE + "/../list.yaml"]),
        Node(package="demo", executable="say", parameters=[HERE + "/../broken.yaml"]),
    """)
    done = ros2("launch", path)
    warning = (
        "[WARNING] [launch_ros.actions.node]: Parameter file path is not a file: /nowhere.yaml"
    )
    assert warning in done.stdout
    notes = done.stderr.splitlines()
    assert "the values in its code" in notes[0]
    assert "has no `ros__parameters`" in notes[2]
    assert "broken.yaml', line 2 is no YAML" in notes[4]
    assert len(notes) == 6


def test_a_program_that_cannot_be_started(ros2, demo):
    path = demo.file("""
        ExecuteProcess(cmd=["/nowhere/program"]), Node(package="demo", executable="say"),
    """)
    done = ros2("launch", path)
    assert (
        "FileNotFoundError: [Errno 2] No such file or directory: '/nowhere/program'" in done.stdout
    )
    assert "[INFO] [say-2]: process has finished cleanly" in done.stdout
    assert len(done.stderr.splitlines()) == 2


LEFT_OUT = {
    "from launch_ros.actions import LifecycleNode": "launch_ros.actions.LifecycleNode",
    "from launch_ros.actions import ComposableNodeContainer": "ComposableNodeContainer",
    "from launch_ros.descriptions import ComposableNode": "launch_ros.descriptions.ComposableNode",
    "from launch_ros.events.lifecycle import ChangeState": "lifecycle.ChangeState",
    "from launch_ros.event_handlers import OnStateTransition": "OnStateTransition",
    "from launch.actions import OpaqueCoroutine": "launch.actions.OpaqueCoroutine",
    "import launch_ros; launch_ros.actions.RosTimer": "launch_ros.actions.RosTimer",
}


@pytest.mark.parametrize("line", LEFT_OUT)
def test_what_is_left_out_is_refused_by_name(ros2, demo, line):
    path = demo.file("")
    path.write_text(f"{line}\n{path.read_text()}")
    (first, *_), error = refusal(ros2, path)
    assert LEFT_OUT[line] in first
    assert first.endswith("is left out here")
    assert len(error) == 2


def test_tags_that_are_left_out_are_refused_by_name(ros2, demo):
    path = demo.file("<launch><node_container/></launch>", "x.launch.xml")
    (first, *_), error = refusal(ros2, path)
    assert "ComposableNodeContainer` is left out here" in first
    assert len(error) == 2


def test_what_cannot_be_found(ros2, demo):
    path = demo.file("")
    assert ros2.error("launch", "demmo", "x.launch.py").endswith("# Did you mean 'demo'?\n")
    what, listed, advice = ros2.error("launch", "demo", "x.lanch.py").splitlines()
    assert what == (
        "file 'x.lanch.py' was not found in the share directory of package 'demo' which is at "
        f"'{demo.share}'"
    )
    assert (listed, advice) == (
        "# Package 'demo' has: x.launch.py",
        "# Did you mean 'x.launch.py'?",
    )
    assert "# Type:  ros2 launch demo x.launch.py" in ros2.error("launch", "demo")
    assert "path of a launch file" in ros2.error("launch", "./nope.launch.py")
    twin = demo.share / "other" / path.name
    twin.parent.mkdir()
    twin.write_text(path.read_text())
    assert "found more than once" in ros2.error("launch", "demo", "x.launch.py")


def test_arguments_that_are_none(ros2, demo):
    path = demo.file('DeclareLaunchArgument("mode", default_value="a", choices=["a", "b"]),')
    assert ros2.error("launch", path, "mode=b").splitlines() == [
        "malformed launch argument 'mode=b', expected format '<name>:=<value>'",
        "# What stands behind the launch file gives its arguments their values.",
        "# Type a colon before the equals sign:  mode:=b",
    ]
    (first, *_), error = refusal(ros2, path, "mode:=c")
    assert first.startswith('Argument "mode" provided value "c" is not valid.')
    assert error[-1] == "# Type one of them, as in mode:=a"
    ros2("launch", path, "mode:=c", "mode:=b")  # of two the last counts
    assert "--launch-prefix must be" in ros2.error("launch", "--launch-prefix-filter", "x", path)


def test_a_prefix(ros2, demo):
    path = demo.file('Node(package="demo", executable="say", output="screen"),')
    shown = lines(ros2.out("launch", "--launch-prefix", "env", path))
    assert "[INFO] [env-1]: process started with pid N" in shown
    shown = lines(ros2.out("launch", "--launch-prefix", "env", "--launch-prefix-filter", "x", path))
    assert "[INFO] [say-1]: process started with pid N" in shown


def test_a_full_ros_that_is_sourced_comes_first(ros2, demo, tmp_path):
    """Its packages come first through PYTHONPATH, and what it knows is left to it."""
    path = demo.file("")
    (tmp_path / "ros" / "launch").mkdir(parents=True)
    (tmp_path / "ros" / "launch" / "__init__.py").touch()
    first = os.pathsep.join([str(tmp_path / "ros"), ros2.environment["PYTHONPATH"]])
    what, *rest = ros2.error("launch", path, PYTHONPATH=first).splitlines()
    assert what == f"Python finds another `launch` first, in {tmp_path / 'ros' / 'launch'}"
    assert len(rest) == 2


@pytest.mark.ros
def test_real_nodes_hear_their_names_and_end(ros2, graph, demo, monkeypatch):
    monkeypatch.setitem(ros2.environment, "ROS_DOMAIN_ID", graph.environment["ROS_DOMAIN_ID"])
    demo.program(
        "node",
        f"""#!{sys.executable}
import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
rclpy.init()
node = Node("node")
value = node.declare_parameter("value", 0).value
print("waiting", node.get_fully_qualified_name(), node.resolve_topic_name("a"), value, flush=True)
print("waiting", flush=True)
try:
    rclpy.spin(node)
except (KeyboardInterrupt, ExternalShutdownException):
    pass
""",
    )
    demo.file("""
        Node(package="demo", executable="node", name="n", namespace="ns", parameters=[{"value": 7}],
             remappings=[("a", "b")], output="screen"),
    """)
    code, shown, error = ended_by(ros2, demo, signal.SIGINT)
    assert (code, error) == (0, "")
    assert "[node-1] waiting /ns/n /ns/b 7" in shown
    assert shown[-1] == "[INFO] [node-1]: process has finished cleanly [pid N"
