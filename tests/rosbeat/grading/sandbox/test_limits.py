"""Limits hold in the process that applies them, and in what it starts."""

import subprocess
import sys

from rosbeat.grading.sandbox.limits import Limits

PROGRAM = """
import resource
from rosbeat.grading.sandbox.limits import Limits
resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))
Limits(cpu=7, processes=55).apply()
print(resource.getrlimit(resource.RLIMIT_CPU), resource.getrlimit(resource.RLIMIT_NPROC))
print(resource.getrlimit(resource.RLIMIT_FSIZE), resource.getrlimit(resource.RLIMIT_CORE))
"""


def test_limits_are_set_and_never_wider_than_before():
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM], capture_output=True, text=True, check=True, timeout=60
    )
    assert done.stdout.split("\n")[:2] == ["(7, 7) (55, 55)", "(1000, 1000) (0, 0)"]


def test_the_defaults_leave_room_for_ros():
    assert Limits().address_space > 2_000_000_000
    assert Limits().processes >= 64
