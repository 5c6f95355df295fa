from __future__ import annotations

import textwrap

import pytest

from rosbeat.authoring.source import Course, read_lesson

HEADER = """\
# ---
# title: {title}
# minutes: 10
# needs: {needs}
# summary: A page for the tests.
# ---
"""


class Checkout:
    """A course in a temporary folder, written lesson by lesson."""

    def __init__(self, root):
        self.course = Course(root)
        self.course.sources.mkdir(parents=True)
        self.course.notebooks.mkdir()

    def write(self, body, name="00_hear_it", title="Hear it", needs="[]"):
        top = f"\n# %% [markdown]\n# # {title}\n\n"
        text = HEADER.format(title=title, needs=needs) + top + textwrap.dedent(body)
        path = self.course.sources / f"{name}.py"
        path.write_text(text, encoding="utf-8")
        return path

    def lesson(self, body, **options):
        return read_lesson(self.write(body, **options))


@pytest.fixture
def checkout(tmp_path):
    return Checkout(tmp_path)
