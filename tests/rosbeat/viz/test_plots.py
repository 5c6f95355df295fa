"""Numbers over virtual time: values of topics with their bands, and two runs compared."""

import math

import numpy as np
import pytest

from rosbeat.comparisons import compare
from rosbeat.errors import PictureError
from rosbeat.viz import differences, theme, values

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


# Bands, and the same in words.


def said(make, numbers, bands=None, unit=""):
    samples = [make.sample(at, value) for at, value in enumerate(numbers, 1)]
    return values(samples, bands=bands, label="temperature", unit=unit).description


def test_count_span_range_and_bands(make):
    assert said(make, [19.0, 21.0, 30.25], {"Normal": (20.0, 26.0), "Low": (None, 20.0)}, "°C") == (
        "Temperature over virtual time, in °C. 3 values on /temperature from /sensor, from 1 s to "
        "3 s. They lie between 19 and 30.25 °C: first 19, last 30.25 °C. Of these, 1 Low (below "
        "20 °C), 1 Normal (20 to 26 °C) and 1 in no band."
    )


def test_what_is_left_out_is_said(make):
    words = said(make, [1.0, math.nan, -math.inf], {"Any": (None, None)})
    assert (
        "2 values are infinite or not a number and left out. Of these, 1 Any (any value)" in words
    )


def test_one_value_and_the_same_value_always(make):
    assert said(make, [3.0]).endswith("at 1 s. It is 3.")
    assert "All of them are 3." in said(make, [3.0, 3.0])


@pytest.mark.parametrize(
    ("value", "name"), [(19.9, "Low"), (20.0, "Normal"), (26.0, "Normal"), (26.01, "High")]
)
def test_a_limit_belongs_to_the_band_that_is_closed_as_in_the_monitor(make, value, name):
    assert f"1 {name} (" in said(make, [value], BANDS)


@pytest.mark.parametrize(("value", "open_band"), [(26.0, (26.0, None)), (20.0, (None, 20.0))])
def test_an_open_band_does_not_include_its_limit(make, value, open_band):
    assert "none Open (" in said(make, [value], {"Open": open_band})


def test_a_value_in_two_bands_counts_for_the_first(make):
    words = said(make, [0, 5, 9, 10], {"a": (0, 5), "b": (5, 9)})
    assert "Of these, 2 a (0 to 5), 1 b (5 to 9) and 1 in no band." in words


@pytest.mark.parametrize("pair", [(26, 20), (1, 1), (1,), 5, ("a", "b"), None])
def test_a_band_that_is_none_gets_three_parts(make, pair):
    with pytest.raises(PictureError, match="has the limits") as caught:
        said(make, [1.0], {"Odd": pair})
    assert "'Odd'" in caught.value.what
    assert "bands=" in caught.value.to_try


# Two runs.


@pytest.fixture
def broken(make, walk):
    """Drifts, loses some, has one more, and fails for a while."""
    kept = [one for one in walk if one.time not in (5, 6, 7)]
    drifted = [make.sample(one.time, one.value + one.time / 10) for one in kept]
    failing = [make.sample(at, math.nan) for at in (20, 21)]
    rest = [one for one in drifted if one.time not in (20, 21)]
    more = [make.sample(30.5, 15.0)]
    return sorted(rest + failing + more, key=lambda one: one.time_ns)


def compared(one, other):
    return compare(one, other, "temperature", names=("recorded", "replayed"))


def test_both_runs_and_what_one_lacks_are_drawn(walk, broken, words_in, is_tidy):
    picture = differences(compared(walk, broken), label="Temperature", unit="°C")
    one, other, missing, extra, odd = plot(picture).lines
    assert list(one.get_xdata()) == [float(at) for at in range(1, 41)]
    assert len(other.get_xdata()) == 38
    assert list(missing.get_xdata()) == [5, 6, 7]
    assert list(extra.get_xdata()) == [30.5]
    assert list(odd.get_xdata()) == [20, 21]
    assert {"Temperature in °C", "recorded", "replayed", "missing in replayed", "only in replayed",
            "not a number", "virtual time in s"} <= set(words_in(picture))  # fmt: skip
    assert is_tidy(picture)


def test_what_differs_in_colour_differs_in_shape_too(walk, broken):
    lines = plot(differences(compared(walk, broken))).lines
    looks = [(line.get_markeredgecolor(), line.get_marker()) for line in lines]
    assert len({marker for _, marker in looks}) == 4  # a missing message has the first run's mark
    one, other, missing, *_ = lines
    assert one.get_linestyle() != other.get_linestyle()
    assert (one.get_markerfacecolor(), missing.get_markerfacecolor()) == (theme.BLUE, theme.CARD)


def test_the_description_says_what_is_seen(walk, broken):
    said = differences(compared(walk, broken), label="temperature", unit="°C").description
    assert said.startswith("Temperature of two runs, in °C. /temperature: 40 messages in recorded")
    assert "3 are missing in replayed" in said
    assert "2 values of the second are infinite or not a number." in said


def test_the_same_twice_gives_the_same_bytes(walk, broken):
    first, second = (differences(compared(walk, broken)).png() for _ in range(2))
    assert first == second


def test_marks_that_are_not_used_are_not_explained(walk, words_in):
    said = words_in(differences(compared(walk, walk)))
    assert not {"missing in replayed", "only in replayed", "not a number"} & set(said)


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ([1.0], [1.0]),
        ([1.0], []),
        ([], [1.0, 2.0]),
        ([math.nan, 1.0], [math.inf, 2.0]),
        ([1e12, -1e12], [0.0]),
        ([20.0 + k % 9 for k in range(600)], [20.0 + k % 7 for k in range(600)]),
    ],
)
def test_odd_runs_stay_readable(make, one, other, is_tidy):
    runs = ([make.sample(at, v) for at, v in enumerate(numbers)] for numbers in (one, other))
    assert is_tidy(differences(compared(*runs)))


def test_a_field_of_both_runs_can_be_chosen(make):
    one = [make.sample(1, {"x": 1.0, "y": 2.0}), make.sample(2, {"x": 3.0, "y": 4.0})]
    line, *_ = plot(differences(compared(one, one), field="y")).lines
    assert list(line.get_ydata()) == [2.0, 4.0]


@pytest.mark.parametrize(
    ("numbers", "given", "words"),
    [
        ([math.nan], {}, "no value to draw"),
        (["warm"], {}, "is not a number"),
        ([1.0], {"field": "x"}, "have no field 'x'"),
    ],
)
def test_bad_runs_get_three_parts(make, numbers, given, words):
    samples = [make.sample(at, value) for at, value in enumerate(numbers)]
    with pytest.raises(PictureError) as caught:
        differences(compared(samples, samples), **given)
    assert words in str(caught.value)
    assert caught.value.means
    assert caught.value.to_try


def test_what_is_no_comparison_is_refused():
    with pytest.raises(PictureError, match="cannot be drawn from 'int'"):
        differences(3)
