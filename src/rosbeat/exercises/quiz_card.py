"""The questions of a page in a notebook that is open in a browser: below the card are buttons."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any
from uuid import uuid4

from IPython.display import display, update_display
from traitlets import Unicode

from rosbeat.exercises.live import ExerciseWidget

_HERE = Path(__file__).parent
#: What is shown: the card as a MIME bundle, and the questions for the buttons, as JSON.
View = tuple[Mapping[str, Any], str]


class QuizWidget(ExerciseWidget):
    """Offer a button for each choice of each question."""

    _esm = Unicode((_HERE / "quiz.js").read_text(encoding="utf-8")).tag(sync=True)
    #: The questions as JSON: the id, the choices, and which of them was made (an index, or null).
    questions = Unicode().tag(sync=True)


def show(view: View, choose: Callable[[int, int], tuple[View, str]]) -> None:
    """Display questions with buttons below them.

    Args:
        view: What is shown at first.
        choose: Takes the index of a question and that of a choice, and returns what is shown then,
            and what is said in one line.
    """
    display_id = f"rosbeat-quiz-{uuid4().hex}"

    def clicked(content: Mapping[str, Any]) -> str:
        (card, questions), said = choose(int(content["question"]), int(content["choice"]))
        update_display(card, raw=True, display_id=display_id)
        widget.questions = questions
        return said

    card, questions = view
    widget = QuizWidget({"choose": clicked}, "quiz", questions=questions)
    display(card, raw=True, display_id=display_id)
    widget.show()
