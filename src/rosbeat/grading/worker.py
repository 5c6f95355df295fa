"""Prepare a process once, and fork it for each submission: `python -m rosbeat.grading.worker`.

::

    worker           has imported everything that pages need; never reads a submission
      └─ keeper      a fork for one submission: reads its jobs, creates its sandbox (see `sandbox`)
           └─ work   a fork for one page, which forks once more for each check

Each line on standard input is a submission: a list of lines of JSON, one per job. For each job the
worker writes a line to standard output. ROS itself is only started in the work, and a check starts
it anew in its own fork: a context of the process above would not work there. Since the worker never
reads a submission, the next learner's program finds no trace of it in its own memory. The worker's
environment contains only what ROS needs.
"""

from __future__ import annotations

import gc
import importlib
import importlib.util
import inspect
import json
import os
import select
import signal
import sys
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path

from rosbeat.environment import PROFILE_VARIABLES
from rosbeat.errors import GradingError
from rosbeat.grading import system_calls
from rosbeat.grading.jobs import PageEvidence, PageJob, read_line, to_line
from rosbeat.grading.sandbox import (
    Limits,
    Sandbox,
    View,
    become_able,
    python_folders,
)

#: What makes a worker run answers without a sandbox.
UNSAFE = "--unsafe-no-sandbox"
#: What answers use, and what takes time to import.
_PREPARED = (
    *("rclpy", "rclpy.node", "rclpy.qos", "rclpy.executors", "rclpy.action"),
    *("numpy", "numpy.random"),
    *("std_msgs.msg", "std_srvs.srv", "sensor_msgs.msg", "rcl_interfaces.msg", "test_msgs.action"),
    *("rosbeat.page_session", "rosbeat.ros.scenario", "rosbeat.ros.test_nodes"),
    *("IPython.core.interactiveshell", "rosbeat.exercises.registry", "rosbeat.exercises.check"),
    *("rosbeat.workspace.terminals", "rosbeat.workspace.magics", "rosbeat.workspace.saving_magic"),
)
#: Types of messages that answers use, and of the services and topics that every node has.
_TYPES = (
    *(f"std_msgs/msg/{name}" for name in ("Bool", "Float32", "Int32", "String")),
    *(f"rcl_interfaces/msg/{name}" for name in ("Log", "ParameterEvent")),
    *(f"rcl_interfaces/srv/{name}Parameters" for name in ("Describe", "Get", "List", "Set")),
    *("rcl_interfaces/srv/SetParametersAtomically", "rcl_interfaces/srv/GetParameterTypes"),
    "type_description_interfaces/srv/GetTypeDescription",
)
#: Variables that name a file of settings.
_FILES = (*PROFILE_VARIABLES, "COLCON_DEFAULTS_FILE")
#: Variables of the environment that ROS needs; nothing else of it reaches a sandbox.
_KEPT = (
    *("AMENT_PREFIX_PATH", "LD_LIBRARY_PATH", "ROS_PYTHON_CHECK_FIELDS", "LANG", "LC_ALL", "TZ"),
    *(*_FILES, "RMW_FASTRTPS_USE_QOS_FROM_XML"),
)
#: Folders of this package that hold solutions, or are nobody's business in there.
_HIDDEN = ("exercises/solved", "grading", "authoring", "workspace/finished")
#: Seconds that one run of a page may take by the clock on the wall, and bytes of its evidence.
WALL, RESULT = 240.0, 60_000_000
#: How a keeper ends that was told that there are no more submissions.
_NO_MORE = 7


def environment() -> dict[str, str]:
    """Return the environment of a worker: what Python and ROS need, and nothing else.

    The middleware's thousands of functions are looked up once, as it is loaded (ld.so(8)); else
    each answer would do so anew, for itself. Answers see nothing of this: see `View.environment`.
    """
    names = (*_KEPT, "PYTHONPATH", "PYTHONHOME")
    kept = {name: os.environ[name] for name in names if name in os.environ}
    return {**kept, "PATH": "/usr/bin:/bin", "LD_BIND_NOW": "1"}


def main(options: Sequence[str]) -> None:
    """Observe submissions until there are no more."""
    isolated = UNSAFE not in options
    if isolated:
        # It works only while there is one thread, and importing ROS starts more. If it is refused,
        # making a sandbox says so to whoever wants one.
        with suppress(OSError):
            become_able()
    # Whoever grades may be killed in the middle; nothing of a submission runs on after that.
    system_calls.prctl(system_calls.PR_SET_PDEATHSIG, signal.SIGKILL)
    prepare()
    view = view_of_answers()
    while True:
        select.select([0], [], [])
        keeper = os.fork()
        if keeper == 0:
            system_calls.prctl(system_calls.PR_SET_PDEATHSIG, signal.SIGKILL)
            os._exit(_keep(view, isolated))
        _, status = os.waitpid(keeper, 0)
        if status:
            sys.exit(0 if os.waitstatus_to_exitcode(status) == _NO_MORE else 1)


def prepare() -> None:
    """Import what answers will need, and load the C part of their message types."""
    for name in _PREPARED:
        importlib.import_module(name)
    recording = importlib.import_module("rosbeat.ros.recording")
    recording.load_type_support(_TYPES)
    recording.repair_message_classes()  # it looks for them once
    importlib.import_module("rosbeat.grading.transcript")
    # The first log line of a process looks for the file of each module; it finds them here.
    inspect.getmodule(sys._getframe())
    # What is here stays. A fork that looked through it for garbage would copy all of its pages; and
    # it ends before much garbage has come together.
    gc.collect()
    gc.freeze()
    gc.set_threshold(20_000, 20, 20)


def view_of_answers() -> View:
    """Return what answers see: Python, ROS and a part of this package; an empty environment."""
    kept = {name: os.environ[name] for name in _KEPT if name in os.environ}
    package = Path(__file__).resolve().parents[1]
    hidden = [str(package / name) for name in _HIDDEN]
    readable = [*python_folders(), *_commands(), *(kept[name] for name in _FILES if name in kept)]
    return View(readable, hidden, {**kept, "PATH": "/usr/bin:/bin", "HOME": "/tmp"})


def _commands() -> list[str]:
    """Return the folder of the `ros2` command, where it is the course's own."""
    found = importlib.util.find_spec("ros2_command")
    folders = found.submodule_search_locations if found else None
    return [str(Path(one).resolve().parent) for one in folders or ()]


def _keep(view: View, isolated: bool) -> int:
    """Observe one submission, in the keeper; return its exit code."""
    line = _line()
    if not line:
        return _NO_MORE
    try:
        with Sandbox(view, isolated) as sandbox:
            for one in json.loads(line):
                evidence = _observed(read_line(PageJob, one), sandbox)
                _say(to_line(evidence))
    except GradingError as error:
        _say(json.dumps({"refused": [error.what, error.means, error.to_try]}))
    except BaseException as error:
        with suppress(OSError):
            os.write(2, f"A worker ends: {error!r}. Another one does what it did.\n".encode())
        return 1
    return 0


def _line() -> bytes:
    """Return the next line; nobody writes another one before this one is answered."""
    found = bytearray()
    while not found.endswith(b"\n"):
        data = os.read(0, 1 << 20)
        if not data:
            return b""
        found += data
    return bytes(found)


def _say(line: str) -> None:
    data = memoryview(f"{line}\n".encode())
    while data:
        data = data[os.write(1, data) :]


def limits_of(job: PageJob, seconds: float = WALL) -> Limits:
    """Return what a run of a page may use; builds and programs in terminals need more processes.

    Args:
        job: The page.
        seconds: How long it may take, by the clock on the wall.
    """
    processes, wall = 512 if job.needs_files else 128, min(WALL, seconds)
    return Limits(wall=wall, cpu=int(wall) + 1, processes=processes, result=RESULT)


def _observed(job: PageJob, sandbox: Sandbox) -> PageEvidence:
    from rosbeat.grading.transcript import observe_page

    return observe_page(job, lambda work, seconds: sandbox.run(work, limits_of(job, seconds)))


if __name__ == "__main__":
    main(sys.argv[1:])
