"""Page 11, record and replay: look into a bag, notice what is wrong, alone with two sensors."""

from __future__ import annotations

from typing import Any

from rosbeat.exercises.alarms import judge_alarms
from rosbeat.exercises.bag_reports import judge_bag_reports
from rosbeat.exercises.exercise import Exercise
from rosbeat.exercises.page_11_scenarios import SCENARIOS
from rosbeat.exercises.sick_sensor import TASK as SICK_SENSOR
from rosbeat.exercises.two_sensors import TASK as TWO_SENSORS

EXERCISES: tuple[Exercise[Any], ...] = (
    Exercise(
        "11a",
        SCENARIOS["11a"],
        lambda seen: judge_bag_reports("11a", seen),
        "look into a bag",
        2,
        (
            "Each message has a time in seconds and a value. Make lists of them first.",
            "zip(readings, readings[1:]) gives each message together with the next one.",
            "Ask for NaN with the function that page 11 shows, and keep only the numbers in a list "
            "for the mean.",
        ),
    ),
    Exercise(
        "11b",
        SCENARIOS["11b"],
        lambda seen: judge_alarms("11b", seen, SICK_SENSOR),
        "notice a sick sensor",
        3,
        (
            "Ask for NaN first. If it is one, everything else has to wait for the next reading.",
            "A jump is a difference, and its sign does not matter: abs takes it away. Before the "
            "first reading there is nothing to compare with.",
            "Count how many equal readings there were in a row. When does the count begin anew? "
            "And which number of the count, and no other, is worth a message?",
        ),
    ),
    Exercise(
        "11c",
        SCENARIOS["11c"],
        lambda seen: judge_alarms("11c", seen, TWO_SENSORS),
        "compare two sensors, alone",
        4,
        (
            "Two subscriptions, two callbacks. One of them only remembers; the other one decides.",
            "Keep the differences in a list and leave NaN out of it, also before there is a "
            "reference.",
            "Page 04 has a list of the last few readings. Here it has to be full before it counts.",
            "The node has to remember whether it has spoken: only from well to drifting it says "
            "something.",
        ),
    ),
)
