"""Implement `ros2 daemon`: say what is true here, where no daemon runs and none is needed.

The remedy of every forum for incomplete lists is `ros2 daemon stop`, and scripts have it, so the
exit codes are those of the original when its daemon is not running.
"""

from __future__ import annotations

from argparse import Namespace

from ros2_command.errors import note
from ros2_command.registry import Verb, flag

_WHY = (
    "This `ros2` has no daemon: each command asks the graph itself, so there is nothing to start, "
    "to stop or to restart, and no old answer is kept."
)
_INSTEAD = (
    "If a node is missing from a list, compare ROS_DOMAIN_ID in its terminal and in this one."
)


def _start(args: Namespace) -> None:
    note(_WHY)


def _is_not_running(args: Namespace) -> None:
    print("The daemon is not running")
    note(_WHY, _INSTEAD)


VERBS = {
    "start": Verb(
        "Start the daemon if it isn't running",
        _start,
        flag("--debug", "-d", help="Print debug messages (here: there are none)"),
    ),
    "status": Verb("Output the status of the daemon", _is_not_running),
    "stop": Verb("Stop the daemon if it is running", _is_not_running),
}
