from __future__ import annotations

import pytest

from rosbeat.authoring.header import split_header
from rosbeat.errors import LessonError

GOOD = ["# ---", "# title: Hear it: now", "# minutes: 5", '# needs: ["00", 03]',
        "# summary: One.", "# ---", "", "# %%", "1"]  # fmt: skip


def test_a_header_is_read_and_the_rest_keeps_its_lines():
    header, rest, taken = split_header("\n".join(GOOD), "x.py")
    assert (header.title, header.minutes, header.needs) == ("Hear it: now", 5, ("00", "03"))
    assert rest.startswith("# %%")
    assert GOOD[taken] == "# %%"


@pytest.mark.parametrize(
    ("line", "replacement", "message"),
    [
        (0, "# %%", "no header"),
        (5, "#", "not closed"),
        (1, "# titel: x", "does not know"),
        (1, "title: x", "does not know"),
        (2, "# title: twice", "lacks minutes"),
        (2, "# minutes: ten", "not a whole number"),
        (3, "# needs: 00", "not a list"),
        (3, "# needs: [first]", "not a list"),
    ],
)
def test_a_wrong_header_is_refused(line, replacement, message):
    lines = [*GOOD[:line], replacement, *GOOD[line + 1 :]]
    with pytest.raises(LessonError, match=message):
        split_header("\n".join(lines), "x.py")
