"""Page 11, record and replay: look into a bag, notice what is wrong, alone with two sensors."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from math import nan
from random import Random
from typing import Any

from rosbeat import bags
from rosbeat.exercises.bag_report_runs import look_into_bags
from rosbeat.exercises.replays import Recording, Replays, column, replayed
from rosbeat.records import Sample

TEMPERATURE, REFERENCE = "/temperature", "/reference"
#: All made-up readings are multiples of this: a float32 holds them exactly, and no step is zero.
_GRAIN = 1 / 64


def _walk(seed: int, count: int, start: float = 22.0, widest: int = 32) -> list[float]:
    """A random walk that never stands still, with steps of at most half a degree."""
    dice, found = Random(seed), [start]
    while len(found) < count:
        step = dice.choice((-1, 1)) * dice.randint(1, widest)
        found.append(found[-1] + step * _GRAIN)
    return found


# 11b.

#: Up to four equal readings in a row, steps of a thousandth of a degree, and pairs of equals.
_QUIET = (
    *(21.0, 21.0009765625, 21.0, 21.0009765625, 21.001953125, 21.0, 21.0009765625, 21.0),
    *(21.25, 21.25, 21.5, 21.5, 21.75, 21.75, 22.0, 22.0, 22.25, 22.25, 22.5, 22.5),
    *(22.75, 22.75, 22.75, 22.75, 23.0, 23.0, 23.0, 23.25, 23.25, 23.25, 23.25, 23.0),
)
#: A jump is more than 5 degrees: just enough, not quite, up, down, over a NaN, from 0, and far
#: away. At the end, three equal readings and three others are no hang.
_JUMPS = (
    *(22.0, 23.5, 26.0, 22.5, 27.0, 22.25, 27.25, 22.25, 27.265625, 27.0, 21.5, 21.25),
    *(26.25, 21.25, 33.0, 33.25),
    *(nan, 40.0, 39.75, nan, nan, 30.0, 30.25, 5.0, 5.25, 11.25, -10.0, -10.25, 0.0, 5.5, 22.0),
    *(30.0, 30.0, 30.0, 24.5, 24.5, 24.5),
)
#: What answers to 11b hear: where all is well first, then one kind of fault each.
SICK = (
    Recording(
        "a cold room that is heated",
        column(10 + k / 2 for k in range(45)),
        (bags.dropouts(0.1, [(18, 23)], seed=1),),
    ),
    Recording("a quiet room", column(_QUIET)),
    Recording(
        "a sensor that fails openly",
        column(_walk(2, 25)),
        (bags.with_nan(0, 2.5), bags.with_nan(6), bags.with_nan(14, 3)),
    ),
    Recording("a disturbed line", column(_JUMPS)),
    Recording(
        "a sensor that hangs now and then",
        column(_walk(4, 50)),
        (bags.stuck(0, 9), bags.stuck(20, 6), bags.stuck(32, 14)),
    ),
)

# 11c.

_NOISE = 0.25
#: As far off as a sensor may be; no mean of ten comes near the limit by chance.
_OFF = 2.609375
#: Back within the limit, and not by much, whatever the noise adds.
_NEARLY = 0.6875


def _pair(offsets: Sequence[float], seed: int, start: float = 22.0) -> tuple[Sample, ...]:
    """Two sensors: one reads what the other does, and so much more; the reference comes first."""
    dice, truth = Random(seed), _walk(seed, len(offsets), start)
    values = [
        a + b + dice.choice((-_NOISE, _NOISE)) for a, b in zip(truth, offsets, strict=True)
    ]  # fmt: skip
    return column(truth, REFERENCE, first=0.5) + column(values, TEMPERATURE)


def _episodes(*parts: tuple[float, int]) -> list[float]:
    """So many readings each that are off by so much."""
    return [off for off, count in parts for _ in range(count)]


def _noisy(count: int, size: float) -> Iterator[float]:
    return (size if k % 2 else -size for k in range(count))


#: What answers to 11c hear. Once there is no drift, then there is one, of several kinds.
TWO = (
    Recording(
        "a noisy sensor on a disturbed line",
        _pair([*_noisy(20, 2.0), *_episodes((0, 12), (6, 1), (0, 12), (-6, 1), (0, 6))], 4),
        (bags.dropouts(0.1, seed=3, topic=TEMPERATURE),),
    ),
    Recording(
        "a sensor that drifts",
        _pair(_episodes((0, 35)), 2),
        (bags.drift(0.125, at=14, topic=TEMPERATURE),),
    ),
    Recording(
        "a drift that comes, goes and comes again",
        _pair(
            _episodes(
                *((0, 12), (_OFF, 14), (_NEARLY, 14), (_OFF, 14), (0, 14)),
                *((-_OFF, 14), (0, 12), (_OFF, 14)),
            ),
            6,
        ),
    ),
    Recording(
        "a drift with NaN on the way",
        _pair(_episodes((0, 40)), 8),
        (
            bags.with_nan(5, topic=TEMPERATURE),
            bags.with_nan(8, topic=REFERENCE),
            bags.drift(-0.2, at=14, topic=TEMPERATURE),
            bags.with_nan(18, 2, topic=TEMPERATURE),
            bags.with_nan(20.5, topic=REFERENCE),
        ),
    ),
    Recording(
        "a sensor that is wrong from the beginning, and a reference that comes late",
        _pair(_episodes((3, 25)), 9, 31.0),
        (bags.dropouts(spans=[(0, 4)], topic=REFERENCE),),
    ),
)


def _noticed(answer: Any) -> Replays:  # noqa: ANN401 - whatever a learner hands over
    return replayed(answer, SICK)


def _drifted(answer: Any) -> Replays:  # noqa: ANN401
    return replayed(answer, TWO)


SCENARIOS: dict[str, Callable[[Any], Any]] = {
    "11a": look_into_bags,
    "11b": _noticed,
    "11c": _drifted,
}
