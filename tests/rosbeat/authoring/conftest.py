from __future__ import annotations

import textwrap

import pytest

from rosbeat.authoring.lint import Desk
from rosbeat.authoring.source import Course, read_lesson

HEADER = """\
# ---
# title: {title}
# minutes: 10
# needs: {needs}
# summary: A page for the tests.
# ---
"""
# As many words and cells as the first page needs.
FILLER = "\n".join(f"# %% [markdown]\n# {' '.join(['word'] * 40)} {n}\n" for n in range(12))


class Checkout:
    """A course in a temporary folder, written lesson by lesson."""

    def __init__(self, root):
        self.course = Course(root)
        self.course.sources.mkdir(parents=True)
        self.course.notebooks.mkdir()

    def write(self, body, name="00_hear_it", title="Hear it", needs="[]", filler=False):
        top = f"\n# %% [markdown]\n# # {title}\n\n{FILLER if filler else ''}\n"
        text = HEADER.format(title=title, needs=needs) + top + textwrap.dedent(body)
        path = self.course.sources / f"{name}.py"
        path.write_text(text, encoding="utf-8")
        return path

    def lesson(self, body, **options):
        return read_lesson(self.write(body, **options))

    def desk(self, body, **options):
        lesson = self.lesson(body, **options)
        return Desk(self.course, tuple(self.course.lessons()), lesson)


@pytest.fixture
def checkout(tmp_path):
    return Checkout(tmp_path)
