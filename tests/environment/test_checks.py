import errno
import importlib.util
import shutil
import sys
import tempfile
from types import SimpleNamespace

import pytest

from course_tool import checks
from course_tool.messages import Problem

HERE = "{}.{}".format(*sys.version_info[:2])


@pytest.mark.parametrize("version", ["2.28", "2.36", "2.41", "3.0"])
def test_new_enough_c_libraries(version):
    checks.check_libc(version)


@pytest.mark.parametrize(
    ("version", "words"), [("2.27", "glibc 2.27"), ("", "another C library than glibc")]
)
def test_unfit_c_libraries(version, words):
    with pytest.raises(Problem) as caught:
        checks.check_libc(version)
    assert words in caught.value.happened
    assert "Dockerfile" in caught.value.cure


def test_this_machine_is_read(monkeypatch):
    monkeypatch.setattr("os.confstr", lambda name: "glibc 2.36")
    assert checks.glibc_version() == "2.36"


@pytest.mark.parametrize("answer", [None, ValueError("unrecognized configuration name")])
def test_a_machine_without_glibc_is_read(monkeypatch, answer):
    def confstr(name):
        if answer is not None:
            raise answer

    monkeypatch.setattr("os.confstr", confstr)
    assert checks.glibc_version() == ""


def test_a_complete_python():
    checks.check_venv_module()


@pytest.mark.parametrize("missing", ["venv", "ensurepip"])
def test_an_incomplete_python_gets_the_right_apt_line(monkeypatch, missing):
    find = importlib.util.find_spec
    monkeypatch.setattr(
        importlib.util, "find_spec", lambda name: None if name == missing else find(name)
    )
    with pytest.raises(Problem) as caught:
        checks.check_venv_module()
    assert f"sudo apt install python{HERE}-venv" in caught.value.cure


def test_a_folder_of_ones_own(tmp_path):
    checks.check_writable(tmp_path)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("number", "words"),
    [
        (errno.EACCES, "Nothing can be written"),
        (errno.EROFS, "Nothing can be written"),
        (errno.ENOSPC, "not enough room on the disk"),
    ],
)
def test_a_folder_that_cannot_be_written_to(monkeypatch, tmp_path, number, words):
    def refuse(dir):
        raise OSError(number, "no")

    monkeypatch.setattr(tempfile, "TemporaryFile", refuse)
    with pytest.raises(Problem) as caught:
        checks.check_writable(tmp_path)
    assert words in caught.value.happened


def test_a_disk_with_room(tmp_path):
    checks.check_space(tmp_path, 1)


def test_a_full_disk_is_said_before_it_is_filled(monkeypatch, tmp_path):
    monkeypatch.setattr(shutil, "disk_usage", lambda folder: SimpleNamespace(free=400_000_000))
    with pytest.raises(Problem) as caught:
        checks.check_space(tmp_path, checks.FIRST_TIME)
    assert "0.4 GB free, 1.5 needed" in caught.value.happened


def test_a_refresh_needs_less_room_than_a_first_start(monkeypatch, layout):
    asked = []
    monkeypatch.setattr(checks, "check_space", lambda folder, needed: asked.append(needed))
    checks.before_installing(layout)
    layout.uv.parent.mkdir(parents=True)
    layout.uv.touch()
    checks.before_installing(layout)
    assert asked == [checks.FIRST_TIME, checks.REFRESH]
