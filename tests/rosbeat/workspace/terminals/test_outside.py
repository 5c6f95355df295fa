import pytest

from rosbeat.workspace.terminals.outside import builds_outside


@pytest.fixture
def folders(tmp_path):
    """The learner's workspace in a checkout that holds a package, and a workspace of their own."""
    for package in ("course/src/command", "mine/src/robots/arm"):
        (tmp_path / package).mkdir(parents=True)
        (tmp_path / package / "package.xml").touch()
    for folder in ("course/ws/src/deep", "course/notebooks", "other/src/empty"):
        (tmp_path / folder).mkdir(parents=True)
    return tmp_path


@pytest.mark.parametrize(
    "command", ["colcon build", "  colcon  test --event-handlers x", "colcon build;ls"]
)
@pytest.mark.parametrize(
    ("folder", "outside"),
    [
        ("course/ws", False),
        ("course/ws/src/deep", False),
        ("course/ws/gone", False),
        ("course", True),
        ("course/notebooks", True),
        (".", True),
        ("other", True),
        ("/", True),
        ("mine", False),
        ("mine/src/robots", False),
    ],
)
def test_colcon_builds_in_a_workspace_only(folders, command, folder, outside):
    assert builds_outside(command, folders / folder, folders / "course/ws") is outside


@pytest.mark.parametrize(
    "command",
    [
        "colcon build --base-paths src",
        "colcon build --paths=src/a",
        "colcon build --help",
        "colcon build -h",
        "colcon test-result --verbose",
        "colcon --help",
        "colcon",
        "cd x && colcon build",
        "echo colcon build",
        "",
    ],
)
def test_other_commands_are_nobody_s_business(folders, command):
    assert not builds_outside(command, folders, folders / "course/ws")


@pytest.mark.parametrize(
    "command", ["colcon --log-base l build", "colcon build && x --base-paths y"]
)
def test_options_of_others_do_not_hide_a_build(folders, command):
    assert builds_outside(command, folders, folders / "course/ws")


def test_a_link_into_the_workspace_is_inside(folders):
    (folders / "link").symlink_to(folders / "course/ws")
    assert not builds_outside("colcon build", folders / "link", folders / "course/ws")


def test_a_terminal_types_no_build_outside(seen, terminal, home):
    shown = seen("mkdir a; cd a\ncolcon build\necho never")
    assert shown[1].startswith("# nothing was typed: the terminal is in `a`, which is outside")
    assert shown[-2].endswith("Page 01 makes the workspace.")
    assert shown[-1] == "# 1 more line in the cell, not typed"
    assert terminal.command == "mkdir a; cd a"
    (home / "ROS2_and_RL_Tutorials").mkdir()
    assert 'cd "$ROS2_WORKSPACE"' in " ".join(seen("colcon test", until="x"))
    assert seen('cd "$ROS2_WORKSPACE"\ncolcon build --help > /dev/null') == [
        'a$ cd "$ROS2_WORKSPACE"',
        "ROS2_and_RL_Tutorials$ colcon build --help > /dev/null",
    ]
