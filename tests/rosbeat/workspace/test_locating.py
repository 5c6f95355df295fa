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


def test_the_nearest_name():
    assert nearest("Sensor_Simulatr", ["sensor_simulator", "rclpy"]) == "sensor_simulator"
    assert nearest("xyz", ["sensor_simulator"]) is None
