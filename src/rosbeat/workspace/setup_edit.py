"""Puts entry points into the empty list of a `setup.py`, and changes nothing else of it."""

from __future__ import annotations

import re
from collections.abc import Sequence

from rosbeat.workspace.parsing import decoded, encoding_of
from rosbeat.workspace.setup_script import SetupScript, parse_setup

#: Python ends lines at these and, unlike `str.splitlines`, at nothing else.
_LINE = re.compile(r"[^\r\n]*(?:\r\n|\r|\n|$)")
_ITEM, _BRACKET = " " * 12, " " * 8


def with_entry_points(data: bytes, scripts: Sequence[str]) -> bytes | None:
    """Return the build script with entry points in its empty list of console scripts.

    Args:
        data: The build script. Its encoding and its line ends stay.
        scripts: Entry points, as in `talk = my_package.talk:main`.

    Returns:
        None if there is no such list, or the result would not say exactly that.
    """
    before = parse_setup(data)
    if before.problem or before.entry_points or before.incomplete or not before.end_of_scripts:
        return None
    text = decoded(data)
    at = _place_of_bracket(text, before)
    after = _inserted(text, at, scripts).encode(encoding_of(data))
    seen = parse_setup(after)
    says = [one.text for one in seen.entry_points]
    return after if says == list(scripts) and not seen.incomplete else None


def _place_of_bracket(text: str, setup: SetupScript) -> int:
    lines = _LINE.findall(text)
    line = lines[setup.end_of_scripts - 1].encode()
    column = len(line[: setup.end_column].decode()) - 1
    return sum(map(len, lines[: setup.end_of_scripts - 1])) + column


def _inserted(text: str, at: int, scripts: Sequence[str]) -> str:
    end = next((one for one in ("\r\n", "\n", "\r") if one in text), "\n")
    items = "".join(f"{_ITEM}'{one}',{end}" for one in scripts)
    start = max(text.rfind("\n", 0, at), text.rfind("\r", 0, at)) + 1
    if not text[start:at].strip():  # the bracket has a line of its own
        return text[:start] + items + text[start:]
    return f"{text[:at].rstrip(' ')}{end}{items}{_BRACKET}{text[at:]}"
