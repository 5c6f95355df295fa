"""A beginner's first hour in a real kernel: each mistake is answered with what to do next."""

import re

import pytest

from first_hour import CELLS, IMPORTS
from torture.kernel import Kernel

#: What every answer has: the third part of an error, a hint, a near name, a remark, or the usage.
NEXT = re.compile(
    r"(?m)What to try|Hint|Did you mean|: write a number|^# (?!exit code)|^rosbeat: |%terminal NAME"
)


@pytest.mark.ros
def test_each_mistake_is_answered_with_what_to_do_next(tmp_path):
    with Kernel() as kernel:
        place = f"import os\nos.environ['ROSBEAT_WORKSPACE_IN'] = {str(tmp_path)!r}\n"
        assert kernel.run(place + IMPORTS).error == ""
        replies = {name: kernel.run(cell) for name, cell in CELLS.items()}
    said = {name: f"{reply.text}\n{reply.trace}" for name, reply in replies.items()}
    assert {name: text for name, text in said.items() if not NEXT.search(text)} == {}
