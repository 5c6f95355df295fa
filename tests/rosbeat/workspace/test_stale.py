import pytest

from rosbeat.diagnosis.situation import StaleBuild
from rosbeat.workspace.stages import NODES, PACKAGE
from rosbeat.workspace.stale import stale_builds

PUBLISHER = f"{PACKAGE}/{NODES[0]}.py"


def edit(package, text="# more\n"):
    path = package / PUBLISHER
    path.write_text(path.read_text() + text)


def test_built_and_not_edited(root, installed):
    assert stale_builds("/temperature", root) == ()


def test_edited_since(root, package, installed):
    edit(package)
    assert stale_builds("/temperature", root) == (StaleBuild(PACKAGE, NODES[0], PUBLISHER),)
    assert stale_builds("/humidity", root) == ()


def test_never_built(root, package):
    found = stale_builds("/temperature", root)
    assert [(one.executable, one.built) for one in found] == [(node, False) for node in NODES]


@pytest.mark.parametrize("text", ["def (\n", "\0"])
def test_what_python_cannot_read_says_nothing(root, package, installed, text):
    edit(package, text)
    assert stale_builds("/temperature", root) == ()


def test_a_module_that_is_gone(root, package, installed):
    (package / PUBLISHER).unlink()
    assert stale_builds("/temperature", root) == ()


def test_the_workspace_that_the_terminal_knows(root, package, monkeypatch, tmp_path):
    monkeypatch.setenv("ROS2_WORKSPACE", str(root))
    assert len(stale_builds("/temperature")) == 2
    monkeypatch.setenv("ROS2_WORKSPACE", str(tmp_path / "none"))
    assert stale_builds("/temperature") == ()
    monkeypatch.delenv("ROS2_WORKSPACE")
    assert len(stale_builds("/temperature")) == 2
