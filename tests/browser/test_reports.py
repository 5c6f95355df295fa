"""Feedback and the report of a class in a real browser: on a phone, day and night, offline."""

import pytest

from graded_classes import HOSTILE, a_class, hostile_learner, one_of_each
from rosbeat.grading.feedback import feedback
from rosbeat.grading.marks import Gradebook
from rosbeat.grading.report import class_report

#: How much is wider than the window.
TOO_WIDE = "document.documentElement.scrollWidth - document.documentElement.clientWidth"
UNFOLD = "document.querySelectorAll('details').forEach(one => one.open = true)"
BACKGROUND = "getComputedStyle(document.body).backgroundColor"
REPORTS = {
    "feedback": lambda: feedback(one_of_each()),
    "class": lambda: class_report(a_class(100)),
    "hostile class": lambda: class_report(Gradebook("1", tuple(map(hostile_learner, HOSTILE)))),
    **{f"hostile {at}": lambda text=text: feedback(hostile_learner(text))
       for at, text in enumerate(HOSTILE)},
}  # fmt: skip


@pytest.fixture
def seen(chromium, tmp_path):
    """Open a report in a window of some width; nothing may be asked for, run or complained of."""
    noticed, contexts = [], []

    def look(report, width, scheme="light"):
        path = tmp_path / "report.html"
        path.write_text(report, encoding="utf-8")
        context = chromium.new_context(
            viewport={"width": width, "height": 700}, color_scheme=scheme, offline=True
        )
        contexts.append(context)
        page = context.new_page()
        page.on("console", lambda message: noticed.append(message.text))
        page.on("dialog", lambda dialog: (noticed.append("dialog"), dialog.dismiss()))
        page.on("request", lambda request: noticed.append(request.url))
        page.goto(path.as_uri())
        page.evaluate(UNFOLD)
        return page

    yield look
    for context in contexts:
        context.close()
    assert [one for one in noticed if not one.startswith("file:")] == []
    assert len(noticed) == len(contexts)  # the pages themselves


@pytest.mark.parametrize("width", [320, 1200])
@pytest.mark.parametrize("name", REPORTS)
def test_nothing_is_wider_than_the_window(seen, name, width):
    page = seen(REPORTS[name](), width)
    assert page.evaluate(TOO_WIDE) == 0
    assert page.locator("h1").is_visible()


@pytest.mark.parametrize("name", ["feedback", "class"])
def test_it_is_dark_where_everything_is_dark(seen, name):
    grounds = [
        seen(REPORTS[name](), 360, scheme).evaluate(BACKGROUND) for scheme in ("light", "dark")
    ]
    assert grounds == ["rgb(255, 255, 255)", "rgb(20, 24, 28)"]
