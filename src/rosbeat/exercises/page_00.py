"""Page 00, hear the heartbeat: choose a topic, and report on one."""

from __future__ import annotations

from typing import Any

from rosbeat.checks.verdicts import failed, failed_by, passed
from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.diagnosis.wires import Wire, why_not_heard, why_not_published
from rosbeat.exercises.exercise import Exercise
from rosbeat.exercises.running import feeder, observe
from rosbeat.records import NANOSECONDS, Observation, Outcome, Sample

_ARTICLES = 3
_STRING = "std_msgs/msg/String"
_WEATHER, _SPORTS = Wire("/weather", _STRING), Wire("/sports", _STRING)
_TOPICS = ("weather", "sports", "politics")


def _among_reporters(answer: Any) -> Observation:  # noqa: ANN401
    reporters = [
        feeder(f"{topic}_reporter", topic, _STRING, [f"{topic} {n}" for n in range(_ARTICLES)])
        for topic in _TOPICS
    ]
    return observe(answer, 5, others=reporters)


def _judge_reader(observation: Observation) -> Outcome:
    heard = [call.source for call in observation.callbacks if call.kind == "subscription"]
    if heard == [_WEATHER.topic] * _ARTICLES:
        return passed("00a", f"The reader got all {_ARTICLES} articles on /weather and no others.")
    if not heard:
        return failed_by("00a", _deaf_reader(observation))
    topics = ", ".join(sorted(set(heard)))
    if topics == _WEATHER.topic and len(heard) < _ARTICLES:
        return failed(
            "00a",
            f"The reader heard {len(heard)} of {_ARTICLES} articles on /weather.",
            "What makes the reader stop? Look at what its callback does.",
        )
    if topics == _WEATHER.topic:
        return failed(
            "00a",
            f"There were {_ARTICLES} articles, and the reader's callback ran {len(heard)} times.",
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


def _alone(answer: Any) -> Observation:  # noqa: ANN401
    return observe(answer, 9)


def _judge_reporter(observation: Observation) -> Outcome:
    sports = [sample for sample in observation.samples if sample.topic == _SPORTS.topic]
    if not sports:
        return failed_by("00b", _silent_reporter(observation))
    if sports[0].type_name != _STRING:
        return failed(
            "00b",
            f"The messages on /sports are of type {sports[0].type_name}.",
            "An article is a String: both sides of a topic have to agree on the type.",
            "type-mismatch",
        )
    times = [sample.time_ns for sample in sports]
    if times == [second * NANOSECONDS for second in (2, 4, 6, 8)]:
        return passed("00b", "Four articles in nine seconds on /sports, one every two seconds.")
    return _wrong_rate(sports)


def _wrong_rate(sports: list[Sample]) -> Outcome:
    if not any(sample.time_ns for sample in sports):
        return failed(
            "00b",
            f"{len(sports)} articles were published while the node was made, and none later.",
            "The constructor runs once. What calls write again and again?",
            "no-timer",
        )
    if len({sample.time_ns for sample in sports}) < len(sports):
        return failed(
            "00b",
            f"{len(sports)} articles appeared on /sports, some of them at the same second.",
            "One article for each tick is enough. Does anything publish twice, or are there two "
            "timers?",
            "wrong-rate",
        )
    return failed("00b", *_rate(sports), "wrong-rate")


def _rate(sports: list[Sample]) -> tuple[str, str]:
    seconds = ", ".join(f"{sample.time:g}" for sample in sports[:6])
    return (
        f"In nine seconds {len(sports)} articles appeared on /sports, at these seconds: {seconds}.",
        "One every two seconds is wanted. The first argument of create_timer is the time between "
        "two calls, in seconds.",
    )


def _silent_reporter(observation: Observation) -> Diagnosis:
    return why_not_published(observation, _SPORTS) or Diagnosis(
        "new-to-me",
        "Nobody published on /sports in nine seconds.",
        "create_publisher takes the message type, the topic's name and the queue depth, in this "
        "order.",
    )


EXERCISES = (
    Exercise(
        "00a",
        _among_reporters,
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
        _alone,
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
