"""The table in the README of `ros2_command`: each verb and option of the original, and where it is.

Print it with:  python tests/ros2_command/readme_table.py
"""

import sys
from argparse import ArgumentParser
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2] / "src" / "ros2_command"
sys.path.insert(0, str(SOURCE))

from ros2_command.registry import (  # noqa: E402
    COMMANDS,
    LEFT_OUT,
    LEFT_OUT_VERBS,
    LeftOut,
    verbs_of,
)

_DIRECT = "--spin-time --use-sim-time"
_GRAPH = f"{_DIRECT} --no-daemon"
_QOS = (
    "--qos-profile --qos-depth --qos-history --qos-reliability --qos-durability --qos-liveliness "
    "--qos-liveliness-lease-duration-seconds"
)
_STYLE = "--csv --full-length --truncate-length --no-arr --no-str --flow-style"
_NODE = f"{_GRAPH} --include-hidden-nodes --timeout"
_KINDS = "--only-msgs --only-srvs --only-actions"
_BAG = "--log-level --disable-keyboard-controls --qos-profile-overrides-path --storage-config-file"
_CHOICE = "--topics --services --regex --exclude-regex --exclude-topics --exclude-services"

#: The options of ros2cli 0.32 and ros2bag 0.26 (Jazzy), long forms, without `--help`.
UPSTREAM = {
    "action info": "--show-types --count",
    "action list": "--show-types --count-actions",
    "action send_goal": "--stdin --feedback",
    "action type": "",
    "bag info": "--storage --topic-name --verbose",
    "bag play": f"{_BAG} {_CHOICE} --storage --read-ahead-queue-size --rate --loop --remap --clock "
    "--clock-topics --clock-topics-all --delay --playback-duration --playback-until-sec "
    "--playback-until-nsec --start-paused --start-offset --wait-for-all-acked "
    "--disable-loan-message --publish-service-requests --service-requests-source",
    "bag record": f"{_BAG} {_CHOICE} --output --storage --topic-types --all --all-topics "
    "--all-services --exclude-topic-types --include-unpublished-topics --include-hidden-topics "
    "--no-discovery --polling-interval --ignore-leaf-topics --serialization-format "
    "--max-bag-size --max-bag-duration --max-cache-size --start-paused --use-sim-time --node-name "
    "--custom-data --snapshot-mode --storage-preset-profile --compression-queue-size "
    "--compression-threads --compression-threads-priority --compression-mode --compression-format",
    "daemon start": "--debug",
    "daemon status": "",
    "daemon stop": "",
    "doctor": "--report --report-failed --exclude-packages --include-warnings",
    "interface list": _KINDS,
    "interface package": _KINDS,
    "interface packages": _KINDS,
    "interface proto": "--no-quotes",
    "interface show": "--all-comments --no-comments",
    "launch": "--noninteractive --debug --print --print-description --show-args --show-arguments "
    "--show-all-subprocesses-output --launch-prefix --launch-prefix-filter",
    "node info": f"{_GRAPH} --include-hidden",
    "node list": f"{_GRAPH} --all --count-nodes",
    "param delete": _NODE,
    "param describe": _NODE,
    "param dump": _NODE,
    "param get": f"{_NODE} --hide-type",
    "param list": f"{_GRAPH} --include-hidden-nodes --param-prefixes --param-type --filter",
    "param load": f"{_NODE} --no-use-wildcard",
    "param set": _NODE,
    "pkg create": "--package-format --description --license --destination-directory --build-type "
    "--dependencies --maintainer-email --maintainer-name --node-name --library-name",
    "pkg executables": "--full-path",
    "pkg list": "",
    "pkg prefix": "--share",
    "pkg xml": "--tag",
    "run": "--prefix",
    "service call": "--stdin --rate",
    "service echo": _STYLE,
    "service find": "--count-services --include-hidden-services",
    "service info": _GRAPH,
    "service list": f"{_GRAPH} --show-types --count-services --include-hidden-services",
    "service type": "",
    "topic bw": f"{_DIRECT} --window",
    "topic delay": f"{_DIRECT} --window",
    "topic echo": f"{_GRAPH} {_QOS} {_STYLE} --field --no-lost-messages --raw --filter --once "
    "--timeout --include-message-info",
    "topic find": f"{_GRAPH} --count-topics --include-hidden-topics",
    "topic hz": f"{_DIRECT} --window --filter --wall-time",
    "topic info": f"{_GRAPH} --verbose",
    "topic list": f"{_GRAPH} --show-types --count-topics --include-hidden-topics --verbose",
    "topic pub": f"{_DIRECT} {_QOS} --stdin --rate --print --once --times "
    "--wait-matching-subscriptions --max-wait-time-secs --keep-alive --node-name",
    "topic type": _GRAPH,
    "wtf": "--report --report-failed --exclude-packages --include-warnings",
}


def options(command, verb):
    """The long options of a verb here, each with whether it is refused."""
    parser = ArgumentParser(add_help=False)
    verbs_of(command)[verb].add_arguments(parser)
    return {
        name: isinstance(action, LeftOut)
        for action in parser._actions for name in action.option_strings if name.startswith("--")
    }  # fmt: skip


def verbs():
    """Every command and verb that is here, as two words or one."""
    return [
        (command, verb) for command in COMMANDS for verb in verbs_of(command)
        if command != "completion"
    ]  # fmt: skip


def table():
    """The table."""
    lines = ["| `ros2 ...` | here | refused with a sentence |", "|---|---|---|"]
    for command, verb in verbs():
        name = " ".join(filter(None, (command, verb)))
        known = options(command, verb)
        here = [one for one in UPSTREAM[name].split() if not known[one]]
        refused = [one for one in UPSTREAM[name].split() if known[one]]
        lines.append(f"| `{name}` | {_cells(here)} | {_cells(refused)} |")
    for command, verbs_left_out in LEFT_OUT_VERBS.items():
        lines += [f"| `{command} {verb}` | | the verb |" for verb in verbs_left_out]
    lines += [f"| `{command}` | | the command |" for command in LEFT_OUT]
    return "\n".join(lines)


def _cells(names):
    return " ".join(f"`{one}`" for one in names)


if __name__ == "__main__":
    print(table())
