"""Notebooks of strangers, whole and broken."""

import json

import pytest

from grading_files import PAGE_03, cell, notebook
from rosbeat.page_runs import notebook as module
from rosbeat.page_runs.notebook import read_notebook


def read(text):
    return read_notebook(text.encode())


def test_a_page_is_read():
    found = read(PAGE_03)
    assert (found.lesson, found.problem) == ("03_write", "")
    assert [one.sort for one in found.cells] == ["markdown", "code", "code", "code"]
    assert (found.cells[2].exercise, found.cells[3].check) == ("03a", "03a")


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (b"", "is empty"),
        (b'{"cells": [{"source": "\xff"}]}', "not UTF-8"),
        (b" \n\0\0", "is empty"),
        (b"hello", "not JSON"),
        (b"[1, 2]", "not a notebook"),
        (b'{"a": 1}', "not a notebook"),
        (b'{"cells": 3}', "not a notebook"),
        (b'{"cells": [{"source"', "not whole"),
        (b"[" * 100_000, "not JSON"),
        (b'{"cells": ' + b"[" * 100_000, "not whole"),
        (PAGE_03[: len(PAGE_03) // 2].encode(), "not whole"),
    ],
)
def test_what_is_no_notebook_is_said(data, words):
    found = read_notebook(data)
    assert found.cells == ()
    assert words in found.problem


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


def test_no_more_cells_are_read_than_any_page_has(monkeypatch):
    monkeypatch.setattr(module, "MOST_CELLS", 3)
    found = read(notebook(*[cell("x") for _ in range(5)]))
    assert (found.cells, found.problem) == ((), "It has 5 cells, more than any page.")


def test_a_cell_that_is_too_long_makes_a_notebook_that_waits_for_a_person(monkeypatch):
    monkeypatch.setattr(module, "MOST_OF_A_CELL", 50)
    found = read(notebook(cell("y"), cell("x" * 51), lesson="03_write"))
    assert (found.cells, found.lesson) == ((), "03_write")
    assert found.problem == "Cell 2 has 51 characters, more than any answer."


def test_outputs_cost_no_answer_and_too_many_lists_are_not_parsed():
    """A print loop of 24 MB is read like any other page."""
    whole = json.loads(PAGE_03)
    whole["cells"][2]["outputs"] = [{"text": ['1 "]\\[{{\n'] * 1_700_000}]
    whole["metadata"]["widgets"] = {"state": {"a": [1, {"b": "]"}]}}
    data = json.dumps(whole).encode()
    assert len(data) > 24_000_000
    assert read_notebook(data) == read(PAGE_03)
    found = read_notebook(b'{"cells": [' + b"[]," * 11_000_000)
    assert found.cells == ()
    assert found.problem
