"""Page 00, hear the heartbeat: a reader among reporters, and a reporter alone."""

from __future__ import annotations

from collections import Counter
from functools import partial
from typing import Any

from rosbeat.diagnosis.mistakes import UNKNOWN, Diagnosis
from rosbeat.diagnosis.wires import Wire, why_not_heard
from rosbeat.exercises.exercise import Exercise, failed, failed_by, passed
from rosbeat.exercises.model import diagnose_beat, diagnose_wait, explain_subscription, missing, on
from rosbeat.exercises.scenarios import feeder, observe
from rosbeat.records import Observation, Outcome

_STRING = "std_msgs/msg/String"

# 00a, read the weather. Which topics were heard, and how often, says all; no model is needed.

_WEATHER = Wire("/weather", _STRING)
#: How many articles each reporter publishes, one a second.
_ARTICLES = 3


def _run_among_reporters(answer: Any) -> Observation:  # noqa: ANN401 - whatever was handed over
    reporters = [
        feeder(f"{topic}_reporter", topic, _STRING, [f"{topic} {n}" for n in range(_ARTICLES)])
        for topic in ("weather", "sports", "politics")
    ]
    return observe(answer, 5, others=reporters)


def _judge_reader(observation: Observation) -> Outcome:
    heard = Counter(call.source for call in observation.callbacks if call.kind == "subscription")
    count = heard.total()
    if heard == {_WEATHER.topic: _ARTICLES}:
        return passed("00a", f"The reader got all {_ARTICLES} articles on /weather and no others.")
    if not heard:
        return failed_by("00a", why_not_heard(observation, _WEATHER) or _NOTHING_HEARD)
    if set(heard) != {_WEATHER.topic}:
        return failed(
            "00a",
            f"The reader's callback ran {count} times, for messages on {', '.join(sorted(heard))}.",
            "It should run for /weather only. The second argument of create_subscription is the "
            "topic.",
            "wrong-topic",
        )
    if count < _ARTICLES:
        evidence = f"The reader heard {count} of {_ARTICLES} articles on /weather."
        hint = "What makes the reader stop? Look at what its callback does."
        waited = diagnose_wait(observation, evidence)
        return failed_by("00a", waited or Diagnosis(UNKNOWN, evidence, hint))
    return failed(
        "00a",
        f"There were {_ARTICLES} articles, and the reader's callback ran {count} times.",
        "One subscription is enough. Is create_subscription there twice?",
        "heard-twice",
    )


_NOTHING_HEARD = Diagnosis(
    UNKNOWN,
    "Three articles appeared on /weather and the reader got none.",
    'Topics match by name, letter by letter. The name is a text: write "weather", with quotes.',
)

# 00b, report on sports.

_SPORTS = Wire("/sports", _STRING)
#: Seconds from one article to the next.
_PERIOD = 2.0


def _run_alone(answer: Any) -> Observation:  # noqa: ANN401 - whatever was handed over
    return observe(answer, 9)


def _judge_reporter(observation: Observation) -> Outcome:
    wrong = (
        missing(observation, _SPORTS, otherwise=_NOTHING_PUBLISHED)
        or diagnose_beat(observation, _SPORTS, _PERIOD, "articles")
        or _empty_article(observation)
    )
    if wrong:
        return failed_by("00b", wrong)
    return passed("00b", "Four articles in nine seconds on /sports, one every two seconds.")


_NOTHING_PUBLISHED = Diagnosis(
    UNKNOWN,
    "Nobody published on /sports in nine seconds.",
    "create_publisher takes the message type, the topic's name and the queue depth, in this order.",
)


def _empty_article(observation: Observation) -> Diagnosis | None:
    empty = next((one for one in on(observation, _SPORTS) if not one.value.strip()), None)
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
