"""A tendency in the random numbers, for as long as a run lasts."""

import random

import pytest
from rclpy.node import Node

from rosbeat import Session
from rosbeat.ros.test_nodes import drift

pytestmark = pytest.mark.ros


class Dice(Node):
    def __init__(self):
        super().__init__("dice")
        self.drawn = []
        self.create_timer(1.0, lambda: self.drawn.append(random.uniform(2.0, 3.0)))


def drawn(phases, seconds=300):
    with Session(seed=5) as ros:
        ros.add(drift(phases))
        dice = ros.add(Dice)
        ros.run(seconds)
        return dice.drawn


def mean(values):
    return sum(values) / len(values)


def test_numbers_tend_upwards_then_downwards_then_nowhere():
    values = drawn([(100, 1 / 3), (100, 3.0), (0, 1.0)])
    assert mean(values[:100]) == pytest.approx(2.75, abs=0.06)
    assert mean(values[100:200]) == pytest.approx(2.25, abs=0.06)
    assert mean(values[200:]) == pytest.approx(2.5, abs=0.09)
    assert all(2.0 <= value <= 3.0 for value in values)


@pytest.mark.parametrize(
    "draw",
    [lambda: random.random(), lambda: random.choice(range(100)) / 100, lambda: random.gauss(1, 2)],
)
def test_other_functions_drift_too(draw):
    class Gambler(Node):
        def __init__(self):
            super().__init__("gambler")
            self.drawn = []
            self.create_timer(1.0, lambda: self.drawn.append(draw()))

    with Session(seed=5) as ros:
        ros.add(drift([(200, 1 / 3), (0, 3.0)]))
        gambler = ros.add(Gambler)
        ros.run(400)
    assert mean(gambler.drawn[:200]) != pytest.approx(mean(gambler.drawn[200:]), abs=0.2)


def test_the_same_seed_gives_the_same_numbers():
    assert drawn([(100, 3.0), (0, 1.0)]) == drawn([(100, 3.0), (0, 1.0)])


def test_nothing_is_left_of_it():
    plain = random.Random(9)
    drawn([(0, 50.0)], 3)
    random.seed(9)
    assert [random.uniform(0, 1) for _ in range(5)] == [plain.uniform(0, 1) for _ in range(5)]


def test_nothing_is_left_of_it_after_an_exception():
    class Interrupted(Node):
        def __init__(self):
            super().__init__("interrupted")
            self.create_timer(1.0, self.stop)

        def stop(self):
            raise KeyboardInterrupt

    with Session() as ros:
        ros.add(drift([(0, 50.0)]))
        ros.add(Interrupted)
        with pytest.raises(KeyboardInterrupt):
            ros.run(3)
    shared = random.uniform.__self__
    assert not {"random", "_randbelow"} & set(vars(shared))
    assert random.random == shared.random
