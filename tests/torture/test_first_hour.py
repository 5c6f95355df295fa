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


STOPPED = {
    "a loop in a cell": "print('go', flush=True)\nwhile True:\n    pass",
    "a check": (
        "import time\n"
        "from rclpy.node import Node\n"
        "from rosbeat import check\n"
        "class Slow(Node):\n"
        "    def __init__(self):\n"
        "        super().__init__('slow')\n"
        "        import sys; print('go', file=sys.__stdout__, flush=True)\n"
        "        while True: pass\n"
        "print('go', flush=True)\n"
        "check('00a', Slow)"
    ),
    "a terminal": "%%terminal one --timeout 50\necho go; cat",
}


@pytest.mark.ros
@pytest.mark.parametrize("name", STOPPED)
def test_interrupt_is_explained_in_three_parts_and_by_no_stack(name, tmp_path):
    with Kernel() as kernel:
        place = f"import os\nos.environ['ROSBEAT_WORKSPACE_IN'] = {str(tmp_path)!r}\n"
        assert kernel.run(place + IMPORTS).error == ""
        reply = kernel.interrupt(STOPPED[name], 1.0)
    assert reply.error == "KeyboardInterrupt"
    lines = reply.trace.splitlines()
    assert lines[0].startswith("KeyboardInterrupt: ")
    assert [line.split(":")[0].strip() for line in lines[1:]] == ["What it means", "What to try"]
