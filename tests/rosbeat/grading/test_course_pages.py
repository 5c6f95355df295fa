"""Which page of the course a notebook is."""

import json

import pytest

from grading_files import BLANK, PAGE_04, cell, notebook
from rosbeat.errors import GradingError
from rosbeat.grading.course_pages import course_pages, which_page
from rosbeat.grading.notebook import read_notebook


def of(text, file, pages):
    page = which_page(read_notebook(text.encode()), file, pages)
    return page and page.lesson


def test_the_pages_know_their_exercises(pages):
    assert [(one.number, one.title) for one in pages] == [("03", "Write"), ("04", "Listen")]
    assert [(one.exercise, one.id) for one in pages[0].wanted] == [("03a", "03a-cell")]
    assert pages[0].wanted[0].blank == BLANK


def test_what_a_page_is_counts_more_than_its_name(pages):
    assert of(PAGE_04, "03_write.ipynb", pages) == "04_listen"
    assert of(PAGE_04, "homework.ipynb", pages) == "04_listen"


@pytest.mark.parametrize(
    ("text", "file"),
    [
        (notebook(cell("x", id="04a-import")), "a"),
        (notebook(cell("x"), lesson="04_listen"), "a"),
        (notebook(cell("# Listen", "markdown")), "a"),
        (notebook(cell("x")), "my_04_listen (2).ipynb"),
    ],
)
def test_little_is_enough(text, file, pages):
    assert of(text, file, pages) == "04_listen"


def test_a_notebook_of_another_course_is_none(pages):
    assert of(notebook(cell("import pandas")), "03_other.ipynb", pages) is None


def test_metadata_that_is_removed_does_not_matter(pages):
    whole = json.loads(PAGE_04)
    for one in whole["cells"]:
        one["metadata"] = {}
    assert of(json.dumps(whole), "x", pages) == "04_listen"


def test_a_folder_without_pages_is_refused(tmp_path, says):
    with pytest.raises(GradingError) as caught:
        course_pages(tmp_path)
    says(caught.value, "no pages", "folder of the course")
