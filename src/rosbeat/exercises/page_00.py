"""Page 00, hear the heartbeat: choose a topic, and report on one."""

from __future__ import annotations

from typing import Any

from rosbeat.checks.verdicts import failed, passed
from rosbeat.exercises.exercise import Exercise
from rosbeat.records import NANOSECONDS, Observation, Outcome
from rosbeat.runtime.scenario import feeder, observe

_ARTICLES = 3
_STRING = "std_msgs/msg/String"


def _among_reporters(answer: Any) -> Observation:  # noqa: ANN401
    topics = ("weather", "sports", "politics")
    reporters = [
        feeder(f"{topic}_reporter", topic, _STRING, [f"{topic} {n}" for n in range(_ARTICLES)])
        for topic in topics
    ]
    return observe(answer, 5, others=reporters)


def _judge_reader(observation: Observation) -> Outcome:
    heard = [call.source for call in observation.callbacks if call.kind == "subscription"]
    if heard == ["/weather"] * _ARTICLES:
        return passed("00a", f"The reader got all {_ARTICLES} articles on /weather and no others.")
    if not heard:
        return _deaf_reader(observation)
    topics = ", ".join(sorted(set(heard)))
    return failed(
        "00a",
        f"The reader's callback ran {len(heard)} times, for messages on {topics}.",
        "It should run for /weather only. The second argument of create_subscription is the topic.",
    )


def _deaf_reader(observation: Observation) -> Outcome:
    ends = [end for end in observation.graph.endpoints if end.kind == "subscription"]
    mine = [end.name for end in ends if end.name not in ("/clock", "/parameter_events")]
    where = f"It listens on {', '.join(mine)}." if mine else "It has no subscription."
    return failed(
        "00a",
        f"Three articles appeared on /weather and the reader got none. {where}",
        'Topics match by name, letter by letter. The name is a text: write "weather", with quotes.',
    )


def _alone(answer: Any) -> Observation:  # noqa: ANN401
    return observe(answer, 9)


def _judge_reporter(observation: Observation) -> Outcome:
    sports = [sample for sample in observation.samples if sample.topic == "/sports"]
    if not sports:
        return _silent_reporter(observation)
    times = [sample.time_ns for sample in sports]
    wanted = [second * NANOSECONDS for second in (2, 4, 6, 8)]
    if times == wanted:
        return passed("00b", "Four articles in nine seconds on /sports, one every two seconds.")
    seconds = ", ".join(f"{sample.time:g}" for sample in sports[:6])
    return failed(
        "00b",
        f"In nine seconds {len(sports)} articles appeared on /sports, at these seconds: {seconds}.",
        "One every two seconds is wanted. The first argument of create_timer is the time between "
        "two calls, in seconds.",
    )


def _silent_reporter(observation: Observation) -> Outcome:
    topics = sorted({sample.topic for sample in observation.samples})
    where = f"It published on {', '.join(topics)}." if topics else "It published nothing."
    return failed(
        "00b",
        f"Nobody published on /sports in nine seconds. {where}",
        "create_publisher takes the message type, the topic's name and the queue depth, in this "
        "order.",
    )


EXERCISES = (
    Exercise("00a", _among_reporters, _judge_reader),
    Exercise("00b", _alone, _judge_reporter),
)
