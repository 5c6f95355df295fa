"""Page 07, look inside the graph: findings about a system, limits as parameters, a log watcher."""

from __future__ import annotations

from typing import Any

from rosbeat.exercises import log_watching, tuning
from rosbeat.exercises.exercise import Exercise
from rosbeat.exercises.findings import judge_report
from rosbeat.exercises.page_07_scenarios import SCENARIOS

EXERCISES: tuple[Exercise[Any], ...] = (
    Exercise(
        "07a",
        SCENARIOS["07a"],
        judge_report,
        "a system of strangers",
        3,
        (
            "Ask about one thing at a time, in the terminal `look`, and write down what you see.",
            "ros2 topic info --verbose names both sides of a topic; ros2 topic hz counts; ros2 "
            "param get reads; the field name of a log line says who speaks.",
            "Terminals do not know the depth of a queue, but this kernel made the greenhouse: "
            "for end in ros.graph().endpoints: print(end) shows it all.",
        ),
    ),
    Exercise(
        "07b",
        SCENARIOS["07b"],
        lambda seen: tuning.judge_tuning("07b", seen),
        "limits to turn",
        2,
        (
            "A parameter is declared in the constructor, with its name and its first value.",
            "get_parameter gives the parameter; its value stands behind a dot.",
            "What is asked for in the constructor is asked for once. The callback runs at each "
            "reading.",
        ),
    ),
    Exercise(
        "07c",
        SCENARIOS["07c"],
        lambda seen: log_watching.judge_log_watcher("07c", seen),
        "a log watcher",
        3,
        (
            "It is an alarm like that of page 04, with another message type on its ear.",
            "create_subscription takes Log, the topic, your method and a depth. The message has "
            "the fields level, name and msg.",
            "Levels are numbers, and worse is greater. Log.WARN is the number of a warning.",
        ),
    ),
)
