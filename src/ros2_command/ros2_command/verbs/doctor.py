"""Implement `ros2 doctor`: check for common problems, and report on the system."""

from __future__ import annotations

import os
import platform
import socket
import sys
from argparse import Namespace
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from ros2_command.graph import PROFILE_VARIABLE, Graph, open_graph
from ros2_command.names import is_hidden
from ros2_command.registry import Verb, flag, one_of

Rows = list[tuple[str, str]]
#: Topics that every node has, whether anybody listens or not.
_COMMON = ("/parameter_events", "/rosout")


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
        return f"{'ERROR' if self.error else 'WARNING'}: {self.text}"


def check_environment() -> list[Finding]:
    """Find variables that are missing, or name files that do not exist."""
    found = []
    if not os.environ.get("AMENT_PREFIX_PATH"):
        found.append(Finding("AMENT_PREFIX_PATH is not set: `ros2 run` finds no workspace. "
                             "Run `source install/setup.bash` there."))  # fmt: skip
    profile = os.environ.get(PROFILE_VARIABLE)
    if profile and not os.path.isfile(profile):
        found.append(Finding(f"{PROFILE_VARIABLE} names {profile}, which does not exist.", True))
    for prefix in os.environ.get("AMENT_PREFIX_PATH", "").split(":"):
        if prefix and not os.path.isdir(prefix):
            found.append(Finding(f"AMENT_PREFIX_PATH names {prefix}, which does not exist."))
    return found


def check_network() -> list[Finding]:
    """Find out whether other machines could be reached, and multicast works at all."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        try:
            probe.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_LOOP, 1)
            probe.connect(("239.255.0.1", 7400))
        except OSError as error:
            text = f"Multicast does not work here ({error}): other machines cannot be found."
            return [Finding(text)]
    return []


def check_graph(graph: Graph) -> list[Finding]:
    """Find topics with one side only, and pairs that cannot hear each other."""
    found = []
    for topic, _ in graph.topics():
        publishers = graph.others(graph.publishers(topic))
        subscriptions = graph.others(graph.subscriptions(topic))
        if topic in _COMMON or is_hidden(topic):
            continue
        if publishers and not subscriptions:
            found.append(Finding(f"Publisher without subscriber detected on {topic}."))
        if subscriptions and not publishers:
            found.append(Finding(f"Subscriber without publisher detected on {topic}."))
    for topic, _, _, reason in _pairs(graph):
        if reason:
            text = f"QoS compatibility error found on topic '{topic}': {reason}"
            found.append(Finding(text, error=True))
    return found


def _pairs(graph: Graph) -> Iterator[tuple[str, Any, Any, str]]:
    """Yield every publisher with every subscriber of its topic, and why they do not fit, if so."""
    from rclpy.qos import QoSCompatibility, qos_check_compatible

    for topic, _ in graph.topics():
        subscriptions = graph.others(graph.subscriptions(topic))
        for publisher in graph.others(graph.publishers(topic)):
            for subscription in subscriptions:
                verdict, reason = qos_check_compatible(
                    publisher.qos_profile, subscription.qos_profile
                )
                bad = verdict == QoSCompatibility.ERROR
                yield topic, publisher, subscription, reason if bad else ""


def compatibility_rows(graph: Graph) -> list[tuple[str, str]]:
    """Return rows of the report about pairs of publishers and subscribers."""
    rows = []
    for topic, publisher, subscription, reason in _pairs(graph):
        rows += [
            ("topic [type]", f"{topic} [{publisher.topic_type}]"),
            ("publisher node", publisher.node_name),
            ("subscriber node", subscription.node_name),
            ("compatibility status", reason or "OK"),
        ]
    return rows or [("compatibility status", "No publisher/subscriber pairs found")]


def _main(args: Namespace) -> int:
    with open_graph() as graph:
        graph.settle()
        if args.report:
            print(report(_sections(graph)))
            return 0
        checks: dict[str, Callable[[], list[Finding]]] = {
            "environment": check_environment,
            "network": check_network,
            "topic": lambda: check_graph(graph),
        }
        results = {name: check() for name, check in checks.items()}
        failed = summarize(results, args.include_warnings)
        if failed and args.report_failed:
            print(report(_sections(graph)))
    return 1 if failed else 0


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


def report(sections: Sequence[tuple[str, Rows]]) -> str:
    """Return sections with titles and aligned rows."""
    lines = []
    for title, rows in sections:
        width = max((len(key) for key, _ in rows), default=0)
        lines += ["", f"   {title}", *(f"{key:<{width}} : {value}" for key, value in rows)]
    return "\n".join(lines)


def _sections(graph: Graph) -> list[tuple[str, Rows]]:
    import rclpy

    names = ("ROS_DISTRO", "ROS_DOMAIN_ID", "ROS_AUTOMATIC_DISCOVERY_RANGE", "AMENT_PREFIX_PATH")
    topics = [
        row for name, types in graph.topics() for row in (
            ("topic", f"{name} [{', '.join(types)}]"),
            ("publisher count", str(len(graph.others(graph.publishers(name))))),
            ("subscriber count", str(len(graph.others(graph.subscriptions(name))))),
        )
    ]  # fmt: skip
    return [
        ("ENVIRONMENT", [(name, os.environ.get(name, "(not set)")) for name in names]),
        (
            "PLATFORM INFORMATION",
            [("system", platform.system()), ("platform info", platform.platform()),
             ("processor", platform.machine()), ("python version", platform.python_version())],
        ),
        ("QOS COMPATIBILITY LIST", compatibility_rows(graph)),
        ("RMW MIDDLEWARE", [("middleware name", rclpy.get_rmw_implementation_identifier())]),
        ("TOPIC LIST", topics),
    ]  # fmt: skip


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
