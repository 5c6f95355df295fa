"""`ros2 doctor`."""

from __future__ import annotations

import os
import platform
import sys
from argparse import ArgumentParser, Namespace
from collections.abc import Callable, Sequence

from ros2_command.checkup import (
    Finding,
    check_environment,
    check_graph,
    check_network,
    compatibility_rows,
)
from ros2_command.graph import Graph, open_graph

Rows = list[tuple[str, str]]


def add_arguments(parser: ArgumentParser) -> None:
    """A report or the checks."""
    group = parser.add_mutually_exclusive_group()
    group.add_argument("--report", "-r", action="store_true", help="Print all reports.")
    group.add_argument("--report-failed", "-rf", action="store_true",
                       help="Print reports of failed checks only.")  # fmt: skip
    parser.add_argument("--exclude-packages", "-ep", action="store_true",
                        help="Exclude package checks (here: there are none).")  # fmt: skip
    parser.add_argument("--include-warnings", "-iw", action="store_true",
                        help="Include warnings as failed checks.")  # fmt: skip


def main(args: Namespace) -> int:
    """Look for what commonly goes wrong. The exit code is 1 if a check failed."""
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
    """Sections with titles and aligned rows."""
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
