"""Page 00, hear the heartbeat: choose a topic, and report on one."""

from __future__ import annotations

from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.diagnosis.wires import Wire, why_not_heard
from rosbeat.exercises.exercise import Exercise, failed, failed_by, passed
from rosbeat.exercises.model import diagnose_beat, missing
from rosbeat.exercises.page_00_scenarios import ARTICLES, SCENARIOS, STRING
from rosbeat.records import Observation, Outcome

_WEATHER, _SPORTS = Wire("/weather", STRING), Wire("/sports", STRING)
#: Seconds from one article of 00b to the next.
_PERIOD = 2.0


def _judge_reader(observation: Observation) -> Outcome:
    heard = [call.source for call in observation.callbacks if call.kind == "subscription"]
    if heard == [_WEATHER.topic] * ARTICLES:
        return passed("00a", f"The reader got all {ARTICLES} articles on /weather and no others.")
    if not heard:
        return failed_by("00a", _deaf_reader(observation))
    topics = ", ".join(sorted(set(heard)))
    if topics == _WEATHER.topic and len(heard) < ARTICLES:
        return failed(
            "00a",
            f"The reader heard {len(heard)} of {ARTICLES} articles on /weather.",
            "What makes the reader stop? Look at what its callback does.",
        )
    if topics == _WEATHER.topic:
        return failed(
            "00a",
            f"There were {ARTICLES} articles, and the reader's callback ran {len(heard)} times.",
            "One subscription is enough. Is create_subscription there twice?",
            "wrong-rate",
        )
    return failed(
        "00a",
        f"The reader's callback ran {len(heard)} times, for messages on {topics}.",
        "It should run for /weather only. The second argument of create_subscription is the topic.",
        "wrong-topic",
    )


def _deaf_reader(observation: Observation) -> Diagnosis:
    return why_not_heard(observation, _WEATHER) or Diagnosis(
        "new-to-me",
        "Three articles appeared on /weather and the reader got none.",
        'Topics match by name, letter by letter. The name is a text: write "weather", with quotes.',
    )


def _judge_reporter(observation: Observation) -> Outcome:
    wrong = missing(observation, _SPORTS, otherwise=_SILENT)
    wrong = wrong or diagnose_beat(observation, _SPORTS, _PERIOD, "articles")
    if wrong:
        return failed_by("00b", wrong)
    return passed("00b", "Four articles in nine seconds on /sports, one every two seconds.")


_SILENT = Diagnosis(
    "new-to-me",
    "Nobody published on /sports in nine seconds.",
    "create_publisher takes the message type, the topic's name and the queue depth, in this order.",
)


EXERCISES = (
    Exercise(
        "00a",
        SCENARIOS["00a"],
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
        SCENARIOS["00b"],
        _judge_reporter,
        "report on sports",
        1,
        (
            "Two things are missing: where the articles go, and how long it is from one to the "
            "next.",
            "The topic is a text in quotes. The timer wants a number: seconds between two calls.",
        ),
    ),
)
