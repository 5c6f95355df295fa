"""The files of an upload, from folders and hostile zip files."""

import os
import stat
import zipfile
from io import BytesIO

import pytest

from grading_files import zipped
from rosbeat.errors import GradingError
from rosbeat.grading import entries
from rosbeat.grading.entries import list_files


def paths(listing):
    return [one.path for one in listing.entries]


def abouts(listing):
    return [one.about for one in listing.remarks]


def archive(tmp_path, data, name="all.zip"):
    path = tmp_path / name
    path.write_bytes(data)
    return path


def test_a_folder_and_a_zip_file_give_the_same(handed_in, tmp_path):
    files = {"ana/03.ipynb": "a", "ben/deep/03.ipynb": "b", "notes.txt": "c"}
    listing = list_files(handed_in(files))
    packed = list_files(archive(tmp_path, zipped(files)))
    assert paths(listing) == paths(packed) == sorted(files)
    assert [one.read() for one in listing.entries] == [one.read() for one in packed.entries]
    assert [one.size for one in packed.entries] == [1, 1, 1]
    assert listing.remarks == packed.remarks == ()


def test_zip_files_in_a_folder_and_in_a_zip_file_are_opened(handed_in, tmp_path):
    inner = zipped({"03.ipynb": "a", "more/04.ipynb": "b"})
    wanted = ["ana/03.ipynb", "ana/more/04.ipynb"]
    assert paths(list_files(handed_in({"ana.zip": inner}))) == wanted
    assert paths(list_files(archive(tmp_path, zipped({"ana.ZIP": inner})))) == wanted


def test_a_third_level_is_refused(tmp_path):
    deep = zipped({"c.zip": zipped({"x": "x"})})
    listing = list_files(archive(tmp_path, zipped({"a.zip": zipped({"b.zip": deep})})))
    assert paths(listing) == []
    assert abouts(listing) == ["refused"]


def test_what_computers_add_is_left_out(handed_in, tmp_path):
    files = {
        "__MACOSX/ana/._03.ipynb": "x",
        "ana/.DS_Store": "x",
        "ana/.ipynb_checkpoints/03-checkpoint.ipynb": "x",
        "ana/03.ipynb": "x",
    }
    assert paths(list_files(handed_in(files))) == ["ana/03.ipynb"]
    assert paths(list_files(archive(tmp_path, zipped(files)))) == ["ana/03.ipynb"]


@pytest.mark.parametrize("name", ["../../etc/passwd", "/etc/passwd", "C:/x", "a/../../b", "..\\x"])
def test_paths_that_lead_elsewhere_are_refused(name, tmp_path):
    listing = list_files(archive(tmp_path, zipped({name: "x", "ana/03.ipynb": "y"})))
    assert paths(listing) == ["ana/03.ipynb"]
    assert abouts(listing) == ["refused"]


def test_links_are_not_followed(handed_in, tmp_path):
    folder = handed_in({"ana/03.ipynb": "x"})
    secret = tmp_path / "secret"
    secret.write_text("s")
    (folder / "ana/04.ipynb").symlink_to(secret)
    (folder / "ben").symlink_to(tmp_path)
    os.mkfifo(folder / "ana/pipe.ipynb")
    listing = list_files(folder)
    assert paths(listing) == ["ana/03.ipynb"]
    assert abouts(listing) == ["refused", "refused"]

    link = zipfile.ZipInfo("ana/05.ipynb")
    link.external_attr = (stat.S_IFLNK | 0o777) << 16
    buffer = BytesIO()
    with zipfile.ZipFile(buffer, "w") as made:
        made.writestr(link, "/etc/passwd")
    listing = list_files(archive(tmp_path, buffer.getvalue()))
    assert (paths(listing), abouts(listing)) == ([], ["refused"])


def test_a_zip_bomb_is_not_unpacked(tmp_path):
    bomb = zipped({"ana/03.ipynb": "0" * 50_000_000, "ben/03.ipynb": "fine"})
    listing = list_files(archive(tmp_path, bomb))
    assert paths(listing) == ["ben/03.ipynb"]
    assert "grow" in listing.remarks[0].text


def test_too_many_and_too_large_files_are_refused(tmp_path, monkeypatch):
    monkeypatch.setattr(entries, "MOST_FILES", 3)
    listing = list_files(archive(tmp_path, zipped({f"{n}/x": "x" for n in range(4)})))
    assert (paths(listing), abouts(listing)) == ([], ["too-large"])
    monkeypatch.setattr(entries, "MOST_OF_A_ZIP", 10)
    listing = list_files(archive(tmp_path, zipped({"a/x": "x" * 11, "b/x": "x"})))
    assert (paths(listing), abouts(listing)) == (["b/x"], ["too-large"])


def test_a_broken_zip_file_is_told_and_costs_no_other(handed_in):
    half = zipped({"03.ipynb": "x" * 1000})[:50]
    listing = list_files(handed_in({"ana.zip": half, "ben/03.ipynb": "x"}))
    assert paths(listing) == ["ben/03.ipynb"]
    assert abouts(listing) == ["unreadable"]


def test_a_member_that_was_damaged_is_an_error_when_it_is_read(tmp_path):
    data = bytearray(zipped({"ana/03.ipynb": os.urandom(300)}))
    data[60] ^= 0xFF
    (entry,) = list_files(archive(tmp_path, bytes(data))).entries
    with pytest.raises(OSError, match="unpacked"):
        entry.read()


def test_what_is_no_upload_is_refused(tmp_path, says):
    with pytest.raises(GradingError) as caught:
        list_files(tmp_path / "nothing")
    says(caught.value, "is not there", "zip file")
    with pytest.raises(GradingError, match="no zip file"):
        list_files(archive(tmp_path, b"hello", "class.rar"))
