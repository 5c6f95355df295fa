"""Who handed in what, as a table for a terminal and as JSON."""

import json

from grading_files import PAGE_03, PAGE_04
from rosbeat.grading.collected import as_json, as_text
from rosbeat.grading.collecting import collect

FILES = {
    "ana/03_write.ipynb": PAGE_03,
    "ana/04_listen.ipynb": PAGE_04,
    "ben/homework.ipynb": PAGE_03,
    "cleo/03_write.ipynb": "",
    "stray.ipynb": PAGE_03,
}


def rows(text):
    return [line.split() for line in text.splitlines()]


def test_the_table_says_who_handed_in_what(handed_in, pages):
    text = as_text(collect(handed_in(FILES), pages), pages)
    assert rows(text)[:4] == [
        ["learner", "name", "03", "04", "remarks"],
        ["ana", "yes", "yes"],
        ["ben", "yes", "-", "1"],
        ["cleo", "-", "-", "1"],
    ]
    assert "3 learners, 3 pages, 1 learner without any page, 3 remarks about files." in text


def test_every_remark_is_there(handed_in, pages):
    found = collect(handed_in(FILES), pages)
    text = as_text(found, pages)
    for one in (*found.remarks, *(one for each in found.submissions for one in each.remarks)):
        assert f"{one.about}: {one.path}\n    {one.text}" in text


def test_half_is_said(handed_in, pages):
    half = PAGE_03[: int(len(PAGE_03) * 0.8)]
    files = {"ana/03_write.ipynb": half, "a_LATE_1_9_03_write.ipynb": half}
    text = as_text(collect(handed_in(files), pages), pages)
    assert ["ana", "half", "-", "1"] in rows(text)
    assert "late, half" in text


def test_late_is_said(handed_in, pages):
    found = collect(handed_in({"a_LATE_1_9_03_write.ipynb": PAGE_03}), pages)
    assert ["1", "a", "late", "-", "1"] in rows(as_text(found, pages))


def test_pages_that_were_not_asked_for_are_counted(handed_in, pages):
    text = as_text(collect(handed_in(FILES), pages), pages[:1])
    assert rows(text)[0] == ["learner", "name", "03", "remarks"]
    assert "2 pages, 1 learner without any page, 1 page that you did not ask for" in text


def test_nothing_is_a_class_too(tmp_path, pages):
    (tmp_path / "empty").mkdir()
    found = collect(tmp_path / "empty", pages)
    assert as_text(found, pages) == "0 learners, 0 pages, 0 remarks about files."
    assert json.loads(as_json(found)) == {"version": 1, "learners": [], "remarks": []}


def test_names_change_no_terminal(handed_in, pages):
    name = "\x1b[31m[bold]\u202e" + "W" * 100
    found = collect(handed_in({f"{name}/\x07.ipynb": "", "漢字/03_write.ipynb": PAGE_03}), pages)
    for text in (as_text(found, pages), as_json(found)):
        assert not set("\x1b\x07\u202e") & set(text)
    text = as_text(found, pages)
    assert "\\u001b[31m[bold]" in text
    assert max(map(len, text.splitlines()[:3])) < 100
    assert as_json(found).isascii()


def test_the_json_has_everything(handed_in, pages):
    found = json.loads(as_json(collect(handed_in(FILES), pages)))
    ana, ben, cleo = found["learners"]
    assert (ana["learner"], ana["system"]) == ("ana", "folder")
    assert [page["page"] for page in ana["pages"]] == ["03_write", "04_listen"]
    assert ana["pages"][0]["cells"] == 4
    assert ben["remarks"][0]["about"] == "renamed"
    assert cleo["pages"] == []
    assert found["remarks"][0]["about"] == "left-out"
