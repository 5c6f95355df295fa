"""The folder of results."""

import pytest

from rosbeat.errors import GradingError
from rosbeat.grading.output import require_folder


def test_a_folder_need_not_be_there_yet(tmp_path):
    require_folder(tmp_path)
    require_folder(tmp_path / "a/b/c")
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("name", ["points.csv", "points.csv/grades"])
def test_a_file_is_no_folder(tmp_path, name, says):
    (tmp_path / "points.csv").write_text("mine")
    with pytest.raises(GradingError) as caught:
        require_folder(tmp_path / name)
    says(caught.value, "points.csv is a file, not a folder", "--out ~/class/grades")
    assert (tmp_path / "points.csv").read_text() == "mine"
