"""Page 13: the rubric, the weather, what a page shows, the models, and the parts of an outcome."""

import json
from importlib.resources import files
from itertools import combinations
from pathlib import Path

import answers  # the folder is put on the path by conftest.py
import pytest
from rclpy.node import Node
from std_msgs.msg import Float32

from bank.pages import solution
from bank.running import outcome_of
from rosbeat.errors import ExerciseError
from rosbeat.exercises import greenhouse
from rosbeat.exercises.evidence import from_json, to_json
from rosbeat.exercises.greenhouse import (
    BROKEN,
    DROUGHT,
    KNOWN,
    LOSSY,
    OTHER,
    PLAIN,
    SETTING,
    TOTAL,
    USUAL,
    parse_rubric,
    read_rubric,
    requirements,
    weather,
)
from rosbeat.exercises.model import agree
from rosbeat.exercises.page_13 import (
    JUDGES,
    REPORTERS,
    VENTS,
    Reports,
    Trials,
    held_temperatures,
    is_near,
    observe_greenhouse,
    observe_vent,
    reached,
)
from rosbeat.exercises.registry import EXERCISES
from rosbeat.records import Endpoint, Fault, GraphSnapshot, Observation, QoS

# The rubric.

OWN = files("rosbeat.exercises").joinpath("rubrics/greenhouse.json").read_text(encoding="utf-8")


def changed(edit):
    data = json.loads(OWN)
    edit(data)
    return json.dumps(data)


def number(name, value):
    return changed(lambda data: data["numbers"].update({name: value}))


def row(**values):
    return changed(lambda data: data["requirements"][0].update(values))


def test_the_courses_own_rubric_holds_everything(monkeypatch):
    monkeypatch.delenv(SETTING, raising=False)
    rubric = read_rubric()
    assert [one.id for one in rubric.requirements] == list(KNOWN) == list(JUDGES)
    assert sum(one.points for one in rubric.requirements) == TOTAL == EXERCISES["13b"].points
    assert not any("{" in one.text for one in rubric.requirements)


def test_another_one_may_be_named(monkeypatch, tmp_path):
    path = tmp_path / "mine.json"
    path.write_text(number("open_above", 31.5))
    monkeypatch.setenv(SETTING, str(path))
    assert "above 31.5 " in read_rubric().requirements[0].text
    assert "above 31.5 " in str(requirements("R1"))


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("{", ["not JSON"]),
        ('{"numbers": [], "requirements": {}}', ["numbers"]),
        (changed(lambda data: data["numbers"].pop("open_above")), ["`open_above` is missing"]),
        (number("hue", 3), ["no number `hue`"]),
        (number("open_above", "28"), ["should be a number"]),
        (number("rest_seconds", 1000), ["from 1 to 120"]),
        (number("close_below", 28.0), ["at least 1 below"]),
        (number("dry_below", 5.0), ["from 20 to 70"]),
        (number("pump_seconds", 4), ["`react_seconds` has to be"]),
        (row(points=4), ["add up to 21"]),
        (row(points=-1), ["none below 0"]),
        (row(id="R99"), ["may stand there once"]),
        (row(text="above {hue}"), ["the text of R1"]),
        (changed(lambda data: [r.update(required=False) for r in data["requirements"]]),
         ["nothing is required"]),
        (changed(lambda data: data["numbers"].update(open_above=59.0, dry_below=5.0)),
         ["`open_above`", "`dry_below`"]),
    ],
)  # fmt: skip
def test_what_is_wrong_in_a_rubric_is_said(text, said, says):
    with pytest.raises(ExerciseError) as caught:
        parse_rubric(text, "mine.json")
    says(caught.value, "mine.json", *said)


# The weather.

OTHERS = {
    **USUAL, "open_above": 23.3, "close_below": 21.1, "dry_below": 55.7, "react_seconds": 3.0,
    "pump_seconds": 8.0, "rest_seconds": 12.0, "silent_seconds": 9.0,
}  # fmt: skip
DAYS = (
    greenhouse.plain_day,
    greenhouse.broken_day,
    greenhouse.drought,
    greenhouse.lossy_day,
    greenhouse.other_day,
)


#: Seeds of the weather; the first one is the page's.
SEEDS = range(20)


@pytest.mark.parametrize("numbers", [USUAL, OTHERS], ids=["usual", "others"])
@pytest.mark.parametrize("make", DAYS)
def test_both_sensors_have_a_reading_or_a_silence_for_each_second(make, numbers):
    for seed in SEEDS:
        day = make(numbers, seed)
        assert len(day.temperature) == len(day.humidity) == day.seconds - 1
        assert all(0 < at < day.seconds for at in day.marks.values())
        assert sorted(day.marks.values()) == list(day.marks.values())


@pytest.mark.parametrize("numbers", [USUAL, OTHERS], ids=["usual", "others"])
def test_the_vent_is_tried_on_every_side_of_both_limits_and_has_time(numbers):
    limits = numbers["open_above"], numbers["close_below"]
    for day in (greenhouse.airing(numbers, seed) for seed in SEEDS):
        values = {value for _, _, value in day.held}
        for limit in limits:
            # A limit that no Float32 holds is met by no reading.
            assert (limit in values) == (greenhouse.as_float32(limit) == limit)
            assert any(limit - 2 < one < limit for one in values)
            assert any(limit < one < limit + 2 for one in values)
        for begins, ends, value in day.held:
            assert set(day.temperature[begins - 1 : ends - 1]) == {value}
            assert ends - begins > numbers["react_seconds"]


# What a page shows.


def test_requirements_and_days_are_chosen_by_name(says):
    assert [one.id for one in requirements("R4", "R1").rows] == ["R1", "R4"]
    with pytest.raises(ExerciseError):
        requirements("R77")
    with pytest.raises(ExerciseError) as caught:
        weather("snow")
    says(caught.value, "snow", "plain day")


def test_the_page_names_the_numbers_of_the_rubric():
    n = read_rubric().numbers
    (page,) = (Path(__file__).parents[3] / "src/lessons").glob("13_*.py")
    text = page.read_text(encoding="utf-8")
    for said in (
        f'"stays as it is": ({n["close_below"]}, {n["open_above"]})',
        f'"dry": (None, {n["dry_below"]})',
        f"at exactly {n['open_above']:g}, the vent doesn't open",
        f'declare_parameter("open_above", {n["open_above"]})',
        f'declare_parameter("close_below", {n["close_below"]})',
        f'declare_parameter("dry_below", {n["dry_below"]})',
        f"outside {n['temperature_min']:g} to {n['temperature_max']:g} degrees",
        {2.0: "two"}[n["react_seconds"]] + " seconds to do whatever",
    ):
        assert said in text


# The models.


def assert_told_apart(suspects, right, fed, same):
    for one in suspects:
        assert not all(agree(one.model(each), right(each), same) for each in fed), one
    for one, other in combinations(suspects, 2):
        alike = all(agree(one.model(each), other.model(each), same) for each in fed)
        assert not alike or (one.mistake, one.hint) == (other.mistake, other.hint), (one, other)


def test_the_plain_day_tells_vents_from_the_right_one_and_from_each_other():
    for seed in SEEDS:
        fed = [held for _, _, held in held_temperatures(greenhouse.airing(USUAL, seed), USUAL)]
        assert_told_apart(
            VENTS, lambda held: {0: (held.right,)}, fed, lambda one, other: one == other
        )


@pytest.mark.parametrize("numbers", [USUAL, OTHERS], ids=["usual", "others"])
def test_a_drought_outlasts_the_longest_rest_that_is_allowed(numbers):
    for seed in SEEDS:
        day, react = greenhouse.drought(numbers, seed), numbers["react_seconds"]
        stopped = day.marks["dry"] + react + numbers["pump_seconds"] + 1
        assert (
            stopped + greenhouse.PATIENCE * numbers["rest_seconds"] + react + 1 < day.marks["wet"]
        )
        dry = day.humidity[day.marks["dry"] - 1 : day.marks["wet"] - 1]
        assert set(dry) == {greenhouse.air(numbers, seed).dry, None}


def test_the_plain_day_tells_reports_from_the_right_one_and_from_each_other():
    for seed in SEEDS:
        day = greenhouse.plain_day(USUAL, seed)
        fed = Reports(day, tuple(range(10, day.seconds, 10)))
        means = {at: (sum(day.temperature[at - 10 : at]) / 10,) for at in fed.times}
        assert_told_apart(REPORTERS, lambda _, means=means: means, [fed], is_near)


def test_a_topic_leads_through_nodes_and_services_and_never_back_to_publishers():
    ends = (
        ("/a", "/in", "subscription"), ("/a", "/middle", "publisher"),
        ("/b", "/middle", "subscription"), ("/b", "/ask", "server"),
        ("/c", "/ask", "client"), ("/c", "/out", "publisher"),
        ("/d", "/else", "subscription"), ("/d", "/other", "publisher"), ("/e", "/in", "publisher"),
    )  # fmt: skip
    graph = GraphSnapshot((), tuple(Endpoint(a, b, "x", kind, QoS()) for a, b, kind in ends))
    assert reached(graph, "/in") == {"/in", "/middle", "/ask", "/out"}
    assert reached(graph, "/else") == {"/else", "/other"}


# Trials, and their outcomes.

EMPTY = Observation(
    175 * 10**9, 0, graph=GraphSnapshot(("/a",), (Endpoint("/a", "/x", "t", "publisher", QoS()),))
)


def trials(plain=EMPTY):
    return Trials(USUAL, {PLAIN: plain, **dict.fromkeys((BROKEN, LOSSY, DROUGHT, OTHER), EMPTY)})


def raised(kind, text, callback="__init__", node=""):
    fault = Fault(0, node, callback, kind, text, 3, "x = 1")
    return trials(
        Observation(0, 0, faults=(fault,), graph=EMPTY.graph if node else GraphSnapshot())
    )


@pytest.mark.parametrize(
    ("seen", "status", "mistake", "parts"),
    [
        (raised("NameError", "name '____' is not defined"), "not attempted", "", 0),
        (raised("NoSystemError", "It is of type int.", "add"), "failed", "no-system", 0),
        (raised("SessionError", "Not with name=3.", "run"), "failed", "no-system", 0),
        (raised("DeadlinePassed", "running after 5 s"), "failed", "constructor-blocks", 0),
        (raised("ZeroDivisionError", "division by zero", "report", "/a"),
         "failed", "division-by-zero", len(KNOWN)),
    ],
)  # fmt: skip
def test_what_was_raised_comes_before_the_requirements(seen, status, mistake, parts):
    outcome = EXERCISES["13b"].judged(seen)
    assert (outcome.status, outcome.mistake, len(outcome.parts)) == (status, mistake, parts)


@pytest.mark.parametrize("exercise", ["13a", "13b"])
def test_trials_are_made_with_the_numbers_that_count(exercise, says):
    assert EXERCISES[exercise].given() == {"numbers": read_rubric().numbers}
    with pytest.raises(ExerciseError) as caught:
        EXERCISES[exercise].judged(Trials({**USUAL, "react_seconds": 1000.0}, trials().runs))
    says(caught.value, "another rubric")


class Listener(Node):
    """Hears temperatures, and publishes nothing."""

    def __init__(self):
        super().__init__("listener")
        self.create_subscription(Float32, "temperature", lambda _: None, 10)


@pytest.mark.ros
def test_a_vent_is_run_in_the_weather_of_the_numbers_that_are_handed_over():
    numbers = {**USUAL, "open_above": 20.0, "close_below": 15.0}
    seen = observe_vent(Listener, numbers=numbers)
    fed = [one.value for one in seen.plain.samples if one.topic == "/temperature"]
    assert fed == greenhouse.airing(numbers).temperature
    assert seen.numbers == numbers
    assert from_json(to_json(seen)) == seen


@pytest.mark.ros
def test_a_system_goes_through_every_trial_and_something_else_through_one():
    seen = observe_greenhouse(lambda: [Listener])
    assert list(seen.runs) == [PLAIN, BROKEN, LOSSY, DROUGHT, OTHER]
    assert from_json(to_json(seen)).numbers == seen.numbers == observe_vent(Listener).numbers
    none = observe_greenhouse(lambda: 3)
    assert list(none.runs) == [PLAIN]
    assert [one.kind for one in none.plain.faults] == ["NoSystemError"]


@pytest.mark.ros
def test_an_adjusted_rubric_judges_by_its_own_numbers(monkeypatch, tmp_path):
    numbers = [("28.0", "31.5"), ("timer(5.0", "timer(8.0")]
    path = tmp_path / "mine.json"
    rubric = OWN.replace('"pump_seconds": 5', '"pump_seconds": 8').replace(": 28.0", ": 31.5")
    path.write_text(rubric, encoding="utf-8-sig")
    monkeypatch.setenv(SETTING, str(path))
    usual = outcome_of("13b", solution("13b"), "greenhouse")
    assert "R1" in {part.id for part in usual.parts if not part.met}
    adjusted = outcome_of("13b", answers.edited(solution("13b"), *numbers), "greenhouse")
    assert (adjusted.status, adjusted.points) == ("passed", TOTAL)
