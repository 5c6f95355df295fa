"""A rebuild does not change what cannot come out the same twice."""

from __future__ import annotations

import pytest
from nbformat import v4

from rosbeat.authoring import pages
from rosbeat.authoring.transforms.uncompared import UNCOMPARED, keep_uncompared


def page(text, *, source="roll()", tags=(UNCOMPARED,), cell_id="a"):
    output = v4.new_output("stream", text=text, name="stdout")
    cell = v4.new_code_cell(source, outputs=[output], metadata={"tags": list(tags)})
    cell.id = cell_id
    return v4.new_notebook(cells=[cell])


def rebuilt(path, new):
    return keep_uncompared(path)(new).cells[0].outputs[0].text


@pytest.fixture
def stored(tmp_path):
    path = tmp_path / "page.ipynb"
    path.write_bytes(pages.to_bytes(page("3\n")))
    return path


def test_a_tagged_cell_keeps_the_output_it_has(stored):
    assert rebuilt(stored, page("5\n")) == "3\n"


@pytest.mark.parametrize(
    "change", [{"source": "roll(2)"}, {"tags": ()}, {"cell_id": "b"}], ids=lambda c: next(iter(c))
)
def test_a_changed_cell_gets_its_new_output(stored, change):
    assert rebuilt(stored, page("5\n", **change)) == "5\n"


def test_another_kind_of_output_is_stored(stored):
    failed = page("5\n")
    failed.cells[0].outputs = [v4.new_output("error", ename="E", evalue="no", traceback=[])]
    assert keep_uncompared(stored)(failed).cells[0].outputs[0].output_type == "error"


@pytest.mark.parametrize("content", [None, b"", b"{", b"\xff\xfe"])
def test_a_page_that_cannot_be_read_has_nothing_to_keep(tmp_path, content):
    path = tmp_path / "page.ipynb"
    if content is not None:
        path.write_bytes(content)
    assert rebuilt(path, page("5\n")) == "5\n"
