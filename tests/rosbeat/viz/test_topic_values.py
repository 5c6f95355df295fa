import math

import numpy as np
import pytest

from rosbeat.errors import PictureError
from rosbeat.viz import theme
from rosbeat.viz.topic_values import values

BANDS = {"Low": (None, 20.0), "Normal": (20.0, 26.0), "High": (26.0, None)}


@pytest.fixture
def walk(make):
    return [make.sample(at, 22 + 5 * math.sin(at)) for at in range(1, 41)]


def plot(picture):
    return picture.figure.axes[1]


def steps(picture):
    return [line for line in plot(picture).lines if line.get_drawstyle() == "steps-post"]


def test_every_message_is_a_step_with_a_mark(walk):
    (line,) = steps(values(walk))
    assert list(line.get_xdata()) == [float(at) for at in range(1, 41)]
    assert list(line.get_ydata()) == [sample.value for sample in walk]
    assert line.get_marker() == "o"


def test_bands_are_tinted_named_and_visible_even_without_values(make, words_in, is_tidy):
    picture = values([make.sample(1, 22.0), make.sample(2, 22.5)], bands=BANDS, unit="°C")
    assert {"Low", "Normal", "High", "below 20 °C", "20 to 26 °C"} <= set(words_in(picture))
    low, high = plot(picture).get_ylim()
    assert low < 20
    assert high > 26
    assert len(plot(picture).patches) == 3
    assert is_tidy(picture)


def test_narrow_bands_keep_their_names_apart(walk, is_tidy):
    narrow = {"a": (None, 20.0), "b": (20.0, 20.1), "c": (20.1, 20.2), "d": (20.2, None)}
    assert is_tidy(values(walk, bands=narrow))


def test_two_publishers_have_two_styles_and_a_key(make, walk, words_in, is_tidy):
    other = [make.sample(at, 15.0 + at / 10, node="/second") for at in range(1, 41)]
    picture = values(walk + other, "temperature")
    assert [line.get_color() for line in steps(picture)] == [theme.BLUE, theme.VERMILLION]
    assert [line.get_marker() for line in steps(picture)] == ["o", "s"]
    assert {"/sensor", "/second"} <= set(words_in(picture))
    assert is_tidy(picture)


def test_several_topics_are_named_with_their_publisher(make, walk, words_in):
    outside = [make.sample(at, 5.0, topic="/outside") for at in range(3)]
    picture = values(walk + outside, ["temperature", "outside"])
    assert "/outside from /sensor" in words_in(picture)


def test_one_publisher_needs_no_key(walk, words_in):
    assert "/sensor" not in words_in(values(walk))


def test_label_unit_and_axis_are_written(walk, words_in):
    said = words_in(values(walk, label="Temperature", unit="°C"))
    assert {"Temperature in °C", "virtual time in s"} <= set(said)


def test_what_is_not_a_number_leaves_a_gap(make):
    (line,) = steps(values([make.sample(at, v) for at, v in enumerate([1.0, math.inf, 3.0])]))
    assert np.isnan(line.get_ydata()[1])


@pytest.mark.parametrize(
    "numbers",
    [
        [-1000.0, -999.0],
        [0.0],
        [5.0] * 3,
        [1e-9, 2e-9],
        [1e12, -1e12],
        [20.0 + k % 9 for k in range(600)],
    ],
)
def test_odd_values_stay_readable(make, numbers, is_tidy):
    picture = values([make.sample(at, v) for at, v in enumerate(numbers)], bands=BANDS)
    assert is_tidy(picture)


def test_all_in_one_instant(make, is_tidy):
    assert is_tidy(values([make.sample(1, 3.0 + k) for k in range(5)]))


def test_many_messages_get_fewer_marks(make):
    (line,) = steps(values([make.sample(at, float(at % 7)) for at in range(600)]))
    assert line.get_markevery() == 10


@pytest.mark.parametrize(
    ("samples", "arguments", "words"),
    [
        (lambda m: [], {}, "no messages"),
        (lambda m: [m.sample(1, 2.0)], {"topic": "/tmperature"}, "Did you mean '/temperature'"),
        (
            lambda m: [m.sample(1, 2.0), m.sample(1, 2.0, topic="/x")],
            {},
            "Choose one: /temperature, /x",
        ),
        (lambda m: [m.sample(1, math.nan)], {}, "Every value is infinite or not a number"),
        (lambda m: [m.sample(1, "warm")], {}, "is not a number"),
    ],
)
def test_bad_input_gets_three_parts(make, samples, arguments, words):
    with pytest.raises(PictureError) as caught:
        values(samples(make), **arguments)
    assert words in str(caught.value)
    assert caught.value.means
    assert caught.value.to_try
