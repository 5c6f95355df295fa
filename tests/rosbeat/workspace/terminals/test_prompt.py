from pathlib import Path

import pytest

from rosbeat.workspace.terminals.prompt import prompt


@pytest.mark.parametrize(
    ("folder", "parent", "shown"),
    [
        ("/home/a", "/home/a", "~$ "),
        ("/home/a/course", "/home/a/course", "course$ "),
        ("/home/a/course/ws/src", "/home/a/course", "ws/src$ "),
        ("/home/a/ws/src", "/home/a", "ws/src$ "),
        ("/home/a/other", "/home/a/course", "~/other$ "),
        ("/home/ab", "/home/a/course", "/home/ab$ "),
        ("/", "/", "/$ "),
        ("/usr", "/home/a/course", "/usr$ "),
    ],
)
def test_folders_are_named_from_the_workspace(folder, parent, shown):
    assert prompt(Path(folder), Path(parent), Path("/home/a")) == shown
