"""Mistakes in the exercises of page 09, test the five claims."""

from __future__ import annotations

from rosbeat.diagnosis.mistake import Mistake

MISTAKES: tuple[Mistake, ...] = (
    Mistake("parameter-type", "a parameter of another type than declared"),
    Mistake("parameter-undeclared", "a parameter that was not declared"),
    Mistake("parameter-twice", "a parameter declared twice"),
    Mistake("parameter-for-value", "a parameter where its value is meant"),
    Mistake("absolute-name", "a name that no namespace moves"),
    Mistake("limits-fixed", "limits that no parameter changes"),
    Mistake("unit-fixed", "a unit that no parameter changes"),
    Mistake("other-default", "another default than asked for"),
    Mistake("beat-starved", "a beat that waits for the work"),
    Mistake("work-too-short", "work that takes less time than it has to"),
    Mistake("work-too-long", "work that takes more time than it has to"),
    Mistake("work-at-once", "two orders worked on at once"),
    Mistake("order-lost", "an order that nobody works on"),
    Mistake("order-swapped", "orders done in another order than they came"),
    Mistake("done-twice", "an order reported done twice"),
    Mistake("silence-unnoticed", "a silence that nobody notices"),
    Mistake("noticed-afterwards", "a silence noticed only when it is over"),
    Mistake("noticed-early", "a silence reported that is none"),
    Mistake("noticed-late", "a silence noticed too late"),
    Mistake("lost-before-found", "a sensor reported lost that was never there"),
    Mistake("back-missing", "a return that nobody reports"),
    Mistake("back-too-often", "a return reported of one that was not lost"),
    Mistake("wrong-form", "a text whose parts stand in another form than asked for"),
)
