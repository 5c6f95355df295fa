"""What a program printed, and the mistake that it shows."""

import os
import subprocess
import sys

import pytest

from broken_nodes import IMPORTS, Broken, P, S, T, V, publisher, sensor, timer
from rosbeat.diagnosis.programs import diagnose_output, fault_in
from rosbeat.domains import lease_domain

START = "Traceback (most recent call last):\n"
MAIN = '  File "/home/you/src/a.py", line 20, in main\n    rclpy.spin(node)\n'
RCLPY = '  File "/x/.venv/lib/python3.11/site-packages/rclpy/node.py", line 1, in f\n    take()\n'


def frame(code, name="tick", line=9):
    return f'  File "/home/you/install/a/lib/python3.11/site-packages/a/b.py", line {line}, ' \
        f"in {name}\n    {code}\n"  # fmt: skip


def test_the_record_of_a_traceback():
    error = "AssertionError: The 'data' field must be of type 'float'"
    frames = f"{MAIN}{RCLPY}{frame('msg.data = 25')}{RCLPY}"
    text = f"[INFO] [s]: on\n{START}{frames}{error}\n[ros2run]: Process exited\n"
    fault = fault_in(text)
    assert (fault.kind, fault.callback, fault.line, fault.code) == (
        *("AssertionError", "tick"),
        *(9, "msg.data = 25"),
    )
    assert fault.text == "The 'data' field must be of type 'float'"
    assert diagnose_output(text).evidence == (
        "tick raised AssertionError. The field data of the message takes a float, but 25 is an "
        "int. Line 9: `msg.data = 25`."
    )


def test_the_last_traceback_counts():
    first = f"{START}{MAIN}KeyError: 'a'\n\nDuring handling of the above exception:\n\n"
    text = f"{first}{START}{MAIN}{frame('humidity')}NameError: name 'humidity' is not defined\n"
    assert diagnose_output(text).mistake == "name-error"
    assert diagnose_output(first) is None


def test_marks_under_a_line_and_colours_are_no_code():
    text = f"{START}{frame('publish(25.0)')}    ~~~~^^^^\n\x1b[1mTypeError\x1b[0m: Expected " \
        "<class 'std_msgs.msg._float32.Float32'>, got <class 'float'>\r\n"  # fmt: skip
    found = diagnose_output(text)
    assert found.mistake == "number-published"
    assert "`publish(25.0)`" in found.evidence


@pytest.mark.parametrize(
    "text",
    [
        "",
        "all is well\n",
        "[ERROR] [s]: TypeError: Expected a Float32\n",
        "TypeError: quoted in a log\n",
        "Publisher ready\n",
    ],
)
def test_without_a_traceback_nothing_is_known(text):
    assert diagnose_output(text) is None


@pytest.mark.parametrize(
    ("last", "mistake"),
    [
        ("KeyboardInterrupt", "ctrl-c-traceback"),
        ("rclpy.executors.ExternalShutdownException", "ctrl-c-traceback"),
        ("rclpy._rclpy_pybind11.RCLError: failed to shutdown: rcl_shutdown already called on the "
         "given context, at ./src/rcl/init.c:333", "ctrl-c-traceback"),
        ("RuntimeError: Context must be initialized before it can be shutdown", "shut-down-twice"),
        ("SyntaxError: '(' was never closed", "syntax-error"),
        ("IndentationError: unexpected indent (b.py, line 3)", "syntax-error"),
        ("TypeError: 'NoneType' object is not callable", "callback-called"),
        ("TypeError: S.tick() missing 1 required positional argument: 'msg'",
         "callback-parameters"),
    ],
)  # fmt: skip
def test_how_programs_end(last, mistake):
    assert diagnose_output(f"{START}{MAIN}{RCLPY}{last}\n").mistake == mistake


def test_a_file_that_python_cannot_read_has_no_traceback():
    text = '  File "/home/you/a.py", line 3\n    rclpy.init(\n              ^\n' \
        "SyntaxError: '(' was never closed\n"  # fmt: skip
    found = diagnose_output(text)
    assert found.mistake == "syntax-error"
    assert found.evidence.endswith("Line 3: `rclpy.init(`.")


def test_two_nodes_of_one_name():
    text = "[WARN] [1.2] [rcl.logging_rosout]: Publisher already registered for node name: 'x'.\n"
    assert diagnose_output(text).mistake == "run-twice"


# For real.

LAST = "\nrclpy.init()\nnode = Answer()\nrclpy.spin(node)\n"
TWO = Broken("two nodes", "run-twice",
             "rclpy.init()\na, b = Node('x'), Node('x')\nrclpy.shutdown()")  # fmt: skip


@pytest.fixture
def domain_id():
    lease = lease_domain()
    yield lease.domain_id
    lease.release()


@pytest.mark.ros
@pytest.mark.parametrize(
    "broken",
    [
        publisher("topic first", "arguments-swapped", "'temperature', Float32, 10"),
        timer("called", "callback-called", "1.0, self.tick()"),
        sensor("init twice", "initialised-twice", f"rclpy.init()\n{S}{P}{V}{T}"),
        Broken("with init", "init-in-with", "with rclpy.init():\n    pass"),
        Broken("shut down twice", "shut-down-twice",
               "rclpy.init()\nrclpy.shutdown()\nrclpy.shutdown()"),
        TWO,
    ],
    ids=lambda one: one.name,
)  # fmt: skip
def test_real_programs(broken, tmp_path, domain_id):
    file = tmp_path / "program.py"
    file.write_text(IMPORTS + broken.text + (LAST if "Answer" in broken.text else ""))
    variables = {**os.environ, "ROS_DOMAIN_ID": str(domain_id), "HOME": str(tmp_path)}
    ran = subprocess.run(
        [sys.executable, str(file)],
        check=False,
        capture_output=True,
        text=True,
        timeout=100,
        env=variables,
    )
    found = diagnose_output(ran.stdout + ran.stderr)
    assert found, ran
    assert found.mistake == broken.mistake
