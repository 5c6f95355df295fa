"""The same program gives the same observation, byte for byte; its random numbers are its own."""

import multiprocessing
import os
import random
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path

import numpy
import pytest
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile

import six_nodes
from digests import digest
from nodes import Listener, Talker
from rosbeat import Session
from rosbeat.ros.isolation import SeededRandom, tilt

TESTS = Path(six_nodes.__file__).parent
#: The lead runs 200; a test suite does not need to.
RUNS = int(os.environ.get("ROSBEAT_DETERMINISM_RUNS", "5"))
PROCESSES = int(os.environ.get("ROSBEAT_DETERMINISM_PROCESSES", "1"))


def _burn() -> None:
    while True:
        pass


@contextmanager
def busy_cores(number: int = 2) -> Iterator[None]:
    """Keep processor cores busy with something else."""
    burners = [multiprocessing.get_context("spawn").Process(target=_burn) for _ in range(number)]
    for burner in burners:
        burner.start()
    try:
        yield
    finally:
        for burner in burners:
            burner.kill()
            burner.join()


def test_runs_in_one_process():
    assert {digest(six_nodes.observe()) for _ in range(RUNS)} == {six_nodes.DIGEST}


def test_runs_and_late_joiners_while_all_cores_are_busy():
    with busy_cores():
        assert {digest(six_nodes.observe()) for _ in range(RUNS // 5)} == {six_nodes.DIGEST}
        assert all(late() == [16, 17, 18, 19, 20] for _ in range(RUNS // 5))


def test_runs_in_fresh_processes():
    environ = {**os.environ, "PYTHONPATH": os.pathsep.join([str(TESTS), *filter(None, sys.path)])}
    for number in range(PROCESSES):
        environ["PYTHONHASHSEED"] = str(number)
        done = subprocess.run(
            [sys.executable, str(TESTS / "six_nodes.py")],
            env=environ, capture_output=True, text=True, timeout=60, check=True,
        )  # fmt: skip
        assert done.stdout.strip() == six_nodes.DIGEST
        assert done.stderr == ""


def stored(depth, **options):
    return QoSProfile(depth=depth, durability=DurabilityPolicy.TRANSIENT_LOCAL, **options)


def late(published=20, stores=5, wants=10):
    """What a late joiner gets."""
    with Session() as ros:
        talker = ros.add(partial(Talker, burst=published, qos=stored(stores)))
        ros.run(1)
        listener = ros.add(partial(Listener, qos=stored(wants)))
        ros.run(0)
        heard = list(listener.heard)
        talker.talk()
        ros.run(0)
        assert listener.heard[len(heard) :][-1] == 2 * published
        return heard


@pytest.mark.parametrize(
    ("published", "stores", "wants", "gets"),
    [(3, 5, 10, 3), (20, 10, 4, 4), (1, 1, 1, 1), (20, 1, 10, 1)],
)
def test_the_smaller_of_both_depths(published, stores, wants, gets):
    assert late(published, stores, wants) == list(range(published - gets + 1, published + 1))


# Random numbers.


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
