"""`ros2 launch` with real processes: what it starts, prints and ends."""

import os
import re
import signal
import sys

import pytest
import yaml
from launch_package import lines, outputs

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
    """Each step is the cause of the next one."""
    path = demo.file("""
        first := Node(package="demo", executable="say"),
        RegisterEventHandler(OnProcessStart(target_action=first, on_start=[
            LogInfo(msg="started")])),
        RegisterEventHandler(OnProcessIO(target_action=first, on_stderr=lambda event: [
            LogInfo(msg="io " + event.text.decode().strip()),
            TimerAction(period=0.01, actions=[
                LogInfo(msg="timer"), ExecuteProcess(cmd=["true"], name="second")])])),
        RegisterEventHandler(OnProcessExit(
            target_action=lambda action: action is not first, on_exit=lambda event, context: [
                LogInfo(msg=f"exit {event.process_name} {event.returncode}"),
                EmitEvent(event=ShutdownEvent(reason="done"))])),
        RegisterEventHandler(OnShutdown(on_shutdown=[
            LogInfo(msg=["shutdown ", LocalSubstitution("event.reason")])])),
        TimerAction(period=60.0, actions=[LogInfo(msg="never")]),
    """)
    shown = lines(ros2.out("launch", path))
    logs = [line.partition("[launch.user]: ")[2] for line in shown if "[launch.user]" in line]
    assert logs == ["started", "io wrong", "timer", "exit second-2 0", "shutdown done"]


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


def test_what_a_process_leaves_running_does_not_hold_the_launch_up(ros2, demo):
    demo.program("leave", "#!/bin/sh\nsleep 30 &\necho $!\n")
    path = demo.file('Node(package="demo", executable="leave", output="screen"),')
    shown = lines(ros2.out("launch", path, timeout=20))
    os.kill(int(outputs(shown, "leave-1")[0]), signal.SIGKILL)
    assert shown[-1] == "[INFO] [leave-1]: process has finished cleanly [pid N"


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
    """The next line that nobody reads ends it, as that of `| head -1` does."""
    demo.program("chat", "#!/bin/sh\nwhile :; do echo chat; sleep 0.01; done\n")
    demo.file('Node(package="demo", executable="chat", output="screen"),')
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
