from rosbeat.exercises.hint import answer_to, are_here
from rosbeat.exercises.registry import EXERCISES


def test_every_exercise_of_a_page_has_an_answer_without_a_blank():
    for name in EXERCISES:
        if name[:2].isdigit():
            assert answer_to(name), name
            assert "____" not in answer_to(name)
            assert "# ---" not in answer_to(name)


def test_commands_come_with_the_terminal_that_they_are_for():
    assert answer_to("01b").startswith("%%terminal two\ncd ")


def test_what_is_no_exercise_has_none():
    assert answer_to("99z") == ""


def test_whether_there_are_answers_at_all(monkeypatch, tmp_path):
    assert are_here()
    monkeypatch.setattr("rosbeat.exercises.hint.files", lambda _: tmp_path)
    assert not are_here()
    assert answer_to("03a") == ""
