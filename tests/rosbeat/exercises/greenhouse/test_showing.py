"""What a page shows of the greenhouse."""

from importlib.resources import files
from pathlib import Path

import pytest

from rosbeat import Session
from rosbeat.errors import ExerciseError
from rosbeat.exercises.greenhouse import requirements, weather
from rosbeat.exercises.greenhouse.rubric import SETTING, the_rubric


def test_every_requirement_is_shown_with_its_points():
    shown = requirements()
    html, text = shown.html(), " ".join(str(shown).split())
    assert repr(shown) == str(shown)
    for row in the_rubric().requirements:
        assert row.text in text
        assert f"<td>{row.id}</td>" in html
    assert "<td>1,&nbsp;optional</td>" in html  # on one line
    assert "(1, optional)" in text
    assert set(shown._repr_mimebundle_()) == {"text/plain", "text/html"}


def test_some_may_be_chosen():
    assert [row.id for row in requirements("R4", "R1").rows] == ["R1", "R4"]
    with pytest.raises(ExerciseError):
        requirements("R77")


def test_the_rubric_that_counts_is_shown(monkeypatch, tmp_path):
    text = files("rosbeat.exercises").joinpath("rubrics/greenhouse.json").read_text()
    path = tmp_path / "mine.json"
    path.write_text(text.replace('"open_above": 28.0', '"open_above": 30.0'))
    monkeypatch.setenv(SETTING, str(path))
    assert "above 30 " in str(requirements("R1"))


def test_other_weather_is_refused(says):
    with pytest.raises(ExerciseError) as caught:
        weather("snow")
    says(caught.value, "snow", "plain day")


@pytest.mark.ros
def test_the_weather_is_two_sensors_that_may_be_silent():
    with Session() as ros:
        for sensor in weather(temperature=[20.0, None, 21.5]):
            ros.add(sensor)
        ros.run(seconds=5)
        said = [(one.time, one.value) for one in ros.messages("temperature")]
        assert said == [(1.0, 20.0), (3.0, 21.5)]
        assert ros.messages("humidity") == ()
        assert [node.get_name() for node in ros.nodes] == ["thermometer", "hygrometer"]


def test_the_page_names_the_numbers_of_the_rubric():
    n = the_rubric().numbers
    (page,) = (Path(__file__).parents[4] / "src/lessons").glob("13_*.py")
    text = page.read_text(encoding="utf-8")
    for said in (
        f'"stays as it is": ({n["close_below"]}, {n["open_above"]})',
        f'"dry": (None, {n["dry_below"]})',
        f"exactly {n['open_above']:g} opens nothing",
        f'declare_parameter("open_above", {n["open_above"]})',
        f'declare_parameter("close_below", {n["close_below"]})',
        f'declare_parameter("dry_below", {n["dry_below"]})',
        f"not {n['temperature_min']:g} <= one.value <= {n['temperature_max']:g}",
        {2.0: "two"}[n["react_seconds"]] + " seconds to happen",
    ):
        assert said in text
