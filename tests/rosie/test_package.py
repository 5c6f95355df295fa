"""Rosie's package: pip puts the same files in the same places as colcon."""

import os
import pty
import re
import subprocess
import sys
import termios
from pathlib import Path

import pytest
from geometry_msgs.msg import Twist
from rclpy.node import Node

from rosbeat import Session
from rosbeat.domains import lease_domain

ROOT = Path(__file__).parents[2] / "src" / "rosie"
FOLDERS = ("lib/rosie", "share/rosie")


def files_below(prefix):
    """Return the names of the package's files in a prefix, and which of them are programs."""
    return {
        str(path.relative_to(prefix)): bool(path.stat().st_mode & 0o111)
        for folder in FOLDERS
        for path in (prefix / folder).rglob("*")
        if path.is_file() and "__pycache__" not in path.parts
    }


@pytest.mark.ros
def test_pip_and_colcon_put_the_same_files_in_the_same_places(tmp_path):
    made = subprocess.run(
        ["colcon", "build", "--base-paths", str(ROOT / "rosie"), "--packages-select", "rosie"],
        cwd=tmp_path, capture_output=True, text=True, timeout=120,
    )  # fmt: skip
    assert made.returncode == 0, made.stderr
    by_colcon = files_below(tmp_path / "install" / "rosie")
    own = {name: one for name, one in by_colcon.items() if "/hook/" not in name}
    own = {name: one for name, one in own.items() if not name.startswith("share/rosie/package.")}
    own["share/rosie/package.xml"] = False
    assert files_below(Path(sys.prefix)) == own


def test_both_have_one_version():
    project = (ROOT / "pyproject.toml").read_text()
    (version,) = re.findall(r'^version = "(.+)"', project, re.MULTILINE)
    assert f"<version>{version}</version>" in (ROOT / "rosie" / "package.xml").read_text()
    assert f"version='{version}'" in (ROOT / "rosie" / "setup.py").read_text()


@pytest.mark.ros
def test_the_linters_of_ros_find_nothing():
    found = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "test"],
        cwd=ROOT / "rosie", capture_output=True, text=True, timeout=120,
        env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1"},
    )  # fmt: skip
    assert found.returncode == 0, found.stdout


@pytest.mark.ros
def test_keys_are_read_from_a_terminal_only():
    program = Path(sys.prefix) / "lib" / "rosie" / "teleop"
    found = subprocess.run(
        [sys.executable, program],
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        timeout=60,
    )
    assert found.returncode == 1
    assert found.stderr.splitlines()[0] == "There are no keys to read here."
    assert "ros2 topic pub --once /rosie/cmd_vel" in found.stderr


@pytest.mark.ros
def test_arrow_keys_drive_and_q_leaves_the_terminal_as_it_was():
    lease = lease_domain()
    heard = []
    ours, theirs = pty.openpty()
    before = termios.tcgetattr(theirs)
    program = Path(sys.prefix) / "lib" / "rosie" / "teleop"
    with Session(domain_id=lease.domain_id) as ros:
        node = ros.add(lambda: Node("listener"))
        node.create_subscription(
            Twist, "/rosie/cmd_vel", lambda told: heard.append((told.linear.x, told.angular.z)), 10
        )
        ros.start()
        running = subprocess.Popen(
            [sys.executable, program], stdin=theirs, stdout=subprocess.DEVNULL,
            env={**os.environ, "ROS_DOMAIN_ID": str(lease.domain_id)},
        )  # fmt: skip
        try:
            ros.wait_for_nodes("/rosie/teleop", timeout=30.0)
            assert ros.wait(30, until=lambda: node.count_publishers("/rosie/cmd_vel"))
            for key, command in (
                (b"\x1b[A", (0.4, 0.0)),
                (b"\x1b[D", (0.0, 1.2)),
                (b" ", (0.0, 0.0)),
            ):
                os.write(ours, key)
                assert ros.wait(30, until=lambda wanted=command: wanted in heard)
            os.write(ours, b"q")
            assert running.wait(30) == 0
        finally:
            running.kill()
            running.wait()
    assert termios.tcgetattr(theirs) == before
    os.close(ours)
    os.close(theirs)
    lease.release()
