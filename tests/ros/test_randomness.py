"""Random numbers belong to one session."""

import random

import numpy
import pytest
from rclpy.node import Node

from rosbeat import Session
from rosbeat.ros.isolation import SeededRandom, tilt


class Dice(Node):
    """Draws in its constructor and in its callbacks, with Python and with NumPy."""

    def __init__(self):
        super().__init__("dice")
        self.drawn = [self.draw()]
        self.create_timer(1.0, lambda: self.drawn.append(self.draw()))

    def draw(self):
        return random.random(), float(numpy.random.rand())


def drawn(seed, *spans):
    with Session(seed=seed) as ros:
        dice = ros.add(Dice)
        for span in spans:
            ros.run(span)
            random.random()
        return dice.drawn


def test_the_same_seed_gives_the_same_numbers():
    assert drawn(3, 4) == drawn(3, 1, 3) == drawn(3, 2, 0, 2)


def test_a_session_does_not_disturb_the_page():
    random.seed(1)
    numpy.random.seed(1)
    wanted = [random.random() for _ in range(2)], numpy.random.rand(2).tolist()
    random.seed(1)
    numpy.random.seed(1)
    got = [], []
    for _ in range(2):
        got[0].append(random.random())
        got[1].append(float(numpy.random.rand()))
        with Session(seed=5) as ros:
            ros.add(Dice)
            ros.run(3)
    assert got == wanted


def test_the_state_comes_back_after_an_exception():
    generator = SeededRandom(1)
    state = random.getstate()
    with pytest.raises(KeyError), generator.lent():
        {}[random.random()]
    assert random.getstate() == state


def test_after_a_run_the_very_same_function_stands_there_again():
    before = random.random
    with SeededRandom(1).lent():
        tilt(2.0)
        assert random.random is not before
    assert random.random is before
