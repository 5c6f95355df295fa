"""The number that a fault changes."""

import pytest

from rosbeat.bags import drift, with_nan
from rosbeat.errors import BagError

IMU = {"angular": {"x": 1.0, "y": 2.0}, "valid": True, "label": "a", "list": [1.0]}


def test_a_field_of_a_larger_message(make):
    one = make.sample(10, IMU)
    (found,) = drift(1, field="angular.y")([one])
    assert found.data == {**IMU, "angular": {"x": 1.0, "y": 12.0}}
    assert one.data["angular"]["y"] == 2.0


def test_whole_numbers_stay_whole(make):
    (found,) = drift(0.26)([make.sample(10, 5)])
    assert found.value == 8
    assert isinstance(found.value, int)


@pytest.mark.parametrize(
    ("value", "fault", "words"),
    [
        ("warm", drift(1), "holds no number"),
        (True, drift(1), "holds no number"),
        (IMU, drift(1), "'angular.x', 'angular.y'"),
        (IMU, drift(1, field="angular.z"), "the field 'angular.z'"),
        (IMU, with_nan(field="angular"), "the field 'angular'"),
        (3, with_nan(), "whole numbers, and NaN is not one"),
    ],
)
def test_a_message_that_cannot_have_the_fault_gets_three_parts(make, says, value, fault, words):
    with pytest.raises(BagError) as caught:
        fault([make.sample(1, value)])
    says(caught.value, words)
