"""How long a newcomer who reads nothing waits: from the first command to the first message.

It takes a clone and an empty home, and downloads what the course needs, so only a thorough run
does it. The figure is printed (`-s`) and is in the report (`--junitxml`); the goal, `GOAL` seconds
on an idle machine with a near mirror, is no limit, since nobody knows what else a machine does.
"""

import os
import re
import shutil
import signal
import subprocess
import time

import pytest

from browser.course import ROOT
from browser.notebook import LONG_PATIENCE, SHOWN
from rosbeat.domains import lease_domain

#: Seconds.
GOAL = 30.0
#: Whoever clicks on without reading runs so many cells until the first message.
CELLS = 3

pytestmark = [pytest.mark.ros, pytest.mark.thorough, pytest.mark.timeout(900)]


@pytest.fixture(scope="session")
def lab():
    """None: the server is what the test starts."""


@pytest.fixture
def environ(tmp_path):
    """The environment of somebody whose home is empty."""
    dropped = re.compile(
        r"PYTEST|ROSBEAT_|ROS2_WORKSPACE|JUPYTER_|VIRTUAL_ENV|XDG_|PYTHONPATH|UV_CACHE"
    )
    kept = {name: value for name, value in os.environ.items() if not dropped.match(name)}
    (tmp_path / "home").mkdir()
    lease = lease_domain()
    yield {**kept, "HOME": str(tmp_path / "home"), "ROS_DOMAIN_ID": str(lease.domain_id)}
    lease.release()


def test_the_first_message_comes_soon(page, environ, tmp_path, record_property):
    clone = tmp_path / "course"
    subprocess.run(["git", "clone", "--quiet", ROOT, clone], check=True, env=environ)
    begin = time.monotonic()
    lab = subprocess.Popen(
        [clone / "environment" / "course", "lab", "--no-browser", "--ServerApp.port=0"],
        env=environ, cwd=clone, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
    )  # fmt: skip
    try:
        said = []
        while not (said and "is open at" in said[-1]):
            line = lab.stdout.readline()
            assert line, "".join(said)
            said.append(line)
        opened = time.monotonic() - begin
        page.goto(said[-1].split()[-1], timeout=LONG_PATIENCE)
        page.locator(".rosbeat-progress").get_by_role(
            "link", name="00 Hear the heartbeat"
        ).first.click(timeout=LONG_PATIENCE)
        cell = page.locator(f"{SHOWN} .jp-CodeCell").first
        page.locator(f"{SHOWN} h1", has_text="Hear the heartbeat").wait_for(timeout=LONG_PATIENCE)
        page.get_by_text("ROS 2 (rosbeat) | Idle").wait_for(timeout=LONG_PATIENCE)
        cell.locator(".cm-content").click(timeout=LONG_PATIENCE)
        message = page.locator(f"{SHOWN} .jp-OutputArea-output", has_text="It is 22.5 degrees")
        for _ in range(2 * CELLS):  # some cells between are texts
            page.keyboard.press("Shift+Enter")
        message.first.wait_for(timeout=LONG_PATIENCE)
        heard = time.monotonic() - begin
    finally:
        lab.send_signal(signal.SIGINT)
        lab.communicate(timeout=120)
        shutil.rmtree(clone)
    record_property("seconds until the address", round(opened, 1))
    record_property("seconds until the first message", round(heard, 1))
    print(f"\naddress {opened:.1f} s, first message {heard:.1f} s (goal: {GOAL:g} s)")
