"""The live view of a robot, without a browser; `tests/browser/test_robot.py` has the rest."""

import json
import os
import subprocess
import sys

import pytest

from rosbeat import watch_robot
from rosbeat.domains import lease_domain
from rosbeat.errors import CallError


def test_where_no_browser_is_it_says_what_would_be_here(capsys):
    watch_robot()._ipython_display_()
    assert "In JupyterLab, the live view of Rosie is here" in capsys.readouterr().out


@pytest.mark.parametrize("name", ["", "a b", "/", 5, "2nd", "größe"])
def test_what_is_no_name_is_refused(name):
    with pytest.raises(CallError, match="is not the name of a robot"):
        watch_robot(name)


@pytest.mark.ros
def test_the_reporter_tells_what_a_robot_does_and_passes_commands_on():
    lease = lease_domain()
    environment = {**os.environ, "ROS_DOMAIN_ID": str(lease.domain_id)}
    rover = subprocess.Popen(
        [sys.executable, f"{sys.prefix}/lib/rosie/rover"], env=environment,
        stderr=subprocess.DEVNULL,
    )  # fmt: skip
    reporter = subprocess.Popen(
        [sys.executable, "-m", "rosbeat.ros.robot_reporter", "rosie"], env=environment,
        stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
    )  # fmt: skip
    try:
        frames = (json.loads(line) for line in reporter.stdout)
        first = next(frames)
        assert first == {"pose": None, "scan": [], "temperature": None, "lamp": None}
        # Fifteen seconds of frames, if it takes so long on a busy machine.
        early = [frame for frame, _ in zip(frames, range(150), strict=False) if frame["pose"]][:1]
        assert early[0]["pose"] == [0.5, 0.7, 0.0]
        reporter.stdin.write("[0.5, 0]\n")
        reporter.stdin.flush()
        assert any(frame["pose"][0] > 0.6 for frame, _ in zip(frames, range(150), strict=False))
        rover.terminate()
        rover.wait(30)
        assert any(frame["pose"] is None for frame, _ in zip(frames, range(150), strict=False))
        reporter.stdin.close()
        assert reporter.wait(30) == 0
    finally:
        for program in (rover, reporter):
            program.kill()
            program.wait()
        reporter.stdout.close()
        lease.release()
