"""The panel where nobody can use it: a picture of the graph, and words."""

from __future__ import annotations

import os
from typing import Any

from IPython import get_ipython

from rosbeat.records import GraphSnapshot

#: While pages are built and tested, outputs must be the same each time; a panel's own never are.
_STEADY = "ROSBEAT_STEADY_HOME"
_HEADING = "The instrument panel of this session."


def is_for_a_browser() -> bool:
    """Return whether a browser may be attached that can show a widget."""
    shell = get_ipython()
    return getattr(shell, "kernel", None) is not None and not os.environ.get(_STEADY)


def still(graph: GraphSnapshot) -> dict[str, str]:
    """Return the graph as a MIME bundle, which depends only on the graph."""
    from rosbeat.viz.graphs import graph as draw  # matplotlib takes a while to load

    if not any(graph.nodes):
        return {"text/plain": f"{_HEADING} There are no nodes yet."}
    picture = draw(graph)
    return {"text/html": picture.html(), "text/plain": f"{_HEADING} {picture.description}"}


def with_view(bundle: dict[str, str], model_id: str) -> dict[str, Any]:
    """Return the bundle with the widget's live view added."""
    view = {"version_major": 2, "version_minor": 0, "model_id": model_id}
    return {"application/vnd.jupyter.widget-view+json": view, **bundle}
