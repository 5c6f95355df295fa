"""Implement `ros2 doctor`: check for common problems, and report on the system."""

from __future__ import annotations

import os
import platform
import re
import sys
from argparse import Namespace
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ros2_command.errors import note
from ros2_command.graph import PROFILE_VARIABLE, Graph, open_graph
from ros2_command.registry import Verb, flag, one_of

Rows = list[tuple[str, object]]
#: Topics that every node has, whether anybody listens or not.
_COMMON = ("/parameter_events", "/rosout")
_INTERFACES = Path("/sys/class/net")
_LOOPBACK, _MULTICAST = 1 << 3, 1 << 12  # among the flags of a network interface
_VARIABLES = ("ROS_DISTRO", "ROS_DOMAIN_ID", "ROS_AUTOMATIC_DISCOVERY_RANGE", "AMENT_PREFIX_PATH")


@dataclass(frozen=True)
class Finding:
    """Tell something that a check has found.

    Attributes:
        text: A sentence.
        error: Whether it fails its check; otherwise it is a warning.
    """

    text: str
    error: bool = False

    def __str__(self) -> str:
        return f"UserWarning: {'ERROR: ' if self.error else ''}{self.text}"


def environment_problems() -> list[str]:
    """Return what is wrong with the variables of this terminal."""
    found = []
    if not os.environ.get("AMENT_PREFIX_PATH"):
        found.append("AMENT_PREFIX_PATH is not set: `ros2 run` finds no workspace. "
                     "Run `source install/setup.bash` there.")  # fmt: skip
    profile = os.environ.get(PROFILE_VARIABLE)
    if profile and not os.path.isfile(profile):
        found.append(f"{PROFILE_VARIABLE} names {profile}, which does not exist.")
    for prefix in os.environ.get("AMENT_PREFIX_PATH", "").split(":"):
        if prefix and not os.path.isdir(prefix):
            found.append(f"AMENT_PREFIX_PATH names {prefix}, which does not exist.")
    return found


def check_network(interfaces: Path = _INTERFACES) -> list[Finding]:
    """Find out whether this machine has what a graph of several machines needs."""
    flags = [int(path.read_text(), 16) for path in interfaces.glob("*/flags")]
    if not flags:  # a system that keeps them elsewhere
        return []
    found = []
    if not any(one & _LOOPBACK for one in flags):
        found.append(Finding("No loopback IP address is found.", error=True))
    if all(one & _LOOPBACK for one in flags):
        found.append(Finding("Only loopback IP address is found."))
    if not any(one & _MULTICAST for one in flags):
        found.append(Finding("No multicast IP address is found."))
    return found


def check_topics(graph: Graph) -> list[Finding]:
    """Find topics with one side only."""
    found = []
    for topic in _own_topics(graph):
        publishers, subscribers = _counts(graph, topic)
        if publishers and not subscribers:
            found.append(Finding(f"Publisher without subscriber detected on {topic}."))
        if subscribers and not publishers:
            found.append(Finding(f"Subscriber without publisher detected on {topic}."))
    return found


def _own_topics(graph: Graph) -> list[str]:
    return [name for name, _ in graph.topics() if name not in _COMMON]


def _counts(graph: Graph, topic: str) -> tuple[int, int]:
    ends = graph.publishers(topic), graph.subscriptions(topic)
    return len(graph.others(ends[0])), len(graph.others(ends[1]))


def check_middleware(graph: Graph) -> list[Finding]:
    """Find publishers and subscriptions that cannot, or may not, hear each other."""
    found = []
    for topic, _, _, kind, reason in _pairs(graph):
        if kind != "ok":
            text = re.sub("^(?i:warning|error): ", "", reason)
            text = f"QoS compatibility {kind} found on topic '{topic}': {text}"
            found.append(Finding(text, error=kind == "error"))
    return found


def _pairs(graph: Graph) -> Iterator[tuple[str, Any, Any, str, str]]:
    """Yield every publisher with every subscriber of its topic, and whether they fit, and why."""
    from rclpy.qos import qos_check_compatible

    for topic, _ in graph.topics():
        subscriptions = graph.others(graph.subscriptions(topic))
        for publisher in graph.others(graph.publishers(topic)):
            for subscription in subscriptions:
                verdict, reason = qos_check_compatible(
                    publisher.qos_profile, subscription.qos_profile
                )
                yield topic, publisher, subscription, verdict.name.lower(), reason


def compatibility_rows(graph: Graph) -> Rows:
    """Return rows of the report about pairs of publishers and subscribers."""
    rows: Rows = []
    for topic, publisher, subscription, kind, reason in _pairs(graph):
        rows += [
            ("topic [type]", f"{topic} [{publisher.topic_type}]"),
            ("publisher node", publisher.node_name),
            ("subscriber node", subscription.node_name),
            ("compatibility status", "OK" if kind == "ok" else reason),
        ]
    return rows or [("compatibility status", "No publisher/subscriber pairs found")]


def _main(args: Namespace) -> None:
    with open_graph() as graph:
        graph.settle()
        sections = _sections(graph)
        results = {
            "middleware": check_middleware(graph),
            "network": check_network(),
            "topic": check_topics(graph),
        }
    variables = [f"{name}={os.environ.get(name, '')}" for name in _VARIABLES]
    if args.report:
        print(report(rows for _, rows in sections))
        note(*variables)
        return
    failed = summarize(results, args.include_warnings)
    note(*environment_problems())
    if failed and args.report_failed:
        print(report(rows for name, rows in sections if name in failed))


def summarize(results: dict[str, list[Finding]], warnings: bool) -> list[str]:
    """Print the findings and the verdict.

    Args:
        results: What each check has found.
        warnings: Whether a warning fails a check.

    Returns:
        The names of the checks that failed.
    """
    for finding in (one for found in results.values() for one in found):
        print(finding, file=sys.stderr)
    failed = [
        name for name, found in results.items() if any(one.error or warnings for one in found)
    ]
    if failed:
        print(f"\n{len(failed)}/{len(results)} check(s) failed\n")
        print("Failed modules:", *failed)
    else:
        print(f"\nAll {len(results)} checks passed\n")
    return failed


def report(sections: Iterable[tuple[str, Rows]]) -> str:
    """Return sections with titles and aligned rows."""
    lines = []
    for title, rows in sections:
        longest = max((len(key) for key, _ in rows), default=0)
        width = longest + 4 if longest >= 8 else 8
        lines += ["", f"   {title}", *(f"{key:<{width}}: {value}" for key, value in rows)]
    return "\n".join(lines)


def _sections(graph: Graph) -> list[tuple[str, tuple[str, Rows]]]:
    """Return the sections of the report, each with the check that it belongs to."""
    import rclpy

    topics: Rows = []
    for name in _own_topics(graph) or ["none"]:
        publishers, subscribers = (0, 0) if name == "none" else _counts(graph, name)
        topics += [("topic", name), ("publisher count", publishers)]
        topics += [("subscriber count", subscribers)]
    system: Rows = [
        ("system", platform.system()),
        ("platform info", platform.platform()),
        ("release", platform.release()),
        ("processor", platform.processor()),
    ]
    rmw: Rows = [("middleware name", rclpy.get_rmw_implementation_identifier())]
    return [
        ("platform", ("PLATFORM INFORMATION", system)),
        ("middleware", ("QOS COMPATIBILITY LIST", compatibility_rows(graph))),
        ("middleware", ("RMW MIDDLEWARE", rmw)),
        ("topic", ("TOPIC LIST", topics)),
    ]


VERBS = {
    "": Verb(
        "",
        _main,
        one_of(
            flag("--report", "-r", help="Print all reports."),
            flag("--report-failed", "-rf", help="Print reports of failed checks only."),
        ),
        flag("--exclude-packages", "-ep", help="Exclude package checks (here: there are none)."),
        flag("--include-warnings", "-iw", help="Include warnings as failed checks."),
    )
}
