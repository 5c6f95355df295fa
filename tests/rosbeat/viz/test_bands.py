import math

import pytest

from rosbeat.errors import PictureError
from rosbeat.viz.bands import read_bands, tally

LIMITS = {"Low": (None, 20.0), "High": (26.0, None), "Normal": (20.0, 26.0)}


def test_bands_come_in_ascending_order():
    assert [band.name for band in read_bands(LIMITS)] == ["Low", "Normal", "High"]
    assert read_bands(None) == ()


@pytest.mark.parametrize(
    ("value", "name"), [(19.9, "Low"), (20.0, "Normal"), (26.0, "Normal"), (26.01, "High")]
)
def test_a_limit_belongs_to_the_band_that_is_closed_as_in_the_monitor(value, name):
    assert [band.name for band in read_bands(LIMITS) if band.holds(value)] == [name]


def test_what_is_not_a_number_is_in_no_band():
    assert not any(band.holds(math.nan) for band in read_bands({**LIMITS, "Any": (None, None)}))


def test_ranges_in_words():
    said = [band.words("°C") for band in read_bands(LIMITS)]
    assert said == ["below 20 °C", "20 to 26 °C", "above 26 °C"]
    assert read_bands({"Any": (None, None)})[0].words() == "any value"


def test_every_value_counts_once():
    both = read_bands({"a": (0, 5), "b": (5, 9)})
    assert tally(both, [0, 5, 9, 10]) == {"a": 2, "b": 1}


@pytest.mark.parametrize("pair", [(26, 20), (1, 1), (1,), 5, ("a", "b"), None])
def test_a_band_that_is_none_gets_three_parts(pair):
    with pytest.raises(PictureError, match="has the limits") as caught:
        read_bands({"Odd": pair})
    assert "'Odd'" in caught.value.what
    assert "bands=" in caught.value.to_try
