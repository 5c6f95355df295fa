"""What counts as a difference between two outputs, and what no comparison can see.

The checks of a page say something else on an untouched page than on a solved one.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from nbformat import NotebookNode, from_dict

from rosbeat.authoring.execution import BACKGROUND
from rosbeat.authoring.pages import quiet_message, quiet_traceback

#: As an outcome comes with its output; see `rosbeat.exercises.outcome_display`.
OUTCOME = "application/vnd.rosbeat.outcome+json"
REPLACING = ("clear_output", "update_display_data")


def comparable(outputs: list[Any]) -> list[Any]:
    """Copies of outputs in which a picture is only known to be there.

    Pixels depend on fonts and versions; the description beside them is compared like other text.
    """
    return [_comparable(from_dict(output)) for output in outputs]


def missing_outputs(cells: list[Any]) -> str:
    """Say why a page cannot be compared strictly, or say nothing."""
    code = [cell for cell in cells if cell.cell_type == "code" and cell.source.strip()]
    unrun = [cell.source.split("\n")[0] for cell in code if cell.execution_count is None]
    if unrun:
        return f"{len(unrun)} of {len(code)} code cells were never run, first {unrun[0]!r}."
    if code and not any(cell.outputs for cell in code):
        return "not one code cell has an output."
    return ""


def wrong_outcome(cell: Any, outputs: Iterable[Any], *, solved: bool) -> str:
    """Say what is wrong with the outcome of a check, or nothing.

    Args:
        cell: The cell that ran; only one that is marked as a check is looked at.
        outputs: Its outputs.
        solved: Whether the page is the solved one.
    """
    exercise = cell.metadata.get("rosbeat", {}).get("check")
    if not exercise:
        return ""
    found = [one["data"][OUTCOME] for one in outputs if OUTCOME in one.get("data", {})]
    wanted = (exercise, "passed" if solved else "not attempted")
    said = [(one["exercise"], one["status"]) for one in found]
    return "" if said == [wanted] else f"The check should say {wanted}, and says {said}"


class Watch:
    """Looks at every message of a kernel, also those that belong to no running cell."""

    def __init__(self) -> None:
        self._stderr = ""
        self._reported = 0
        self.replaced = ""

    def see(self, message: dict[str, Any]) -> None:
        """Take note of a message from the iopub channel."""
        content = message["content"]
        if message["msg_type"] == "stream" and content["name"] == "stderr":
            self._stderr += content["text"]
        if message["msg_type"] in REPLACING:
            self.replaced = message["msg_type"]

    def background_exception(self) -> str:
        """What a thread or finalizer printed while dying since this was last asked."""
        count = sum(self._stderr.count(mark) for mark in BACKGROUND)
        is_new, self._reported = count > self._reported, count
        return self._stderr[-2000:] if is_new else ""


def _comparable(output: NotebookNode) -> NotebookNode:
    if output.output_type == "error":
        output.evalue = quiet_message(output.evalue)
    elif output.output_type == "stream" and output.name == "stderr":
        output.text = quiet_traceback(output.text)
    data = output.get("data", {})
    for mime in list(data):
        if mime.startswith("image/") or (mime == "text/html" and ";base64," in data[mime]):
            del data[mime]
            data["picture"] = "a picture"
    return output
