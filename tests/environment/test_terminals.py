"""Terminals as a learner has them: `course shell`, those of JupyterLab, and a bare bash."""

import asyncio
import json
import os
import re
import subprocess
import sys
import urllib.request
from pathlib import Path

import pytest
from tornado.websocket import websocket_connect

from course_tool import commands, lab, layout, running
from rosbeat.environment import learners_folder

LAYOUT = layout.of_this_checkout()
#: Where the workspace lies, and a terminal starts.
HOME = Path(learners_folder())
TOKEN = "only-for-this-test"
ASK = 'echo "<$(command -v ros2)> <$(command -v python3)> <$ROS_DISTRO> <${PYTHONPATH-}> <$PWD>"\n'

pytestmark = pytest.mark.skipif(
    Path(sys.prefix) != LAYOUT.venv, reason="needs the .venv of this checkout"
)

UNFRIENDLY = """\
export PATH="$HOME/bin:$PATH"
export AMENT_PREFIX_PATH=/opt/ros/humble ROS_DISTRO=humble
export PYTHONPATH=/opt/ros/humble/lib/python3.10/site-packages
alias mine='echo my own alias'
"""


@pytest.fixture
def environ(tmp_path):
    """The environment of somebody whose start file puts another Python and another ROS first."""
    HOME.mkdir(exist_ok=True)
    (tmp_path / ".bashrc").write_text(UNFRIENDLY)
    (tmp_path / "bin").mkdir()
    for name in ("python3", "ros2"):
        program = tmp_path / "bin" / name
        program.write_text("#!/bin/sh\necho wrong\n")
        program.chmod(0o755)
    plain = {"HOME": str(tmp_path), "PATH": os.defpath, "TERM": "dumb"}
    return commands.for_shells(running.inside(plain, LAYOUT), LAYOUT)


def typed(text, environ, folder=LAYOUT.root):
    """What an interactive bash of the course prints when a text is typed into it."""
    done = subprocess.run(
        [*commands.interactive_shell(), "-i"],
        input=text,
        env=environ,
        cwd=folder,
        capture_output=True,
        text=True,
        timeout=100,
        check=False,
    )
    return done.stdout


def ours(folder=HOME):
    return f"<{LAYOUT.venv}/bin/ros2> <{LAYOUT.venv}/bin/python3> <jazzy> <> <{folder}>\n"


def test_the_courses_environment_comes_after_the_persons_start_file(environ):
    assert typed(ASK + "mine\n", environ) == ours() + "my own alias\n"


def test_every_command_is_there_and_the_two_long_ones_complete(environ):
    text = "command -v colcon rosbeat; complete -p ros2 colcon\n"
    lines = typed(text, environ).splitlines()
    assert lines[:2] == [f"{LAYOUT.venv}/bin/colcon", f"{LAYOUT.venv}/bin/rosbeat"]
    assert re.match(r"complete .* ros2$", lines[2])
    assert re.match(r"complete .* colcon$", lines[3])


def test_a_shell_that_runs_one_command_knows_the_same_workspace():
    launcher, ask = LAYOUT.environment / "course", 'echo "$ROS2_WORKSPACE"'
    dropped = ("ROS2_WORKSPACE", "ROSBEAT_WORKSPACE_IN", "ROSBEAT_MY_COURSE")
    environ = {name: value for name, value in os.environ.items() if name not in dropped}
    done = subprocess.run(
        [launcher, "shell", "-c", ask], env=environ, capture_output=True, text=True, check=True
    )
    assert done.stdout.splitlines()[-1] == str(LAYOUT.learner / "ROS2_and_RL_Tutorials")
    assert LAYOUT.learner.is_dir()


def test_a_terminal_starts_where_the_workspace_lies(environ, tmp_path):
    environ["ROSBEAT_WORKSPACE_IN"] = str(tmp_path)
    assert typed(ASK, environ) == ours(tmp_path)


def test_a_terminal_that_was_opened_elsewhere_stays_there(environ, tmp_path):
    environ["ROSBEAT_WORKSPACE_IN"] = str(tmp_path)
    there = LAYOUT.root / "notebooks"
    assert typed(ASK, environ, there) == ours(there)


def test_a_workspace_folder_that_is_gone_stops_nothing(environ, tmp_path):
    environ["ROSBEAT_WORKSPACE_IN"] = str(tmp_path / "gone")
    assert typed(ASK, environ) == ours(LAYOUT.root)


def test_sourcing_the_underlay_in_a_bare_bash_is_enough():
    script = f". '{LAYOUT.venv}/setup.bash' && ros2 pkg prefix rclpy && python3 -c 'import rclpy'"
    done = subprocess.run(
        ["bash", "-c", script],
        env={"PATH": os.defpath, "HOME": "/nowhere"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.stdout, done.stderr, done.returncode) == (f"{LAYOUT.venv}\n", "", 0)


@pytest.fixture
def server(environ, tmp_path):
    """The address of a Jupyter server with the options of `course lab`."""
    options = [f"--IdentityProvider.token={TOKEN}", f"--ServerApp.root_dir={LAYOUT.root}"]
    command = [LAYOUT.python, "-m", "jupyter_server", "--no-browser", "--ServerApp.port=0"]
    command += lab.lab_options(LAYOUT, options, root_user=os.geteuid() == 0)
    folders = {
        f"JUPYTER_{name}_DIR": str(tmp_path / name) for name in ("RUNTIME", "CONFIG", "DATA")
    }
    with (tmp_path / "server.log").open("wb") as log:
        process = subprocess.Popen(
            command, env={**environ, **folders}, cwd=LAYOUT.root, stdout=log, stderr=log
        )
        try:
            yield lab.when_open(process, tmp_path / "RUNTIME")["url"]
        finally:
            process.terminate()
            process.wait(timeout=30)


async def typed_in_lab(server, text, until):
    """What a terminal of JupyterLab shows until a pattern appears."""
    request = urllib.request.Request(
        f"{server}api/terminals", method="POST", headers={"Authorization": f"token {TOKEN}"}
    )
    with urllib.request.urlopen(request) as answer:
        name = json.load(answer)["name"]
    place = server.replace("http", "ws", 1) + f"terminals/websocket/{name}?token={TOKEN}"
    connection = await websocket_connect(place)
    await connection.write_message(json.dumps(["stdin", text]))
    shown = ""
    while not re.search(until, shown):
        kind, *rest = json.loads(await connection.read_message())
        shown += rest[0] if kind == "stdout" else ""
    connection.close()
    while await connection.read_message() is not None:
        pass  # the socket is closed when the other side has said goodbye, too
    return shown


def test_a_terminal_of_jupyterlab_is_the_courses_shell(server, tmp_path):
    asking = typed_in_lab(server, ASK.replace("\n", "\r"), r"<[^\n]*> <jazzy> <[^\n]*>")
    shown = asyncio.run(asyncio.wait_for(asking, 100))
    assert ours().strip() in shown
    asking = typed_in_lab(server, 'echo "<$ROS_DOMAIN_ID=$ROSBEAT_DOMAIN_ID>"\r', r"<\d+=\d+>")
    shown = asyncio.run(asyncio.wait_for(asking, 100))
    *_, leased = (tmp_path / ".cache" / "rosbeat" / "domains").read_text().split()
    assert f"<{leased}={leased}>" in shown
