"""Who handed in what, in all the forms in which it may come, whole and broken."""

import errno
import io
import json
import os
import stat
import struct
import zipfile
from pathlib import Path

import pytest

from grading_files import BLANK, PAGE_03, PAGE_04, cell, notebook, zipped
from rosbeat.errors import GradingError
from rosbeat.grading import archives
from rosbeat.grading.deadlines import mark_late, read_due
from rosbeat.grading.files import printable
from rosbeat.grading.platforms import own_path
from rosbeat.grading.submissions import collect, require_apart
from rosbeat.page_runs.notebook import read_notebook, which_page

MORE_03 = json.dumps({**json.loads(PAGE_03), "cells": [*json.loads(PAGE_03)["cells"], cell("1")]})
BOTH = {"03_write.ipynb": PAGE_03, "04_listen.ipynb": PAGE_04}


def summary(found):
    return {one.learner: [page.page[:2] for page in one.pages] for one in found.submissions}


def only(found, learner):
    (one,) = [one for one in found.submissions if one.learner == learner]
    return one


def abouts(found, learner):
    return sorted(remark.about for remark in only(found, learner).remarks)


def inside(prefix, files=BOTH):
    return {prefix + name: text for name, text in files.items()}


# Forms.


@pytest.mark.parametrize(
    ("files", "learners"),
    [
        ({**inside("ana/"), **inside("ben/")}, ("ana", "ben")),
        ({**inside("class/ana/"), **inside("class/ben/")}, ("ana", "ben")),
        ({"ana.zip": zipped(BOTH), "ben.ZIP": zipped(inside("homework/"))}, ("ana", "ben")),
        ({"class/ana.zip": zipped(BOTH), "class/ben.zip": zipped(BOTH)}, ("ana", "ben")),
        ({"ana/all.zip": zipped({"more.zip": zipped(BOTH)}), **inside("ben/x/y/")}, ("ana", "ben")),
        (
            {**inside("A B_11_assignsubmission_file_/"), **inside("C_12_assignsubmission_file_")},
            ("11", "12"),
        ),
        (
            {"A B_11_assignsubmission_file_/all.zip": zipped(BOTH),
             "C_12_assignsubmission_file_x.zip": zipped(BOTH)},
            ("11", "12"),
        ),
        ({**inside("bana_21_9_"), **inside("ccy_22_8_")}, ("21", "22")),
        ({"bana_21_9_all-2.zip": zipped(BOTH), **inside("ccy_LATE_22_8_")}, ("21", "22")),
    ],
    ids=["folders", "wrapped", "zips", "wrapped zips", "zip in a zip", "moodle", "moodle zip",
         "canvas", "canvas zip"],
)  # fmt: skip
@pytest.mark.parametrize("packed", [False, True], ids=["folder", "zip"])
def test_each_form_gives_the_same_class(files, learners, packed, handed_in, pages, tmp_path):
    source = handed_in(files)
    if packed:
        source = tmp_path / "all.zip"
        source.write_bytes(zipped(files))
    found = collect(source, pages)
    assert summary(found) == {one: ["03", "04"] for one in learners}
    assert found.remarks == ()


# The homes of a hub.


def home(learner, files=BOTH):
    """What the course makes in a learner's home, and what Jupyter and the learner add."""
    own = {f"{learner}/my_course/{name}": text for name, text in files.items()}
    return {
        **own,
        f"{learner}/my_course/.rosbeat/before/03_write.ipynb": MORE_03,
        f"{learner}/my_course/solutions/03_write.ipynb": MORE_03,
        f"{learner}/my_course/03_write-Copy1.ipynb": MORE_03,
        f"{learner}/my_course/00_x_4711_assignsubmission_file_03.ipynb": MORE_03,
        f"{learner}/03_write.ipynb": MORE_03,
        f"{learner}/.bashrc": "",
    }


def test_the_homes_of_a_hub_are_a_class(handed_in, pages):
    found = collect(handed_in({**home("ana"), **home("ben"), **home("cy", {})}), pages)
    assert summary(found) == {"ana": ["03", "04"], "ben": ["03", "04"], "cy": []}
    assert abouts(found, "cy") == ["empty"]
    assert [page.path for page in only(found, "ana").pages] == [f"ana/{name}" for name in BOTH]
    assert found.remarks == only(found, "ana").remarks == ()


def test_a_home_in_which_nobody_opened_the_course_is_no_learners(handed_in, pages):
    found = collect(handed_in({**home("ana"), "admin/notes.txt": "", "admin/03.ipynb": "x"}), pages)
    assert summary(found) == {"ana": ["03", "04"]}
    (remark,) = found.remarks
    assert (remark.path, remark.text) == ("admin", "Nobody has opened the course in this home.")


def without_notes(files):
    """The same after the learner has reset the progress, as docs/exercises.md says."""
    return {name: text for name, text in files.items() if "/.rosbeat/" not in name}


@pytest.mark.parametrize("everybody", [False, True])
def test_whoever_resets_the_progress_stays_in_the_class(handed_in, pages, everybody):
    ana = without_notes(home("ana")) if everybody else home("ana")
    found = collect(handed_in({**ana, **without_notes(home("ben")), "admin/notes.txt": ""}), pages)
    assert summary(found) == {"ana": ["03", "04"], "ben": ["03", "04"]}
    assert only(found, "ben").remarks == ()
    assert [remark.path for remark in found.remarks] == ["admin"]


@pytest.mark.parametrize(
    "others", [inside("ben/"), inside("ben/pages/"), {"ben.zip": zipped(BOTH)}], ids=range(3)
)
def test_a_folder_of_the_course_among_what_was_handed_in_makes_no_homes(handed_in, pages, others):
    found = collect(handed_in({**inside("ana/my_course/"), **others}), pages)
    assert summary(found) == {"ana": ["03", "04"], "ben": ["03", "04"]}


@pytest.mark.parametrize("place", ["my_course/03_write.ipynb", "my_course", "my_course/.rosbeat"])
def test_no_link_leads_out_of_a_home(handed_in, pages, place):
    source = handed_in({**home("ana"), **home("eve")})
    (source / "eve" / place).rename(source / "eve" / "own")
    (source / "eve" / place).symlink_to(source / "ana" / place)
    found = collect(source, pages)
    assert not [one for one in only(found, "eve").pages if "03" in one.page and one.notebook.cells]
    assert ["It is a link" in one.text for one in only(found, "eve").remarks] == [True]


@pytest.mark.parametrize("place", ["03_write.ipynb", ""])
def test_a_link_that_a_learner_puts_in_place_meanwhile_is_not_followed(handed_in, place):
    source = handed_in({**home("ana"), **home("eve", {"03_write.ipynb": BLANK})})
    with archives.open_upload(source) as files:
        (page,) = [one for one in files if one.parts[:1] == ("eve",)]
        moved = source / "eve" / "my_course" / place
        moved.rename(source / "eve" / "own")
        moved.symlink_to(source / "ana" / "my_course" / place)
        with pytest.raises(OSError, match=r"symbolic links|Not a directory"):
            page.read()


def test_a_pipe_that_a_learner_puts_in_place_keeps_nobody(handed_in):
    source = handed_in({**home("eve", {"03_write.ipynb": BLANK})})
    with archives.open_upload(source) as (page,):
        (source / "eve" / "my_course" / "03_write.ipynb").unlink()
        os.mkfifo(source / "eve" / "my_course" / "03_write.ipynb")
        assert page.read() == b""


def test_a_home_that_cannot_be_read_is_said(handed_in, pages, monkeypatch):
    """Root can read all of them, and may run this test: the refusal is made up."""
    source = handed_in({**home("ana"), **home("ben")})
    lstat = Path.lstat

    def refusing(path):
        if path.is_relative_to(source / "ben"):
            raise PermissionError(errno.EACCES, "Permission denied", str(path))
        return lstat(path)

    monkeypatch.setattr(Path, "lstat", refusing)
    found = collect(source, pages)
    assert summary(found) == {"ana": ["03", "04"], "ben": []}
    (unread,) = only(found, "ben").unread
    assert unread.text == "The folder cannot be read: Permission denied."


@pytest.mark.parametrize(
    ("ana", "eve", "learners"),
    [
        ("Ana_4711_assignsubmission_file_", "Eve_5_assignsubmission_file_x_4711_assignsubmission_"
         "file_", ("4711", "5")),
        ("Ana_4711_assignsubmission_file_/", "Eve_5_assignsubmission_file_/x_4711_assignsubmission_"
         "file_/", ("4711", "5")),
        ("ana_4711_99_", "eve_5_98_x_4711_99_", ("4711", "5")),
        ("4711/", "eve/x_4711_assignsubmission_file_/", ("4711", "eve")),
        ("4711/", "eve/exercise_4711_1_", ("4711", "eve")),
        ("all/4711/", "all/eve/exercise_4711_1_", ("4711", "eve")),
        ("one/Ana_4711_assignsubmission_file_", "two/Eve_5_assignsubmission_file_", ("4711", "5")),
    ],
)  # fmt: skip
def test_nobody_hands_in_for_somebody_else(ana, eve, learners, handed_in, pages):
    files = {f"{ana}03_write.ipynb": PAGE_03, f"{eve}03_write.ipynb": f"{PAGE_03}\n"}
    found = collect(handed_in(files), pages)
    assert tuple(one.learner for one in found.submissions) == learners
    assert all(len(one.pages) == 1 and not one.remarks for one in found.submissions)


# What is wrong, and never fatal.


def test_nothing_that_is_wrong_is_fatal_and_nothing_is_lost(handed_in, pages, monkeypatch):
    monkeypatch.setattr(archives, "MOST_BYTES", 100_000)
    files = {
        "ana/03_write.ipynb": PAGE_03,
        "ben/03_write.ipynb": "",
        "cleo/homework.ipynb": PAGE_04,
        "dan/03_write.ipynb": PAGE_03[: int(len(PAGE_03) * 0.8)],
        "eve/03_write.ipynb": '{"cells": [{"sou',
        "fay/pandas.ipynb": notebook(cell("import pandas")),
        "gus/03_write.ipynb": PAGE_03,
        "gus/old/03_write.ipynb": PAGE_03,
        "hal/photo.jpg": "x",
        "ida/03_write.ipynb": b" " * 100_001,
        "jan/work.ipynb": b"\x80\x81 no notebook",
        "kim/pages.rar": "Rar!",
        "leo/04_listen.pdf": "%PDF",
        "max/notes.txt": "Sorry, I was ill.",
        "stray.ipynb": PAGE_03,
    }
    root = handed_in(files)
    (root / "nia").mkdir()
    found = collect(root, pages)
    assert {one.learner: abouts(found, one.learner) for one in found.submissions} == {
        "ana": [],
        "ben": ["empty"],
        "cleo": ["renamed"],
        "dan": ["unreadable"],
        "eve": ["unreadable"],
        "fay": ["wrong-course"],
        "gus": ["duplicate"],
        "hal": ["left-out"],
        "ida": ["unreadable"],
        "jan": ["unreadable"],
        "kim": ["unreadable"],
        "leo": ["unreadable"],
        "max": ["left-out"],
        "nia": ["empty"],
    }
    assert [remark.about for remark in found.remarks] == ["left-out"]
    handed = {name for name, pages_of in summary(found).items() if pages_of}
    assert handed == {"ana", "ben", "cleo", "dan", "eve", "gus", "ida", "leo"}
    # Which page these are is known by the name; of the others nobody knows.
    unreadable = {one.learner for one in found.submissions for p in one.pages if p.notebook.problem}
    assert unreadable == {"ben", "dan", "eve", "ida", "leo"}
    assert {one.learner for one in found.submissions if one.unread} == {"jan", "kim"}


def test_what_is_read_for_one_learner_has_an_end_and_costs_no_other(handed_in, pages, monkeypatch):
    monkeypatch.setattr(archives, "MOST_OF_A_LEARNER", 2 * len(PAGE_03))
    monkeypatch.setattr(archives, "MOST_FILES", 6)
    many = {f"{n}.txt": "x" for n in range(10)} | {"z/03_write.ipynb": PAGE_03}
    files = {**inside("ana/"), "ana/a/04_listen.ipynb": PAGE_04, **inside("ben/", many),
             "cy/03.ipynb": PAGE_03}  # fmt: skip
    found = collect(handed_in(files), pages)
    assert "more than is read of one learner's files" in str(only(found, "ana").remarks)
    assert "More than 6 files" in only(found, "ben").unread[0].text
    assert summary(found)["cy"] == ["03"]


# Which of several counts.


SEVERAL = (
    ({"a_1_9_03_write-2.ipynb": (PAGE_03, 1), "a_1_8_03_write.ipynb": (PAGE_03, 9)}, 0),
    ({"ana/a.ipynb": (PAGE_03, 1), "ana/b.ipynb": (PAGE_03.replace("1.0", "2"), 2)}, 1),
    ({"ana/a.ipynb": (PAGE_03, 1), "ana/b.ipynb": (MORE_03, 1)}, 1),
    ({"ana/a.ipynb": (PAGE_03, 1), "ana/b.ipynb": (PAGE_03, 1)}, 0),
    ({"ana/03_write.ipynb": ('{"cells": [{"sou', 9), "ana/b.ipynb": (PAGE_03, 1)}, 1),
)


@pytest.mark.parametrize(("files", "best"), SEVERAL, ids=range(len(SEVERAL)))
def test_the_last_attempt_counts_then_the_newest_then_the_longest(handed_in, pages, files, best):
    root = handed_in({name: text for name, (text, _) in files.items()})
    for name, (_, date) in files.items():
        os.utime(root / name, (1000 * date, 1000 * date))
    (one,) = collect(root, pages).submissions
    assert one.pages[0].path == list(files)[best]
    (said,) = [remark.text for remark in one.remarks if remark.about == "duplicate"]
    assert said.startswith(f"The page is there 2 times; {own_path(list(files)[best])} counts: ")


def test_clutter_is_nothing_and_of_many_files_only_the_number_is_said(handed_in, pages):
    many = {f"ana/{n:03}.txt": "x" for n in range(50)}
    found = collect(handed_in({"ben/.DS_Store": "x", "cy/.git/03.ipynb": "x", **many}), pages)
    assert summary(found) == {"ana": [], "ben": [], "cy": []}
    assert [abouts(found, name) for name in ("ben", "cy")] == [["empty"], ["empty"]]
    remarks = only(found, "ana").remarks
    assert len(remarks) == 21
    assert remarks[-1].text == "30 more files are not notebooks."


# Dates.


def test_the_date_in_a_zip_file_is_that_of_this_computer_as_a_deadline_is(tmp_path, pages):
    path = tmp_path / "all.zip"
    with zipfile.ZipFile(path, "w") as archive:
        moment = zipfile.ZipInfo("ana/03_write.ipynb", (2026, 11, 30, 18, 0, 0))
        archive.writestr(moment, PAGE_03)
    for due, is_late in (("2026-11-30 17:59", True), ("2026-11-30 18:00", False)):
        deadline = read_due(due)
        (one,) = mark_late(collect(path, pages), lambda _, at=deadline: at).submissions
        assert one.pages[0].late == is_late


# Broken archives and names: nothing is written, nobody else is harmed, nobody vanishes.


def raw(names):
    """A zip file whose members have these very names, as no honest program writes them."""
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w") as archive:
        for name in names:
            info = zipfile.ZipInfo("x")
            info.filename = name
            archive.writestr(info, PAGE_03)
    return buffer.getvalue()


def patched(place, new, data=None):
    """A zip file with some bytes of its first central header changed."""
    data = bytearray(data or zipped({"03_write.ipynb": PAGE_03}))
    at = data.index(b"PK\x01\x02") + place
    data[at : at + len(new)] = new
    return bytes(data)


def linked():
    info = zipfile.ZipInfo("03_write.ipynb")
    info.external_attr = (stat.S_IFLNK | 0o777) << 16
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w") as archive:
        archive.writestr(info, "/etc/passwd")
    return buffer.getvalue()


def nested(levels):
    data = zipped({"03_write.ipynb": PAGE_03})
    for level in range(levels):
        data = zipped({f"{level}.zip": data})
    return data


SOUND = zipped({"03_write.ipynb": PAGE_03})
BROKEN = {
    **{f"cut at {n}": SOUND[: len(SOUND) * n // 8] for n in range(8)},
    "no end": SOUND[:-10],
    "garbage in front": b"#!/bin/sh\n" * 40 + SOUND,
    "garbage behind": SOUND + b"\0" * 400,
    "only a signature": b"PK\x05\x06",
    "an end alone": b"PK\x05\x06" + b"\0" * 18,
    "text": b"This is no zip file.",
    "an end that lies": SOUND[:-22] + b"PK\x05\x06" + b"\xff" * 18,
    "encrypted": patched(8, b"\x01\x00"),
    "method 99": patched(10, struct.pack("<H", 99)),
    "method stored": patched(10, struct.pack("<H", 0)),
    "another checksum": patched(16, b"\0\0\0\0"),
    "claims 4 GB": patched(24, b"\xfe\xff\xff\xff"),
    "claims nothing": patched(24, b"\0\0\0\0"),
    "claims to be packed into 4 GB": patched(20, b"\xfe\xff\xff\xff"),
    "begins elsewhere": patched(42, b"\xf0\xff\xff\x7f"),
    "a date that is none": patched(12, b"\xff\xff\xff\xff"),
    "a name beyond the file": patched(28, b"\xff\xff"),
    "version 99": patched(6, b"\xff\x00"),
    "a link": linked(),
    "three deep": nested(3),
    "a bomb": zipped({"03_write.ipynb": b" " * 70_000_000}),
    "7z": b"7z\xbc\xaf\x27\x1c",
}  # fmt: skip
NAMES = (
    *("../../03.ipynb", "/03.ipynb", "/etc/cron.d/03.ipynb", "..\\03.ipynb", "C:\\03.ipynb"),
    *("c:03.ipynb", "\\\\server\\share\\03.ipynb", "a/../../03.ipynb", "....//03.ipynb"),
    *("\x1b[31m.ipynb", "a\nb.ipynb", "\u202egnp.ipynb", "\u200b.ipynb", "\ud83d.ipynb"),
    *(
        '=HYPERLINK("x").ipynb',
        "%s%n.ipynb",
        "<script>alert(1)<.ipynb",
        "nul",
        "W" * 300 + ".ipynb",
    ),
    *(".ipynb", "03_write.ipynb/", "../", "a/" * 200 + "03.ipynb"),
)
ARCHIVES = BROKEN | {
    f"name {n}": zipped({"a": ""}) if "\ud83d" in name else raw([name])
    for n, name in enumerate(NAMES)
}


def everything(folder):
    return sorted((str(path), path.lstat().st_size) for path in folder.rglob("*"))


# Flags, method, checksum, sizes, offset. Damage that moves later members is the system's, not a
# learner's, and then the whole file is refused.


#: Names by which the class's own zip file has its learners.
BEN, ANA = "Ben B_12_assignsubmission_file_", "Ana A_11_assignsubmission_file_"


@pytest.mark.parametrize("packed", [False, True], ids=["folder", "zip"])
def test_a_broken_archive_costs_only_its_learner(packed, handed_in, pages, tmp_path):
    files = {f"{ANA}/03_write.ipynb": PAGE_03, "zoe/all.7z": b"7z\xbc\xaf\x27\x1c"}
    folders = {f"{BEN.replace('12', str(100 + n))}/": name for n, name in enumerate(ARCHIVES)}
    files |= {f"{folder}all.zip": ARCHIVES[name] for folder, name in folders.items()}
    source = handed_in(files)
    if packed:
        source = tmp_path / "all.zip"
        source.write_bytes(zipped(files))
    before = everything(tmp_path)
    found = collect(source, pages)
    assert everything(tmp_path) == before
    assert len(found.submissions) == len(files)
    assert summary(found)["11"] == ["03"]
    for folder, name in folders.items():
        ben = only(found, folder.split("_")[1])
        for remark in ben.remarks:
            assert remark.path.isprintable(), name
            assert remark.text.isprintable(), name
            assert len(remark.text) < 600, name
        if name in BROKEN and name not in ("an end alone", "claims nothing"):
            assert ben.pages or ben.unread, name  # never a final 0


# Flags, method, checksum, sizes, offset. Damage that moves later members is the system's, not a
# learner's, and then the whole file is refused.


def test_links_and_pipes_are_not_followed_and_their_learner_stays(handed_in, tmp_path, pages):
    root = handed_in({"ana/03_write.ipynb": PAGE_03})
    secret = tmp_path / "secret.ipynb"
    secret.write_text(PAGE_03)
    (root / "ben").symlink_to(tmp_path)
    for learner in ("cy", "dan"):
        (root / learner).mkdir()
    (root / "cy/03_write.ipynb").symlink_to(secret)
    os.mkfifo(root / "dan/03_write.ipynb")
    found = collect(root, pages)
    assert sorted(summary(found)) == ["ana", "ben", "cy", "dan"]
    assert only(found, "ben").unread
    for learner in ("cy", "dan"):
        assert "not followed" in only(found, learner).pages[0].notebook.problem


# What cannot be submissions.


@pytest.mark.parametrize("make", ["nothing", "text", "half"])
def test_what_is_neither_a_folder_nor_a_zip_file_is_refused(make, tmp_path, pages, says):
    path = tmp_path / "all.zip"
    if make != "nothing":
        path.write_bytes(b"no zip file" if make == "text" else zipped(BOTH)[:-30])
    with pytest.raises(GradingError) as caught:
        collect(path, pages)
    says(caught.value, "all.zip", "Give the folder or the zip file")


@pytest.mark.parametrize(
    ("out", "is_apart"),
    [("class", False), ("class/grades", False), ("grades/../class/x", False), ("class2", True),
     ("grades", True), (".", True)],
)  # fmt: skip
def test_results_do_not_lie_among_submissions(tmp_path, out, is_apart, says):
    (tmp_path / "class").mkdir()
    if is_apart:
        require_apart(tmp_path / "class", tmp_path / out)
        return
    with pytest.raises(GradingError) as caught:
        require_apart(tmp_path / "class", tmp_path / out)
    says(caught.value, "inside the folder of submissions", "--out ~/class/grades")


# Which page of the course a file is.


def page_of(text, file, pages):
    page = which_page(read_notebook(text.encode()), file, pages)
    return page and page.lesson


WITHOUT_METADATA = json.dumps(
    {"cells": [one | {"metadata": {}} for one in json.loads(PAGE_04)["cells"]]}
)


@pytest.mark.parametrize(
    ("text", "file", "wanted"),
    [
        (PAGE_04, "03_write.ipynb", "04_listen"),  # what it is counts more than its name
        (WITHOUT_METADATA, "x", "04_listen"),
        (notebook(cell("x", id="04a-import")), "a", "04_listen"),
        (notebook(cell("x"), lesson="04_listen"), "a", "04_listen"),
        (notebook(cell("x")), "my_04_listen (2).ipynb", "04_listen"),
        (notebook(cell("import pandas")), "03_other.ipynb", None),
    ],
    ids=range(6),
)
def test_little_is_enough_to_tell_which_page_a_file_is(text, file, wanted, pages):
    assert page_of(text, file, pages) == wanted


@pytest.mark.parametrize(
    ("name", "most", "shown"),
    [
        ("Ana Müller 日本語.ipynb", 120, "Ana Müller 日本語.ipynb"),
        ("a\x1b[31mred", 120, "a\\u001b[31mred"),
        ("a\nb\r\tc", 120, "a\\u000ab\\u000d\\u0009c"),
        ("abc\u202egnp\u200b.exe", 120, "abc\\u202egnp\\u200b.exe"),
        ("lone\ud800", 120, "lone\\ud800"),
        ("x" * 121, 120, "x" * 117 + "..."),
        ("x" * 120, 120, "x" * 120),
        ("\x1b" * 10_000, 12, "\\u001b\\u0..."),
    ],
)
def test_no_character_of_a_name_changes_the_terminal(name, most, shown):
    assert printable(name, most) == shown
