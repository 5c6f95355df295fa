"""Mistakes in the exercises of page 13, build your own."""

from __future__ import annotations

from rosbeat.diagnosis.mistake import Mistake

MISTAKES: tuple[Mistake, ...] = (
    Mistake("no-system", "something that is no list of nodes"),
    Mistake("two-controllers", "two nodes that command one actuator"),
    Mistake("two-tasks", "one node with two tasks"),
    Mistake("shared-variable", "nodes that share a variable and no topic"),
    Mistake("falls-together", "a node that takes another one down with it"),
    Mistake("never-switched-on", "an actuator that is not switched on when it should be"),
    Mistake("wrong-duration", "another duration than asked for"),
    Mistake("rest-too-short", "a rest that is too short"),
    Mistake("no-interlock", "two actuators at work that exclude each other"),
    Mistake("alarm-too-early", "an alarm before its time"),
    Mistake("nonsense-believed", "a reading that cannot be is believed"),
    Mistake("limit-fixed", "a limit that cannot be set from outside"),
)
