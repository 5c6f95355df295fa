"""What `ros2 launch` refuses: what happened, what it means, what to try, and nothing runs on."""

import pytest
from launch_package import HEAD


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
    "no format": (
        'Node(package="demo", executable="say", output_format="{lin}"),',
        "output_format='{lin}' cannot be used: 'lin'",
        "# Write for example",
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


def test_the_line_of_a_fault_is_one_of_the_launch_file(ros2, demo):
    path = demo.file("OpaqueFunction(function=lambda context: [LogInfo(msg=5)]),")
    _, error = refusal(ros2, path)
    assert error[0].startswith("# Python raised TypeError in line 18 of 'x.launch.py': ")


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
    "list.launch.py": (
        f"{HEAD}[LogInfo(msg='x')]])\n",
        " - TypeError: LaunchDescription expected actions, but got [",
        "# Correct the launch file there",
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
