"""Where the course is, and which of its pages somebody means."""

import pytest

from rosbeat.errors import GradingError
from rosbeat.grading import checkout
from rosbeat.grading.checkout import choose_pages, find_checkout


def test_the_course_is_found():
    assert (find_checkout() / "environment" / "course").is_file()


def test_a_package_without_its_course_says_so(monkeypatch, says):
    monkeypatch.setattr(checkout, "course_root", lambda: None)
    with pytest.raises(GradingError) as caught:
        find_checkout()
    says(caught.value, "./environment/course shell")


@pytest.mark.parametrize(
    ("names", "numbers"),
    [
        ([], ["03", "04"]),
        (["04"], ["04"]),
        (["4", "3"], ["03", "04"]),
        (["03_write"], ["03"]),
        (["notebooks/03_write.ipynb", " 03 "], ["03"]),
    ],
)
def test_pages_go_by_many_names(pages, names, numbers):
    assert [page.number for page in choose_pages(pages, names)] == numbers


@pytest.mark.parametrize("name", ["05", "", "write", "³", "\x1b[31m"])
def test_a_page_that_is_not_there_is_refused(pages, name, says):
    with pytest.raises(GradingError) as caught:
        choose_pages(pages, [name])
    says(caught.value, "--lessons 03 04")
    assert "\x1b" not in str(caught.value)
