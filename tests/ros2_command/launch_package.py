"""The package `demo` with programs and launch files, and how to read what a launch prints."""

import os
import re
import textwrap
from pathlib import Path

SAY = '#!/bin/sh\necho "$@"\necho wrong >&2\n'
WAIT = """#!/bin/sh
case $1 in [0-9]*) code=$1;; esac
trap 'echo interrupted; exit ${code:-0}' INT
echo waiting
while :; do sleep 0.01; done
"""
DEAF = "#!/bin/sh\ntrap '' INT TERM\necho deaf\nwhile :; do sleep 0.01; done\n"
HEAD = """\
import os
from launch import LaunchDescription
from launch.actions import *
from launch.conditions import *
from launch.event_handlers import *
from launch.events import Shutdown as ShutdownEvent
from launch.launch_description_sources import *
from launch.substitutions import *
from launch_ros.actions import *
from launch_ros.parameter_descriptions import *
from launch_ros.substitutions import *

HERE = os.path.dirname(__file__)


def generate_launch_description():
    return LaunchDescription([
"""


class Demo:
    """The package `demo`, with programs and launch files."""

    def __init__(self, prefix):
        self.prefix, self.share = prefix, prefix / "share" / "demo"
        index = prefix / "share" / "ament_index" / "resource_index" / "packages"
        index.mkdir(parents=True)
        (index / "demo").touch()
        (self.share / "launch").mkdir(parents=True)
        for name, text in (("say", SAY), ("wait", WAIT), ("deaf", DEAF), ("die", "exit 3\n")):
            self.program(name, text if text.startswith("#!") else f"#!/bin/sh\n{text}")

    def program(self, name, text):
        path = self.prefix / "lib" / "demo" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        path.chmod(0o755)

    def file(self, text, name="x.launch.py"):
        """Write a launch file, in Python with these actions, and return its path."""
        path = self.share / "launch" / name
        inside = textwrap.indent(textwrap.dedent(text), " " * 8)
        path.write_text(f"{HEAD}{inside}\n    ])\n" if name.endswith(".py") else text)
        return path


def running_in(folder):
    """The processes whose command line names a folder."""
    found = []
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit() and int(entry.name) != os.getpid():
            try:
                words = (entry / "cmdline").read_bytes()
            except OSError:  # it has just ended
                continue
            if os.fsencode(str(folder)) + b"/lib/" in words:
                found.append(words)
    return found


def lines(text):
    """What a launch prints, without what differs from run to run and how every launch begins."""
    text = re.sub(r"pid \[?\d+\]?", "pid N", text)
    shown = re.sub(r"\S+/launch_params_\w+/(\d+)\.yaml", r"FILE\1", text).splitlines()
    assert shown[0].startswith("[INFO] [launch]: All log files can be found below ")
    assert shown[1] == "[INFO] [launch]: Default logging verbosity is set to INFO"
    return shown[2:]


def outputs(shown, name):
    """What one process has printed."""
    return [line.removeprefix(f"[{name}] ") for line in shown if line.startswith(f"[{name}] ")]
