"""Outcomes as text, HTML and JSON; code in colours, and with nothing added to its text."""

import json
import re
from dataclasses import replace

import pytest

from parsed_html import Parsed
from rosbeat.diagnosis.mistakes import MISTAKES
from rosbeat.exercises import outcome_display
from rosbeat.exercises.check import check
from rosbeat.exercises.exercise import failed, not_attempted
from rosbeat.exercises.outcome_display import EDGES, MIME, Shown, highlighted, words
from rosbeat.records import Outcome, Part

OUTCOMES = {
    "passed": Outcome("03a", "passed", "Ten readings.", remarks=("There is a shorter way.",)),
    "not there yet": failed("03a", "Nine readings.", "Count again."),
    "still open": replace(not_attempted(), exercise="03a"),
}


def views(outcome):
    bundle = Shown(outcome)._repr_mimebundle_()
    return bundle["text/plain"], bundle["text/html"]


@pytest.mark.parametrize("word", OUTCOMES)
def test_text_and_html_say_the_same(word):
    shown = Shown(OUTCOMES[word])
    assert str(shown) == repr(shown)
    for view in views(shown.outcome):
        assert f"Exercise 03a: {word}." in view
        assert shown.outcome.evidence in view
        assert shown.outcome.hint in view
        assert all(remark in view for remark in shown.outcome.remarks)


def test_a_known_mistake_is_told_by_its_evidence_and_only_the_record_has_its_id():
    for mistake in MISTAKES:
        shown = Shown(failed("03a", "Nothing.", "Look.", mistake))
        assert shown.record()["mistake"] == mistake
        for view in views(shown.outcome):
            assert "Mistake:" not in view
            assert "recognize this mistake" not in view


def test_a_failed_try_has_no_points_to_speak_of():
    for view in views(replace(failed("03a", "Nothing.", "Look.", "wrong-depth"), out_of=2)):
        assert "points" not in view


PRINTS = """
class Talker(Node):
    def __init__(self):
        super().__init__("talker")
        print("made")
        self.create_timer(1.0, self.tick)

    def tick(self):
        print("tick", self.get_clock().now().nanoseconds)
        self.get_logger().info("a reading")
"""


def test_a_check_shows_the_first_lines_that_a_node_printed_and_logged():
    space = {}
    exec(f"from rclpy.node import Node\n{PRINTS}", space)
    shown = check("03a", space["Talker"])
    for view in (str(shown), re.sub("<[^>]*>", "\n", shown.html())):
        assert re.search(r"Your code printed:\s+made\s+tick 1\d+\n", view)
        assert re.search(r"and 1 more line", view)
        assert re.search(r"Your node logged:\s+1.00 s  INFO  a reading", view)


@pytest.mark.parametrize("mistake", ["new-to-me", "", "a-name-that-nobody-knows"])
def test_another_one_is_said_to_be_new(mistake):
    for view in views(failed("03a", "Nothing.", "Look.", mistake)):
        assert view.count("recognize this mistake") == 1
        assert "Mistake:" not in view


def test_evidence_of_several_lines_keeps_its_shape():
    text, html = views(failed("03a", "It said:\n  x = 1\n      ^", "Look."))
    assert "It said:\n    x = 1\n        ^\n  The check" in text
    assert "<pre>It said:\n  x = 1\n      ^</pre>" in html


@pytest.mark.parametrize("evidence", ["word " * 100_000, "line\n" * 100_000])
def test_evidence_without_end_is_cut(evidence):
    for view in views(failed("03a", evidence, "Look.")):
        assert len(view) < 6000
        assert "and more, 500,000 characters in all" in view
        assert "Look." in view


def test_what_a_learner_wrote_cannot_become_html():
    bad = "<script>x</script>\n<img>"
    outcome = Outcome("<b>", "failed", bad, bad, "not-a-float", remarks=(bad,))
    html = Shown(outcome).html()
    assert all(tag not in html for tag in ("<script>", "<b>", "<img>"))


def test_the_record_is_the_whole_outcome_as_json():
    outcome = OUTCOMES["passed"]
    record = json.loads(json.dumps(Shown(outcome)._repr_mimebundle_()[MIME]))
    assert record.pop("version") == 1
    assert Outcome(**{**record, "remarks": tuple(record["remarks"])}) == outcome


PARTS = Outcome(
    *("13b", "failed", "1 of 3 requirements are met.", "Look.", "boundary", 3, 6),
    parts=(
        Part("R1", "It opens.", True, "", 3),
        Part("R2", "It closes.", False, "It stayed <open>.", 2),
        Part("R3", "It is calm.", False, "It was not.", 1, optional=True),
    ),
)


def test_each_requirement_has_a_row_with_a_sign_and_a_word():
    text = str(Shown(PARTS))
    assert "  ✓ R1 met, 3 of 3: It opens." in text
    assert "  ✗ R2 not yet, 0 of 2: It stayed <open>." in text
    assert "  ✗ R3 not yet, 0 of 1, optional: It was not." in text
    html = Shown(PARTS).html()
    assert "✗ R2 not yet, 0 of 2:" in html
    assert "It stayed &lt;open&gt;." in html


# Code, in colours that can be read.

PYTHON = 'def tick(self):\n    return f"{self.count} <b>"  # 3 of `5`\n'
CELLS = {
    "a program": PYTHON,
    "a file of Python": f"%%save src/a.py\n{PYTHON}",
    "a terminal": '%%terminal build\ncd "$HOME"  # there\n',
}
PLAIN = {
    "words": "This is no program & has no colours.",
    "a file that is no Python": "%%save src/a.xml\n<a>1</a>\n",
    "a blank": "",
    "what no parser takes": "\0" + "(" * 500,
}
COLOURS = {
    name: getattr(outcome_display, name)
    for name in ("KEYWORD", "STRING", "NUMBER", "NAME", "COMMENT")
}


def brightness(colour):
    """WCAG 2.2, "relative luminance"."""
    parts = [int(colour[at : at + 2], 16) / 255 for at in (1, 3, 5)]
    linear = [one / 12.92 if one <= 0.04045 else ((one + 0.055) / 1.055) ** 2.4 for one in parts]
    return sum(weight * one for weight, one in zip((0.2126, 0.7152, 0.0722), linear, strict=True))


def contrast(one, other):
    """WCAG 2.2, "contrast ratio"."""
    low, high = sorted(map(brightness, (one, other)))
    return (high + 0.05) / (low + 0.05)


@pytest.mark.parametrize("name", COLOURS)
def test_code_can_be_read_on_light_and_dark_pages(name):
    light, dark = COLOURS[name]
    assert contrast(light, "#ffffff") >= 4.5
    assert contrast(dark, "#111111") >= 4.5


@pytest.mark.parametrize("page", ["#ffffff", "#111111", "#1e1e1e"])
def test_the_edge_of_a_card_is_seen_on_light_and_dark_pages(page):
    assert min(contrast(edge, page) for edge in EDGES.values()) >= 3


@pytest.mark.parametrize("name", CELLS)
def test_code_has_colours_and_its_text_stays(name):
    html = highlighted(CELLS[name])
    assert html.count("light-dark(") >= 3
    assert Parsed(f"<pre>{html}</pre>").text == CELLS[name]


@pytest.mark.parametrize("name", PLAIN)
def test_other_text_has_no_colours(name):
    html = highlighted(PLAIN[name])
    assert "color" not in html
    assert Parsed(f"<pre>{html}</pre>").text == PLAIN[name]


def test_no_backquote_is_left_in_a_sentence():
    html = words("Write `self.count += 1`, or run `ros2 topic list`.")
    assert "`" not in html
    assert Parsed(html).text == "Write self.count += 1, or run ros2 topic list."
    assert len(re.findall("<code>", html)) == 2
    assert words("a `b", "strong") == "<strong>a `b</strong>"
