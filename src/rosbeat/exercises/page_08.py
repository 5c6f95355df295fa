"""Page 08, tune quality of service: the last word waits, listen to everybody, silence is news."""

from __future__ import annotations

from typing import Any

from rosbeat.exercises.everybody import judge_everybody
from rosbeat.exercises.exercise import Exercise
from rosbeat.exercises.last_word import judge_last_word
from rosbeat.exercises.page_08_scenarios import COMMANDS, DISPLAYS, READINGS, SCENARIOS, TIMES
from rosbeat.exercises.silence import judge_silence

EXERCISES: tuple[Exercise[Any], ...] = (
    Exercise(
        "08a",
        SCENARIOS["08a"],
        lambda observation: judge_last_word("08a", observation, COMMANDS, DISPLAYS),
        "the last word waits",
        2,
        (
            "Two questions: does somebody who comes late get old messages at all, and if so, how "
            "many? One policy answers the first, the depth the second.",
            "A profile is made with QoSProfile(depth=..., durability=...). What you leave out "
            "stays as it is by default, and that is reliable.",
            "In the callback, compare the command with self.mode, and do nothing if they are "
            "the same.",
        ),
    ),
    Exercise(
        "08b",
        SCENARIOS["08b"],
        lambda observation: judge_everybody("08b", observation, READINGS),
        "listen to everybody",
        2,
        (
            "Two decisions: what may you ask for, so that nobody is shut out? And how many "
            "readings have to wait?",
            "Ask for no more than the poorest sensor offers. The others offer more, and that fits.",
            "Both sensors fill the same queue. Count what comes from the two in eight seconds.",
        ),
    ),
    Exercise(
        "08c",
        SCENARIOS["08c"],
        lambda observation: judge_silence("08c", observation, TIMES),
        "silence is news",
        3,
        (
            "Three things belong together: a deadline in the QoS of the subscription, a callback "
            "for its event, and a memory of what was said last.",
            "QoSProfile takes deadline=Duration(...), and the events are handed over as "
            "SubscriptionEventCallbacks(deadline=...): the method, without brackets.",
            "Both methods say their word again and again. self.word is what was said last: only "
            "another word is news, and then it has to be remembered.",
        ),
    ),
)
