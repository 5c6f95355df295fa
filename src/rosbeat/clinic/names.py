"""List the diagnoses that the clinic accepts."""

from __future__ import annotations

from rosbeat.diagnosis.mistakes import mistake
from rosbeat.errors import called_as

#: More than ever occur.
KNOWN = (
    *("topic-misspelled", "wrong-namespace", "wrong-topic"),
    *("qos-mismatch", "type-mismatch", "depth-too-small", "first-messages-lost"),
    *("not-spun", "callback-blocks", "node-ended", "never-published", "gone-quiet"),
    *("run-twice", "two-sources", "wrong-rate"),
    *("wrong-unit", "never-changes", "no-clamp", "clamped-too-early", "boundary"),
)


@called_as("clinic.names()")
def names() -> dict[str, str]:
    """Return the meaning of every diagnosis by its id, including diagnoses that never occur."""
    return {name: mistake(name).title for name in KNOWN}
