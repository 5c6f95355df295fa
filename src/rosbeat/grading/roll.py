"""Who is meant in a table that went through a person's hands."""

from __future__ import annotations

from collections.abc import Iterable

from rosbeat.grading.cells import cell
from rosbeat.grading.marks import Graded
from rosbeat.grading.remarks import printable


class UnusableError(ValueError):
    """Why a line, or a cell of it, cannot be used: a sentence.

    Args:
        what: What is wrong, a sentence.
        to_try: What to write instead, a sentence.
    """

    def __init__(self, what: str, to_try: str) -> None:
        super().__init__(what)
        self.to_try = to_try


#: Where to look a learner up.
_LOOK_UP = "Write what stands in the column learner of grades.csv."


class Roll:
    """Finds a learner by what a person, or a spreadsheet on the way, has made of the id.

    Args:
        learners: The class.
    """

    def __init__(self, learners: Iterable[Graded]) -> None:
        self._by_form: list[dict[str, list[Graded]]] = [{}, {}, {}, {}]
        for one in learners:
            forms = (one.learner, cell(one.learner), _folded(one.learner), _folded(one.name))
            for index, form in zip(self._by_form, forms, strict=True):
                if form:  # an empty name means nobody
                    index.setdefault(form, []).append(one)
            if one.system == "moodle":  # what the column Identifier of moodle.csv calls this one
                called = self._by_form[-1].setdefault(_folded(f"Participant {one.learner}"), [])
                called += [one] if one not in called else []

    def learner(self, text: str) -> Graded:
        """The one learner that is meant: by the id, by the id as a table shows it, by the name.

        In Moodle's worksheet, learner 4711 is `Participant 4711`; that is as good as the name.

        Args:
            text: What stands in the table.

        Raises:
            UnusableError: If there is none, or more than one.
        """
        if not text:
            raise UnusableError("It names no learner.", _LOOK_UP)
        shown = printable(text, 40)
        for index, form in zip(self._by_form, (text, text, *[_folded(text)] * 2), strict=True):
            found = index.get(form, [])
            if len(found) > 1:
                raise UnusableError(f"{shown!r} are {len(found)} learners; write the id.", _LOOK_UP)
            if found:
                return found[0]
        raise UnusableError(f"There is no learner {shown!r}.", _LOOK_UP)


def _folded(text: str) -> str:
    """Without capital letters, spare blanks, and zeros that a spreadsheet takes away."""
    plain = " ".join(cell(text).strip("' ").casefold().split())
    return (plain.lstrip("0") or "0") if plain.isdigit() else plain
