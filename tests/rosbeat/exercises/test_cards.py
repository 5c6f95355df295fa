"""Outcomes as text, HTML and JSON."""

import json
from dataclasses import replace

import pytest

from rosbeat.diagnosis.mistakes import MISTAKES
from rosbeat.exercises.cards import MIME, Shown
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


# Frames.
