"""Files that are whole or not there, and names for them."""

import os
import re

import pytest

from graded_classes import HOSTILE
from rosbeat.errors import GradingError
from rosbeat.grading import files
from rosbeat.grading.files import file_name, write_whole


@pytest.mark.parametrize("content", ["text\r\n", b"\0\xff", "", "Müller 日本", "x" * 1_000_000])
def test_a_file_is_written_as_it_is(tmp_path, content):
    path = tmp_path / "deep" / "results.json"
    assert write_whole(path, content)
    assert path.read_bytes() == (content if isinstance(content, bytes) else content.encode())
    assert os.listdir(path.parent) == ["results.json"]
    os.utime(path, (1, 1))
    assert not write_whole(path, content)  # an equal file is not touched
    assert path.stat().st_mtime == 1
    assert write_whole(path, "x\ud800y")
    assert path.read_text() == "x\\ud800y"


@pytest.mark.parametrize("step", ["fsync", "replace"])
@pytest.mark.parametrize(
    ("error", "raised"),
    [
        (OSError(28, "No space left on device"), GradingError),
        (KeyboardInterrupt(), KeyboardInterrupt),
    ],
)
def test_a_failure_half_way_leaves_what_was_there(tmp_path, monkeypatch, step, error, raised):
    path = tmp_path / "a"
    write_whole(path, "before")

    def fail(*_):
        raise error

    monkeypatch.setattr(files.os, step, fail)
    with pytest.raises(raised):
        write_whole(path, "after")
    assert path.read_text() == "before"
    assert os.listdir(tmp_path) == ["a"]


def test_a_link_is_replaced_and_what_it_leads_to_is_not_written(tmp_path):
    (tmp_path / "precious").write_text("precious")
    (tmp_path / "a").symlink_to("precious")
    write_whole(tmp_path / "a", "one")
    assert (tmp_path / "precious").read_text() == "precious"
    assert (tmp_path / "a").read_text() == "one"


@pytest.mark.parametrize("place", ["folder", "file/a", "a" * 300])
def test_a_place_where_no_file_can_be_is_told(tmp_path, place):
    (tmp_path / "folder").mkdir()
    (tmp_path / "file").write_text("")
    with pytest.raises(GradingError, match="cannot be written"):
        write_whole(tmp_path / place, "one")


# Names.


@pytest.mark.parametrize(
    ("learner", "name", "file"),
    [
        ("ana", "ana", "ana"),
        ("ana-b", "", "ana-b"),
        ("4711", "Ana Müller", "ana-muller_4711"),
        ("4711", "日本語", "4711"),
        ("4711", "../../etc/passwd", "etc-passwd_4711"),
        ("4711", "CON", "con_4711"),
    ],
)
def test_a_plain_learner_has_a_plain_name(learner, name, file):
    assert file_name(learner, name) == file


NASTY = [
    *HOSTILE, "..", ".", "/", "\\", "a/../b", "C:\\a", "con", "CON", "nul", "com1", "lpt9", "aux",
    "Ana", "ANA", "ana ", "aná", "ana", "ana.", "-rf", "~", "$HOME", "a" * 10_000, "a" * 10_001,
    "👩🏽‍🚀", "日本", "日本語", "\n", " ", "0123456789ab", "ana-0123456789ab", "=HYPERLINK(1)", "ﬁ",
]  # fmt: skip


def test_every_name_is_safe_everywhere_and_no_two_are_the_same():
    for name in ("", "Ana", *NASTY):
        given = {learner: file_name(learner, name) for learner in NASTY}
        assert set(given) == set(NASTY)
        assert len({one.casefold() for one in given.values()}) == len(set(NASTY))
        for one in given.values():
            assert re.fullmatch(r"[a-z0-9]+((-|__?)[a-z0-9]+)*", one)
            assert len(one) <= 100


def test_a_name_cannot_be_taken_by_calling_oneself_like_it():
    victim = file_name("Ana")
    assert file_name(victim) != victim
    assert file_name("47", victim) != victim
    assert file_name("ana_4711") != file_name("4711", "ana")
