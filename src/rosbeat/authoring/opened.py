"""What JupyterLab alone changes in a learner's page: opening, running and saving it."""

from __future__ import annotations

import json
from typing import Any

#: Metadata that editors add to a cell when it is run, folded or scrolled.
_CELL_KEYS = ("collapsed", "execution", "jupyter", "scrolled", "trusted")


def only_opened(present: bytes, content: bytes) -> bool:
    """Whether a page says what it should, apart from what opening and running it adds.

    Args:
        present: The page as it stands in a file.
        content: What it should be; a page with outputs is compared in full elsewhere.
    """
    try:
        wanted = json.loads(content)
        return not _has_outputs(wanted) and _bare(json.loads(present)) == _bare(wanted)
    except (ValueError, KeyError, TypeError, AttributeError):
        return False  # no notebook any more


def _has_outputs(page: dict[str, Any]) -> bool:
    return any(cell.get("outputs") for cell in page["cells"])


def _bare(page: dict[str, Any]) -> list[Any]:
    return [_bare_cell(cell) for cell in page["cells"]]


def _bare_cell(cell: dict[str, Any]) -> tuple[Any, ...]:
    source, metadata = cell["source"], dict(cell["metadata"])
    for key in _CELL_KEYS:
        metadata.pop(key, None)
    text = source if isinstance(source, str) else "".join(source)
    return cell["cell_type"], cell["id"], text, metadata
