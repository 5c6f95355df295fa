import pytest

from rosbeat.workspace.meanings.situation import Situation


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
