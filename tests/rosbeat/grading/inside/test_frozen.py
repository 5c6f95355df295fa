"""Freezing changes the process it is done in, so each of these runs in one of its own."""

import subprocess
import sys
from textwrap import dedent

import pytest

pytestmark = pytest.mark.ros
_BEFORE = """
    from rosbeat.grading.worker import prepare
    prepare()
    import json
    from rclpy.node import Node
    from std_msgs.msg import Float32
"""


def said(code):
    program = dedent(_BEFORE) + dedent(code)
    run = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    return run.stdout.strip() + run.stderr.strip().rpartition("\n")[2]


@pytest.mark.parametrize(
    ("code", "words"),
    [("Node.create_timer = None", "cannot set 'create_timer' attribute of immutable type"),
     ("del Node.create_timer", "immutable type"),
     ("json.dumps = None", "cannot set 'dumps' of the module 'json'"),
     ("del json.dumps", "cannot delete 'dumps' of the module 'json'"),
     ("from rosbeat.ros.recording import Recorder as R; R.samples = 1", "immutable type"),
     ("from contextlib import ExitStack as E; E.__exit__ = 1", "immutable type")],
)  # fmt: skip
def test_what_is_there_stays_as_it_is(code, words):
    assert words in said(code)


@pytest.mark.parametrize(
    "code",
    ["class Mine(Node):\n    pass\nMine.speed = 3\nassert Mine.speed == 3",
     "Float32.data = 3.0", "import random; random.seed(1)", "json.mine = 1",
     "import weakref, tempfile; tempfile.TemporaryDirectory()"],
)  # fmt: skip
def test_ones_own_classes_and_messages_can_be_changed(code):
    assert said(f"{dedent(code)}\nprint('done')").endswith("done")
