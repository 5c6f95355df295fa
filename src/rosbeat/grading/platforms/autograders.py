"""Write what the platforms of autograders read: `results.json` of Gradescope and of PrairieLearn.

Neither was at hand. The formats are those that they publish:

- Gradescope: "Autograder Specifications", gradescope-autograders.readthedocs.io/en/latest/specs.
- PrairieLearn: "External Grading" in its documentation, docs.prairielearn.com/externalGrading, and
  what its element `pl-external-grader-results` shows. It takes 1 MB at most.

Learners may choose parts of what is said here, such as the text of an exception. So all of it is
plain text, in which no control character is left.
"""

from __future__ import annotations

from collections.abc import Mapping

from rosbeat.errors import SubmissionError
from rosbeat.grading.files import number
from rosbeat.grading.marks import Gradebook, Mark
from rosbeat.grading.one_submission import Form, finding, plain, remarks_of, written
from rosbeat.grading.remarks import REACHES_INSIDE

#: Characters of what is said of the whole.
_MOST = 4_000


def _about(book: Gradebook) -> str:
    """Return what came of the whole, and what the learner should know of the files."""
    (graded,) = book.learners
    lines = [
        f"{remark.path}: {remark.text}"
        for remark in remarks_of(book)
        if remark.about != REACHES_INSIDE  # that is for the instructor only
    ]
    points = f"{number(graded.points)} of {number(graded.out_of)} points."
    return plain([points, *lines])[:_MOST]


def _name(mark: Mark) -> str:
    return plain([f"{mark.exercise} {mark.title}"])


def _refused(error: SubmissionError) -> str:
    return " ".join(filter(None, (error.what, error.means, error.to_try)))


# Gradescope.


def _gradescope(book: Gradebook, code: int) -> str:
    (graded,) = book.learners
    tests = [
        {
            **{"name": _name(mark), "name_format": "text"},
            **{"score": mark.points, "max_score": mark.out_of},
            "status": "passed" if mark.points >= mark.out_of else "failed",
            **{"output": finding(mark), "output_format": "text"},
        }
        for mark in graded.marks
    ]
    about = {"output": _about(book), "output_format": "text"}
    return written({**about, "score": graded.points, "tests": tests, **_course(book)})


def _gradescope_refusal(error: SubmissionError, code: int) -> str:
    return written({"output": _refused(error), "output_format": "text", "score": 0.0, "tests": []})


def _course(book: Gradebook) -> Mapping[str, object]:
    """Return the version of the course, which Gradescope keeps and shows to nobody."""
    return {"extra_data": {"course": book.course}}


# PrairieLearn.


def _prairielearn(book: Gradebook, code: int) -> str:
    (graded,) = book.learners
    tests = [
        {
            **{"name": _name(mark), "description": plain([mark.status])},
            **{"points": mark.points, "max_points": mark.out_of},
            "output": finding(mark),
        }
        for mark in graded.marks
    ]
    share = graded.points / graded.out_of if graded.out_of else 0.0
    score = {"gradable": True, "score": min(max(share, 0.0), 1.0)}
    return written({**score, "message": _about(book), "tests": tests})


def _prairielearn_refusal(error: SubmissionError, code: int) -> str:
    """Return that there is nothing to grade, which costs the learner no attempt."""
    return written({"gradable": False, "format_errors": [_refused(error)]})


#: The forms by what is typed after `--format`. These platforms hand over one submission at a time.
AUTOGRADERS = {
    "gradescope": Form(_gradescope, _gradescope_refusal),
    "prairielearn": Form(_prairielearn, _prairielearn_refusal),
}
