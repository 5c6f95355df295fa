import pytest

from rosbeat.workspace.situation import Situation


@pytest.fixture
def calls(root):
    def calls(command, folder=None):
        seen = Situation(command, "", 0, folder or root, root)
        return [(" ".join(one.words), one.place) for one in seen.calls]

    return calls


def test_lines_and_signs_between_commands(calls, root):
    found = calls("cd src && ls -l; pwd\necho 'a; b' | cat")
    src = root / "src"
    assert found == [
        ("cd src", root),
        ("ls -l", src),
        ("pwd", src),
        ("echo a; b", src),
        ("cat", src),
    ]


def test_a_line_that_goes_on(calls, root):
    assert calls("ros2 pkg create \\\n  --build-type ament_python a") == [
        ("ros2 pkg create --build-type ament_python a", root)
    ]


def test_where_cd_leads(calls, root, tmp_path):
    assert calls("cd ~/ROS2_and_RL_Tutorials/src\nls", tmp_path)[1][1] == root / "src"
    assert calls("cd\nls")[1][1] == tmp_path
    assert calls("cd nowhere\nls")[1][1] == root
    assert calls("cd ..\nls", root / "src")[1][1] == root


def test_a_quote_that_is_not_closed(calls, root):
    assert calls("echo 'a b") == [("echo 'a b", root)]


def test_colours_and_quotes_do_not_count(root):
    seen = Situation("", "\x1b[31mno ‘a’\x1b[0m\r\n", 1, root, root)
    assert seen.text == "no 'a'\n"


def test_a_workspace_that_is_not_there(tmp_path):
    assert Situation("colcon build", "", 0, tmp_path, tmp_path / "none").packages == ()


def test_cd_by_the_variable_of_the_workspace(calls, root):
    for name in ('"$ROS2_WORKSPACE"', "${ROS2_WORKSPACE}"):
        assert calls(f"cd {name}/src && ls", root.parent)[1][1] == root / "src"


def test_settings_in_front_of_a_program(calls):
    assert [one for one, _ in calls("A=1 B=2 ros2 run a b; C=3 cd")] == ["ros2 run a b", "cd"]
    assert calls("timeout -s INT 5 ros2 run a b")[0][0] == "ros2 run a b"
    assert [calls(one)[0][0] for one in ("timeout", "A=1", "timeout 5")] == [
        "timeout",
        "A=1",
        "timeout 5",
    ]


def test_out_of_a_folder_that_has_gone(calls, root):
    assert calls("cd .. && ls", root / "gone")[1][1] == root


def test_a_traceback_belongs_to_a_program_that_ran(root):
    output = "before\nTraceback (most recent call last):\nError: rclpy\n"
    seen = [Situation(command, output, 1, root, root) for command in ("cat a.py", "./a.py", "ls")]
    assert [bool(one.traceback) for one in seen] == [False, True, False]
    assert [one.about_ros for one in seen] == [False, True, False]
