"""A class of 200 on the instructor's page, in a real browser, while learners go on."""

import json
import random

import pytest

from browser.accessibility import CUT_OFF, UNSEEN_FOCUS, serious
from graded_classes import HOSTILE
from rosbeat.exercises.registry import EXERCISES
from rosbeat.grading.class_board import _examples
from sharing import NOW, PASSED, class_folder, learner, record, served

LEARNERS = 200
SIZES = ((1280, 720), (1920, 1080))
#: Mistakes that hardly anybody in the class has made.
NEW = ("no-hysteresis", "hysteresis-lost", "status-repeated")
TOO_WIDE = "document.documentElement.scrollWidth - document.documentElement.clientWidth"


def a_class(place):
    """Learners on all pages; some give names that would be markup elsewhere."""
    chance = random.Random(1)
    names = [one.encode("utf-8", "replace").decode()[:40] for one in HOSTILE]
    ids = list(EXERCISES)
    for number in range(LEARNERS):
        exercise = ids[number % len(ids)]
        mistakes = sorted(name for name in _examples().get(exercise, {}) if name)
        said = {"exercise": exercise, "status": "failed", "time": NOW - number}
        if number % 3 == 0:
            said["name"] = names[number % len(names)]
        lines = [
            json.dumps({**said, "mistake": chance.choice(mistakes) if mistakes else "new-to-me"})
            for _ in range(1 + number % 4)
        ]
        lines += [record(one, PASSED, ago=2_000) for one in ids[: number % len(ids)]]
        learner(place, number, *lines)


@pytest.fixture
def place(tmp_path):
    a_class(tmp_path)
    return tmp_path


@pytest.fixture
def server(place):
    with served(class_folder(place)) as made:
        yield made


@pytest.fixture(params=["light", "dark"])
def scheme(request):
    return request.param


@pytest.fixture
def tab(chromium, server, scheme):
    """The page in a window; nothing may be asked for elsewhere or complained of."""
    context = chromium.new_context(
        viewport={"width": 1280, "height": 720}, color_scheme=scheme, reduced_motion="reduce"
    )
    made = context.new_page()
    noticed = []
    made.on("console", lambda message: noticed.append(message.text))
    made.on("pageerror", lambda error: noticed.append(str(error)))
    own = (server.url, "data:")
    made.on("request", lambda sent: None if sent.url.startswith(own) else noticed.append(sent.url))
    made.on("response", lambda seen: None if seen.ok else noticed.append(seen.url))
    made.on("dialog", lambda dialog: (noticed.append(dialog.message), dialog.dismiss()))
    made.goto(server.url)
    made.get_by_text("Updated at").wait_for()
    yield made
    context.close()
    assert noticed == []


def summaries(tab):
    return tab.locator(".mistake > summary")


def open_mistakes(tab):
    return [one.get_attribute("id") for one in tab.locator(".mistake[open]").all()]


def test_a_class_of_200_is_counted_and_changes_while_one_looks(tab, place):
    assert tab.locator(".lead strong").first.inner_text() == "200 learners"
    row = tab.locator(".tally", has_text="03a another sensor")
    before = row.get_by_role("img").get_attribute("aria-label")
    numbers = [int(word) for word in before.replace(",", "").split() if word.isdecimal()]
    assert numbers == counted("03a")
    for number in range(LEARNERS, LEARNERS + 60):  # newcomers, all with the same mistake
        learner(place, number, *[record("03a", mistake="number-published")] * 3)
    tab.get_by_text("260 learners").wait_for()
    first = summaries(tab).first
    assert "A value published instead of a message" in first.inner_text()
    assert int(first.locator(".many").inner_text()) >= 60
    assert "Most are stuck on 03a another sensor" in tab.locator(".lead").inner_text()
    passed, trying, stuck = counted("03a")
    said = f"03a another sensor: {passed} passed, {trying} trying, {stuck + 60} stuck"
    assert row.get_by_role("img").get_attribute("aria-label") == said
    assert "Most common now" in tab.locator("#news").inner_text()


def counted(exercise):
    """Where learners are by the way in which the class was made."""
    ids = list(EXERCISES)
    place = ids.index(exercise)
    passed = sum(place < number % len(ids) for number in range(LEARNERS))
    here = [1 + number % 4 for number in range(LEARNERS) if number % len(ids) == place]
    return [passed, sum(one < 3 for one in here), sum(one >= 3 for one in here)]


def test_hostile_names_are_text_and_hidden_until_somebody_asks(tab):
    shown = tab.get_by_text("<script>alert(1)</script>").locator("visible=true")
    assert shown.count() == 0
    tab.get_by_role("button", name="Show names").click()
    for number in range(1, 4):  # it is with one of the three mistakes
        if not shown.count():
            tab.keyboard.press(str(number))
    shown.first.wait_for()
    assert tab.evaluate("document.querySelectorAll('main script, main [onload]').length") == 0
    tab.get_by_role("button", name="Show names").click()
    assert shown.count() == 0


@pytest.mark.parametrize("size", SIZES)
def test_nothing_is_cut_off_or_hidden_from_anybody(tab, size):
    tab.set_viewport_size({"width": size[0], "height": size[1]})
    tab.get_by_role("button", name="Show names").click()
    for number in range(3):
        if not open_mistakes(tab)[number:]:
            tab.keyboard.press(str(number + 1))
        assert tab.evaluate(TOO_WIDE) == 0
        assert serious(tab.locator("html")) == []
    assert tab.locator("html").evaluate(UNSEEN_FOCUS) == []
    assert tab.locator("main").evaluate(CUT_OFF) == []


def test_everything_is_reached_by_keyboard(tab):
    assert open_mistakes(tab) == [tab.locator(".mistake").first.get_attribute("id")]
    reached = []
    for _ in range(6):
        tab.keyboard.press("Tab")
        reached.append(tab.evaluate("document.activeElement.textContent.trim().split('\\n')[0]"))
    assert reached[:3] == ["Pause", "Show names", "Theme"]
    assert [one.split()[0] for one in reached[3:]] == [
        one.inner_text() for one in tab.locator(".mistake .many").all()
    ]
    tab.keyboard.press("Enter")
    third = tab.locator(".mistake").nth(2).get_attribute("id")
    assert open_mistakes(tab) == [third]  # one at a time
    tab.keyboard.press("2")
    assert open_mistakes(tab) == [tab.locator(".mistake").nth(1).get_attribute("id")]


def test_what_is_discussed_stays_and_keeps_the_focus(tab, place):
    tab.keyboard.press("3")
    (third,) = open_mistakes(tab)
    for number in range(LEARNERS, LEARNERS + 90):
        lines = [record("03a", mistake=name) for name in NEW]
        learner(place, number, *lines)
    tab.get_by_text("290 learners").wait_for()
    assert summaries(tab).count() == 4
    assert open_mistakes(tab) == [third]
    focused = tab.evaluate("document.activeElement.id")
    assert focused == third.replace("mistake-", "open-")


def test_a_paused_page_stays_as_it_is(tab, place):
    tab.get_by_role("button", name="Pause").click()
    tab.get_by_text("Paused at").wait_for()
    learner(place, LEARNERS, record("03a"))
    asked = []
    tab.on("request", lambda sent: asked.append(sent.url))
    tab.wait_for_timeout(5_000)  # more than two looks
    assert asked == []
    assert tab.locator(".lead strong").first.inner_text() == "200 learners"
    tab.get_by_role("button", name="Pause").click()
    tab.get_by_text("201 learners").wait_for()


def test_the_theme_can_be_changed_for_a_projector(tab, scheme):
    colour = "getComputedStyle(document.body).backgroundColor"
    light, dark = "rgb(255, 255, 255)", "rgb(13, 16, 19)"
    assert tab.evaluate(colour) == (light if scheme == "light" else dark)
    tab.get_by_role("button", name="Theme").click()
    assert tab.evaluate(colour) == (dark if scheme == "light" else light)
    assert serious(tab.locator("html")) == []
