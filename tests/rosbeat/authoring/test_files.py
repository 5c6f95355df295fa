from __future__ import annotations

import os
import stat

import pytest

from rosbeat.authoring import files


def test_a_page_is_new_changed_or_the_same(tmp_path):
    path = tmp_path / "tree" / "a.ipynb"
    assert files.compare(path, b"x\n").kind == "new"
    files.write(path, b"x\n")
    assert files.compare(path, b"x\n") is None
    change = files.compare(path, b"y\n")
    assert (change.kind, change.matters) == ("changed", True)
    assert "-x\n+y" in change.diff


def test_a_long_difference_is_cut(tmp_path):
    path = tmp_path / "a.ipynb"
    path.write_text("old\n" * 100)
    diff = files.compare(path, b"new\n" * 100).diff
    assert "more lines" in diff
    assert len(diff.splitlines()) < 50


def test_other_pixels_alone_do_not_matter(tmp_path):
    path = tmp_path / "a.ipynb"
    path.write_bytes(b'{"image/png": "AAAA"}')
    assert not files.compare(path, b'{"image/png": "BBBB"}').matters


def test_a_write_that_fails_leaves_the_old_page_and_no_rest(tmp_path, monkeypatch):
    path = tmp_path / "a.ipynb"
    files.write(path, b"old")

    def refuse(*_):
        raise OSError("no")

    monkeypatch.setattr(os, "replace", refuse)
    with pytest.raises(OSError, match="no"):
        files.write(path, b"new")
    assert path.read_bytes() == b"old"
    assert [entry.name for entry in tmp_path.iterdir()] == ["a.ipynb"]


def test_a_written_page_can_be_read_by_everybody(tmp_path):
    files.write(tmp_path / "a.ipynb", b"x")
    assert stat.S_IMODE((tmp_path / "a.ipynb").stat().st_mode) == 0o644


def test_only_our_own_pages_are_stale(tmp_path):
    ours = '{"cells": [], "metadata": {"rosbeat": {"lesson": "%s"}}, "nbformat": 4, '
    ours += '"nbformat_minor": 5}'
    (tmp_path / "01_gone.ipynb").write_text(ours % "01_gone")
    (tmp_path / "00_here.ipynb").write_text(ours % "00_here")
    (tmp_path / "copy.ipynb").write_text(ours % "00_here")
    (tmp_path / "theirs.ipynb").write_text(ours.replace("rosbeat", "other") % "theirs")
    (tmp_path / "broken.ipynb").write_text("no notebook")
    assert files.stale_pages(tmp_path, {"00_here"}) == [tmp_path / "01_gone.ipynb"]
