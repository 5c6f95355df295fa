"""Mistakes in the exercises of page 12, beyond topics."""

from __future__ import annotations

from rosbeat.diagnosis.mistake import Mistake

MISTAKES: tuple[Mistake, ...] = (
    Mistake("no-service", "nothing that answers"),
    Mistake("service-misspelled", "a service or action under another name"),
    Mistake("response-missing", "a service's callback that gives nothing back"),
    Mistake("response-wrong", "something else given back than the response"),
    Mistake("response-not-filled", "a response that says no although it was done"),
    Mistake("reason-missing", "a refusal without a reason"),
    Mistake("nonsense-accepted", "a value accepted that makes no sense"),
    Mistake("nan-accepted", "a NaN that passes because it compares with nothing"),
    Mistake("good-value-refused", "a good value refused"),
    Mistake("refused-and-kept", "a value refused and used all the same"),
    Mistake("accepted-and-lost", "a value accepted and not used"),
    Mistake("not-validated", "a parameter that takes any value"),
    Mistake("result-of-another-kind", "a parameter callback that gives back no result"),
    Mistake("validated-one-by-one", "a new value compared with an old one"),
    Mistake("no-action", "nothing that takes a goal"),
    Mistake("result-missing", "work that gives no result back"),
    Mistake("result-wrong", "a result that holds something else"),
    Mistake("feedback-wrong", "something else than feedback"),
    Mistake("feedback-missing", "feedback that does not come each second"),
    Mistake("canceled-unasked", "a goal reported canceled that nobody canceled"),
    Mistake("ended-twice", "a goal that ends twice"),
    Mistake("await-missing", "a future where its result is meant"),
    Mistake("not-an-integer", "a number that is not whole"),
    Mistake("succeed-forgotten", "a goal that was reached and is not reported"),
    Mistake("never-ends", "work that does not end"),
    Mistake("ends-too-soon", "work that ends before the goal is reached"),
    Mistake("left-on", "a heater that nobody switches off"),
    Mistake("cancel-refused", "a goal that cannot be canceled"),
    Mistake("cancel-ignored", "a cancel that the work does not look at"),
    Mistake("cancel-not-reported", "a canceled goal that is reported as another end"),
)
