import pytest

from rosbeat.errors import WorkspaceError
from rosbeat.workspace.locating import locate, nearest


@pytest.mark.parametrize(
    "typed", ["src/a.py", " src/a.py ", "'src/a.py'", "./src/a.py", "src//a.py"]
)
def test_one_file_written_in_many_ways(root, typed):
    relative, target = locate(typed, root)
    assert str(relative) == "src/a.py"
    assert target == root / "src/a.py"


def test_the_workspace_twice_is_mended_in_the_message(root):
    with pytest.raises(WorkspaceError, match=r"Leave the first part out:  src/a\.py"):
        locate("ROS2_and_RL_Tutorials/src/a.py", root)


def test_a_link_to_a_folder_that_is_not_for_files(root):
    (root / "kept").mkdir()
    (root / "lkept").symlink_to("kept")
    with pytest.raises(WorkspaceError, match="kept is not for files of yours"):
        locate("lkept/a.py", root)


@pytest.mark.parametrize("typed", ["src/a.py # mine", "src\\a.py"])
def test_more_than_a_path(root, typed):
    with pytest.raises(WorkspaceError) as caught:
        locate(typed, root)
    assert "src/a.py" in caught.value.to_try


def test_the_nearest_name():
    assert nearest("Sensor_Simulatr", ["sensor_simulator", "rclpy"]) == "sensor_simulator"
    assert nearest("xyz", ["sensor_simulator"]) is None
    assert nearest("screen", ["tree"]) == "tree"
    assert nearest("screen", ["tree"], 0.75) is None
