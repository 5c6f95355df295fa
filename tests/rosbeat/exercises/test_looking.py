"""What is handed over instead of a workspace is named plainly."""

import pytest

from rosbeat.errors import ExerciseError
from rosbeat.exercises.scenarios import look_at_workspace


def test_a_workspace_that_is_not_there_is_named_by_its_path(tmp_path):
    gone = tmp_path / "gone"
    for answer in (gone, str(gone)):
        with pytest.raises(ExerciseError) as caught:
            look_at_workspace(answer)
        assert caught.value.what == f"There is no workspace at {gone}."


@pytest.mark.parametrize("answer", [None, 3, "", " "])
def test_something_else_is_shown_as_it_is(answer, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(ExerciseError) as caught:
        look_at_workspace(answer)
    assert caught.value.what == f"There is no workspace at {answer!r}."
