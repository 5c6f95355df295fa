"""Notebooks of strangers, whole and broken."""

import json

import pytest

from grading_files import PAGE_03, cell, notebook
from rosbeat.grading import notebook as module
from rosbeat.grading.notebook import Cell, read_notebook


def read(text):
    return read_notebook(text.encode())


def test_a_page_is_read():
    found = read(PAGE_03)
    assert (found.lesson, found.repairs, found.problem) == ("03_write", (), "")
    assert [one.sort for one in found.cells] == ["markdown", "code", "code", "code"]
    assert (found.cells[2].exercise, found.cells[3].check) == ("03a", "03a")


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (b"", "is empty"),
        (b" \n\0\0", "is empty"),
        (b"hello", "not JSON"),
        (b"[1, 2]", "not a notebook"),
        (b'{"a": 1}', "not a notebook"),
        (b'{"cells": 3}', "not a notebook"),
        (b'{"cells": [{"source"', "breaks off"),
        (b"[" * 100_000, "not JSON"),
        (b'{"cells": ' + b"[" * 100_000, "breaks off"),
    ],
)
def test_what_is_no_notebook_is_said(data, words):
    found = read_notebook(data)
    assert found.cells == ()
    assert words in found.problem


@pytest.mark.parametrize("share", [0.5, 0.7, 0.9, 0.99])
def test_the_whole_cells_of_a_truncated_file_are_kept(share):
    whole = read(PAGE_03)
    cut = read(PAGE_03[: int(len(PAGE_03) * share)])
    assert cut.cells == whole.cells[: len(cut.cells)]
    assert cut.cells
    assert (cut.cut, whole.cut) == (True, False)


def test_formats_of_other_versions_are_read():
    sheet = {"cells": [{"cell_type": "code", "input": ["a = 1\n", "b = 2"]}]}
    found = read(json.dumps({"worksheets": [sheet], "nbformat": 3}))
    assert found.cells == (Cell(0, "code", "a = 1\nb = 2"),)
    assert "format 3" in found.repairs[0]


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16"])
def test_another_editor_s_encoding_is_read(encoding):
    text = notebook(cell("# Grüße", "markdown"))
    assert read_notebook(json.dumps(json.loads(text), ensure_ascii=False).encode(encoding)).cells


def test_text_that_is_not_utf_8_is_mended():
    found = read_notebook(b'{"cells": [{"cell_type": "code", "source": "a = \'\xff\'"}]}')
    assert found.cells[0].source == "a = '\ufffd'"
    assert "UTF-8" in found.repairs[0]


def test_strange_cells_cost_no_others():
    strange = [
        3,
        None,
        {"cell_type": "widget", "source": 7},
        {"cell_type": "code", "source": [1, "a"], "metadata": [], "id": 3},
        {"cell_type": "code", "source": "x", "metadata": {"rosbeat": {"exercise": {"a": 1}}}},
        cell("y"),
    ]
    found = read(notebook(*strange))
    assert [one.source for one in found.cells] == ["", "a", "x", "y"]
    assert found.cells[0].sort == "raw"
    assert len(found.repairs) == 2


def test_no_more_cells_are_read_than_any_page_has(monkeypatch):
    monkeypatch.setattr(module, "MOST_CELLS", 3)
    found = read(notebook(*[cell("x") for _ in range(5)]))
    assert len(found.cells) == 3
    assert "5 cells" in found.repairs[0]


def test_a_cell_that_is_too_long_makes_a_notebook_that_waits_for_a_person(monkeypatch):
    monkeypatch.setattr(module, "MOST_OF_A_CELL", 50)
    found = read(notebook(cell("y"), cell("x" * 51), lesson="03_write"))
    assert (found.cells, found.lesson) == ((), "03_write")
    assert found.problem == "Cell 2 has 51 characters, more than any answer."


# Outputs.

TRICKY = 'print("\\"outputs\\": [", "\\\\", \'{"attachments": {\')'


def noisy(lines):
    """A page with a lot of output, in which everything stands that delimits JSON."""
    whole = json.loads(notebook(cell(TRICKY, id="a"), cell("2", id="b"), lesson="03_write"))
    whole["cells"][0]["outputs"] = [{"text": [f'{n} "]\\[{{\n' for n in range(lines)]}, {"a": [{}]}]
    whole["cells"][0]["attachments"] = {"x.png": {"image/png": "AAAA" * lines}}
    whole["metadata"]["widgets"] = {"state": {"a": [1, {"b": "]"}]}}
    return whole


@pytest.mark.parametrize("indent", [None, 1])
@pytest.mark.parametrize("ascii_only", [True, False])
def test_outputs_are_cut_out_and_nothing_else(indent, ascii_only):
    data = json.dumps(noisy(50), indent=indent, ensure_ascii=ascii_only).encode()
    small = module.without_outputs(data)
    left = json.loads(small)
    wanted = noisy(0)
    wanted["cells"][0] |= {"outputs": [], "attachments": {}}
    wanted["metadata"]["widgets"] = {}
    assert left == wanted
    assert read_notebook(small) == read_notebook(data)


@pytest.mark.parametrize("share", [0.1, 0.3, 0.5, 0.8, 0.95, 0.999])
def test_outputs_of_a_file_that_breaks_off_are_cut_out_as_well(share):
    data = json.dumps(noisy(50)).encode()
    half = data[: int(len(data) * share)]
    assert read_notebook(module.without_outputs(half)).cells == read_notebook(half).cells


def test_a_print_loop_of_24_mb_costs_no_answer():
    data = json.dumps(noisy(1_100_000)).encode()
    assert len(data) > 24_000_000
    found = read_notebook(data)
    assert [one.source for one in found.cells] == [TRICKY, "2"]
    assert (found.repairs, found.problem, found.cut) == ((), "", False)


def test_what_is_too_large_without_outputs_is_not_parsed(monkeypatch):
    monkeypatch.setattr(module, "_LARGE", 100)
    monkeypatch.setattr(module, "MOST_BYTES", 1000)
    found = read(notebook(*[cell("x" * 100) for _ in range(20)]))
    assert found.cells == ()
    assert "without its outputs, more than any page" in found.problem
