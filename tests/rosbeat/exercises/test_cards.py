"""Outcomes as text, HTML and JSON."""

import json
from dataclasses import replace

import pytest

from rosbeat.diagnosis.mistakes import MISTAKES
from rosbeat.exercises.cards import EDGES, MIME, Shown, clipped, code, framed, indented, words
from rosbeat.exercises.exercise import failed, not_attempted
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


def test_the_sign_says_what_the_colour_says():
    signs = [str(Shown(outcome))[0] for outcome in OUTCOMES.values()]
    assert signs == ["✓", "✗", "○"]
    edges = {Shown(outcome).html().split(";")[0] for outcome in OUTCOMES.values()}
    assert len(edges) == 3


def test_a_hint_is_shown_only_if_there_is_one():
    for view in views(OUTCOMES["passed"]):
        assert "Hint" not in view
        assert "hint(" not in view


def test_a_failed_outcome_says_how_to_get_more_help():
    text, html = views(OUTCOMES["not there yet"])
    assert text.endswith('More help: hint("03a")')
    assert "hint(&quot;03a&quot;)" in html
    assert all("hint(" not in view for view in views(OUTCOMES["still open"]))


def test_points_are_told_if_there_are_several_and_something_was_tried():
    assert "passed, 2 of 2 points." in str(Shown(Outcome("03a", "passed", "", "", "", 2, 2)))
    assert "yet, 1 of 2 points." in str(Shown(Outcome("03a", "failed", "", "", "", 1, 2)))
    assert "point" not in str(Shown(Outcome("03a", "passed", "", "", "", 1, 1)))
    assert "point" not in str(Shown(Outcome("03a", "not attempted", "", "", "", 0, 2)))


def test_a_known_mistake_is_named():
    for mistake, known in MISTAKES.items():
        for view in views(failed("03a", "Nothing.", "Look.", mistake)):
            assert "Mistake:" in view
            assert known.title.split("'")[0] in view
            assert "recognize this mistake" not in view


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


def test_the_record_holds_the_parts_if_there_are_any():
    record = json.loads(json.dumps(Shown(PARTS).record()))
    assert [part["id"] for part in record["parts"]] == ["R1", "R2", "R3"]
    assert tuple(Part(**part) for part in record["parts"]) == PARTS.parts
    assert "parts" not in Shown(OUTCOMES["passed"]).record()


# Frames.


def luminance(colour):
    """WCAG 2.2, "relative luminance"."""
    parts = [int(colour[at : at + 2], 16) / 255 for at in (1, 3, 5)]
    red, green, blue = (
        part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in parts
    )
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


@pytest.mark.parametrize("page", ["#ffffff", "#111111", "#1e1e1e"])
@pytest.mark.parametrize("sign", EDGES)
def test_an_edge_is_seen_on_a_white_and_on_a_dark_page(sign, page):
    low, high = sorted(luminance(colour) for colour in (EDGES[sign], page))
    assert (high + 0.05) / (low + 0.05) >= 3


def test_a_frame_has_no_colours_of_its_own_but_the_edge():
    html = framed("✓", "one", "", "two")
    assert html.count("#") == 1
    assert "background" not in html
    assert html.endswith("<div>one</div><div>two</div></div>")


def test_everything_is_escaped():
    for html in (words("<i>&"), words("<i>&", "strong"), words("<i>&\nb"), code("<i>&")):
        assert "&lt;i&gt;&amp;" in html


def test_lines_below_the_first_are_set_in():
    assert indented("a\nb\nc") == "a\n  b\n  c"


@pytest.mark.parametrize("text", ["", "short", "\nlines\n  of a program\n"])
def test_what_is_short_stays_as_it_is(text):
    assert clipped(text) == text.strip("\n")
