"""From running a check to its outcome: exercises about nodes, with a right answer, in a kernel."""

from __future__ import annotations

import json
import sys
import tempfile
from pathlib import Path
from statistics import median

from measuring import Row
from processes import at_95_percent

sys.path.append(str(Path(__file__).resolve().parent.parent))

from torture.kernel import Kernel

WITHIN = 0.3
#: Runs in the kernel: the reference answers, each from the page that asks for it.
_CELL = """
import json, time
from rosbeat import check
from rosbeat.exercises.hint import answer_to
from rosbeat.exercises.registry import EXERCISES
from rclpy.node import Node

PRELUDE = '''
import random
import rclpy
from rclpy.node import Node
from std_msgs.msg import Float32, Float64, Int32, String
'''

def answer_of(name):
    space = {"__name__": "__main__"}
    exec(PRELUDE + answer_to(name), space)
    return next(one for one in reversed(space.values())
                if isinstance(one, type) and issubclass(one, Node) and one is not Node)

def spans_of(name, count):
    answer, spans = answer_of(name), []
    for _ in range(count + 1):
        begin = time.perf_counter()
        outcome = check(name, answer).outcome
        spans.append(time.perf_counter() - begin)
        assert outcome.status == "passed", outcome
    return spans
"""


def measure(quick: bool) -> list[Row]:
    """Median and 95th percentile of each; the first check of a kernel is a row of its own."""
    count = 10 if quick else 50
    with tempfile.TemporaryDirectory() as folder, Kernel() as kernel:
        _run(kernel, f"import os; os.environ['ROSBEAT_WORKSPACE_IN'] = {folder!r}")
        _run(kernel, _CELL)
        names = [name for name in _names(kernel) if name[:2] in ("00", "03", "04")]
        spans = {name: _spans(kernel, name, count) for name in names}
    first = spans[names[0]][0]
    rows = [Row("check, the first in a kernel", f"{first:.2f} s")]
    return rows + [_row(name, spans[name][1:]) for name in names]


def _names(kernel: Kernel) -> list[str]:
    return list(json.loads(_run(kernel, "print(json.dumps(list(EXERCISES)))")))


def _spans(kernel: Kernel, name: str, count: int) -> list[float]:
    return list(json.loads(_run(kernel, f"print(json.dumps(spans_of({name!r}, {count})))")))


def _run(kernel: Kernel, code: str) -> str:
    reply = kernel.run(code)
    if reply.error:
        raise RuntimeError(f"{reply.error}: {reply.text}")
    return reply.text


def _row(name: str, spans: list[float]) -> Row:
    middle, slow = median(spans), at_95_percent(spans)
    value = f"{middle:.3f} s, 95 % {slow:.3f} s"
    return Row(f"check {name}", value, "", f"95 % < {WITHIN:g} s", slow < WITHIN)
