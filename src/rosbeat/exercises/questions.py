"""Three questions for the end of each page, with a reason for every choice: see `questions.md`."""

from __future__ import annotations

import re
from dataclasses import dataclass
from importlib.resources import files


@dataclass(frozen=True)
class Choice:
    """Hold one answer that a question offers.

    Attributes:
        text: The answer; code stands between backticks.
        reason: Why it is right or wrong, in a sentence or two.
        right: Whether it is the right answer.
    """

    text: str
    reason: str
    right: bool


@dataclass(frozen=True)
class Question:
    """Hold a question with exactly one right answer.

    Attributes:
        id: Number of the page and of the question, such as `03.1`.
        text: The question; code stands between backticks.
        choices: The answers on offer, in the order in which they are shown.
    """

    id: str
    text: str
    choices: tuple[Choice, ...]

    @property
    def page(self) -> str:
        """Return the number of the page, such as `03`."""
        return self.id[:2]


_QUESTION = re.compile(r"^## (\d\d\.\d)$\n\n(.*?)(?=^## |\Z)", re.MULTILINE | re.DOTALL)
_CHOICE = re.compile(r"^- \[([x ])\] (.*?)\n\n(.*?)(?=\n\n|\n?\Z)", re.MULTILINE | re.DOTALL)


def _read() -> dict[str, tuple[Question, ...]]:
    """Return the questions of `questions.md` by page."""
    pages: dict[str, tuple[Question, ...]] = {}
    text = files("rosbeat.exercises").joinpath("questions.md").read_text(encoding="utf-8")
    for name, body in _QUESTION.findall(text):
        choices = (
            Choice(_joined(said), _joined(reason), mark == "x")
            for mark, said, reason in _CHOICE.findall(body)
        )
        one = Question(name, _joined(body.partition("\n\n")[0]), tuple(choices))
        pages[one.page] = (*pages.get(one.page, ()), one)
    return pages


def _joined(paragraph: str) -> str:
    return " ".join(paragraph.split())


QUESTIONS = _read()
"""The questions of each page, by its number."""
