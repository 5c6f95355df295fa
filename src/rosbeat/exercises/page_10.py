"""Page 10, find the fault."""

from __future__ import annotations

from typing import Any

from rosbeat.exercises.exercise import Exercise
from rosbeat.exercises.page_10_scenarios import SCENARIOS
from rosbeat.exercises.rounds import judge

_SILENT, _HEARD, _PAIRS = range(1, 5), range(5, 9), range(9, 12)

EXERCISES: tuple[Exercise[Any], ...] = (
    Exercise(
        "10a",
        SCENARIOS["10a"],
        judge("10a", _SILENT),
        "four patients, and something is silent",
        2,
        (
            "The owner says what is fine. Whatever those nodes need is fine too: cross it out.",
            "`ros.graph()` first: is every name as it was ordered, letter by letter? Then "
            "`ros.explain(...)` of the topic on which the silence begins, seen from the sensor.",
            "In ward 7: of patient 1 compare the picture of the graph with the order. Of patient "
            "2, when did each node start, and when was the message? `ros.logs()` and "
            "`ros.messages(...)`.",
            "In ward 7: of patients 3 and 4 ask `ros.explain` about the topic of the readings, "
            "and read its first line only.",
        ),
        tells_hints=True,
    ),
    Exercise(
        "10b",
        SCENARIOS["10b"],
        judge("10b", _HEARD),
        "four patients, and nothing is silent",
        3,
        (
            "All is well, says `ros.explain`: messages arrive. So look at what they say, how many "
            "they are, and who sent them.",
            "`viz.values` beside the order: limits, steps, rate. `ros.graph()` beside the order: "
            "who is on which topic?",
            "In ward 7: of patient 5 read one message of the sensor. On which scale would that be "
            "a mild day? Of patient 6 ask who hears what.",
            "In ward 7: of patient 7 count the nodes. Of patient 8 draw the readings with the "
            "limits that were ordered as a band; by how much are they beyond?",
        ),
        tells_hints=True,
    ),
    Exercise(
        "10c",
        SCENARIOS["10c"],
        judge("10c", _PAIRS),
        "three patients with two faults each",
        4,
        (
            "Find one fault, imagine that it is mended, and begin again at the sensor.",
            "The two are at two places. Go through the nodes one by one: is it published, is it "
            "matched, is it taken, is the value right?",
            "In ward 7: of patient 9 count what each listener has heard, and look at the numbers. "
            "Of patient 10 look at both topics, and of patient 11 at the rate, and at who is "
            "still running.",
        ),
        tells_hints=True,
    ),
)
