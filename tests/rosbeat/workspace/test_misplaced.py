from pathlib import PurePosixPath

import pytest

from rosbeat.errors import WorkspaceError
from rosbeat.workspace.misplaced import refuse_other_place


@pytest.mark.parametrize(
    "path",
    [
        "docs/a.py",
        "a.py",
        "src/sensor_simulator/setup.py",
        "src/sensor_simulator/package.xml",
        "src/sensor_simulator/sensor_simulator/a.py",
        "src/sensor_simulator/test/test_a.py",
        "src/other/a.py",
        "other/a.py",
    ],
)
def test_the_right_place(root, package, path):
    refuse_other_place(PurePosixPath(path), root)


@pytest.mark.parametrize("path", ["other/other/a.py", "other/a.py", "src/other/a.py"])
def test_a_package_of_one_s_own(root, path):
    (root / "src" / "other" / "other").mkdir(parents=True)
    (root / "src" / "other" / "package.xml").touch()
    with pytest.raises(WorkspaceError, match=r"not where") as caught:
        refuse_other_place(PurePosixPath(path), root)
    assert caught.value.to_try == "Did you mean src/other/other/a.py?"


def test_what_is_there_may_be_saved_again(root, package):
    (package / "tool.py").touch()
    refuse_other_place(PurePosixPath("src/sensor_simulator/tool.py"), root)
