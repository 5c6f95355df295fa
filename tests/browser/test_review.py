"""The review of a class of 200 in a real browser: by key, for a whole group at once, regraded."""

import csv
import json
import time

import pytest

from reviewing import a_class_to_review, served

LEARNERS = 200
TOO_WIDE = "document.documentElement.scrollWidth - document.documentElement.clientWidth"


@pytest.fixture
def out(tmp_path):
    return tmp_path / "out"


@pytest.fixture
def server(out):
    with served(out, a_class_to_review(LEARNERS)) as made:
        yield made


@pytest.fixture
def page(chromium, server):
    """The overview in a window; nothing may be refused, asked for elsewhere or complained of."""
    made = chromium.new_page(viewport={"width": 1300, "height": 900})
    noticed = []
    made.on("console", lambda message: noticed.append(message.text))
    made.on("pageerror", lambda error: noticed.append(str(error)))
    made.on("request", lambda request: noticed.append(request.url))
    made.goto(server.url)
    yield made
    made.close()
    refused = "status of 422"  # what a browser says of points that were refused
    assert [one for one in noticed if not one.startswith(server.url) and refused not in one] == []


def heading(page):
    return page.locator("h1").inner_text()


def lines(out):
    with (out / "manual.csv").open(encoding="utf-8-sig", newline="") as file:
        return [tuple(row.values()) for row in csv.DictReader(file)]


def results(out):
    return json.loads((out / "results.json").read_text())["learners"]


def test_a_class_is_marked_by_key_and_regraded_with_one_click(page, out):
    page.keyboard.press("n")
    page.wait_for_url("**/group/0")
    assert heading(page) == "04a watch a fridge: group 1 of 2"
    page.keyboard.press("n")
    page.wait_for_url("**/group/1")
    page.keyboard.press("p")
    page.wait_for_url("**/group/0")
    page.keyboard.press("e")
    page.keyboard.type("0.5n")  # within a field, keys are letters
    page.keyboard.press("Backspace")
    page.get_by_label("Comment to the learners").fill("Exactly 8 is Fine.")
    page.keyboard.press("Control+Enter")
    page.wait_for_url("**/group/1")
    wrong = range(2, LEARNERS, 3)
    given = [(f"{n:04}", f"Learner {n}", "04a", "0.5", "Exactly 8 is Fine.") for n in wrong]
    assert lines(out) == given
    assert "not yet in the results" in page.locator("header").inner_text()
    with page.expect_navigation():
        page.get_by_role("button", name="Write all results").click()
    assert "All results have what you gave." in page.locator("header").inner_text()
    assert sum(one["marks"][0]["points"] == 0.5 for one in results(out)) == len(wrong)


def test_one_of_a_group_is_marked_alone(page, out):
    page.goto(f"{page.url}group/2")
    assert "✓" not in heading(page)
    page.get_by_label("100 answers; what you save is for those that are ticked").uncheck()
    assert page.locator("input[name=member]:checked").count() == 0
    page.get_by_label("Learner 8 (0008)").check()
    page.get_by_label("Points, of 1").fill("1")
    with page.expect_navigation():
        page.get_by_role("button", name="Save for the chosen answers").click()
    assert lines(out) == [("0008", "Learner 8", "04b", "1", "")]
    assert page.locator("tbody tr").count() == 100


def test_points_that_are_none_are_told_beside_what_was_typed(page, out):
    page.goto(f"{page.url}group/0")
    page.get_by_label("Points, of 2").fill("7")
    page.get_by_role("button", name="Save and go on").click()
    assert "Write a number from 0 to 2" in page.get_by_role("alert").inner_text()
    assert page.get_by_label("Points, of 2").input_value() == "7"
    assert ("0002", "Learner 2", "04a", "7", "") not in lines(out)


@pytest.mark.parametrize("path", ["", "group/0", "group/2"])
@pytest.mark.parametrize("width", [320, 1300])
def test_nothing_is_wider_than_the_window(page, path, width):
    page.set_viewport_size({"width": width, "height": 800})
    page.goto(f"{page.url}{path}")
    assert page.evaluate(TOO_WIDE) == 0


def test_each_page_of_a_class_of_200_comes_at_once(page):
    root = page.url
    for path in ("", "group/0", "group/1", "group/2"):
        begin = time.monotonic()
        page.goto(f"{root}{path}")
        assert time.monotonic() - begin < 2.0
