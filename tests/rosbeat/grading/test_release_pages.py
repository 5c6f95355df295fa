"""Pages are released as learners get them: untouched, and with links that lead somewhere."""

import json

import pytest

from grading_files import DONE, cell, notebook, page
from rosbeat.errors import GradingError
from rosbeat.grading.course_pages import course_pages
from rosbeat.grading.release_pages import page_bytes, without_links, worked_in

RUN = cell("1 + 1", id="a") | {"outputs": [{"output_type": "stream"}], "execution_count": 1}


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (page(), []),
        (page(source=DONE), ["x has no blank in exercise 03a"]),
        (notebook(RUN), ["x was run"]),
    ],
    ids=["untouched", "filled in", "run"],
)
def test_work_in_a_page_is_noticed(text, said):
    assert worked_in("x", text.encode()) == said


def test_pages_with_answers_are_not_released(tmp_path, says):
    (tmp_path / "03_write.ipynb").write_text(page(source=DONE))
    with pytest.raises(GradingError) as caught:
        page_bytes(tmp_path, course_pages(tmp_path), ["03_write"])
    says(caught.value, "rosbeat build --no-run")


@pytest.mark.parametrize(
    ("text", "made"),
    [
        ("see [page 04](04_listen.ipynb).", "see page 04."),
        ("see [page 04](04_listen.ipynb#a-b).", "see page 04."),
        ("see [page 03](03_write.ipynb#a).", "see [page 03](03_write.ipynb#a)."),
        ("![x](04.png) [y](https://a.b/04_x.ipynb)", "![x](04.png) [y](https://a.b/04_x.ipynb)"),
    ],
)
def test_links_lead_only_to_pages_that_are_there(text, made):
    data = notebook(cell(f'{text}\n"', "markdown")).encode()
    found = json.loads(without_links(data, {"03_write"}))
    assert found["cells"][0]["source"] == f'{made}\n"'


def test_the_pages_come_byte_for_byte(pages, tmp_path):
    folder = tmp_path / "course"
    found = page_bytes(folder, pages, ["03_write", "04_listen"])
    assert found == {path.name: path.read_bytes() for path in folder.iterdir()}
