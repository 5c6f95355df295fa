"""Page 00, hear the heartbeat: a reader among reporters, and a reporter alone."""

from __future__ import annotations

from collections import Counter
from functools import partial

from rosbeat.diagnosis.mistakes import UNKNOWN, Diagnosis
from rosbeat.diagnosis.wires import Wire, diagnose_unheard, diagnose_unpublished
from rosbeat.exercises.exercise import Exercise, Verdict, passed
from rosbeat.exercises.model import (
    diagnose_beat,
    diagnose_wait,
    explain_subscription,
    samples_on,
)
from rosbeat.exercises.scenarios import Answer, feeder, observe
from rosbeat.records import Observation

_STRING = "std_msgs/msg/String"

# 00a, read the weather. Which topics were heard, and how often, says all; no model is needed.

_WEATHER = Wire("/weather", _STRING)
#: How many articles each reporter publishes, one a second.
_ARTICLES = 3


def _run_among_reporters(answer: Answer) -> Observation:
    reporters = [
        feeder(
            f"{topic}_reporter", Wire(topic, _STRING), [f"{topic} {n}" for n in range(_ARTICLES)]
        )
        for topic in ("weather", "sports", "politics")
    ]
    return observe(answer, 5, others=reporters)


def _judge_reader(observation: Observation) -> Verdict:
    heard = Counter(call.source for call in observation.callbacks if call.kind == "subscription")
    count = heard.total()
    if heard == {_WEATHER.topic: _ARTICLES}:
        return passed(f"The reader got all {_ARTICLES} articles on /weather and no others.")
    unheard = None if heard else diagnose_unheard(observation, _WEATHER)
    if unheard:
        return unheard
    if set(heard) != {_WEATHER.topic}:
        return Diagnosis(
            "wrong-topic",
            f"The reader's callback ran {count} times, for messages on {', '.join(sorted(heard))}.",
            "It should run for /weather only. The second argument of create_subscription is the "
            "topic.",
        )
    if count < _ARTICLES:
        evidence = f"The reader heard {count} of {_ARTICLES} articles on /weather."
        hint = "What makes the reader stop? Look at what its callback does."
        return diagnose_wait(observation, evidence) or Diagnosis(UNKNOWN, evidence, hint)
    return Diagnosis(
        "heard-twice",
        f"There were {_ARTICLES} articles, and the reader's callback ran {count} times.",
        "One subscription is enough. Is create_subscription there twice?",
    )


# 00b, report on sports.

_SPORTS = Wire("/sports", _STRING)
#: Seconds from one article to the next.
_PERIOD = 2.0


def _run_alone(answer: Answer) -> Observation:
    return observe(answer, 9)


def _judge_reporter(observation: Observation) -> Verdict:
    return (
        diagnose_unpublished(observation, _SPORTS)
        or diagnose_beat(observation, _SPORTS, _PERIOD, "articles")
        or _empty_article(observation)
        or passed("Four articles in nine seconds on /sports, one every two seconds.")
    )


def _empty_article(observation: Observation) -> Diagnosis | None:
    empty = next((one for one in samples_on(observation, _SPORTS) if not one.value.strip()), None)
    if empty is None:
        return None
    return Diagnosis(
        "wrong-values",
        f"The article at {empty.time:g} s is empty.",
        "A new String holds an empty text. Which line puts the article into its field data?",
    )


EXERCISES = (
    Exercise(
        "00a",
        _run_among_reporters,
        _judge_reader,
        "read the weather",
        1,
        (
            "Look at the Reader of this page: the topic is the second thing that "
            "create_subscription is given.",
            "The name of a topic is a text, so it stands in quotes.",
        ),
    ),
    Exercise(
        "00b",
        _run_alone,
        _judge_reporter,
        "report on sports",
        1,
        (
            "Two things are missing: where the articles go, and how long it is from one to the "
            "next.",
            "The topic is a text in quotes. The timer wants a number: seconds between two calls.",
        ),
        explains=partial(explain_subscription, _SPORTS),
    ),
)
