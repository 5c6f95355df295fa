import errno
import os
import stat
import threading
from concurrent import futures

import pytest

from rosbeat.errors import WorkspaceError
from rosbeat.workspace import saving
from rosbeat.workspace.saving import only_writer, save, save_bytes


def inside(root):
    return sorted(str(one.relative_to(root)) for one in root.rglob("*") if one.is_file())


def refuse(code):
    def fail(*_, **__):
        raise OSError(code, os.strerror(code))

    return fail


@pytest.mark.parametrize(
    "typed", ["src/a.py", " src/a.py ", "'src/a.py'", "./src/a.py", "src//a.py"]
)
def test_one_file_written_in_many_ways(root, typed):
    save(typed, "x", root)
    assert inside(root) == ["src/a.py"]


def test_a_new_file_with_its_folders(root):
    saved = save("docs/notes/first.md", "hello", root)
    assert str(saved) == "saved docs/notes/first.md"
    assert (root / "docs/notes/first.md").read_text() == "hello\n"
    assert inside(root) == ["docs/notes/first.md"]


def test_the_learner_s_workspace_is_meant_if_none_is_named(root):
    save("docs/a.md", "x")
    assert (root / "docs/a.md").exists()


def test_a_new_file_has_the_usual_rights(root):
    (root / "usual").write_text("")
    save("docs/a.md", "x", root)
    assert (root / "docs/a.md").stat().st_mode == (root / "usual").stat().st_mode


def test_the_version_before_is_kept_and_named(root):
    save("src/a.py", "x = 1", root)
    saved = save("src/a.py", "x = 2", root)
    assert str(saved) == "saved src/a.py (the version before is in kept/src/a.py-1)"
    assert (root / "kept/src/a.py-1").read_text() == "x = 1\n"
    assert (root / "src/a.py").read_text() == "x = 2\n"
    assert (root / "kept/COLCON_IGNORE").exists()


def test_the_same_text_again_touches_nothing(root):
    save("src/a.py", "x = 1", root)
    before = (root / "src/a.py").stat()
    saved = save("src/a.py", "x = 1\n", root)
    assert str(saved) == "saved src/a.py"
    assert not saved.changed
    assert (root / "src/a.py").stat() == before
    assert inside(root) == ["src/a.py"]


def test_one_content_is_kept_once(root):
    for text in ("a", "b", "a", "b", "c"):
        save("src/a.py", text, root)
    assert inside(root / "kept") == ["COLCON_IGNORE", "src/a.py-1", "src/a.py-2"]
    assert (root / "src/a.py").read_text() == "c\n"


def test_an_empty_file_is_no_work_to_keep(root):
    (root / "src/__init__.py").write_text("\n")
    assert save("src/__init__.py", "x = 1", root).kept is None


def test_what_is_no_text_is_kept_byte_for_byte(root):
    (root / "src/a.py").write_bytes(b"\xff\x00\r\n")
    save("src/a.py", "x", root)
    assert (root / "kept/src/a.py-1").read_bytes() == b"\xff\x00\r\n"


def test_the_right_to_run_stays(root):
    save("scripts/a.py", "x", root)
    (root / "scripts/a.py").chmod(0o750)
    save("scripts/a.py", "y", root)
    assert stat.S_IMODE((root / "scripts/a.py").stat().st_mode) == 0o750


@pytest.mark.parametrize(
    "path",
    ["../a.py", "/etc/passwd", "~/a.py", "src/../../a.py", "src/out/a.py", "out.py", "", " ",
     "src/", "a\0b", "loop/a.py", "install/a.py", "kept/a.py", "ROS2_and_RL_Tutorials/src/a.py",
     "."],
)  # fmt: skip
def test_no_way_out_and_nothing_that_is_not_a_file(root, says, path):
    outside = root.parent / "outside"
    outside.mkdir()
    (outside / "b.py").write_text("theirs")
    (root / "src/out").symlink_to(outside)
    (root / "out.py").symlink_to(outside / "b.py")
    (root / "loop").symlink_to(root / "loop")
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


@pytest.mark.parametrize("make", [os.mkdir, os.mkfifo])
def test_what_is_no_file_stays(root, says, make):
    make(root / "src/a.py")
    with pytest.raises(WorkspaceError) as caught:
        save("src/a.py", "x", root)
    says(caught.value, "src/a.py")


def test_a_file_where_a_folder_has_to_be(root, says):
    save("src/a", "x", root)
    with pytest.raises(WorkspaceError) as caught:
        save("src/a/b.py", "x", root)
    says(caught.value, "in the way")


def test_a_write_protected_file_stays(root, says, monkeypatch):
    save("src/a.py", "x", root)
    monkeypatch.setattr(saving.os, "access", lambda *_: False)
    with pytest.raises(WorkspaceError) as caught:
        save("src/a.py", "y", root)
    says(caught.value, "chmod u+w")
    assert (root / "src/a.py").read_text() == "x\n"


@pytest.mark.parametrize(
    ("code", "text"), [(errno.EACCES, "read-only"), (errno.ENOSPC, "full"), (errno.EIO, "refused")]
)
@pytest.mark.parametrize("call", ["open", "replace", "fdopen"])
def test_what_the_system_refuses_changes_nothing(root, says, monkeypatch, code, text, call):
    save("src/a.py", "x", root)
    with monkeypatch.context() as patch:
        patch.setattr(saving.os, call, refuse(code))
        with pytest.raises(WorkspaceError) as caught:
            save("src/a.py", "y", root)
    says(caught.value, "src/a.py cannot be saved", text)
    assert (root / "src/a.py").read_text() == "x\n"
    assert [one for one in inside(root / "src") if one != "a.py"] == []


def test_half_a_character_is_explained(root, says):
    with pytest.raises(WorkspaceError) as caught:
        save("src/a.py", "x = 1\ny = '\ud800'\n", root)
    says(caught.value, "line 2")
    assert inside(root) == []


def test_many_at_once_leave_one_whole_file(root):
    save("src/a.py", "first", root)
    texts = [f"text {number}" for number in range(8)]
    threads = [threading.Thread(target=save, args=("src/a.py", text, root)) for text in texts]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert (root / "src/a.py").read_text().strip() in texts
    kept = {one.read_text().strip() for one in (root / "kept/src").iterdir()}
    assert "first" in kept


def test_exact_bytes(root):
    save_bytes("docs/a.txt", b"a\r\n\xe9", root)
    assert (root / "docs/a.txt").read_bytes() == b"a\r\n\xe9"


def test_two_pages_that_save_one_file_lose_no_version(root):
    texts = [f"version {number}\n" for number in range(24)]
    with futures.ThreadPoolExecutor(4) as pages:
        list(pages.map(lambda text: save("src/a.py", text, root), texts))
    kept = [one.read_text() for one in (root / "kept/src").iterdir()]
    assert sorted([*kept, (root / "src/a.py").read_text()]) == sorted(texts)


def test_one_waits_for_the_other(root):
    with futures.ThreadPoolExecutor(1) as page:
        with only_writer(root):
            other = page.submit(save, "src/a.py", "x\n", root)
            with pytest.raises(futures.TimeoutError):
                other.result(0.05)
            assert not (root / "src/a.py").exists()
        assert other.result(60).changed
