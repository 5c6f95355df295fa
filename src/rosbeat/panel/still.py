"""The panel where nobody can use it: a picture of the graph, and words."""

from __future__ import annotations

import os
from typing import Any

from IPython import get_ipython

from rosbeat.records import GraphSnapshot

#: While pages are built and tested, outputs must be the same each time; a panel's own never are.
_STEADY = "ROSBEAT_STEADY_HOME"
_HEADING = "The instrument panel of this session."
_HOW = "This is a still picture of the panel. Run the cell above it for the live one."
#: JupyterLab shows an output whose widget is gone as an error, and looks at no other form of it. So
#: the picture is an output of its own: hidden while the panel below it lives, and hiding the error
#: when it does not.
_ONE_OF_THEM = """<style>
.jp-OutputArea-child:has(.rosbeat-still):has(+ * .rosbeat-panel) { display: none; }
.jp-OutputArea-child:has(.rosbeat-still) + *:not(:has(.rosbeat-panel)) { display: none; }
</style>
"""


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
    html = f'<div class="rosbeat-still">{picture.html()}\n<p>{_HOW}</p></div>'
    return {"text/html": html, "text/plain": f"{_HEADING} {picture.description}"}


def behind_a_view(bundle: dict[str, str]) -> dict[str, str]:
    """Return the bundle for an output right above a live view; one of the two is seen at a time."""
    html = bundle.get("text/html", f'<p class="rosbeat-still">{bundle["text/plain"]}</p>')
    return {**bundle, "text/html": _ONE_OF_THEM + html}


def view(model_id: str) -> dict[str, Any]:
    """Return the widget's live view as a MIME bundle."""
    about = {"version_major": 2, "version_minor": 0, "model_id": model_id}
    return {"application/vnd.jupyter.widget-view+json": about}
