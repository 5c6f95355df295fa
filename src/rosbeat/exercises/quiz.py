"""Ask the questions at the end of a page, and say at once what is right: `quiz`.

The questions, with a reason for every choice, are in `questions.md`.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from importlib.resources import files
from string import ascii_lowercase
from typing import Any

from rosbeat.errors import ExerciseError, called_as
from rosbeat.exercises.cells import cells_of
from rosbeat.exercises.outcome_display import OPEN, RIGHT, WRONG, framed, words
from rosbeat.exercises.predict import is_blank
from rosbeat.exercises.registry import this_page

# The questions of `questions.md`.


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


def _read_questions() -> dict[str, tuple[Question, ...]]:
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


QUESTIONS = _read_questions()
"""The questions of each page, by its number."""


# What a learner calls.

#: Stands before the choice that was made.
_CHOSEN = "\N{RIGHTWARDS ARROW}"


@dataclass(frozen=True)
class Asked:
    """Hold a question with the choice that was made.

    Attributes:
        question: The question.
        chosen: Index of the choice, or None if the question is still open.
    """

    question: Question
    chosen: int | None = None

    @property
    def choice(self) -> Choice | None:
        """Return the choice that was made, or None."""
        return None if self.chosen is None else self.question.choices[self.chosen]

    @property
    def sign(self) -> str:
        """Return the sign of the outcome: right, wrong or open."""
        if self.choice is None:
            return OPEN
        return RIGHT if self.choice.right else WRONG


@dataclass(frozen=True)
class Quiz:
    """Hold the questions of a page, as Jupyter and a terminal show them.

    Attributes:
        page: Number of the page.
        asked: The questions, in order.
    """

    page: str
    asked: tuple[Asked, ...]

    def __str__(self) -> str:
        return "\n".join(["\n\n".join("\n".join(_lines(one)) for one in self.asked), *self._way()])

    def __repr__(self) -> str:
        return str(self)

    def html(self) -> str:
        """Return the questions as HTML, and how to answer."""
        return self.cards() + "".join(f"<div>{words(line)}</div>" for line in self._way() if line)

    def cards(self) -> str:
        """Return the questions alone as HTML."""
        return "".join(framed(one.sign, *_rows(one)) for one in self.asked)

    @property
    def is_right(self) -> bool:
        """Return whether all answers are right."""
        return all(one.sign == RIGHT for one in self.asked)

    def _repr_mimebundle_(self, **_: object) -> dict[str, Any]:
        return {"text/plain": str(self), "text/html": self.html()}

    def _way(self) -> Iterator[str]:
        """Generate how to answer, unless all answers are right."""
        if self.is_right:
            return
        letters = ", ".join(
            f'"{ascii_lowercase[n if one.chosen is None else one.chosen]}"'
            for n, one in enumerate(self.asked)
        )
        yield ""
        call = f'quiz("{self.page}", {letters})'
        yield f"To answer, write a letter for each question, such as `{call}`."


class QuizCard(Quiz):
    """Show questions whose choices can be clicked, in a notebook that is open in a browser."""

    def _ipython_display_(self) -> None:
        # The widgets take a while to load, and only a notebook in a browser shows them.
        from rosbeat.exercises.widget_actions import ExerciseWidget

        asked = list(self.asked)

        def choose(content: Mapping[str, Any]) -> str:
            number = int(content["question"])
            asked[number] = replace(asked[number], chosen=int(content["choice"]))
            made = Quiz(self.page, tuple(asked))
            card.questions, card.passed = [_view(one) for one in asked], made.is_right
            card.keep(made.cards(), str(made))
            return ""  # the reason is below the choices

        questions = [_view(one) for one in asked]
        card = ExerciseWidget({"choose": choose}, "quiz", questions=questions)
        card.passed = self.is_right
        card.keep(self.cards(), str(self))
        card.show()


@called_as('quiz("03", "b", "a", "c")')
def quiz(page: str = "", *answers: str) -> Quiz:
    """Ask the questions of a page, or say which of the answers are right, and why.

    Args:
        page: Number of the page, such as `"03"`; the page at hand if it is left out.
        answers: A letter for each question, in order. A blank or a missing one leaves its
            question open.

    Returns:
        The questions, which Jupyter shows.

    Raises:
        ExerciseError: If there is no such page, if there are more answers than questions, or if
            an answer is no letter of its question.
    """
    here = this_page()
    number = str(page).strip() or (here.number if here else "")
    questions = QUESTIONS.get(number.zfill(2)) if number else None
    if questions is None:
        raise ExerciseError(
            f"There are no questions for page {page!r}." if number else "Which page is meant?",
            f"There are questions for the pages {', '.join(QUESTIONS)}.",
            'Write the number of a page, as in quiz("03").',
        )
    if len(answers) > len(questions):
        raise ExerciseError(
            f"`quiz` was given {len(answers)} answers.",
            f"Page {questions[0].page} has {len(questions)} questions.",
            "Write one letter for each question, in order.",
        )
    chosen = [_index(*pair) for pair in zip(questions, answers, strict=False)]
    chosen += [None] * (len(questions) - len(answers))
    made = Quiz(questions[0].page, tuple(map(Asked, questions, chosen)))
    cells = cells_of()
    if cells is None or not cells.for_a_browser:
        return made
    return QuizCard(made.page, made.asked)


def _index(question: Question, answer: object) -> int | None:
    """Return the index of the choice that an answer names."""
    if is_blank(answer):
        return None
    letters = ascii_lowercase[: len(question.choices)]
    letter = str(answer).strip().strip("()").lower()
    if len(letter) != 1 or letter not in letters:
        raise ExerciseError(
            f"{answer!r} is not an answer to question {question.id}.",
            f"The choices are {', '.join(letters)}.",
            f'Write the letter of your choice in quotes, such as "{letters[0]}".',
        )
    return letters.index(letter)


def _view(asked: Asked) -> dict[str, Any]:
    """Return what the browser shows of a question, as HTML."""
    return {
        "id": asked.question.id,
        "sign": asked.sign,
        "text": words(asked.question.text),
        "choices": [words(f"{letter}) {choice.text}") for letter, choice in _lettered(asked)],
        "chosen": asked.chosen,
        "reason": words(asked.choice.reason) if asked.choice else "",
    }


def _lines(asked: Asked) -> Iterator[str]:
    """Generate a question as lines of text, with the choice that was made."""
    yield f"{asked.sign} Question {asked.question.id}: {asked.question.text}"
    for letter, choice in _lettered(asked):
        yield f"{_CHOSEN if choice is asked.choice else ' '} {letter}) {choice.text}"
    if asked.choice:
        yield f"  {asked.choice.reason}"


def _rows(asked: Asked) -> Iterator[str]:
    """Generate the same as rows of HTML."""
    yield words(f"{asked.sign} Question {asked.question.id}: {asked.question.text}", "strong")
    for letter, choice in _lettered(asked):
        is_chosen = choice is asked.choice
        mark = f"{_CHOSEN} " if is_chosen else ""
        yield words(f"{mark}{letter}) {choice.text}", "strong" if is_chosen else "")
    if asked.choice:
        yield words(asked.choice.reason, "em")


def _lettered(asked: Asked) -> Iterator[tuple[str, Choice]]:
    return zip(ascii_lowercase, asked.question.choices, strict=False)
