import pytest

from rosbeat import Session, check
from rosbeat.errors import ExerciseError
from rosbeat.exercises.checking import EXERCISES

pytestmark = pytest.mark.ros


def test_an_unknown_exercise_is_refused_with_the_nearest_one():
    with pytest.raises(ExerciseError, match="no exercise '3a'") as caught:
        check("3a", object)
    assert 'check("03a"' in caught.value.to_try


def test_ids_are_a_page_and_a_letter():
    assert all(len(key) == 3 and key[:2].isdigit() and key[2].isalpha() for key in EXERCISES)


def test_a_check_leaves_the_learners_session_alone(capsys):
    import answers as a

    with Session(seed=1) as ros:
        ros.add(a.RoomSensor)
        ros.run(3)
        before = ros.observation()
        check("03b", a.RoomSensor)
        assert ros.observation() == before
        ros.run(1)
    with Session(seed=1) as ros:
        ros.add(a.RoomSensor)
        ros.run(4)
        assert [s.value for s in ros.messages("temperature")][:3] == [
            s.value for s in before.samples
        ]
    assert capsys.readouterr().err == ""
