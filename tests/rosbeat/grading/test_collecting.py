"""Who handed in what, in all shapes in which it may come."""

import json
import os
import zipfile
from dataclasses import replace
from datetime import datetime

import pytest

from grading_files import PAGE_03, PAGE_04, cell, notebook, zipped
from rosbeat.grading import collecting
from rosbeat.grading.collecting import collect
from rosbeat.grading.deadlines import read_due
from rosbeat.grading.entries import MOST_BYTES, Listing, list_files

MORE_03 = json.dumps({**json.loads(PAGE_03), "cells": [*json.loads(PAGE_03)["cells"], cell("1")]})


def summary(found):
    return {one.learner: [page.page[:2] for page in one.pages] for one in found.submissions}


def abouts(found, learner):
    (one,) = [one for one in found.submissions if one.learner == learner]
    return sorted(remark.about for remark in one.remarks)


BOTH = {"03_write.ipynb": PAGE_03, "04_listen.ipynb": PAGE_04}


def inside(prefix, files=BOTH):
    return {prefix + name: text for name, text in files.items()}


@pytest.mark.parametrize(
    ("files", "learners"),
    [
        ({**inside("ana/"), **inside("ben/")}, ("ana", "ben")),
        ({**inside("class/ana/"), **inside("class/ben/")}, ("ana", "ben")),
        ({"ana.zip": zipped(BOTH), "ben.zip": zipped(inside("homework/"))}, ("ana", "ben")),
        (
            {**inside("A B_11_assignsubmission_file_/"), **inside("C_12_assignsubmission_file_")},
            ("11", "12"),
        ),
        (
            {"A B_11_assignsubmission_file_/all.zip": zipped(BOTH),
             **inside("C_12_assignsubmission_file_/x/")},
            ("11", "12"),
        ),
        ({**inside("bana_21_9_"), **inside("ccy_22_8_")}, ("21", "22")),
        ({"bana_21_9_all.zip": zipped(BOTH), **inside("ccy_LATE_22_8_")}, ("21", "22")),
    ],
    ids=["folders", "wrapped", "zips", "moodle", "moodle zip", "canvas", "canvas zip"],
)  # fmt: skip
@pytest.mark.parametrize("packed", [False, True], ids=["folder", "zip"])
def test_each_shape_gives_the_same_class(files, learners, packed, handed_in, pages, tmp_path):
    source = handed_in(files)
    if packed:
        source = tmp_path / "all.zip"
        source.write_bytes(zipped(files))
    found = collect(source, pages)
    assert summary(found) == {one: ["03", "04"] for one in learners}
    assert found.remarks == ()


def test_nothing_that_is_wrong_is_fatal_and_nothing_is_lost(handed_in, pages):
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
        "ida/03_write.ipynb": b" " * (MOST_BYTES + 1),
        "jan/03_write.ipynb": b"\x80\x81 no notebook",
        "stray.ipynb": PAGE_03,
    }
    found = collect(handed_in(files), pages)
    assert {one.learner: abouts(found, one.learner) for one in found.submissions} == {
        "ana": [],
        "ben": ["empty"],
        "cleo": ["renamed"],
        "dan": ["half-uploaded"],
        "eve": ["half-uploaded"],
        "fay": ["wrong-course"],
        "gus": ["duplicate"],
        "hal": ["left-out"],
        "ida": ["unreadable"],
        "jan": ["unreadable"],
    }
    assert [remark.about for remark in found.remarks] == ["left-out"]
    handed = {name for name, pages_of in summary(found).items() if pages_of}
    # Of Eve's page there is not a whole cell; which one it was going to be is known by its name.
    assert handed == {"ana", "cleo", "dan", "eve", "gus"}


def test_of_a_file_that_breaks_off_it_is_said_how_much_is_there(handed_in, pages):
    half = PAGE_03[: int(len(PAGE_03) * 0.8)]
    (one,) = collect(handed_in({"dan/03_write.ipynb": half}), pages).submissions
    (remark,) = one.remarks
    assert remark.text == "The file is not whole: 3 of the page's 4 cells are there."
    assert one.pages[0].notebook.cut


def test_a_file_of_which_nothing_can_be_read_never_takes_the_place_of_another(handed_in, pages):
    files = {"eve/03_write (1).ipynb": '{"cells": [{"sou', "eve/03_write.ipynb": PAGE_03}
    root = handed_in(files)
    os.utime(root / "eve/03_write.ipynb", (1000, 1000))
    (one,) = collect(root, pages).submissions
    assert one.pages[0].path == "eve/03_write.ipynb"


def test_a_text_that_was_typed_in_is_called_so(handed_in, pages):
    files = {"Jo Kim_7_assignsubmission_onlinetext_/onlinetext.html": "<p>Sorry</p>"}
    (one,) = collect(handed_in(files), pages).submissions
    assert one.remarks[0].text == (
        "It is text that was typed into Moodle, no notebook, so it is left out."
    )


def test_what_was_mended_is_not_called_half(handed_in, pages):
    (one,) = collect(
        handed_in({"ana/03_write.ipynb": PAGE_03.replace('"cells": [', '"cells": [3, ')}), pages
    ).submissions
    assert [remark.about for remark in one.remarks] == ["mended"]


def test_the_newest_of_two_counts(handed_in, pages):
    newer = PAGE_03.replace("1.0", "2.0")
    root = handed_in({"ana/03_write (1).ipynb": newer, "ana/03_write.ipynb": PAGE_03})
    os.utime(root / "ana/03_write.ipynb", (1000, 1000))
    (one,) = collect(root, pages).submissions
    assert one.pages[0].path == "ana/03_write (1).ipynb"
    assert [remark.about for remark in one.remarks] == ["duplicate"]
    assert "counts: it is the newest, by the date of the file." in one.remarks[0].text


@pytest.mark.parametrize(
    ("files", "why"),
    [
        ({"a_1_9_03_write-2.ipynb": PAGE_03, "a_1_9_03_write.ipynb": PAGE_03}, "last attempt"),
        ({"ana/a.ipynb": PAGE_03, "ana/b.ipynb": MORE_03}, "and it has more cells"),
        ({"ana/a.ipynb": PAGE_03, "ana/b.ipynb": PAGE_03}, "the first by name"),
    ],
)
def test_it_is_said_why_one_of_two_counts(handed_in, pages, files, why):
    root = handed_in(files)
    for name in files:
        os.utime(root / name, (1000, 1000))
    (one,) = collect(root, pages).submissions
    (said,) = [remark.text for remark in one.remarks if remark.about == "duplicate"]
    assert why in said


def test_the_last_attempt_counts_whenever_it_was_unpacked(handed_in, pages):
    root = handed_in(
        {
            "ana_1_9_03_write-2.ipynb": PAGE_03,
            "ana_1_8_03_write.ipynb": PAGE_03,
            "ana_1_7_x-1.ipynb": PAGE_03,
        }
    )
    os.utime(root / "ana_1_9_03_write-2.ipynb", (1000, 1000))
    (one,) = collect(root, pages).submissions
    assert one.pages[0].path == "ana_1_9_03_write-2.ipynb"


def test_late_is_what_the_system_says_or_what_the_clock_says(handed_in, pages):
    root = handed_in(
        {"a_LATE_1_9_03_write.ipynb": PAGE_03, "b_2_assignsubmission_file_/x.ipynb": PAGE_03}
    )
    os.utime(root / "b_2_assignsubmission_file_/x.ipynb", (1000, 1000))
    assert [one.pages[0].late for one in collect(root, pages).submissions] == [True, False]
    found = collect(root, pages, due=999).submissions
    assert [one.pages[0].late for one in found] == [True, True]
    said = [remark.text for one in found for remark in one.remarks if remark.about == "late"]
    date = f"{datetime.fromtimestamp(1000):%Y-%m-%d %H:%M}"
    assert said == [
        "Its name says that it was handed in late.",
        f"The date of the file, {date}, is after the deadline.",
    ]


def test_canvas_dates_its_files_at_the_download_so_only_its_mark_makes_them_late(handed_in, pages):
    root = handed_in({"a_LATE_1_9_03_write.ipynb": PAGE_03, "b_2_9_03_write.ipynb": PAGE_03})
    late = [one.pages[0].late for one in collect(root, pages, due=0).submissions]
    assert late == [True, False]


def test_a_date_beyond_all_calendars_is_late_and_stops_nothing(handed_in, pages, monkeypatch):
    root = handed_in({"ana/03_write.ipynb": PAGE_03})
    listing = list_files(root)
    never = Listing(tuple(replace(one, modified=1e18) for one in listing.entries), ())
    monkeypatch.setattr(collecting, "list_files", lambda source: never)
    (one,) = collect(root, pages, due=0).submissions
    assert one.pages[0].late
    assert "far in the future" in one.remarks[0].text


def test_the_date_in_a_zip_file_is_that_of_this_computer_as_a_deadline_is(tmp_path, pages):
    path = tmp_path / "all.zip"
    with zipfile.ZipFile(path, "w") as archive:
        moment = zipfile.ZipInfo("ana/03_write.ipynb", (2026, 11, 30, 18, 0, 0))
        archive.writestr(moment, PAGE_03)
    for due, is_late in (("2026-11-30 17:59", True), ("2026-11-30 18:00", False)):
        (one,) = collect(path, pages, read_due(due)).submissions
        assert one.pages[0].late == is_late


def test_a_name_cannot_reach_the_terminal(handed_in, pages):
    root = handed_in({"ana/\x1b[31m.ipynb": "", "ben/03_write.ipynb": PAGE_03})
    found = collect(root, pages)
    assert "\x1b" not in found.submissions[0].remarks[0].path
