"""Solution pages run in processes of their own, and what goes wrong there is told here."""

import os
import shutil
from pathlib import Path

import pytest

from rosbeat.authoring.source import Course
from rosbeat.authoring.together import solution_bytes, solutions
from rosbeat.errors import LessonError

GOLDEN = Path(__file__).parents[2] / "golden"
TEXT = """# ---
# title: Count {n}
# minutes: 1
# needs: []
# summary: A page for a test.
# ---

# %% [markdown]
# # Count {n}

# %%
import os
print({code})
"""


@pytest.fixture
def course(tmp_path):
    for folder in ("src/lessons", "notebooks", "solutions"):
        (tmp_path / folder).mkdir(parents=True)
    shutil.copy(GOLDEN.parents[1] / "pyproject.toml", tmp_path)
    return Course(tmp_path)


def lessons(course, *codes):
    for n, code in enumerate(codes):
        path = course.root / f"src/lessons/{n:02}_count.py"
        path.write_text(TEXT.format(n=n, code=code))
    return course.lessons()


def test_pages_run_together_are_the_pages_run_alone(course):
    found = lessons(course, "1 + 1", "2 + 2", "3 + 3")
    with solutions(found, course.solutions, fresh=True) as solution:
        together = [solution(one) for one in found]
    assert together == [solution_bytes(one, course.solutions, fresh=True) for one in found]
    assert b"'4'" in together[1] or b'"4\\n"' in together[1]


def test_one_page_needs_no_other_process(course, monkeypatch):
    monkeypatch.setattr("rosbeat.authoring.together.ProcessPoolExecutor", None)
    (one,) = lessons(course, "os.getpid() > 0")
    with solutions([one], course.solutions, fresh=True) as solution:
        assert b"True" in solution(one)


def test_an_error_comes_over_with_all_three_parts(course):
    found = lessons(course, "1", "1 / 0", "3")

    def run_all():
        with solutions(found, course.solutions, fresh=True) as solution:
            return [solution(one) for one in found]

    with pytest.raises(LessonError) as caught:
        run_all()
    assert "ZeroDivisionError" in str(caught.value)
    assert caught.value.what
    assert caught.value.to_try


def test_no_page_needs_nothing(course):
    with solutions([], course.solutions, fresh=False):
        assert os.getpid()
