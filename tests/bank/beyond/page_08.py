"""Answers to the exercises of page 08."""

from bank.answer import Answer
from bank.beyond import (
    archive_right,
    archive_wrong,
    deadline_right,
    deadline_wrong,
    mode_keeper_right,
    mode_keeper_wrong,
    qos_more,
)

#: What a learner has to find, in pieces that no hint may hold; spaces do not count.
SECRETS: dict[str, tuple[str, ...]] = {
    "08a": ("depth=1,", "DurabilityPolicy.TRANSIENT_LOCAL", "!=self.mode"),
    "08b": ("depth=16", "16", "reliability=ReliabilityPolicy.BEST_EFFORT"),
    "08c": ("Duration(seconds=2", "deadline=self.on_silence", "word!=self.word", "self.word=word"),
}

ANSWERS: tuple[Answer, ...] = (
    *mode_keeper_right.ANSWERS,
    *mode_keeper_wrong.ANSWERS,
    *archive_right.ANSWERS,
    *archive_wrong.ANSWERS,
    *deadline_right.ANSWERS,
    *deadline_wrong.ANSWERS,
    *qos_more.ANSWERS,
)
