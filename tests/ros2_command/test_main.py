import re
import subprocess
import sys

import pytest
from readme_table import SOURCE, UPSTREAM, options, table, verbs
from ros2_command.errors import CommandError
from ros2_command.main import guarded, main
from ros2_command.names import check_name, full_name, is_hidden, nearest
from ros2_command.registry import COMMANDS, LEFT_OUT, verbs_of

PKG_HELP = """\
usage: ros2 pkg [-h] Call `ros2 pkg <command> -h` for more detailed usage. ...

Various package related sub-commands

options:
  -h, --help            show this help message and exit

Commands:
  create       Create a new ROS 2 package
  executables  Output a list of package specific executables
  list         Output a list of available packages
  prefix       Output the prefix path of a package
  xml          Output the XML of the package manifest or a specific tag

  Call `ros2 pkg <command> -h` for more detailed usage.
"""
TOP_USAGE = """\
usage: ros2 [-h] [--use-python-default-buffering]
            Call `ros2 <command> -h` for more detailed usage. ...
"""


def test_a_command_alone_prints_its_help(ros2):
    assert ros2.out("pkg") == ros2.out("pkg", "--help") == PKG_HELP


def test_the_help_says_what_is_left_out(ros2):
    done = ros2()
    assert done.stdout == ros2.out("--help")
    assert done.stdout.startswith(TOP_USAGE)
    assert all(f"\n  {name} " in done.stdout for name in COMMANDS)
    notes = done.stderr.splitlines()
    assert all(line.startswith("# ") for line in notes)
    assert notes[0] == "# This is a subset for ROS 2 installed with pip. Left out:"
    assert all(name in done.stderr for name in LEFT_OUT)
    assert ros2("--help", ROS2_COMMAND_NO_NOTES="all").stderr == ""


@pytest.mark.parametrize("words", [["security", "a", "b"], ["bag", "convert"], ["doctor", "hello"]])
def test_what_is_left_out_says_where_to_get_it(capsys, words):
    assert main(words) == 1
    error = capsys.readouterr().err
    assert "is left out here" in error
    assert "RoboStack" in error


def test_surplus_arguments_are_reported_as_the_original_does(ros2):
    expected = TOP_USAGE + "ros2: error: unrecognized arguments: b\n"
    assert ros2.error("pkg", "list", "b", code=2) == expected


@pytest.mark.parametrize(("words", "name"), [(["tpoic"], "topic"), (["pkg", "lisst"], "list")])
def test_an_unknown_word_gets_the_nearest(ros2, words, name):
    error = ros2.error(*words, code=2)
    assert "invalid choice" in error
    assert error.endswith(f"\n# Did you mean '{name}'?\n")


ALL = [(command, verb) for command in COMMANDS for verb in verbs_of(command)]


@pytest.mark.parametrize(("command", "verb"), ALL)
def test_every_verb_has_its_help(capsys, command, verb):
    with pytest.raises(SystemExit) as ended:
        main([command, *([verb] if verb else []), "--help"])
    assert ended.value.code == 0
    assert re.match(rf"usage: ros2 {command}", capsys.readouterr().out)


NO_RCLPY = """
import sys
from ros2_command.registry import build
for words in {words!r}:
    build(words)
    assert 'rclpy' not in sys.modules, words
"""


def test_help_and_packages_need_no_rclpy(ros2):
    """Importing a verb, and building its parser, is quick."""
    words = [[one for one in pair if one] for pair in ALL]
    command = [sys.executable, "-c", NO_RCLPY.format(words=words)]
    subprocess.run(command, env=ros2.environment, check=True)


def interrupt():
    raise KeyboardInterrupt


def close_pipe():
    raise BrokenPipeError


def miss():
    import no_such_module

    return no_such_module


def fail():
    raise RuntimeError("text")


def test_whatever_happens_becomes_an_exit_code(capsys):
    assert guarded(interrupt) == 2
    assert guarded(close_pipe) == 0
    assert capsys.readouterr() == ("", "")
    assert guarded(miss) == 1
    assert "cannot find 'no_such_module'" in capsys.readouterr().err
    assert guarded(fail) == 1
    assert capsys.readouterr().err == "ros2: unexpected RuntimeError: text\n"


def test_a_real_ros2cli_takes_over(ros2, tmp_path):
    (tmp_path / "ros2cli").mkdir()
    (tmp_path / "ros2cli" / "__init__.py").touch()
    (tmp_path / "ros2cli" / "cli.py").write_text("def main(argv=None):\n    print('real')\n")
    path = f"{tmp_path}:{ros2.environment['PYTHONPATH']}"
    assert ros2.out("pkg", "list", PYTHONPATH=path) == "real\n"


@pytest.mark.parametrize(
    ("tail", "code", "said"),
    [
        ("pkg list >/dev/full", 1, "ros2: No space left on device\n"),
        (
            "pkg create --build-type ament_python p",
            1,
            "This terminal's current folder no longer exists",
        ),
    ],
)
def test_disks_that_are_full_and_folders_that_are_gone(ros2, tmp_path, tail, code, said):
    command = " ".join(ros2.words())
    gone = f"mkdir gone; cd gone; rmdir ../gone; {command} {tail}"
    done = subprocess.run(
        ["bash", "-c", gone], env=ros2.environment, cwd=tmp_path,
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == code
    assert done.stderr.startswith(said)
    assert "unexpected" not in done.stderr
    assert "Traceback" not in done.stderr


def test_every_verb_knows_every_option_of_the_original():
    here = {" ".join(filter(None, one)): options(*one) for one in verbs()}
    assert here.keys() == UPSTREAM.keys()
    for name, known in here.items():
        assert set(UPSTREAM[name].split()) <= known.keys(), name


def test_the_readme_has_the_table():
    """Print it anew with `python tests/ros2_command/readme_table.py`."""
    assert f"\n{table()}\n" in (SOURCE / "README.md").read_text(encoding="utf-8")


def test_the_nearest_name():
    assert nearest("Temprature", ["/humidity", "Temperature"]) == "Temperature"
    assert nearest("temperature", ["/robot/left/arm/temperature"]) == "/robot/left/arm/temperature"
    assert nearest("xyz", ["abc"]) is None
    assert nearest("std_msgs/msg/Nope", ["std_msgs/msg/Int8"]) is None
    assert nearest("std_msgs/msg/Flot32", ["std_msgs/msg/Int8", "std_msgs/msg/Float32"])[-7:] == (
        "Float32"
    )


def test_names():
    assert [is_hidden(name) for name in ("/a/b_", "/a/_b/c", "/_x")] == [False, True, True]
    assert (full_name("a", "/"), full_name("a", "/b")) == ("/a", "/b/a")
    check_name("topic", "~/a/b_1")
    for name in ("", "a//b", "a/", "1a", "a b", "/a/2"):
        with pytest.raises(CommandError):
            check_name("topic", name)
