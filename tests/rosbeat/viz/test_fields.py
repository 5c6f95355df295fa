import math

import pytest

from rosbeat.errors import PictureError
from rosbeat.viz.fields import paths, read, series


def test_one_series_for_each_topic_and_publisher(make):
    samples = [make.sample(1, 1.0), make.sample(2, 2.0, node="/b"), make.sample(3, math.nan)]
    lines = series(samples)
    assert [(line.node, line.times) for line in lines] == [("/sensor", (1.0, 3.0)), ("/b", (2.0,))]
    assert lines[0].finite == [1.0]


@pytest.mark.parametrize(("value", "number"), [(True, 1.0), (7, 7.0), (2.5, 2.5)])
def test_numbers_and_truth_values(make, value, number):
    assert read(make.sample(1, value)) == number


def test_nested_fields(make):
    pose = {"header": {"frame_id": "map"}, "position": {"x": 1.5, "y": 2.0}}
    assert read(make.sample(1, pose), "position.x") == 1.5
    assert [name for name, _ in paths(pose)] == ["header.frame_id", "position.x", "position.y"]


def test_a_message_with_fields_names_those_that_are_numbers(make):
    with pytest.raises(PictureError, match="Choose a field: 'x' or 'y'"):
        read(make.sample(1, {"x": 1.0, "y": 2.0, "name": "a"}))


@pytest.mark.parametrize("value", ["warm", [1.0, 2.0], None, "long " * 20])
def test_what_is_not_a_number_is_refused(make, value):
    with pytest.raises(PictureError, match="is not a number") as caught:
        read(make.sample(1, value))
    assert "Choose a topic that carries numbers." in str(caught.value)


@pytest.mark.parametrize("field", ["dta", "data.x"])
def test_an_unknown_field_names_the_known(make, field):
    with pytest.raises(PictureError, match="have no field") as caught:
        read(make.sample(1, 1.0), field)
    assert "'data'" in caught.value.means
