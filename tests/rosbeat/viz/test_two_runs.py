import math

import pytest

from rosbeat.comparisons import compare
from rosbeat.errors import PictureError
from rosbeat.viz import theme
from rosbeat.viz.two_runs import differences


@pytest.fixture
def walk(make):
    return [make.sample(at, 22 + 5 * math.sin(at)) for at in range(1, 41)]


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


def plot(picture):
    return picture.figure.axes[1]


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
    runs = ([make.sample(at, v) for at, v in enumerate(values)] for values in (one, other))
    assert is_tidy(differences(compared(*runs)))


def test_a_field_can_be_chosen(make):
    one = [make.sample(1, {"x": 1.0, "y": 2.0}), make.sample(2, {"x": 3.0, "y": 4.0})]
    line, *_ = plot(differences(compared(one, one), field="y")).lines
    assert list(line.get_ydata()) == [2.0, 4.0]


@pytest.mark.parametrize(
    ("values", "given", "words"),
    [
        ([math.nan], {}, "no value to draw"),
        (["warm"], {}, "is not a number"),
        ([1.0], {"field": "x"}, "have no field 'x'"),
    ],
)
def test_bad_input_gets_three_parts(make, values, given, words):
    samples = [make.sample(at, value) for at, value in enumerate(values)]
    with pytest.raises(PictureError) as caught:
        differences(compared(samples, samples), **given)
    assert words in str(caught.value)
    assert caught.value.means
    assert caught.value.to_try


def test_what_is_no_comparison_is_refused():
    with pytest.raises(PictureError, match="cannot be drawn from 'int'"):
        differences(3)
