import math

from rosbeat.viz.bands import read_bands
from rosbeat.viz.fields import series
from rosbeat.viz.value_words import describe

BANDS = read_bands({"Low": (None, 20.0), "Normal": (20.0, 26.0)})


def said(make, values, bands=(), unit=""):
    lines = series([make.sample(at, value) for at, value in enumerate(values, 1)])
    return describe(lines, bands, "temperature", unit)


def test_count_span_range_and_bands(make):
    assert said(make, [19.0, 21.0, 30.25], BANDS, "°C") == (
        "Temperature over virtual time, in °C. 3 values on /temperature from /sensor, from 1 s to "
        "3 s. They lie between 19 and 30.25 °C: first 19, last 30.25 °C. Of these, 1 Low (below "
        "20 °C), 1 Normal (20 to 26 °C) and 1 in no band."
    )


def test_what_is_left_out_is_said(make):
    assert "2 values are infinite or not a number and left out." in said(
        make, [1.0, math.nan, -math.inf]
    )


def test_one_value(make):
    assert said(make, [3.0]).endswith("at 1 s. It is 3.")


def test_the_same_value_always(make):
    assert "All of them are 3." in said(make, [3.0, 3.0])
