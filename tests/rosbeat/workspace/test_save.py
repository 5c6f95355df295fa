"""`%%save`: a cell becomes a file of the workspace, which runs as a module, and no work is lost."""

import errno
import linecache
import os
import shutil
import stat
import sys
from concurrent import futures

import pytest

from rosbeat import Session
from rosbeat.errors import WorkspaceError
from rosbeat.workspace import saving
from rosbeat.workspace.prerequisites import PACKAGE, finished
from rosbeat.workspace.saving import only_writer, save

PUBLISHER = f"src/{PACKAGE}/{PACKAGE}/temperature_publisher.py"
MODULE = f"{PACKAGE}.temperature_publisher"


@pytest.fixture
def run(shell, package, capsys):
    """Run a cell; returns whether it went well, the exception, and what the page shows."""

    def run(cell):
        result = shell.run_cell(cell, store_history=True)
        return result, capsys.readouterr().out

    return run


def inside(root):
    return sorted(str(one.relative_to(root)) for one in root.rglob("*") if one.is_file())


def refuse(code):
    def fail(*_, **__):
        raise OSError(code, os.strerror(code))

    return fail


# Files.


@pytest.mark.parametrize("typed", ["src/a.py", " 'src/a.py' ", "./src//a.py"])
def test_one_file_written_in_many_ways_with_its_folders(root, typed):
    assert str(save(typed, "hello", root)) == "saved src/a.py"
    assert inside(root) == ["src/a.py"]
    save("docs/notes/first.md", "x")  # in the learner's workspace
    (root / "usual").write_text("")
    assert (root / "docs/notes/first.md").stat().st_mode == (root / "usual").stat().st_mode
    assert (root / "docs/notes/first.md").read_text() == "x\n"


def test_the_version_before_is_kept_and_named_and_each_content_once(root):
    for text in ("a", "b", "a", "b"):
        saved = save("src/a.py", text, root)
    assert str(saved) == "saved src/a.py (the previous version is in kept/src/a.py-1)"
    assert inside(root / "kept") == ["COLCON_IGNORE", "src/a.py-1", "src/a.py-2"]
    assert [(root / f"kept/src/a.py-{k}").read_text() for k in (1, 2)] == ["a\n", "b\n"]
    before = (root / "src/a.py").stat()
    again = save("src/a.py", "b\n", root)
    assert (str(again), again.changed) == ("saved src/a.py", False)
    assert (root / "src/a.py").stat() == before


def test_what_is_kept_is_kept_byte_for_byte_with_its_rights(root):
    (root / "src/a.py").write_bytes(b"\xff\x00\r\n")
    (root / "src/a.py").chmod(0o750)
    save("src/a.py", "x", root)
    assert (root / "kept/src/a.py-1").read_bytes() == b"\xff\x00\r\n"
    assert stat.S_IMODE((root / "src/a.py").stat().st_mode) == 0o750
    (root / "src/__init__.py").write_text("\n")
    assert save("src/__init__.py", "x = 1", root).kept is None  # no work to keep


@pytest.mark.parametrize(
    "path",
    ["../a.py", "/etc/passwd", "~/a.py", "src/../../a.py", "src/out/a.py", "out.py", "", " ",
     "src/", "a\0b", "install/a.py", "kept/a.py", "ROS2_and_RL_Tutorials/src/a.py",
     "."],
)  # fmt: skip
def test_no_way_out_and_nothing_that_is_not_a_file(root, says, path):
    outside = root.parent / "outside"
    outside.mkdir()
    (outside / "b.py").write_text("theirs")
    (root / "src/out").symlink_to(outside)
    (root / "out.py").symlink_to(outside / "b.py")
    before = sorted(root.parent.rglob("*"))
    with pytest.raises(WorkspaceError) as caught:
        save(path, "x", root)
    says(caught.value)
    assert sorted(root.parent.rglob("*")) == before
    assert (outside / "b.py").read_text() == "theirs"


def test_a_link_inside_the_workspace_stays_a_link(root):
    save("docs/a.md", "one", root)
    (root / "b.md").symlink_to("docs/a.md")
    save("b.md", "two", root)
    assert (root / "b.md").is_symlink()
    assert (root / "docs/a.md").read_text() == "two\n"


def test_a_folder_or_a_write_protected_file_stays(root, says, monkeypatch):
    (root / "src/b.py").mkdir()
    with pytest.raises(WorkspaceError) as caught:
        save("src/b.py", "x", root)
    says(caught.value, "src/b.py")
    save("src/a.py", "x", root)
    monkeypatch.setattr(saving.os, "access", lambda *_: False)
    with pytest.raises(WorkspaceError) as caught:
        save("src/a.py", "y", root)
    says(caught.value, "chmod u+w")
    assert (root / "src/a.py").read_text() == "x\n"


@pytest.mark.parametrize(
    ("code", "text"), [(errno.EACCES, "read-only"), (errno.ENOSPC, "full"), (errno.EIO, "refused")]
)
@pytest.mark.parametrize("call", ["open", "replace"])
def test_what_the_system_refuses_changes_nothing(root, says, monkeypatch, code, text, call):
    save("src/a.py", "x", root)
    with monkeypatch.context() as patch:
        patch.setattr(saving.os, call, refuse(code))
        with pytest.raises(WorkspaceError) as caught:
            save("src/a.py", "y", root)
    says(caught.value, "src/a.py cannot be saved", text)
    assert (root / "src/a.py").read_text() == "x\n"
    assert [one for one in inside(root / "src") if one != "a.py"] == []


def test_one_waits_for_the_other(root):
    with futures.ThreadPoolExecutor(1) as page:
        with only_writer(root):
            other = page.submit(save, "src/a.py", "x\n", root)
            with pytest.raises(futures.TimeoutError):
                other.result(0.05)
            assert not (root / "src/a.py").exists()
        assert other.result(60).changed


# A module runs.


def test_a_module_is_saved_and_runs_and_the_page_is_itself_again(run, root, shell):
    text = finished(f"{PACKAGE}/temperature_publisher.py")
    result, shown = run(f"%%save {PUBLISHER}\n{text}")
    assert result.success  # and main has not run
    assert shown == f"saved {PUBLISHER}\n"
    assert (root / PUBLISHER).read_text() == text
    assert shell.user_ns["TemperatureSensor"].__module__ == MODULE
    names = "import sys\nname, file, page = __name__, __file__, sys.modules[__name__].__dict__"
    run(f"%%save {PUBLISHER}\n{names}\nseen = page is globals()\n")
    space = shell.user_ns
    assert (space["name"], space["seen"], space["__name__"]) == (MODULE, True, "__main__")
    assert space["file"].endswith(PUBLISHER)
    assert "__file__" not in space
    assert MODULE not in sys.modules


@pytest.mark.parametrize("raises", ["raise SystemExit", "raise KeyboardInterrupt", "def"])
def test_it_is_itself_after_an_error_too(run, root, shell, raises):
    result, _ = run(f"%%save {PUBLISHER}\nx = 1\n{raises}\n")
    assert not result.success
    assert shell.user_ns["__name__"] == "__main__"
    assert MODULE not in sys.modules
    assert (root / PUBLISHER).read_text() == f"x = 1\n{raises}\n"


def test_python_works_as_in_a_file(run):
    body = (
        "from __future__ import annotations\nfrom dataclasses import dataclass\n\n@dataclass\n"
        "class Reading:\n    celsius: float\n\n__all__ = ['____init____']\n"
        'x = 7\ny = (x\n  % 2)\nz = """\n%time\n"""\n'
    )
    result, shown = run(f"%%save {PUBLISHER}\n{body}")
    assert result.success
    assert shown.startswith("saved")


@pytest.mark.parametrize(
    ("body", "later", "error", "parts"),
    [
        ("x = 1\n\nprint(missing)\n", "", "NameError",
         ["Cell In[1], line 4", "----> 4 print(missing)"]),
        ("x = 1\ndef f(:\n    pass\n", "", "SyntaxError",
         ["Cell In[1], line 3", "    def f(:"]),
        # An error in a later cell names the cell that was saved.
        ("def divide():\n    return 1 / 0\n", "divide()", "ZeroDivisionError",
         ["Cell In[1], line 3, in divide()", "----> 3     return 1 / 0"]),
    ],
)  # fmt: skip
def test_an_error_shows_the_cell_s_own_lines_and_none_of_ours(run, root, body, later, error, parts):
    result, shown = run(f"%%save {PUBLISHER}\n{body}")
    if later:
        result, shown = run(later)
    assert type(result.error_in_exec).__name__ == error
    assert [part for part in parts if part not in shown] == []
    assert not [word for word in ("rosbeat", "run_cell_magic") if word in shown]
    assert (root / PUBLISHER).read_text() == body


@pytest.mark.parametrize(
    ("cell", "parts"),
    [
        *((f"%%save {PUBLISHER}\nx = 1\n{line}\n", ["a separate cell"])
          for line in ("%time 3", "x = !ls", "print?")),
        (f"%%save {PUBLISHER}\n\n  \n", ["the cell has no text to save"]),
        *((f"%%save {line}\nx = 1\n", ["What it means", "What to try"])
          for line in ("", "src", "../a.py", f"{PUBLISHER} # my file", PUBLISHER[:9] + "\\a.py")),
        ("%%save src/sensor_simulater/a.py\nx\n", ["Did you mean sensor_simulator?"]),
        *((f"%%save {typed}\nx = 1\n", [text]) for typed, text in (
            (f"{PACKAGE}/temperature_publisher.py", f"Did you mean {PUBLISHER}?"),
            (f"src/{PACKAGE}/temperature_publisher.py", f"Did you mean {PUBLISHER}?"),
            (f"{PACKAGE}/setup.py", f"Did you mean src/{PACKAGE}/setup.py?"),
            (f"ROS2_and_RL_Tutorials/{PUBLISHER}", f"Leave out the first part:  {PUBLISHER}"),
            ("other/other/a.py", "Did you mean src/other/other/a.py?"),
            ("src/other/a.py", "Did you mean src/other/other/a.py?"),
            ("linked/a.py", "kept is not a folder for your files"))),
    ],
)  # fmt: skip
def test_what_is_not_saved_is_explained_and_nothing_changes(run, root, cell, parts):
    (root / "src" / "other" / "other").mkdir(parents=True)
    (root / "src" / "other" / "package.xml").touch()
    (root / "kept").mkdir()
    (root / "linked").symlink_to("kept")
    before, text = sorted(root.rglob("*")), (root / PUBLISHER).read_text()
    result, shown = run(cell)
    assert not result.success
    assert [part for part in parts if part not in shown] == []
    assert (sorted(root.rglob("*")), (root / PUBLISHER).read_text()) == (before, text)


def test_a_blank_is_not_saved_and_the_page_goes_on(run, root, shell):
    before = (root / PUBLISHER).read_text()
    result, shown = run(f"%%save {PUBLISHER}\ndef f():\n    return ____\n")
    assert result.success
    assert shown == (
        "not saved: there is still a blank in temperature_publisher.py, in the line `return ____`\n"
    )
    assert (root / PUBLISHER).read_text() == before
    assert "f" in shell.user_ns


# What other cells define.


def test_definitions_of_other_cells_go_below_the_imports(run, root, shell):
    run("import math\nlimit, other = 1, 2\nclass Old:\n    pass\n")
    run("def decorate(one):\n    return one\n\n@decorate\nclass Node:\n    x = 1\n")
    run("class Old:\n    y = 2")
    run("this is no Python")
    named = "Node, limit Old other"
    result, shown = run(
        f'%%save {PUBLISHER} --with {named}\n"""Say."""\nimport math\n\nx = Old.y\n'
    )
    assert result.success
    assert shown == f"saved {PUBLISHER} (the previous version is in kept/{PUBLISHER}-1)\n"
    assert (root / PUBLISHER).read_text() == (
        '"""Say."""\nimport math\n\n\n@decorate\nclass Node:\n    x = 1\n\n\nlimit, other = 1, 2'
        "\n\n\nclass Old:\n    y = 2\n\n\nx = Old.y\n"
    )
    assert shell.user_ns["x"] == 2


def test_only_the_cell_itself_runs_on_the_page(run, shell):
    run("class One:\n    pass\n")
    before = shell.user_ns["One"]
    assert run(f"%%save {PUBLISHER} --with One\nmade = One()\n")[0].success
    assert shell.user_ns["One"] is before


@pytest.mark.parametrize(
    ("cell", "parts"),
    [
        ("--with Sensr\nx = 1\n", ["no cell that has run", "Did you mean `Sensor`?"]),
        ("--with Unheard\nx = 1\n", ["`Unheard`", "Run the cell that defines it"]),
        ("--with\nx = 1\n", ["was given no name", "--with VentControl"]),
        ("--with Sensor\nx =\n", ["is not Python", "Correct the line"]),
    ],
)
def test_what_cannot_be_copied_is_explained_and_nothing_is_saved(run, root, cell, parts):
    run("class Sensor:\n    pass\n")
    before = (root / PUBLISHER).read_text()
    result, shown = run(f"%%save {PUBLISHER} {cell}")
    assert not result.success
    assert [part for part in (*parts, "What it means", "What to try") if part not in shown] == []
    assert (root / PUBLISHER).read_text() == before


@pytest.mark.parametrize("name", ["setup.py", "test/test_more.py", "package.xml"])
def test_other_files_are_only_saved(run, root, name):
    result, shown = run(f"%%save src/{PACKAGE}/{name}\nthis is = no code: at all\n")
    assert result.success
    assert shown.startswith(f"saved src/{PACKAGE}/{name}")
    assert (root / "src" / PACKAGE / name).read_text() == "this is = no code: at all\n"


@pytest.mark.parametrize(
    ("path", "name"),
    [
        (f"src/{PACKAGE}/{PACKAGE}/deep/node.py", f"{PACKAGE}.deep.node"),
        (f"src/{PACKAGE}/{PACKAGE}/__init__.py", PACKAGE),
        (f"src/{PACKAGE}/{PACKAGE}/a-b.py", None),
        (f"src/{PACKAGE}/test/test_a.py", None),
        ("scripts/a.py", None),
    ],
)
def test_which_files_are_modules(run, shell, path, name):
    assert run(f"%%save {path}\nseen = __name__\n")[0].success
    assert shell.user_ns.get("seen") == name


def test_dollars_and_braces_stay_and_what_is_there_may_be_saved_again(run, root, package):
    run("x = 'no'")
    run("%%save docs/{x}$x.md\nhello\n")
    assert (root / "docs/{x}$x.md").exists()
    (package / "tool.py").touch()
    assert run(f"%%save src/{PACKAGE}/tool.py\nx = 1\n")[0].success


def test_a_missing_package_is_made_and_that_is_said(run, root, package):
    shutil.rmtree(package)
    result, shown = run(f"%%save {PUBLISHER}\nx = 1\n")
    assert result.success
    assert "Created for you" in shown
    assert f"saved {PUBLISHER}" in shown
    assert (root / PUBLISHER).read_text() == "x = 1\n"


def test_a_package_that_is_half_made_is_not_filled(run, package):
    shutil.rmtree(package)
    package.mkdir()
    result, shown = run(f"%%save {PUBLISHER}\nx = 1\n")
    assert not result.success
    assert "is not a package" in shown
    assert list(package.iterdir()) == []


@pytest.mark.ros
def test_a_fault_of_a_saved_class_points_at_the_cell_s_line(run, shell):
    text = finished(f"{PACKAGE}/temperature_publisher.py").replace("msg.data =", "msg.value =")
    result, _ = run(f"%%save {PUBLISHER}\n{text}")
    assert result.success
    line = [number for number, one in enumerate(text.splitlines(), 2) if "msg.value" in one]
    with Session(seed=1) as ros:
        ros.add(shell.user_ns["TemperatureSensor"])
        ros.run(1, quiet=True)
        (fault,) = ros.observation().faults
    assert [fault.line] == line
    assert fault.code == "msg.value = self.temperature"
    linecache.checkcache()
