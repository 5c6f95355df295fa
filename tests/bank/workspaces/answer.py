"""How an answer about files or a terminal is written down."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Answer:
    """One answer, and what must be said of it.

    Attributes:
        exercise: The exercise's id.
        name: What it is about; unique within the exercise.
        given: What the learner typed or wrote: lines of a shell, a file, or a cell.
        status: The status that it must get.
        mistakes: Ids of mistakes, each of which is a true name for what is wrong; one id if there
            is only one mistake. Empty if nothing is wrong.
        also: What else is in the workspace: lines of a shell, typed before.
    """

    exercise: str
    name: str
    given: str
    status: str = "passed"
    mistakes: tuple[str, ...] = ()
    also: str = ""

    @property
    def id(self) -> str:
        """Its name in a test report."""
        return f"{self.exercise} {self.name}"


def right(exercise: str, name: str, given: str, also: str = "") -> Answer:
    """An answer that does what is asked."""
    return Answer(exercise, name, given, also=also)


def untried(exercise: str, name: str, given: str, also: str = "") -> Answer:
    """Nothing that could be judged was left behind."""
    return Answer(exercise, name, given, "not attempted", (), also)


def wrong(exercise: str, name: str, mistakes: str, given: str, also: str = "") -> Answer:
    """An answer with a mistake; of two mistakes, with a blank between them, either may be named."""
    return Answer(exercise, name, given, "failed", tuple(mistakes.split()), also)
