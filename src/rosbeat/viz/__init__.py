"""Draw pictures of what was observed: records in, a `Picture` out.

Every function but `diagram` takes a session and draws from what it has recorded, and none needs
ROS. Importing this package does not import matplotlib; that happens when a picture is asked for the
first time (PEP 562).

- `graph` shows the nodes, the topics and who talks to whom;
- `timeline` shows when callbacks ran and which message caused which;
- `values` shows a topic's numbers over virtual time;
- `queue` shows a subscription's queue filling, emptying and dropping;
- `message_flow` shows which messages went from one process to another, and which were lost;
- `robot` shows a robot from above: its way, its room, what its scanner sees;
- `comparison` shows two runs over each other, and what only one of them has;
- `diagram` shows where a page is going, and how folders, packages and programs belong together.

There is one file for each kind of picture, with its words at the end; `plots` holds both that draw
curves, `values` and `comparison`. `theme` is the only place that names colours, `canvas` has what
all pictures are made of, and `layout` places the boxes of a graph. `arguments` checks what a
learner hands over, `text_format` writes numbers and names, and `picture` is what comes out.

- **Words first.** A picture's plain-text form is its description. Terminals print it, screen
  readers read it as the image's `alt`, and page tests compare it, since the bytes of an image
  depend on the version of matplotlib.
- **Light and dark.** A figure is drawn once, in the colours for a light page. Its SVG has rules
  that put another colour in the place of each on a dark page (`theme.DARK`). The browser chooses
  by the `color-scheme` that JupyterLab sets with its theme.
- **An image, and no part of the page.** JupyterLab drops `<svg>` elements from pages that nobody
  has run, so a picture is an `<img>` with the SVG inside (`picture` says more). For that it has no
  values to point at; what matters is written in it and in its description.
- **One size of text.** In a JupyterLab window 1,000 pixels wide, with the file browser open, a
  picture is scaled to 548 pixels, and its text is 11 pixels high. Below, the output scrolls.
- **One direction.** A graph that fits the page runs to the right and another one down, in pictures
  and in the panel, whatever is highlighted. Only the words of an explanation may turn it.
- **Why the layout is our own.** Boxes have sizes, notes stand on arrows, and a graph that is too
  wide runs down. networkx places boxes in layers, but does not minimize crossings and knows no
  sizes; grandalf has Sugiyama's layers with sizes, would replace about 120 lines of 300, and would
  draw every picture of the pages anew. Graphviz is a program to install.
"""

from __future__ import annotations

import warnings
from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rosbeat.viz.diagrams import diagram as diagram
    from rosbeat.viz.graphs import graph as graph
    from rosbeat.viz.message_flows import message_flow as message_flow
    from rosbeat.viz.picture import Picture as Picture
    from rosbeat.viz.plots import comparison as comparison
    from rosbeat.viz.plots import values as values
    from rosbeat.viz.queues import queue as queue
    from rosbeat.viz.robots import robot as robot
    from rosbeat.viz.timelines import timeline as timeline

_HOMES = {
    "Picture": "picture",
    "comparison": "plots",
    "diagram": "diagrams",
    "graph": "graphs",
    "message_flow": "message_flows",
    "queue": "queues",
    "robot": "robots",
    "timeline": "timelines",
    "values": "plots",
}
__all__ = list(_HOMES)
#: Names of release 0.1.0, and what they are called now.
_RENAMED = {"crossing": "message_flow", "differences": "comparison"}


def __getattr__(name: str) -> Any:  # noqa: ANN401 - the type depends on the name
    """Load a public name when it is first used; an old name still works, with a warning."""
    if name in _RENAMED:
        now = _RENAMED[name]
        words = f"`viz.{name}` is deprecated: it is called `viz.{now}` now."
        warnings.warn(words, DeprecationWarning, stacklevel=2)
        name = now
    if name not in _HOMES:
        raise AttributeError(f"module 'rosbeat.viz' has no attribute {name!r}")
    return getattr(import_module(f"rosbeat.viz.{_HOMES[name]}"), name)


def __dir__() -> list[str]:
    """List the public names, so that completion offers them before they are loaded."""
    return list(__all__)
