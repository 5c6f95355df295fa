"""A process that is prepared once and forks into a sandbox for each job; see `start_worker`.

It reads jobs, a line of JSON each, and answers each with a line. Interpreter, ROS and message types
are imported once, before the first fork; ROS itself is started in the child only, for a fork after
`rclpy.init` hangs. Nothing of a judge is ever imported here: what a process knows, its forks know.
"""

from __future__ import annotations

import gc
import importlib
import importlib.util
import inspect
import json
import os
import secrets
import sys
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any, TextIO

from rosbeat.errors import GradingError
from rosbeat.exercises.evidence import from_json
from rosbeat.grading.inside.frozen import freeze
from rosbeat.grading.inside.intact import Census, census
from rosbeat.grading.inside.kernel import kernel_files, kernel_job
from rosbeat.grading.inside.observing import observe_job
from rosbeat.grading.inside.replaying import replay_job
from rosbeat.grading.jobs import FORGED, READY, Job, Observed, read_job, write_line
from rosbeat.grading.sandbox.cage import Cage, python_folders
from rosbeat.grading.sandbox.limits import Limits
from rosbeat.grading.sandbox.place import Place
from rosbeat.grading.sandbox.running import Ending, run_caged
from rosbeat.grading.sandbox.sandboxes import Sandboxes
from rosbeat.grading.sandbox.unsafe import Bare
from rosbeat.grading.workspaces import read_workspace
from rosbeat.records import Observation
from rosbeat.ros.recording import load_type_support, repair_message_classes

#: What the pages before each page leave: content by path.
Workspaces = dict[str, Mapping[str, bytes]]
#: What answers use, and what takes time to import.
_PREPARED = (
    *("rclpy", "rclpy.node", "rclpy.qos", "rclpy.executors", "rclpy.action"),
    *("numpy", "numpy.random"),
    *("std_msgs.msg", "std_srvs.srv", "sensor_msgs.msg", "rcl_interfaces.msg", "test_msgs.action"),
    *("rosbeat.page_session", "rosbeat.ros.scenario", "rosbeat.ros.test_nodes"),
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
_FILES = ("FASTRTPS_DEFAULT_PROFILES_FILE", "COLCON_DEFAULTS_FILE")
#: Variables of the environment that ROS needs; nothing else of it reaches a sandbox.
_KEPT = (
    *("AMENT_PREFIX_PATH", "LD_LIBRARY_PATH", "ROS_PYTHON_CHECK_FIELDS", "LANG", "LC_ALL", "TZ"),
    *(*_FILES, "RMW_FASTRTPS_USE_QOS_FROM_XML"),
)
#: Rooms of this package that know answers or judge them, or are nobody's business in there.
_HIDDEN = ("exercises/solved", "clinic", "grading", "authoring", "workspace/finished")
#: Of what an answer may have written itself, no more than the course writes is believed.
_MOST, _MOST_CHANGED, _MOST_LINES = 2_000, 5, 1_000_000
#: Seconds that one answer may take by the clock on the wall, and a page of terminals.
WALL, WALL_OF_A_PAGE = 60.0, 240.0
#: All that most answers need: a node, a message type, both ends of a topic, a timer, a log.
_REHEARSAL = """
class Rehearsal(Node):
    def __init__(self):
        super().__init__("rehearsal")
        self.publisher = self.create_publisher(Float32, "rehearsal", 10)
        self.create_subscription(Float32, "rehearsal", self.hear, 10)
        self.create_timer(1.0, self.say)

    def say(self):
        self.publisher.publish(Float32(data=21.0))

    def hear(self, message):
        self.get_logger().info(str(message.data))
"""
_IMPORTS = "from rclpy.node import Node\nfrom std_msgs.msg import Float32"


def main(lines: TextIO = sys.stdin, answers: TextIO = sys.stdout, unsafe: bool = False) -> None:
    """Answer jobs until there are no more.

    Args:
        lines: Where jobs come from.
        answers: Where what was observed goes to.
        unsafe: Whether answers run with limits only.
    """
    before = prepare()
    workspaces: Workspaces = {}
    answer = _answers(furnished(), before, unsafe, workspaces)
    print(READY, file=answers, flush=True)
    for line in lines:
        shown = read_workspace(line)
        if shown:
            workspaces.update([shown])
            continue
        try:
            said = write_line(answer(read_job(line)))
        except GradingError as error:
            parts = [error.what, error.means, error.to_try]
            said = json.dumps({"refused": parts})
        print(said, file=answers, flush=True)


def _answers(
    cage: Cage, before: Census, unsafe: bool, workspaces: Workspaces
) -> Callable[[Job], Observed]:
    """What answers a job: if nothing can be observed on this machine, by saying why."""
    try:
        place: Place = Bare() if unsafe else Sandboxes(cage)
        rehearse(cage, before, place)
    except GradingError as error:
        return partial(_refuse, error)
    return lambda job: observed(job, cage, before, place, workspaces.get(job.page))


def _refuse(trouble: GradingError, _: Job) -> Observed:
    raise trouble


def prepare() -> Census:
    """Import what answers will need, and load the C part of their message types.

    Returns:
        What is there then.
    """
    for name in (*_PREPARED, "rosbeat.exercises.registry"):
        importlib.import_module(name)
    load_type_support(_TYPES)
    repair_message_classes()  # it looks for them once
    # The first log line of a process looks for the file of each module; it finds them here.
    inspect.getmodule(sys._getframe())
    found = census()
    freeze(found)
    # What is here stays. A fork that looked through it for garbage would copy all of its pages; and
    # it ends before much garbage has come together.
    gc.collect()
    gc.freeze()
    gc.set_threshold(20_000, 20, 20)
    return found


def furnished() -> Cage:
    """The sandbox of an answer: Python, ROS and a part of this package; an empty environment."""
    kept = {name: os.environ[name] for name in _KEPT if name in os.environ}
    package = Path(__file__).resolve().parents[1]
    hidden = [str(package / name) for name in _HIDDEN]
    readable = [*python_folders(), *_commands(), *(kept[name] for name in _FILES if name in kept)]
    return Cage(readable, hidden, {**kept, "PATH": "/usr/bin:/bin", "HOME": "/tmp"})


def _commands() -> list[str]:
    """The folder of the `ros2` command, where it is the course's own."""
    found = importlib.util.find_spec("ros2_command")
    folders = found.submodule_search_locations if found else None
    return [str(Path(one).resolve().parent) for one in folders or ()]


def rehearse(cage: Cage, before: Census, place: Place) -> None:
    """Run a program of the course's own, so that no learner pays for a sandbox that cannot work.

    Args:
        cage: The sandbox.
        before: What this process has prepared.
        place: Where it is run.

    Raises:
        GradingError: If the sandbox cannot be made, or nothing can be observed in it.
    """
    said = _failed(
        observed(Job("03a", "Rehearsal", _REHEARSAL, imports=_IMPORTS), cage, before, place)
    )
    if said:
        raise GradingError(
            f"Nothing can be observed in the sandbox of this machine: {said}",
            "A program that certainly works did not work in there, so every mark would be wrong.",
            "`./environment/course doctor` says what is missing, or which other ROS is in the way; "
            "`--unsafe-no-sandbox` tells whether it is the sandbox.",
        )


def _failed(seen: Observed) -> str:
    """Why the rehearsal is no proof that answers can be observed; empty if it is one."""
    if seen.how != "ended" or not seen.evidence:
        return seen.text or seen.output[-300:] or f"it ended with {seen.how} {seen.number}"
    found: Observation = from_json(seen.evidence)
    if found.faults:
        return found.faults[0].text
    return "" if found.logs else "a node does not hear what it publishes"


def observed(
    job: Job, cage: Cage, before: Census, place: Place, workspace: Mapping[str, bytes] | None = None
) -> Observed:
    """Run one job.

    Args:
        job: The job.
        cage: The sandbox.
        before: What this process has prepared.
        place: Where it is run.
        workspace: What the pages before leave, for one that is replayed.

    Raises:
        GradingError: If the sandbox cannot be made.
    """
    seal = secrets.token_hex(16)
    cage = replace(cage, limits=limits_of(job))
    if job.kernel:
        work = partial(kernel_job, job, kernel_files(), seal)
    elif job.replay:
        work = partial(replay_job, job, workspace or {}, seal)
    else:
        work = partial(observe_job, job, before, seal)
    return _read(run_caged(work, cage, place), seal)


def limits_of(job: Job) -> Limits:
    """What one job may use; a page with builds and programs in terminals needs more."""
    if job.replay or job.kernel:
        return Limits(wall=WALL_OF_A_PAGE, cpu=int(WALL_OF_A_PAGE), processes=512)
    return Limits(wall=WALL, cpu=int(WALL))


def _read(ending: Ending, seal: str) -> Observed:
    said, forged = _said(ending.result, seal)
    changed = said["changed"] if isinstance(said.get("changed"), list) else []
    return Observed(
        FORGED if forged else ending.how,
        ending.number,
        _word(said, "evidence", None),
        _word(said, "raised"),
        _word(said, "text"),
        _line(said),
        _word(said, "code"),
        tuple(str(one)[:_MOST] for one in changed[:_MOST_CHANGED]),
        ending.output[:2_000].decode("utf-8", "replace"),
        round(ending.seconds, 3),
    )


def _said(result: bytes, seal: str) -> tuple[dict[str, Any], bool]:
    """What was written, and whether somebody else has written it."""
    text = result.decode("utf-8", "replace")
    if not text:
        return {}, False
    try:
        found = json.loads(text.removeprefix(seal)) if text.startswith(seal) else None
    except (ValueError, RecursionError):
        found = None
    return (found, False) if isinstance(found, dict) else ({}, True)


def _word(said: dict[str, Any], name: str, most: int | None = _MOST) -> str:
    found = said.get(name, "")
    return found[:most] if isinstance(found, str) else ""


def _line(said: dict[str, Any]) -> int:
    found = said.get("line")
    return found if type(found) is int and 0 <= found < _MOST_LINES else 0
