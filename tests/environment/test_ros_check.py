"""The real thing, in the environment that runs these tests."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.ros

CHECK = Path(__file__).resolve().parents[2] / "environment" / "course_tool" / "ros_check.py"


def bare():
    """An environment in which nobody has set anything."""
    return {"PATH": os.defpath, "HOME": os.environ.get("HOME", "/")}


def run(*arguments, **more):
    done = subprocess.run(
        [sys.executable, *arguments],
        env={**bare(), **more},
        capture_output=True,
        text=True,
        check=True,
    )
    return json.loads(done.stdout)


def test_a_node_hears_another():
    pytest.importorskip("rclpy")
    facts = run(str(CHECK))
    assert facts["milliseconds"] is not None
    assert facts["rmw"] == "rmw_fastrtps_cpp"
    assert facts["environ"]["ROS_AUTOMATIC_DISCOVERY_RANGE"] == "LOCALHOST"


def test_a_plain_python_has_what_nodes_need_before_any_import():
    if not list(Path(sys.prefix).glob("lib/python*/site-packages/zz_rosbeat_environment.pth")):
        pytest.skip("this Python is not that of the course's .venv")
    code = "import json, os; print(json.dumps(dict(os.environ)))"
    found = run("-c", code)
    assert 1 <= int(found["ROS_DOMAIN_ID"]) <= 50
    assert found["AMENT_PREFIX_PATH"] == sys.prefix
    assert found["ROS_PYTHON_CHECK_FIELDS"] == "1"
    assert run("-c", code, ROS_DOMAIN_ID="77")["ROS_DOMAIN_ID"] == "77"
