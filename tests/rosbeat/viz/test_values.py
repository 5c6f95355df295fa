"""Numbers over virtual time: values of topics with their bands, and two runs compared."""

import math

import numpy as np
import pytest

from pictures import is_tidy, words_in
from record_builders import sample
from rosbeat.comparisons import compare
from rosbeat.errors import PictureError
from rosbeat.viz import comparison, theme, values

BANDS = {"Low": (None, 20.0), "Normal": (20.0, 26.0), "High": (26.0, None)}
NARROW = {"a": (None, 20.0), "b": (20.0, 20.1), "c": (20.1, 20.2), "d": (20.2, None)}
WALK = [sample(time, 22 + 5 * math.sin(time)) for time in range(1, 41)]
SECOND = [sample(time, 15.0 + time / 10, node="/second") for time in range(1, 41)]
OUTSIDE = [sample(time, 5.0, topic="/outside") for time in range(3)]


def each_second(numbers, begin=0):
    return [sample(time, value) for time, value in enumerate(numbers, begin)]


def plot(picture):
    return picture.figure.axes[1]


def steps(picture):
    return [line for line in plot(picture).lines if line.get_drawstyle() == "steps-post"]


def test_every_message_is_a_step_with_a_mark():
    picture = values(WALK)
    (line,) = steps(picture)
    assert list(line.get_xdata()) == [float(time) for time in range(1, 41)]
    assert list(line.get_ydata()) == [one.value for one in WALK]
    assert line.get_marker() == "o"
    assert "/sensor" not in words_in(picture)  # one publisher needs no key
    (line,) = steps(values(each_second([1.0, math.inf, 3.0])))
    assert np.isnan(line.get_ydata()[1])
    (line,) = steps(values(each_second(float(k % 7) for k in range(600))))
    assert line.get_marker() == "None"  # 600 marks would run together
    many = [*each_second(float(k % 7) for k in range(600)), *SECOND]
    first, second = steps(values(many))
    assert (first.get_markevery(), second.get_markevery()) == (60, 1)  # shapes tell lines apart


def test_two_publishers_have_two_styles():
    drawn = steps(values(WALK + SECOND, "temperature"))
    assert [line.get_color() for line in drawn] == [theme.BLUE, theme.VERMILLION]
    assert [line.get_marker() for line in drawn] == ["o", "s"]


def test_bands_are_visible_even_without_values():
    picture = values(each_second([22.0, 22.5]), bands=BANDS)
    low, high = plot(picture).get_ylim()
    assert low < 20
    assert high > 26
    assert len(plot(picture).patches) == 3


@pytest.mark.parametrize(
    ("samples", "given", "written"),
    [
        (WALK, {"label": "Temperature", "unit": "°C"}, {"Temperature in °C", "virtual time in s"}),
        (WALK, {"bands": BANDS, "unit": "°C"},
         {"Low", "Normal", "High", "below 20 °C", "20 to 26 °C"}),
        (WALK, {"bands": NARROW}, set()),
        (WALK + SECOND, {"topic": "temperature"}, {"/sensor", "/second"}),
        (WALK + OUTSIDE, {"topic": ["temperature", "outside"]}, {"/outside from /sensor"}),
        ([sample(1, 3.0 + k) for k in range(5)], {}, set()),  # all in one instant
        *((each_second(numbers), {"bands": BANDS}, set()) for numbers in (
            [-1000.0, -999.0], [0.0], [5.0] * 3, [1e-9, 2e-9], [1e12, -1e12],
            [20.0 + k % 9 for k in range(600)])),
    ],
)  # fmt: skip
def test_names_are_written_and_stay_readable(samples, given, written):
    picture = values(samples, **given)
    assert written <= set(words_in(picture))
    assert is_tidy(picture)


@pytest.mark.parametrize(
    ("numbers", "bands", "unit", "words"),
    [
        ([19.0, 21.0, 30.25], {"Normal": (20.0, 26.0), "Low": (None, 20.0)}, "°C",
         "Temperature over virtual time, in °C. 3 values on /temperature from /sensor, from 1 s to "
         "3 s. They lie between 19 and 30.25 °C: first 19, last 30.25 °C. Of these, 1 Low (below "
         "20 °C), 1 Normal (20 to 26 °C) and 1 in no band."),
        ([1.0, math.nan, -math.inf], {"Any": (None, None)}, "", "2 values are infinite or not a "
         "number and left out. Of these, 1 Any (any value)"),
        ([3.0], None, "", "at 1 s. It is 3."),
        ([3.0, 3.0], None, "", "All of them are 3."),
        ([-0.123456, 1013.25], None, "", "between −0.1235 and 1013.25"),
        # A limit belongs to the band that is closed there, as in the monitor.
        *(([value], BANDS, "", f"1 {name} (") for value, name in
          ((19.9, "Low"), (20.0, "Normal"), (26.0, "Normal"), (26.01, "High"))),
        ([26.0], {"Open": (26.0, None)}, "", "none Open ("),
        ([20.0], {"Open": (None, 20.0)}, "", "none Open ("),
        ([0, 5, 9, 10], {"a": (0, 5), "b": (5, 9)}, "",  # a value in two bands is of the first
         "Of these, 2 a (0 to 5), 1 b (5 to 9) and 1 in no band."),
    ],
)  # fmt: skip
def test_its_words(numbers, bands, unit, words):
    samples = each_second(numbers, begin=1)
    assert words in values(samples, bands=bands, label="temperature", unit=unit).description


@pytest.mark.parametrize("pair", [(26, 20), (1, 1), (1,), 5, ("a", "b"), None])
def test_a_band_that_is_none_gets_three_parts(pair):
    with pytest.raises(PictureError, match="has the limits") as caught:
        values(WALK, bands={"Odd": pair})
    assert "'Odd'" in caught.value.what
    assert "bands=" in caught.value.to_try


# Two runs.

#: Drifts, loses some, has one more, and fails for a while.
BROKEN = sorted(
    [
        *(sample(one.time, math.nan if one.time in (20, 21) else one.value + one.time / 10)
          for one in WALK if one.time not in (5, 6, 7)),
        sample(30.5, 15.0),
    ],
    key=lambda one: one.time_ns,
)  # fmt: skip
UNUSED = {"missing in replayed", "only in replayed", "not a number"}


def compared(one, other):
    return compare(one, other, "temperature", names=("recorded", "replayed"))


def test_both_runs_and_what_one_lacks_are_drawn():
    picture = comparison(compared(WALK, BROKEN), label="temperature", unit="°C")
    one, other, missing, extra, odd = plot(picture).lines
    assert list(one.get_xdata()) == [float(time) for time in range(1, 41)]
    assert len(other.get_xdata()) == 38
    places = [list(line.get_xdata()) for line in (missing, extra, odd)]
    assert places == [[5, 6, 7], [30.5], [20, 21]]
    assert {"recorded", "replayed", "virtual time in s", *UNUSED} <= set(words_in(picture))
    assert is_tidy(picture)
    # What differs in colour differs in shape too; a missing message has the first run's mark.
    assert len({line.get_marker() for line in plot(picture).lines}) == 4
    assert one.get_linestyle() != other.get_linestyle()
    assert (one.get_markerfacecolor(), missing.get_markerfacecolor()) == (theme.BLUE, theme.CARD)
    said = picture.description
    assert said.startswith("Temperature of two runs, in °C. /temperature: 40 messages in recorded")
    assert "3 are missing in replayed" in said
    assert "2 values of the second are infinite or not a number." in said
    again = comparison(compared(WALK, BROKEN), label="temperature", unit="°C")
    assert again.svg() == picture.svg()


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ([1.0], [1.0]), ([1.0], []), ([], [1.0, 2.0]), ([math.nan, 1.0], [math.inf, 2.0]),
        ([1e12, -1e12], [0.0]),
        ([20.0 + k % 9 for k in range(600)], [20.0 + k % 7 for k in range(600)]),
    ],
)  # fmt: skip
def test_odd_runs_stay_readable(one, other):
    picture = comparison(compared(each_second(one), each_second(other)))
    assert is_tidy(picture)
    assert one != other or not UNUSED & set(words_in(picture))


def test_a_field_of_both_runs_can_be_chosen():
    one = [sample(1, {"x": 1.0, "y": 2.0}), sample(2, {"x": 3.0, "y": 4.0})]
    line, *_ = plot(comparison(compared(one, one), field="y")).lines
    assert list(line.get_ydata()) == [2.0, 4.0]
