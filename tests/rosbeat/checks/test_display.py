import pytest

from rosbeat.checks.display import Shown
from rosbeat.checks.verdicts import failed, not_attempted, passed

OUTCOMES = {
    "passed": passed("03a", "Ten readings."),
    "not there yet": failed("03a", "Nine readings.", "Count again."),
    "not attempted yet": not_attempted("03a"),
}


@pytest.mark.parametrize("word", OUTCOMES)
def test_text_and_html_say_the_same(word):
    shown = Shown(OUTCOMES[word])
    for view in (str(shown), repr(shown), shown._repr_html_()):
        assert f"Exercise 03a: {word}." in view
        assert shown.outcome.evidence in view


def test_a_hint_is_shown_only_if_there_is_one():
    assert "Count again." in str(Shown(OUTCOMES["not there yet"]))
    assert "Hint" not in str(Shown(OUTCOMES["passed"]))
    assert "Hint" not in Shown(OUTCOMES["passed"])._repr_html_()


def test_what_a_learner_wrote_cannot_become_html():
    html = Shown(failed("03a", "<script>x</script>", "<b>"))._repr_html_()
    assert "<script>" not in html
    assert "<b>" not in html
