"""Mistakes in the exercises of page 11, record and replay."""

from __future__ import annotations

from rosbeat.diagnosis.mistake import Mistake

MISTAKES: tuple[Mistake, ...] = (
    Mistake("all-topics", "messages of another topic counted"),
    Mistake("nan-left-out", "a message left out because it holds no number"),
    Mistake("counted-wrong", "counted one too many or too few"),
    Mistake("other-gap", "another stretch of time than asked for"),
    Mistake("nan-spreads", "a NaN that spoils a mean"),
    Mistake("wrong-share", "a sum divided by another count than its own"),
    Mistake("other-mean", "another number than the mean"),
    Mistake("no-dict", "a result without names"),
    Mistake("key-missing", "a result without a name that was asked for"),
    Mistake("no-number", "something else than one number"),
    Mistake("fixed-answer", "the same answer whatever is given"),
    Mistake("nan-compared", "a NaN that nobody notices"),
    Mistake("nan-kept", "a NaN kept for the next comparison"),
    Mistake("alarm-at-start", "an alarm for the very first reading"),
    Mistake("one-direction", "a difference noticed in one direction only"),
    Mistake("other-reading", "compared with another reading than asked for"),
    Mistake("never-reset", "a memory that is never reset"),
    Mistake("nearly-equal", "nearly equal taken for equal"),
    Mistake("too-few-pairs", "a mean of too few pairs"),
    Mistake("mean-of-sizes", "signs lost before the mean is made"),
    Mistake("pairs-mixed-up", "pairs that do not belong together"),
)
