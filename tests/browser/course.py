"""The course as a learner opens it, `course lab`, in a folder of its own."""

import json
import os
import re
import shutil
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from browser.lab import Lab
from rosbeat.domains import lease_domain

ROOT = Path(__file__).parents[2]
#: `course lab` without the installing: this checkout's `.venv` serves a copy of the course.
TOOL = """\
import os, sys
sys.path.insert(0, {environment!r})
from course_tool import cli, prepare, running
prepare.ready = lambda layout, level: running.inside(dict(os.environ), layout)
sys.exit(cli.main(["lab", *sys.argv[1:]]))
"""
OPTIONS = (
    *("--no-browser", "--ServerApp.port=0", "--IdentityProvider.token="),
    *("--ServerApp.disable_check_xsrf=True", "--LabApp.expose_app_in_browser=True"),
)


class Course:
    """A copy of the course, and `course lab` in it.

    Attributes:
        root: The copy.
        process: The command.
        said: What it has printed until the pages could be opened.
    """

    def __init__(self, root, environ):
        self.root = root
        tool = TOOL.format(environment=str(root / "environment"))
        self.process = subprocess.Popen(
            [sys.executable, "-I", "-c", tool, *OPTIONS],
            env=environ, cwd=root, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        )  # fmt: skip
        self.said = []
        while not self.said or "Ctrl+C" not in self.said[-1]:
            line = self.process.stdout.readline()
            assert line, self.process.communicate()
            self.said.append(line)

    @property
    def own(self):
        """The learner's folder."""
        return self.root / "my_course"

    @property
    def lab(self):
        """The server that it started."""
        return Lab(re.search(r"(http\S+/)lab", "".join(self.said))[1], self.own)

    def progress(self):
        """The ids of the exercises that were tried."""
        path = self.own / ".rosbeat" / "progress.json"
        return set(json.loads(path.read_text())["exercises"]) if path.exists() else set()

    def programs(self):
        """Command lines of all processes that belong to this course."""
        found = []
        for folder in Path("/proc").glob("[0-9]*"):
            try:
                line = (folder / "cmdline").read_bytes().replace(b"\0", b" ").decode()
            except OSError:
                continue  # it has ended meanwhile
            found += [line] if str(self.root) in line else []
        return found

    def stop(self):
        """Press Ctrl+C; return what the command printed after that."""
        self.process.send_signal(signal.SIGINT)
        return self.process.communicate(timeout=120)


@contextmanager
def open_course(folder: Path) -> Iterator[Course]:
    """Copy the course to a folder that is a learner's first, open it there, and end it with all.

    Args:
        folder: An empty folder.
    """
    root = folder / "course"
    for name in ("environment", "src", "notebooks", "solutions"):
        shutil.copytree(ROOT / name, root / name)
    (root / ".venv").symlink_to(ROOT / ".venv")
    lease = lease_domain()
    dropped = re.compile(r"PYTEST|ROSBEAT_|ROS2_WORKSPACE|JUPYTER_")
    kept = {name: value for name, value in os.environ.items() if not dropped.match(name)}
    made = Course(root, {
        **kept,
        "PYTHONPATH": os.pathsep.join(str(root / one) for one in ("src", "src/ros2_command")),
        "JUPYTER_CONFIG_DIR": str(folder / "config"),
        "IPYTHONDIR": str(folder / "ipython"),
        "ROS_DOMAIN_ID": str(lease.domain_id),
    })  # fmt: skip
    try:
        yield made
    finally:
        if made.process.poll() is None:
            made.stop()
        lease.release()
