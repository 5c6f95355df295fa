"""What may be wrong with an answer that is graded, and is never seen by a check on a page."""

from __future__ import annotations

from rosbeat.diagnosis.mistake import Mistake

MISTAKES: tuple[Mistake, ...] = (
    Mistake("unreadable-cell", "a cell that Python cannot read"),
    Mistake("too-long", "a program that does not come to an end"),
    Mistake("too-much-memory", "a program that takes more and more memory"),
    Mistake("too-much-output", "a program that prints without end"),
    Mistake("crashed", "a process that died"),
    Mistake("left-early", "a program that ends its process"),
    Mistake("changes-the-course", "a program that changes what observes it"),
    Mistake("evidence-unreadable", "a run that leaves something else than evidence"),
)
