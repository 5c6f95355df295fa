"""Evidence as text: whatever a scenario hands to a judge, written as JSON and read back.

The text is an object with `format`, `version`, `kind` and the fields of that kind, nested as they
are in the dataclass; see `rosbeat.records_json`. Nothing of a learner's is run when it is read, so
an answer can be judged elsewhere, and later.
"""

from __future__ import annotations

from rosbeat import records_json
from rosbeat.exercises.page_01 import FolderMaking
from rosbeat.exercises.page_02 import PackageMaking
from rosbeat.exercises.page_06 import CodeChange, LinkMaking
from rosbeat.exercises.page_11 import BagReports, Replays
from rosbeat.exercises.page_13 import Trials
from rosbeat.exercises.scenarios import Report, TypedIn, Value, Workspace
from rosbeat.exercises.system import SystemRun
from rosbeat.records import Observation, ProgramRun

FORMAT = "rosbeat evidence"
#: Raised by one whenever a field that a judge reads is taken away or given another meaning; not for
#: a new one with a default, nor for one that no judge reads any more, which is passed over.
VERSION = 5
KINDS: dict[str, type] = {
    kind.__name__: kind
    for kind in (
        Observation,
        Workspace,
        TypedIn,
        FolderMaking,
        PackageMaking,
        SystemRun,
        ProgramRun,
        Report,
        Replays,
        BagReports,
        Trials,
        CodeChange,
        LinkMaking,
    )
}


def to_json(seen: Value) -> str:
    """Write what a scenario has seen; the same evidence gives the same text.

    Raises:
        RecordError: If it is of no known kind.
    """
    kind = type(seen).__name__
    if KINDS.get(kind) is not type(seen):
        raise records_json.refusal(f"There is no evidence of the kind {kind}.", _known())
    return records_json.to_json(seen, {"format": FORMAT, "version": VERSION, "kind": kind})


def from_json(text: str) -> Value:
    """Read what `to_json` wrote.

    Raises:
        RecordError: If it is not JSON, of another format, version or kind, or if any field is
            missing or of another type.
    """
    kind = records_json.read_head(text, "evidence", FORMAT, VERSION).kind
    if kind not in KINDS:
        raise records_json.refusal(f"Its kind is {kind!r}.", _known())
    return records_json.from_json(KINDS[kind], text, kind)


def _known() -> str:
    return f"The kinds are: {', '.join(KINDS)}."
