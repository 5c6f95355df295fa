"""Draw pictures of what was observed: records in, a `Picture` out.

Every function here draws from records alone and needs no ROS. Importing this package does not
import matplotlib; that happens when a picture is asked for the first time (PEP 562).

- `graph` shows the nodes, the topics and who talks to whom;
- `timeline` shows when callbacks ran and which message caused which;
- `values` shows a topic's numbers over virtual time;
- `queue` shows a subscription's queue filling, emptying and dropping;
- `crossing` shows which messages went from one process to another, and which were lost;
- `differences` shows two runs over each other, and what only one of them has.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rosbeat.viz.crossings import crossing as crossing
    from rosbeat.viz.graphs import graph as graph
    from rosbeat.viz.picture import Picture as Picture
    from rosbeat.viz.plots import differences as differences
    from rosbeat.viz.plots import values as values
    from rosbeat.viz.queues import queue as queue
    from rosbeat.viz.timelines import timeline as timeline

__all__ = ["Picture", "crossing", "differences", "graph", "queue", "timeline", "values"]

_HOMES = {
    "Picture": "picture",
    "crossing": "crossings",
    "differences": "plots",
    "graph": "graphs",
    "queue": "queues",
    "timeline": "timelines",
    "values": "plots",
}


def __getattr__(name: str) -> Any:  # noqa: ANN401 - the type depends on the name
    """Load a public name when it is first used."""
    if name not in _HOMES:
        raise AttributeError(f"module 'rosbeat.viz' has no attribute {name!r}")
    return getattr(import_module(f"rosbeat.viz.{_HOMES[name]}"), name)


def __dir__() -> list[str]:
    """List the public names, so that completion offers them before they are loaded."""
    return list(__all__)
