"""Page 03: beats and walks made by hand, and the mistakes that are named; needs no ROS.

Each walk is the model of a misunderstanding, which takes its steps from numbers that drift as they
do in the scenario.
"""

import math
import random
from dataclasses import replace

import pytest

from failed_calls import failed_call
from rosbeat.exercises import page_03
from rosbeat.exercises.registry import EXERCISES
from rosbeat.records import (
    NANOSECONDS,
    Endpoint,
    Fault,
    GraphSnapshot,
    Observation,
    QoS,
    Sample,
    WaitRecord,
)

FLOAT = "std_msgs/msg/Float32"
READINGS = 3600


def judged(exercise, topic, times, values, end, nodes=("/node",), **more):
    samples = [
        Sample(round(at * NANOSECONDS), topic, FLOAT, "/node", {"data": value})
        for at, value in zip(times, values, strict=True)
    ]
    graph = GraphSnapshot(nodes, (Endpoint("/node", topic, FLOAT, "publisher", QoS(depth=5)),))
    seen = Observation(end * NANOSECONDS, 0, tuple(samples), graph=graph, subject="/node", **more)
    return EXERCISES[exercise].judged(seen)


# Beats: a tick every half second, ten of them.

TICKS = [n / 2 for n in range(1, 11)]


def beat(*times, **more):
    return judged("03a", "/humidity", times, [45.0] * len(times), 5, **more)


BEATS = {
    "right": (TICKS, "", ""),
    "only while it is made": ([0, 0, 0], "no-timer", "constructor"),
    "one while it is made": ([0], "no-timer", "constructor"),
    "one more while it is made": ([0, *TICKS], "wrong-rate", "first tick"),
    "two each time": (sorted(TICKS * 2), "wrong-rate", "twice"),
    "once a second": ([1, 2, 3, 4, 5], "wrong-rate", "first argument"),
    "four a second": ([n / 4 for n in range(1, 21)], "wrong-rate", "first argument"),
    "no beat at all": ([0.5, 0.7, 3.1], "wrong-rate", "first argument"),
    "it stops": (TICKS[:6], "gone-quiet", "ends the beat"),
}


@pytest.mark.parametrize("name", BEATS)
def test_a_beat_is_told_from_every_other(name):
    times, mistake, word = BEATS[name]
    found = beat(*times)
    assert found.mistake == mistake
    others = {one for _, other, one in BEATS.values() if (other, one) != (mistake, word)}
    assert word in found.hint
    assert not any(one in found.hint for one in others - {""})


def test_the_first_moment_that_differs_is_shown():
    assert "10 readings were due, and 5 came" in beat(1, 2, 3, 4, 5).evidence
    assert "At 0.5 s none came, and one was due" in beat(1, 2, 3, 4, 5).evidence
    assert "At 0.5 s 2 came, and one was due" in beat(*sorted(TICKS * 2)).evidence


def test_a_callback_that_waits_is_named_and_not_its_timer():
    wait = WaitRecord(500_000_000, 600_000_000, "/node", "publish_humidity", "sleep")
    late = [at + 0.1 for at in TICKS[:-1]]
    assert beat(*late, waits=(wait,)).mistake == "callback-blocks"
    assert beat(*TICKS, waits=(wait,)).status == "passed"


def test_a_node_that_is_gone_is_named():
    assert beat(0.5, nodes=()).mistake == "node-ended"


@pytest.mark.parametrize(
    ("exercise", "topic"), [("03a", "humidity"), ("03b", "temperature"), ("03c", "temperature")]
)
def test_a_subscription_that_fails_is_no_publisher(exercise, topic):
    code = f'self.create_subscription(Float32, "{topic}", self.tick, 5)'
    fault = Fault(
        0, "", "__init__", "TypeError", "?", 4, code, failed_call("create_subscription(str)")
    )
    elsewhere = replace(fault, code=code.replace(topic, "x"))
    named, other = (
        EXERCISES[exercise].judged(Observation(0, 0, faults=(one,))).mistake
        for one in (fault, elsewhere)
    )
    assert named == "no-publisher" != other


# Walks.

_LOW, _HIGH = 18.0, 28.0


def clamp(value, low=_LOW, high=_HIGH):
    return max(low, min(high, value))


def drawn(number):
    """A number between 0 and 1 with the tendency that it has in the scenario."""
    up, down, free = page_03._UP, page_03._DOWN, page_03._FREE
    phase = number // page_03._PHASE
    return random.random() ** (up if phase == 0 else down if phase == 1 else free)


def walk(step=lambda u: 0.6 * u - 0.3, keep=clamp, show=lambda x: x, draw=drawn):
    """A node that keeps one number and shows one, from the steps that it takes."""
    random.seed(4)
    here, shown = 22.0, []
    for number in range(READINGS):
        here = keep(here + step(draw(number)))
        shown.append(show(here))
    return shown


def clamped_early():
    random.seed(4)
    here, shown = 22.0, []
    for number in range(READINGS):
        here = clamp(here) + 0.6 * drawn(number) - 0.3
        shown.append(here)
    return shown


def set_back(value):
    return value if _LOW <= value <= _HIGH else 22.0


def thrown_back(value):
    return 52.0 - value if value > 26.0 else 40.0 - value if value < 20.0 else value


def opened_at_times():
    return [value - 4.0 * (n % 250 == 0) for n, value in enumerate(walk(), 1)]


def in_advance():
    random.seed(4)
    steps = [random.uniform(-0.3, 0.3) for _ in range(100)]
    found, here = [], 22.0
    for number in range(READINGS):
        here = clamp(here + steps[number % 100])
        found.append(here)
    return found


def to_fahrenheit(celsius):
    return celsius * 9 / 5 + 32


WALKS = {
    "right": (walk, ""),
    "right, of two steps without drift": (
        lambda: walk(lambda u: 0.3 if u < 0.5 else -0.3, draw=lambda _: random.random()),
        "",
    ),
    "rounded to 32 bits": (lambda: [x + 1e-5 * (-1) ** n for n, x in enumerate(walk())], ""),
    "standing": (lambda: [22.0] * READINGS, "never-changes"),
    "standing at the lower limit": (lambda: [18.0] * READINGS, "never-changes"),
    "an empty message": (lambda: [0.0] * READINGS, "wrong-values"),
    "whole degrees": (lambda: walk(show=lambda x: float(round(x))), "wrong-values"),
    "no number": (lambda: [*walk()[:-1], math.nan], "wrong-values"),
    "min and max swapped": (lambda: walk(keep=lambda x: max(_HIGH, min(_LOW, x))), "clamp-swapped"),
    "one limit swapped": (lambda: walk(keep=lambda x: min(_LOW, x)), "clamp-swapped"),
    "only up": (lambda: walk(lambda u: 0.3 * u), "one-way"),
    "only down": (lambda: walk(lambda u: -0.3 * u), "one-way"),
    "drawn anew": (lambda: [18.0 + 10.0 * drawn(n) for n in range(READINGS)], "forgets-itself"),
    "always from 22": (lambda: [21.7 + 0.6 * drawn(n) for n in range(READINGS)], "forgets-itself"),
    "a sine": (lambda: [23 + 5 * math.sin(n / 100) for n in range(READINGS)], "not-random"),
    "drawn in advance": (in_advance, "not-random"),
    "back to the start": (lambda: walk(keep=set_back), "set-back"),
    "round and round": (lambda: walk(keep=lambda x: _LOW + (x - _LOW) % 10.0), "wraps-round"),
    "a jump now and then": (opened_at_times, "jumps"),
    "wide steps": (lambda: walk(lambda u: u - 0.5), "step-too-wide"),
    "small steps": (lambda: walk(lambda u: 0.2 * u - 0.1), "step-too-small"),
    "smaller steps than allowed": (lambda: walk(lambda u: 0.4 * u - 0.2), ""),
    "smaller steps up": (lambda: walk(lambda u: 0.5 * u - 0.3), "uneven-steps"),
    "the clamp first": (clamped_early, "clamped-too-early"),
    "a clamped copy": (lambda: walk(keep=lambda x: x, show=clamp), "clamp-not-kept"),
    "no upper limit": (lambda: walk(keep=lambda x: max(_LOW, x)), "no-clamp"),
    "no lower limit": (lambda: walk(keep=lambda x: min(_HIGH, x)), "no-clamp"),
    "no limits": (lambda: walk(keep=lambda x: x), "no-clamp"),
    "a lower upper limit": (lambda: walk(keep=lambda x: clamp(x, _LOW, 27.0)), "other-limits"),
    "a higher upper limit": (lambda: walk(keep=lambda x: clamp(x, _LOW, 28.2)), "other-limits"),
    "a lower lower limit": (lambda: walk(keep=lambda x: clamp(x, 10.2)), "other-limits"),
    "thrown back inside narrower limits": (lambda: walk(keep=thrown_back), "other-limits"),
}


def room(values):
    return judged("03b", "/temperature", range(1, len(values) + 1), values, READINGS)


@pytest.mark.parametrize("name", WALKS)
def test_a_walk_is_told_from_every_other(name):
    make, mistake = WALKS[name]
    found = room(make())
    assert found.mistake == mistake, found
    assert bool(found.hint) == bool(mistake)


@pytest.mark.parametrize("name", [name for name, (_, mistake) in WALKS.items() if not mistake])
def test_a_right_walk_says_how_far_it_went(name):
    evidence = room(WALKS[name][0]()).evidence
    assert evidence.startswith("The readings went from 18.00 to 28.00 degrees, in steps of at most")


def test_the_first_moment_that_no_right_walk_has_is_shown():
    values = walk(keep=set_back)
    at = next(n for n, one in enumerate(values[1:], 1) if abs(one - values[n - 1]) > 0.31)
    moment = f"At {at + 1} s it went from {values[at - 1]:.2f} to 22.00."
    assert moment in room(values).evidence


@pytest.mark.parametrize(
    ("show", "mistake"),
    [
        (to_fahrenheit, ""),
        (lambda c: c, "wrong-unit"),
        (lambda c: c * 5 / 9 + 32, "wrong-unit"),
        (lambda c: to_fahrenheit(c) - 64, "wrong-unit"),
        (lambda c: 28.0, "wrong-unit"),
        (lambda c: to_fahrenheit(clamp(c, 10.2, 20.0)), "other-limits"),
    ],
)
def test_a_unit_is_told_from_every_other(show, mistake):
    values = walk(lambda u: u - 0.5, lambda x: clamp(x, 10.2), show)
    times = [n / 4 for n in range(1, READINGS + 1)]
    assert judged("03c", "/greenhouse/temperature", times, values, 900).mistake == mistake


# How long a walk is watched, which needs ROS.


def sensor(draw):
    from rclpy.node import Node
    from std_msgs.msg import Float32

    class Sensor(Node):
        def __init__(self):
            super().__init__("room")
            self.temperature = 22.0
            self.publisher = self.create_publisher(Float32, "temperature", 10)
            self.create_timer(1.0, self.tick)

        def tick(self):
            self.temperature = clamp(self.temperature + 0.3 * draw())
            self.publisher.publish(Float32(data=self.temperature))

    return Sensor


@pytest.mark.ros
def test_a_walk_is_watched_until_it_has_met_both_limits():
    own = random.Random(12)
    lengths = [
        len(EXERCISES["03b"].scenario(sensor(draw)).samples)
        for draw in (
            lambda: random.uniform(-1.0, 1.0),
            lambda: own.uniform(-1.0, 1.0),
            lambda: 0.0,
            lambda: own.uniform(-1.0, 0.5),
        )
    ]
    first, second, _ = page_03._RUNS
    assert lengths == [first, second, first, first]
