"""Prose in code cells, and code in prose."""

from __future__ import annotations

import re
from collections.abc import Iterator

from rosbeat.authoring.lint.desk import Desk, Finding, learner_text, prose_lines, tree_of

_FEW_WORDS = 4
_MANY_WORDS = 40
_LOOKS_LIKE_CODE = re.compile(
    r"^\s*(?:>>> |\$ |import \w[\w.]*$|from [\w.]+ import \w|(?:async )?def \w+\(.*:\s*$"
    r"|class \w+(?:\(.*\))?:\s*$|self\.\w+|@\w+|(?:for|while|with|if) .+:\s*$"
    r"|[A-Za-z_][\w.]*\(.*\)\s*$|[A-Za-z_][\w.]* = \S+|(?:ros2|colcon|source|pip) \w\S*( \S+)?$)"
)


def prose_as_code(desk: Desk) -> Iterator[Finding]:
    """A code cell holds code, not sentences behind comment signs."""
    for cell in (cell for cell in desk.code if not cell.magic):
        lines = [line.strip() for line in learner_text(cell).split("\n") if line.strip()]
        comments = [line for line in lines if line.startswith("#")]
        words = sum(len(re.findall(r"[^\W\d_]{2,}", line)) for line in comments)
        only_comments = len(comments) == len(lines) and words >= _FEW_WORDS
        if only_comments or (words >= _MANY_WORDS and 3 * len(comments) > 2 * len(lines)):
            yield desk.finding(
                "prose-as-code",
                cell.line,
                "this code cell is prose.",
                "Begin it with '# %% [markdown]'.",
            )
        elif not lines:
            yield desk.finding("prose-as-code", cell.line, "this code cell is empty.")


def code_as_prose(desk: Desk) -> Iterator[Finding]:
    """Code in a markdown cell stands inside a fence, where it keeps its shape."""
    for cell in desk.markdown:
        for number, line in prose_lines(cell):
            text = re.sub(r"`[^`]*`", "", line)
            if _LOOKS_LIKE_CODE.match(text) and _parses_if_python(text):
                yield desk.finding(
                    "code-as-prose",
                    number,
                    f"{line.strip()!r} looks like code outside of a fence.",
                    "Put it between lines of ```.",
                )


def _parses_if_python(text: str) -> bool:
    # "for the first time:" opens like code and is a sentence; a compound statement needs a body.
    stripped = text.strip()
    if stripped.startswith((">>> ", "$ ", "@", "ros2 ", "colcon ", "source ", "pip ")):
        return True
    return tree_of(stripped + (" pass" if stripped.endswith(":") else "")) is not None
