"""Answers to the exercises of page 08."""

from bank.answer import Answer
from bank.beyond import (
    everybody_right,
    everybody_wrong,
    last_word_right,
    last_word_wrong,
    news_of_silence_right,
    news_of_silence_wrong,
    qos_more,
)

#: What a learner has to find, in pieces that no hint may hold; spaces do not count.
SECRETS: dict[str, tuple[str, ...]] = {
    "08a": ("depth=1,", "DurabilityPolicy.TRANSIENT_LOCAL", "!=self.mode"),
    "08b": ("depth=16", "16", "reliability=ReliabilityPolicy.BEST_EFFORT"),
    "08c": ("Duration(seconds=2", "deadline=self.on_silence", "word!=self.word", "self.word=word"),
}

ANSWERS: tuple[Answer, ...] = (
    *last_word_right.ANSWERS,
    *last_word_wrong.ANSWERS,
    *everybody_right.ANSWERS,
    *everybody_wrong.ANSWERS,
    *news_of_silence_right.ANSWERS,
    *news_of_silence_wrong.ANSWERS,
    *qos_more.ANSWERS,
)
