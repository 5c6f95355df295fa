"""Hints: one more at each call, about the last mistake, and the answer at last."""

import pytest

from parsed_html import Parsed
from rosbeat import check, hint
from rosbeat.errors import ExerciseError
from rosbeat.exercises import registry
from rosbeat.exercises.exercise import Exercise, failed
from rosbeat.exercises.hint import answer_to, are_here
from rosbeat.exercises.progress import progress_file
from rosbeat.exercises.registry import EXERCISES

HINTS = ("Look at the <timer>.", "Its first argument is a time.")
ANSWER = answer_to("03a")


@pytest.fixture(autouse=True)
def _home(tmp_path, monkeypatch):
    monkeypatch.setenv("ROSBEAT_STEADY_HOME", str(tmp_path))
    exercise = Exercise("03a", None, None, "another sensor", 1, HINTS)
    monkeypatch.setitem(registry.EXERCISES, "03a", exercise)


def test_each_call_gives_one_hint_more_and_the_answer_last():
    first, second, third, fourth = (hint("03a") for _ in range(4))
    assert str(first) == (f'• Hint 1 of 2 for exercise 03a: {HINTS[0]}\n  One more: hint("03a")')
    assert HINTS[1] in str(second)
    assert HINTS[0] not in str(second)
    assert str(second).endswith(
        '\n  The next one is the answer.\n  The earlier ones again: hint("03a", again=True)'
    )
    assert "    class HumiditySensor(Node):\n" in str(third)
    assert third == fourth
    assert third.answer == ANSWER


def test_those_so_far_are_shown_again_and_not_counted():
    assert "For a first hint: " in str(hint("03a", again=True))
    hint("03a")
    hint("03a")
    for _ in range(2):
        again = str(hint("03a", again=True))
        assert all(text in again for text in HINTS)
        assert again.endswith("The next one is the answer.")
    hint("03a")
    assert hint("03a", again=True).hints == hint("03a", again=True).hints != ()
    assert hint("03a", again=True).answer == ANSWER


def test_an_exercise_without_a_cell_says_where_the_answer_is(monkeypatch):
    bare = Exercise("system", None, None, "", 1, HINTS)
    monkeypatch.setitem(registry.EXERCISES, "system", bare)
    assert "solution page" in [str(hint("system")) for _ in range(3)][-1]


def test_without_answers_the_last_hint_stays(monkeypatch):
    hint("03a")
    monkeypatch.setattr("rosbeat.exercises.hint.are_here", lambda: False)
    second, third = str(hint("03a")), str(hint("03a"))
    assert HINTS[1] in second
    assert second == third
    assert "This was the last hint. Your instructor can tell you more." in second
    assert not progress_file().standings()["03a"].answer


def test_html_says_the_same_escaped():
    bundles = [hint("03a")._repr_mimebundle_() for _ in range(3)]
    assert "Look at the &lt;timer&gt;." in bundles[0]["text/html"]
    assert "The next one is the answer." in bundles[1]["text/html"]
    assert "class HumiditySensor(Node):\n" in Parsed(bundles[2]["text/html"]).text
    assert "<pre><span style=" in bundles[2]["text/html"]
    assert all(set(bundle) == {"text/plain", "text/html"} for bundle in bundles)


# After a check.


def fail_with(mistake, lead="Compare the two names."):
    outcome = failed("03a", "Nothing came.", lead, mistake)
    progress_file().change("03a", lambda before: before.after(outcome))


def test_the_first_hint_after_a_check_is_about_the_mistake_it_named():
    hint("03a")
    fail_with("topic-misspelled")
    first, second, third = str(hint("03a")), str(hint("03a")), hint("03a")
    assert first == (
        "• Your last check of 03a found: a topic name that no other node uses. "
        'Compare the two names.\n  One more: hint("03a")'
    )
    assert HINTS[1] in second
    assert third.answer == ANSWER


@pytest.mark.parametrize("mistake", ["new-to-me", "never-heard-of"])
def test_a_check_that_named_nothing_leaves_the_hints_as_they_are(mistake):
    fail_with(mistake)
    assert HINTS[0] in str(hint("03a"))


# Without an exercise.


@pytest.mark.parametrize("call", [hint, check])
def test_a_call_without_an_exercise_offers_those_of_the_page(call, monkeypatch, says):
    monkeypatch.setenv("JPY_SESSION_NAME", "/home/ana/notebooks/04_write_a_subscriber.ipynb")
    with pytest.raises(ExerciseError, match="was not told which exercise") as caught:
        call()
    says(caught.value, "on this page", "04a (", "04c (", f'{call.__name__}("04a"')


def test_a_check_without_an_answer_says_what_to_hand_over(says):
    with pytest.raises(ExerciseError) as caught:
        check("03a")
    says(caught.value, "no answer to exercise 03a", 'check("03a", ...)')


# Answers.


def test_every_exercise_of_a_page_has_an_answer_without_a_blank():
    for name in EXERCISES:
        if name[:2].isdigit():
            assert answer_to(name), name
            assert "____" not in answer_to(name)
            assert "# ---" not in answer_to(name)


def test_whether_there_are_answers_at_all(monkeypatch, tmp_path):
    assert are_here()
    monkeypatch.setattr("rosbeat.exercises.hint.files", lambda _: tmp_path)
    assert not are_here()
    assert answer_to("03a") == ""
