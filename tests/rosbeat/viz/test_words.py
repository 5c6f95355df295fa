import pytest

from rosbeat.viz import words


@pytest.mark.parametrize(("number", "said"), [(0, "no nodes"), (1, "1 node"), (2, "2 nodes")])
def test_count(number, said):
    assert words.count(number, "node") == said


def test_count_with_an_irregular_plural():
    assert words.count(2, "entry", "entries") == "2 entries"


@pytest.mark.parametrize(
    ("names", "said"), [([], ""), (["a"], "a"), (["a", "b"], "a and b"), ("abc", "a, b and c")]
)
def test_listing(names, said):
    assert words.listing(names) == said


@pytest.mark.parametrize(
    ("value", "said"), [(20.0, "20"), (-1.5, "−1.5"), (1e6, "1e+06"), (10.530212, "10.5302")]
)
def test_number(value, said):
    assert words.number(value) == said


@pytest.mark.parametrize(
    ("value", "said"), [(10.530212, "10.53"), (1013.25, "1013.25"), (-0.123456, "−0.1235")]
)
def test_rounded(value, said):
    assert words.rounded(value) == said


@pytest.mark.parametrize(
    ("time_ns", "said"),
    [(0, "0 s"), (1_500_000_000, "1.5 s"), (-1, "−0.000000001 s"), (60 * 10**9, "60 s")],
)
def test_seconds(time_ns, said):
    assert words.seconds(time_ns) == said


@pytest.mark.parametrize(
    ("numbers", "said"),
    [([], ""), ([3], "3"), ([1, 2], "1 and 2"), ([1, 2, 3, 5], "1 to 3 and 5")],
)
def test_ranges(numbers, said):
    assert words.ranges(numbers) == said


def test_ranges_stop_before_they_bore():
    assert words.ranges(range(0, 100, 2), most=2) == "0, 2 and 48 more"


def test_nearest_forgives_the_slash_and_a_slip():
    assert words.nearest("temprature", ["/temperature", "/humidity"]) == "/temperature"
    assert words.nearest("xyz", ["/temperature"]) == ""


def test_sentence_case():
    assert words.sentence_case("a ROS node") == "A ROS node"


@pytest.mark.parametrize(
    ("number", "said"), [(0, ""), (1, "1 moment is not shown."), (2, "2 moments are not shown.")]
)
def test_not_shown(number, said):
    assert words.not_shown(number, "moment") == said
