"""Answers to the exercises of page 07."""

from bank.answer import Answer
from bank.beyond import findings, log_watcher, tuning

#: What a learner has to find, in pieces that no hint may hold; spaces do not count.
SECRETS: dict[str, tuple[str, ...]] = {
    "07a": findings.SECRETS,
    "07b": tuning.SECRETS,
    "07c": log_watcher.SECRETS,
}

ANSWERS: tuple[Answer, ...] = (*findings.ANSWERS, *tuning.ANSWERS, *log_watcher.ANSWERS)
