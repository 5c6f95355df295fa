import errno

import pytest

from rosbeat.errors import WorkspaceError
from rosbeat.workspace import catch_up, catching_up
from rosbeat.workspace.packages import read_package
from rosbeat.workspace.stages import NODES, PACKAGE, finished


@pytest.mark.timeout(300)  # a build, while other tests keep the machine busy
def test_the_whole_course_from_nothing_and_it_can_be_built(root, capsys):
    report = catch_up("07")
    assert report.complete
    assert [one.split("(")[1][:7] for one in report.made] == [
        f"page 0{page}" for page in range(1, 7)
    ]
    found = read_package(root / "src" / PACKAGE, root)
    assert found.installed.executables == NODES
    assert found.installed.changed == ()
    assert found.flaws == ()
    assert "Building" in capsys.readouterr().out
    assert repr(catch_up("07")) == "Everything this page needs is there."
    assert capsys.readouterr().out == ""


def test_only_what_comes_before_the_page(root):
    assert catch_up("01").made == ()
    (made,) = catch_up("02").made
    assert made.endswith("(page 01)")
    assert list((root / "src").iterdir()) == []


def test_what_is_there_stays(root, package):
    mine = package / PACKAGE / f"{NODES[0]}.py"
    mine.write_text("mine\n")
    (package / PACKAGE / f"{NODES[1]}.py").unlink()
    report = catch_up("05")
    assert any(NODES[1] in one for one in report.made)
    assert mine.read_text() == "mine\n"
    assert (package / "setup.py").read_text() == finished("setup.py")


def test_what_stands_in_the_way_ends_it_and_is_said(root):
    (root / "src" / PACKAGE).mkdir()
    report = catch_up("06")
    assert not report.complete
    assert "rmdir" in repr(report)
    assert not (root / "src" / PACKAGE / PACKAGE).exists()


@pytest.mark.parametrize("page", ["05", "5", 5, "05_set_entry_points", "05_set_entry_points.ipynb"])
def test_a_page_is_known_by_its_number(root, package, page):
    assert catch_up(page).complete


@pytest.mark.parametrize("page", ["", "setup", "-1", "5.5", None])
def test_no_such_page(root, says, page):
    with pytest.raises(WorkspaceError) as caught:
        catch_up(page)
    says(caught.value)


def test_a_place_that_cannot_be_written(root, says, monkeypatch):
    def refuse(_):
        raise OSError(errno.EROFS, "read-only")

    monkeypatch.setattr(catching_up, "STAGES", (("01", refuse),))
    with pytest.raises(WorkspaceError) as caught:
        catch_up("05")
    says(caught.value, "workspace")


def test_a_workspace_that_does_not_exist_yet(tmp_path, monkeypatch):
    monkeypatch.setenv("ROSBEAT_STEADY_HOME", str(tmp_path / "new"))
    assert catch_up("02").complete
    assert (tmp_path / "new" / "ROS2_and_RL_Tutorials" / "resources" / "images").is_dir()
