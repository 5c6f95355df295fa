import pytest
from rclpy.node import Node

from rosbeat import Session, check
from rosbeat.errors import ExerciseError
from rosbeat.exercises.check import EXERCISES
from rosbeat.exercises.progress import Standing, progress_file

pytestmark = pytest.mark.ros


def test_an_unknown_exercise_is_refused_with_the_nearest_one():
    with pytest.raises(ExerciseError, match="no exercise '3a'") as caught:
        check("3a", object)
    assert 'check("03a"' in caught.value.to_try


def test_ids_of_pages_are_a_page_and_a_letter():
    ids = [key for key in EXERCISES if key[0].isdigit()]
    assert all(len(key) == 3 and key[:2].isdigit() and key[2].isalpha() for key in ids)


def test_every_check_is_remembered_with_its_points_and_its_mistake(tmp_path, monkeypatch):
    monkeypatch.setenv("ROSBEAT_STEADY_HOME", str(tmp_path))
    import answers as a

    class Untouched(Node):
        def __init__(self):
            super().__init__("humidity_sensor")
            self.publisher_ = self.create_publisher(____)  # noqa: F821

    check("03a", Untouched)
    assert progress_file().standings()["03a"] == Standing()
    failed = check("03a", a.ShallowHumiditySensor).outcome
    passed = check(" 03A ", a.HumiditySensor).outcome
    check("03a", a.ShallowHumiditySensor)
    check("03a", Untouched)
    assert progress_file().standings()["03a"] == Standing(
        "not attempted", True, passed.points, attempts=3, mistake=failed.mistake
    )


def test_a_refused_check_leaves_no_trace(tmp_path, monkeypatch):
    monkeypatch.setenv("ROSBEAT_STEADY_HOME", str(tmp_path))
    with pytest.raises(ExerciseError):
        check("01a", tmp_path / "nowhere")
    assert list(tmp_path.iterdir()) == []


def test_a_check_answers_though_nothing_can_be_remembered(tmp_path, monkeypatch, capsys):
    (tmp_path / ".rosbeat").write_text("mine")
    monkeypatch.setenv("ROSBEAT_STEADY_HOME", str(tmp_path))
    (tmp_path / "resources/sounds/alarm").mkdir(parents=True)
    assert [check("01a", tmp_path).outcome.status for _ in range(3)] == ["passed"] * 3
    assert capsys.readouterr().out.count("cannot be saved") == 1


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
