from pathlib import Path

import pytest

from rosbeat.workspace.meanings.folders import near, way_to

NO_FILE = "No such file or directory"


def mkdir(path, why=NO_FILE):
    return f"mkdir: cannot create directory ‘{path}’: {why}\n"


@pytest.mark.parametrize(
    ("command", "output", "text"),
    [
        ("mkdir /Documents/ROS2_and_RL_Tutorials/", mkdir("/Documents/ROS2_and_RL_Tutorials/"),
         "mkdir -p ~/Documents/ROS2_and_RL_Tutorials/"),
        ("mkdir /Documents", mkdir("/Documents", "Permission denied"), "mkdir -p ~/Documents"),
        ("mkdir a/b", mkdir("a/b"), "With -p"),
        ("mkdir src", mkdir("src", "File exists"), "there already"),
        ("cd scr", f"bash: line 1: cd: scr: {NO_FILE}", "Did you mean src?"),
        ("cd nothing_like_it", f"bash: cd: nothing_like_it: {NO_FILE}", "`pwd`"),
        ("cd../../src", f"bash: cd../../src: {NO_FILE}", "write  cd ../../src"),
        ("cd..", "bash: cd..: command not found", "A blank is missing after `cd`"),
    ],
)  # fmt: skip
def test_what_the_shell_complains_about(meaning, command, output, text):
    assert text in meaning(command, output)


@pytest.mark.parametrize(
    "output",
    [
        mkdir("src", "File exists"),
        mkdir("/Documents"),
        f"bash: cd: /Documents/x: {NO_FILE}",
        f"bash: cd: scr: {NO_FILE}",
        "bash: cd..: command not found",
    ],
)
def test_a_complaint_that_is_only_read(meaning, output):
    assert meaning("cat log.txt", output, 0) is None
    assert meaning("mkdir a; cd src", f"log: {output}") is None


@pytest.mark.parametrize("path", ["/etc/a/b", "/tmp/a/b", "/home/you/a/b"])
def test_only_what_is_not_at_the_top_is_taken_for_one_s_own_folder(meaning, path):
    assert "~" not in meaning(f"mkdir {path}", mkdir(path))


def test_a_folder_of_one_s_own_is_not_the_top_of_the_disk(meaning, root):
    path = f"{root}/a/b"
    assert "With -p" in meaning(f"mkdir {path}", mkdir(path))


def test_cd_to_the_top_proposes_what_there_is(meaning, root):
    output = f"bash: cd: /Documents/my x: {NO_FILE}"
    assert "cd ~" not in meaning("cd '/Documents/my x'", output)
    (root.parent / "Documents" / "my x").mkdir(parents=True)
    assert meaning("cd '/Documents/my x'", output).endswith("cd ~/'Documents/my x'")


def test_cd_to_a_workspace_that_lies_elsewhere(meaning):
    path = "/home/you/Documents/ROS2_and_RL_Tutorials/src"
    said = meaning("cd ~/Documents/ROS2_and_RL_Tutorials/src", f"bash: cd: {path}: {NO_FILE}")
    assert said.endswith('cd "$ROS2_WORKSPACE"/src')


def test_cd_into_a_workspace_proposes_no_folder_that_is_not_there(meaning, root):
    output = f"bash: cd: ROS2_and_RL_Tutorials/srk: {NO_FILE}"
    said = meaning("cd ROS2_and_RL_Tutorials/srk", output, folder=root.parent)
    assert said.endswith('cd "$ROS2_WORKSPACE"/src')
    output = output.replace("srk", "xyz")
    said = meaning("cd ROS2_and_RL_Tutorials/xyz", output, folder=root.parent)
    assert said.endswith('cd "$ROS2_WORKSPACE"')


def test_a_file_is_not_proposed_for_cd(meaning, root):
    (root / "srk").touch()
    assert "Did you mean" not in meaning("cd srkk", f"bash: cd: srkk: {NO_FILE}", folder=root)


def test_a_whole_path_has_nothing_to_do_with_here(meaning, root):
    path = f"{root.parent}/xyz"
    said = meaning(f"cd {path}", f"bash: cd: {path}: {NO_FILE}")
    assert "where this terminal is" not in said


def test_a_name_with_a_blank_is_quoted(meaning, root):
    (root / "my folder").mkdir()
    said = meaning("cd 'my foldr'", f"bash: cd: my foldr: {NO_FILE}")
    assert "Did you mean 'my folder'?" in said
    assert way_to("my folder") == "cd \"$ROS2_WORKSPACE\"/'my folder'"
    assert way_to() == way_to(".") == 'cd "$ROS2_WORKSPACE"'


def test_the_folder_of_the_terminal_has_gone(meaning, root):
    output = "Traceback (most recent call last):\nFileNotFoundError: [Errno 2] No such file\n"
    said = meaning("colcon build", output, 1, root / "gone")
    assert "does not exist any more" in said
    assert 'cd "$ROS2_WORKSPACE"' in said
    assert meaning("cd ..", "", 0, root / "gone") is None
    assert meaning("cd .. && false", "", 1, root / "gone") is None
    output = "colcon: error: argument verb_name: invalid choice: 'build' (choose from 'info')"
    said = meaning("colcon build | tail -2", output, 0, root / "gone")
    assert "does not exist any more" in said
    root.joinpath("src").rmdir()
    root.rmdir()
    assert meaning("colcon build", output, 1, root / "gone").endswith("Go to another: `cd`")


def test_a_new_folder_has_the_name_of_the_one_that_has_gone(meaning, root):
    output = (
        "Traceback (most recent call last):\n    path = os.getcwd()\n"
        "FileNotFoundError: [Errno 2] No such file or directory\n"
    )
    assert "does not exist any more" in meaning("colcon build", output)


def test_the_nearest_of_what_is_there(root):
    (root / "srt").touch()
    assert near(root, "srcc", folders=True) == "src"
    assert near(root, "nowhere/srcc") is None
    assert Path(near(root, "./srrt")).name == "srt"
