"""Mistakes in the exercises of page 07, look inside the graph."""

from __future__ import annotations

from rosbeat.diagnosis.mistake import Mistake

MISTAKES: tuple[Mistake, ...] = (
    # Findings about a system.
    Mistake("finding-missing", "a question that has no answer any more"),
    Mistake("finding-wrong", "a finding that the system contradicts"),
    Mistake("other-kind", "a finding of another kind than was asked for"),
    Mistake("name-incomplete", "a part of a name in the place of the whole"),
    Mistake("not-in-graph", "a name that nothing in the graph has"),
    Mistake("sides-confused", "one side of a topic taken for the other"),
    Mistake("period-for-rate", "seconds from one message to the next instead of messages a second"),
    # Parameters.
    Mistake("parameter-frozen", "a parameter that is read only once"),
    Mistake("parameter-late", "a parameter that counts one reading too late"),
    Mistake("parameter-refused", "a parameter that refuses a good value"),
    Mistake("parameters-swapped", "two parameters in each other's place"),
    Mistake("decimals-lost", "a decimal number made a whole one"),
    # Log lines as messages.
    Mistake("level-too-low", "a log line counted that is no warning"),
    Mistake("level-missed", "a level left out that is worse than a warning"),
    Mistake("text-for-name", "a log line's text in the place of its node's name"),
    Mistake("own-name", "the listener's own name in the place of the speaker's"),
    Mistake("said-once", "a name that is said only the first time"),
    Mistake("one-name-only", "warnings of one node only"),
)
