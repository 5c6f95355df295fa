import errno
from pathlib import PurePosixPath

import pytest

from rosbeat.workspace import keeping
from rosbeat.workspace.keeping import keep

PATH = PurePosixPath("src/p/setup.py")


def test_copies_are_numbered(root):
    assert [str(keep(PATH, content, root)) for content in (b"a", b"b", b"a")] == [
        "kept/src/p/setup.py-1",
        "kept/src/p/setup.py-2",
        "kept/src/p/setup.py-1",
    ]


def test_nothing_takes_a_copy_for_code(root):
    copy = root / keep(PurePosixPath("src/p/test/test_a.py"), b"assert False", root)
    assert copy.suffix != ".py"
    assert (root / "kept" / "COLCON_IGNORE").is_file()


def test_half_a_copy_is_removed(root, monkeypatch):
    def full(*_):
        raise OSError(errno.ENOSPC, "full")

    monkeypatch.setattr(keeping.os, "fdopen", full)
    with pytest.raises(OSError, match="full"):
        keep(PATH, b"a", root)
    assert list((root / "kept/src/p").iterdir()) == []
