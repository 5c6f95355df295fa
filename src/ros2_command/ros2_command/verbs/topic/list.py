"""`ros2 topic list`."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from collections.abc import Sequence
from typing import Any

from ros2_command.graph import Graph, add_graph_arguments, open_graph
from ros2_command.lookup import show_types
from ros2_command.names import is_hidden


def add_arguments(parser: ArgumentParser) -> None:
    """Which topics, and how much about each."""
    add_graph_arguments(parser)
    add = parser.add_argument
    add("-t", "--show-types", action="store_true", help="Additionally show the topic type")
    add("-c", "--count-topics", action="store_true",
        help="Only display the number of topics discovered")  # fmt: skip
    add("--include-hidden-topics", action="store_true", help="Consider hidden topics as well")
    add("-v", "--verbose", action="store_true", help="List full details about each topic")


def main(args: Namespace) -> None:
    """Print the topics of the graph."""
    with open_graph(args) as graph:
        graph.settle()
        topics = [
            one for one in graph.topics() if args.include_hidden_topics or not is_hidden(one[0])
        ]
        details = _details(graph, topics) if args.verbose else []
    if args.count_topics:
        print(len(topics))
    elif args.verbose:
        print("\n".join(details))
    else:
        for name, types in topics:
            print(f"{name} {show_types(types)}" if args.show_types else name)


def _details(graph: Graph, topics: Sequence[tuple[str, list[str]]]) -> list[str]:
    lines = []
    for title, word, ask in (
        ("Published", "publisher", graph.publishers),
        ("Subscribed", "subscriber", graph.subscriptions),
    ):
        lines.append(f"{title} topics:")
        for name, types in topics:
            lines += _detail(name, types, word, graph.others(ask(name)))
        lines.append("")
    return lines


def _detail(name: str, types: list[str], word: str, endpoints: list[Any]) -> list[str]:
    count = len(endpoints)
    ending = "" if count == 1 else "s"
    return [f" * {name} {show_types(types)} {count} {word}{ending}"] if count else []
