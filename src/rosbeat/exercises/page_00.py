"""Page 00, hear the heartbeat: a subscriber among several publishers, and a publisher alone."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from functools import partial

from rosbeat.diagnosis.connections import Wire, diagnose_unheard, diagnose_unpublished
from rosbeat.diagnosis.mistakes import UNKNOWN, Diagnosis
from rosbeat.exercises.exercise import Exercise, Verdict, passed
from rosbeat.exercises.model import (
    diagnose_beat,
    diagnose_length,
    diagnose_wait,
    explain_subscription,
    samples_on,
)
from rosbeat.exercises.random_inputs import Draw
from rosbeat.exercises.scenarios import Answer, feeder, observe
from rosbeat.records import Observation

_STRING = "std_msgs/msg/String"

# 00a, read the weather. Which topics were heard, and how often, says all; no model is needed.

_WEATHER = Wire("/weather", _STRING)
#: Whether each reporter publishes an article in a second, from 1 s on.
Seconds = Sequence[bool]


def draw_articles(draw: Draw) -> Seconds:
    """Draw when there are articles; on the page three, one a second.

    So it ends in any case: a reader that waits too long in its callback misses one of them.
    """
    earlier = (True,) * draw.whole(0, 2, 4) + (False,) * draw.whole(0, 10, 40)
    pause = (False,) * draw.whole(0, 2, 4)
    return (*draw.shuffled(earlier), *pause, True, True, True)


#: The article that the page shows. It comes as the last but one, among others.
_SHOWN = "Sun all day"


def _articles(topic: str, seconds: Seconds) -> list[str | None]:
    texts = [f"{topic} {n}" if there else None for n, there in enumerate(seconds)]
    return [*texts[:-2], _SHOWN, texts[-1]]


def _run_among_reporters(answer: Answer, seconds: Seconds) -> Observation:
    reporters = [
        feeder(f"{topic}_reporter", Wire(topic, _STRING), _articles(topic, seconds))
        for topic in ("weather", "sports", "politics")
    ]
    return observe(answer, len(seconds) + 2, others=reporters)


def _judge_reader(observation: Observation, seconds: Seconds) -> Verdict:
    heard = Counter(call.source for call in observation.callbacks if call.kind == "subscription")
    count, articles = heard.total(), sum(seconds)
    if heard == {_WEATHER.topic: articles}:
        return (
            diagnose_length(observation, len(seconds) + 2)
            or _heard_at_other_times(observation, seconds)
            or _read_one_text_only(observation, seconds)
            or passed(f"The reader got all {articles} articles on /weather and no others.")
        )
    unheard = None if heard else diagnose_unheard(observation, _WEATHER)
    if unheard:
        return unheard
    if set(heard) != {_WEATHER.topic}:
        return Diagnosis(
            "wrong-topic",
            f"The reader's callback ran {count} times, for messages on {', '.join(sorted(heard))}.",
            "It should run for /weather only. The topic is the second argument of "
            "create_subscription.",
        )
    if count < articles:
        evidence = f"The reader heard {count} of {articles} articles on /weather."
        hint = "What makes the reader stop? Look at what its callback does."
        return diagnose_wait(observation, evidence) or Diagnosis(UNKNOWN, evidence, hint)
    return Diagnosis(
        "heard-twice",
        f"There were {articles} articles, and the reader's callback ran {count} times.",
        "One subscription is enough. Do you call create_subscription twice?",
    )


def _heard_at_other_times(observation: Observation, seconds: Seconds) -> Diagnosis | None:
    """Say that articles were not heard when they came; a reader that waits may be late."""
    due = [float(second) for second, there in enumerate(seconds, 1) if there]
    heard = [one.time for one in observation.callbacks if one.kind == "subscription"]
    first = next((pair for pair in zip(due, heard, strict=True) if pair[0] != pair[1]), None)
    if first is None or (observation.waits and first[0] < first[1]):
        return None
    return Diagnosis(
        UNKNOWN,
        f"An article came at {first[0]:g} s, and the reader's callback ran at {first[1]:g} s.",
        "The callback runs when an article comes. What else calls it?",
    )


def _read_one_text_only(observation: Observation, seconds: Seconds) -> Diagnosis | None:
    """Name a reader that logs the page's article, and no other; it need not log anything."""
    articles = [one for one in _articles("weather", seconds) if one]
    if [one for one in articles if any(one in log.text for log in observation.logs)] != [_SHOWN]:
        return None
    evidence = f"Of {len(articles)} articles on /weather, the reader logged only {_SHOWN!r}."
    hint = "The topic selects the articles: whatever arrives on it is weather, whatever its text."
    return Diagnosis("nothing-logged", evidence, hint)


# 00b, report on sports. Nothing is fed to a reporter; drawn is how long it is watched.

_SPORTS = Wire("/sports", _STRING)
#: Seconds from one article to the next.
_PERIOD = 2.0
_NUMERALS: dict[float, str] = {4: "Four", 9: "nine"}


def draw_seconds(draw: Draw) -> float:
    """Draw for how long a reporter is watched; never until the moment of an article."""
    return draw.whole(4, 4, 30) * _PERIOD + draw.number(1.0, 0.25, 1.75, 1 / 4096)


def _judge_reporter(observation: Observation, seconds: float) -> Verdict:
    count = int(seconds / _PERIOD)
    return (
        diagnose_unpublished(observation, _SPORTS)
        or diagnose_beat(observation, _SPORTS, _PERIOD, "articles")
        or _empty_article(observation)
        or diagnose_length(observation, seconds)
        or passed(
            f"{_NUMERALS.get(count, count)} articles in "
            f"{_NUMERALS.get(seconds, f'{seconds:g}')} seconds on /sports, one every two seconds."
        )
    )


def _empty_article(observation: Observation) -> Diagnosis | None:
    empty = next((one for one in samples_on(observation, _SPORTS) if not one.value.strip()), None)
    if empty is None:
        return None
    return Diagnosis(
        "wrong-values",
        f"The article at {empty.time:g} s is empty.",
        "A new String is empty. Which line assigns the article to its field data?",
    )


EXERCISES = (
    Exercise("00a", _run_among_reporters, _judge_reader, "read the weather", 1, (
        "Look at the Reader on this page: the topic is the second argument of "
        "create_subscription.",
        "The name of a topic is a string, so it needs quotes.",
    ), draw=draw_articles),
    Exercise("00b", observe, _judge_reporter, "report on sports", 1, (
        "Two things are missing: the topic of the articles, and the time from one to the next.",
        "The topic is a string in quotes. The timer needs a number: the seconds between two "
        "calls.",
    ), draw=draw_seconds, explains=partial(explain_subscription, _SPORTS)),
)  # fmt: skip
