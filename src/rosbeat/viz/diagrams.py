"""Draw the map of the course on each page, and other diagrams of boxes and arrows.

A diagram is rows of data: boxes on a grid, arrows between them, frames around some of them, and the
names of those that are highlighted. `_MAP` is the whole of the course; each page highlights its own
part of it.
"""

from __future__ import annotations

import itertools
from collections.abc import Collection, Iterable
from dataclasses import dataclass, replace

from rosbeat.errors import PictureError, called_as
from rosbeat.viz import theme
from rosbeat.viz.canvas import (
    FRAME_INDENT,
    PLAIN,
    Canvas,
    Point,
    Stroke,
    blank,
    cornered,
    line_height,
    text_width,
)
from rosbeat.viz.picture import Picture
from rosbeat.viz.text_format import listing, nearest

# What a diagram is.


@dataclass(frozen=True)
class Box:
    """Hold one box, and where it is on the grid.

    Attributes:
        name: What is written in it, on one or several lines.
        kind: `node`, `topic`, `program`, `file` or `text`, which has no outline.
        column: Counted from the left.
        row: Counted from the top.
    """

    name: str
    kind: str
    column: int
    row: int

    @property
    def size(self) -> Point:
        """Return width and height in CSS pixels, highlighted or not."""
        lines = self.name.split("\n")
        weight = "normal" if self.kind == "text" else "bold"
        width = max(text_width(line, weight) for line in lines)
        height = line_height() * len(lines)
        if self.kind == "node":
            return width * 1.2 + 10, height * 1.7 + 4
        return (width, height) if self.kind == "text" else (width + 20, height + 14)


@dataclass(frozen=True)
class Arrow:
    """Hold an arrow: along a row, along a column, or around a corner.

    Attributes:
        source: Name of the box where it begins.
        target: Name of the box where it ends.
        words: What is written beside it.
        is_sideways: Whether an arrow around a corner leaves its box sideways.
    """

    source: str
    target: str
    words: str = ""
    is_sideways: bool = False


@dataclass(frozen=True)
class Frame:
    """Hold a frame around some boxes: its label, and their names."""

    words: str
    boxes: tuple[str, ...]
    is_centred: bool = False


@dataclass(frozen=True)
class Diagram:
    """Hold everything that one diagram shows.

    Attributes:
        heading: What it is about, written above it.
        words: The same as the picture, for who does not see it.
        boxes: The boxes, each with a name of its own.
        arrows: The arrows.
        frames: The frames, the outer ones first.
        bright: Names of the boxes and frames that are highlighted; empty for all. An arrow is
            highlighted if both its ends are.
        gaps: Between columns and between rows, in CSS pixels.
        is_tree: Whether boxes of a column begin at the same place, and arrows at that of their box.
    """

    heading: str
    words: str
    boxes: tuple[Box, ...]
    arrows: tuple[Arrow, ...] = ()
    frames: tuple[Frame, ...] = ()
    bright: tuple[str, ...] = ()
    gaps: Point = (34.0, 66.0)
    is_tree: bool = False

    def highlights(self, *names: str) -> bool:
        """Return whether all these boxes and frames are highlighted."""
        return not self.bright or set(names) <= set(self.bright)


# The picture.

#: From the boxes in a frame to its edge, and more for each frame in between.
_FRAME_GAP, _OUTER_GAP = 11.0, 21.0
#: From the heading to what is below it.
_HEAD = 10.0
#: From the left edge of a box in a tree to the arrows that leave it.
_TRUNK = 16.0
_QUIET = Stroke(theme.FRAME, "-", 1.2)
_BRIGHT = replace(PLAIN, width=2.2)
#: Fill and edge of highlighted boxes.
_LOOKS = {
    "node": (theme.NODE_FILL_STRONG, theme.BLUE),
    "topic": (theme.TOPIC_FILL_STRONG, theme.TOPIC_EDGE),
    "program": (theme.NODE_FILL, theme.BLUE),
    "file": (theme.CARD, theme.INK),
}
#: Radius of the corners; an ellipse has none.
_RADII = {"node": None, "topic": 5, "program": 9, "file": 1}


@called_as('viz.diagram("03")')
def diagram(name: str) -> Picture:
    """Draw a diagram of the course.

    Args:
        name: The number of a page, for a map with the part that the page is about; or `workspace`,
            `overlay`, `entry point`.

    Raises:
        PictureError: If there is no such diagram.
    """
    shown = DIAGRAMS.get(name) if isinstance(name, str) else None
    if shown is None:
        meant = nearest(str(name), DIAGRAMS)
        raise PictureError(
            f"There is no diagram {name!r}.",
            f"The diagrams are {listing(DIAGRAMS)}.",
            f"Did you mean {meant!r}?" if meant else 'For example `viz.diagram("03")`.',
        )
    grid = _Grid(shown)
    width = max(grid.width, text_width(shown.heading, "bold")) + 2 * theme.MARGIN
    with blank(_HEAD + grid.height, width, heading=shown.heading) as canvas:
        _draw(canvas, shown, grid)
    return Picture(canvas.figure, describe(shown), "A diagram of the course")


class _Grid:
    """Place boxes, frames and arrows, in CSS pixels from the upper left corner, y counted down."""

    def __init__(self, shown: Diagram) -> None:
        self._boxes = {one.name: one for one in shown.boxes}
        self._frames, self._is_tree = shown.frames, shown.is_tree
        self._widths = _widest((one.column, one.size[0]) for one in shown.boxes)
        heights = _widest((one.row, one.size[1]) for one in shown.boxes)
        self._x = _middles(self._widths, shown.gaps[0])
        self._y = _middles(heights, shown.gaps[1])
        corners = [self.edge(one, side, side) for one in self._boxes for side in (-1, 1)]
        for left, bottom, right, top in map(self.around, shown.frames):
            corners += [(left, top - line_height() / 2), (right, bottom)]
        self.left, self.top = (min(one[axis] for one in corners) for axis in (0, 1))
        self.width = max(one[0] for one in corners) - self.left
        self.height = max(one[1] for one in corners) - self.top

    def edge(self, name: str, right: int = 0, down: int = 0) -> Point:
        """Return the middle of a box, or of an edge: 1 and -1 are right and left, down and up."""
        box = self._boxes[name]
        width, height = box.size
        x = self._x[box.column]
        if box.kind == "text" or self._is_tree:
            x += (width - self._widths[box.column]) / 2
        return x + right * width / 2, self._y[box.row] + down * height / 2

    def around(self, frame: Frame) -> tuple[float, float, float, float]:
        """Return left, lower, right and upper edge of a frame."""
        pad = self._pad(frame)
        left = min(self.edge(one, -1)[0] for one in frame.boxes) - pad
        right = max(self.edge(one, 1)[0] for one in frame.boxes) + pad
        more = text_width(frame.words, "bold") + 2 * FRAME_INDENT - (right - left)
        top = min(self.edge(one, down=-1)[1] for one in frame.boxes) - pad
        bottom = max(self.edge(one, down=1)[1] for one in frame.boxes) + pad
        return left - max(0, more / 2), bottom, right + max(0, more / 2), top

    def way(self, arrow: Arrow) -> list[Point]:
        """Return the points through which an arrow leads."""
        source, target = self._boxes[arrow.source], self._boxes[arrow.target]
        right, down = _sign(target.column - source.column), _sign(target.row - source.row)
        if not (right and down):
            begin = self.edge(arrow.source, right, down)
            return [begin, self.edge(arrow.target, -right, -down)]
        if arrow.is_sideways:
            begin, end = self.edge(arrow.source, right), self.edge(arrow.target, down=-down)
            return [begin, (end[0], begin[1]), end]
        begin, end = self.edge(arrow.source, down=down), self.edge(arrow.target, -right)
        if self._is_tree:
            begin = (self.edge(arrow.source, -1)[0] + _TRUNK, begin[1])
        return [begin, (begin[0], end[1]), end]

    def beside(self, arrow: Arrow) -> tuple[float, float, str]:
        """Return where the words of an arrow are, and how they are aligned.

        In a column they are in the middle between the frames, at the side of the other columns; in
        a row they are above the arrow.
        """
        (x0, y0), *_, (x1, y1) = self.way(arrow)
        if y0 == y1:
            return (x0 + x1) / 2, y0 - line_height() / 2, "center"
        down = _sign(round(y1 - y0))
        y0 += down * self._rim(arrow.source, arrow.target)
        y1 -= down * self._rim(arrow.target, arrow.source)
        is_last = 0 < self._boxes[arrow.source].column == max(self._x)
        x, align = (x0 - 8, "right") if is_last else (x0 + 8, "left")
        return x, (y0 + y1) / 2, align

    def _rim(self, name: str, other: str) -> float:
        """Return the width of the frames around a box that are not around another one."""
        frames = [one for one in self._frames if name in one.boxes and other not in one.boxes]
        return max(map(self._pad, frames), default=0.0)

    def _pad(self, frame: Frame) -> float:
        return _FRAME_GAP + _OUTER_GAP * _depth(frame, self._frames)


def _widest(sizes: Iterable[tuple[int, float]]) -> dict[int, float]:
    """Return the width of each column, or the height of each row."""
    found: dict[int, float] = {}
    for key, size in sorted(sizes):
        found[key] = max(size, found.get(key, 0.0))
    return found


def _middles(sizes: dict[int, float], gap: float) -> dict[int, float]:
    """Return the middle of each column or row."""
    ends = itertools.accumulate(size + gap for size in sizes.values())
    pairs = zip(sizes.items(), ends, strict=True)
    return {key: end - gap - size / 2 for (key, size), end in pairs}


def _depth(frame: Frame, frames: Collection[Frame]) -> int:
    """Return how many frames are nested in a frame."""
    inside = [one for one in frames if set(one.boxes) < set(frame.boxes)]
    return max((1 + _depth(one, inside) for one in inside), default=0)


def _sign(number: int) -> int:
    return (number > 0) - (number < 0)


def _draw(canvas: Canvas, shown: Diagram, grid: _Grid) -> None:
    def on_canvas(point: Point) -> Point:
        x = theme.MARGIN + point[0] - grid.left
        return x, canvas.top - _HEAD - (point[1] - grid.top)

    for frame in shown.frames:
        left, bottom, right, top = grid.around(frame)
        ends = (*on_canvas((left, bottom)), *on_canvas((right, top)))
        strong = bool(shown.bright) and shown.highlights(frame.words)
        canvas.frame(*ends, frame.words, strong, frame.is_centred)
    # What is highlighted is drawn last, where arrows share a part of their way.
    for arrow in sorted(shown.arrows, key=lambda one: shown.highlights(one.source, one.target)):
        bright = shown.highlights(arrow.source, arrow.target)
        points = [on_canvas(point) for point in grid.way(arrow)]
        canvas.arrow(cornered(points), _BRIGHT if bright else _QUIET)
        if arrow.words:
            x, y, align = grid.beside(arrow)
            colour = theme.INK if bright else theme.MUTED
            canvas.text(*on_canvas((x, y)), arrow.words, colour, align)
    for box in shown.boxes:
        _draw_box(canvas, box, on_canvas(grid.edge(box.name)), shown.highlights(box.name))


def _draw_box(canvas: Canvas, box: Box, at: Point, bright: bool) -> None:
    rows = box.name.split("\n")
    x, align, weight = at[0], "center", "bold" if bright else "normal"
    if box.kind == "text":
        x, align, weight = at[0] - box.size[0] / 2, "left", "normal"
    else:
        fill, edge = _LOOKS[box.kind] if bright else (theme.CARD, theme.FRAME)
        canvas.shape(at, box.size, _RADII[box.kind], fill, edge, 2.2 if bright else 1.1)
    for rank, row in enumerate(rows):
        y = at[1] + ((len(rows) - 1) / 2 - rank) * line_height()
        canvas.text(x, y, row, theme.INK if bright else theme.MUTED, align, weight)


# The same in words.


def describe(shown: Diagram) -> str:
    """Tell what a diagram shows: its heading, its words, and what is highlighted."""
    bright = listing(map(one_line, shown.bright))
    return " ".join(
        [f"{shown.heading}.", shown.words, *([f"Highlighted: {bright}."] * bool(bright))]
    )


def one_line(name: str) -> str:
    """Return the name of a box without the breaks between its lines."""
    return name.replace("_\n", "_").replace("/\n", "/").replace(".\n", ".").replace("\n", " ")


# The diagrams. First the map: at the top what runs, below what it is made from.

_SENSOR, _MONITOR = "temperature_\nsensor", "temperature_\nmonitor"
_TOPIC = "/temperature"
_PUBLISHER, _SUBSCRIBER = "temperature_\npublisher.py", "temperature_\nsubscriber.py"
_PROGRAMS = ("temperature_\npublisher", "temperature_\nsubscriber")
_ABOUT = "package.xml\nsetup.py"
_PACKAGE, _WORKSPACE, _INSTALL = "package sensor_simulator", "workspace", "install"
_TERMINALS = ("terminal 1", "terminal 2")
_RUNNING = (_SENSOR, _TOPIC, _MONITOR)

_MAP = Diagram(
    "On this page",
    "At the top is what runs: temperature_sensor in terminal 1 publishes on /temperature, and "
    "temperature_monitor in terminal 2 subscribes to it. Below is the workspace. In it is the "
    "package sensor_simulator, with package.xml, setup.py, temperature_publisher.py and "
    "temperature_subscriber.py. With colcon build, the last two become the programs in install, "
    "temperature_publisher and temperature_subscriber. With source and ros2 run, these become "
    "the two nodes.",
    (
        Box(_SENSOR, "node", 0, 1),
        Box(_TOPIC, "topic", 1, 1),
        Box(_MONITOR, "node", 2, 1),
        Box(_PROGRAMS[0], "program", 0, 2),
        Box(_PROGRAMS[1], "program", 2, 2),
        Box(_PUBLISHER, "file", 0, 3),
        Box(_ABOUT, "file", 1, 3),
        Box(_SUBSCRIBER, "file", 2, 3),
    ),
    (
        Arrow(_SENSOR, _TOPIC),
        Arrow(_TOPIC, _MONITOR),
        Arrow(_PROGRAMS[0], _SENSOR, "source, ros2 run"),
        Arrow(_PROGRAMS[1], _MONITOR, "source, ros2 run"),
        Arrow(_PUBLISHER, _PROGRAMS[0], "colcon build"),
        Arrow(_SUBSCRIBER, _PROGRAMS[1], "colcon build"),
    ),
    (
        Frame(_TERMINALS[0], (_SENSOR,)),
        Frame(_TERMINALS[1], (_MONITOR,)),
        Frame(_WORKSPACE, (*_PROGRAMS, _PUBLISHER, _ABOUT, _SUBSCRIBER), is_centred=True),
        Frame(_INSTALL, _PROGRAMS, is_centred=True),
        Frame(_PACKAGE, (_PUBLISHER, _ABOUT, _SUBSCRIBER), is_centred=True),
    ),
)


def _page(heading: str, *bright: str) -> Diagram:
    """Return the map with the part of one page highlighted."""
    return replace(_MAP, heading=f"On this page: {heading}", bright=bright)


def _beyond(made: Diagram, name: str, kind: str, words: str, *arrows: Arrow) -> Diagram:
    """Return the map with a box above the topic that only one page has."""
    return replace(
        made,
        words=f"{made.words} {words}",
        boxes=(*made.boxes, Box(name, kind, 1, 0)),
        arrows=(*made.arrows, *arrows),
        # A page on which it is about nodes, wherever they run.
        frames=made.frames[len(_TERMINALS) :],
    )


_LOOKING, _QUALITY = "ros2 node,\ntopic, param", "quality\nof service"
_BAG, _SERVICE = "bag", "service,\naction"

_YOURS, _INPUTS, _OUTPUTS = "your\nnodes", "/temperature\n/humidity", "/vent /pump\n/alarm /report"
_PROGRAM, _NODES, _LAUNCH = "your\nprograms", "nodes.py", "launch file"
_GREENHOUSE = Diagram(
    "On this page: a system and a package of your own",
    "At the top is what runs: two sensors publish on /temperature and /humidity. Your nodes "
    "subscribe to these, and publish on /vent, /pump, /alarm and /report. Below is the workspace. "
    "In it is the package greenhouse, with package.xml, setup.py, nodes.py and a launch file. "
    "With colcon build, nodes.py becomes your programs in install. With source and ros2 run, "
    "these become your nodes.",
    (
        Box("two\nsensors", "node", 0, 0),
        Box(_INPUTS, "topic", 1, 0),
        Box(_YOURS, "node", 2, 0),
        Box(_OUTPUTS, "topic", 3, 0),
        Box(_PROGRAM, "program", 2, 1),
        Box(_ABOUT, "file", 1, 2),
        Box(_NODES, "file", 2, 2),
        Box(_LAUNCH, "file", 3, 2),
    ),
    (
        Arrow("two\nsensors", _INPUTS),
        Arrow(_INPUTS, _YOURS),
        Arrow(_YOURS, _OUTPUTS),
        Arrow(_PROGRAM, _YOURS, "source, ros2 run"),
        Arrow(_NODES, _PROGRAM, "colcon build"),
    ),
    (
        Frame(_WORKSPACE, (_PROGRAM, _ABOUT, _NODES, _LAUNCH)),
        Frame(_INSTALL, (_PROGRAM,)),
        Frame("package greenhouse", (_ABOUT, _NODES, _LAUNCH)),
    ),
    (_YOURS, _OUTPUTS, _PROGRAM, _ABOUT, _NODES, _LAUNCH, "package greenhouse"),
)

_ROOT = "ROS2_and_RL_\nTutorials"
_FOLDERS = Diagram(
    "The folders of a workspace",
    "In ROS2_and_RL_Tutorials are seven folders: src, for your packages, from page 02 on; docs; "
    "scripts; resources, with images in it; install, where colcon build puts what it makes from "
    "src; build, for its intermediate files; and log, for its records.",
    (
        Box(_ROOT, "file", 0, 0),
        Box("src", "file", 1, 1),
        Box("your packages, from page 02 on", "text", 2, 1),
        Box("docs", "file", 1, 2),
        Box("scripts", "file", 1, 3),
        Box("resources", "file", 1, 4),
        Box("images", "file", 2, 4),
        Box("install", "file", 1, 5),
        Box("what colcon build makes from src", "text", 2, 5),
        Box("build", "file", 1, 6),
        Box("its intermediate files", "text", 2, 6),
        Box("log", "file", 1, 7),
        Box("its records", "text", 2, 7),
    ),
    (
        *(Arrow(_ROOT, name)
          for name in ("src", "docs", "scripts", "resources", "install", "build", "log")),
        Arrow("resources", "images"),
    ),
    gaps=(28.0, 12.0),
    is_tree=True,
)  # fmt: skip

_WITH, _WITHOUT = (
    "terminal build,\nafter source\ninstall/setup.bash",
    "terminal other,\nnot sourced",
)
_UNDERLAY = "rclpy\nstd_msgs\n..."
_OVERLAY = Diagram(
    "Two terminals, and the packages that each of them finds",
    "The overlay, your workspace, with the package sensor_simulator, lies on top of the underlay, "
    "ROS 2, with rclpy, std_msgs and more. Terminal build, after source install/setup.bash, finds "
    "the packages of both. Terminal other, where the workspace is not sourced, finds only those of "
    "the underlay.",
    (
        Box(_WITH, "program", 0, 0),
        Box("sensor_simulator", "file", 1, 0),
        Box(_UNDERLAY, "file", 1, 1),
        Box(_WITHOUT, "program", 2, 1),
    ),
    (
        Arrow(_WITH, "sensor_simulator"),
        Arrow(_WITH, _UNDERLAY),
        Arrow(_WITHOUT, _UNDERLAY),
    ),
    (
        Frame("overlay: your workspace", ("sensor_simulator",)),
        Frame("underlay: ROS 2", (_UNDERLAY,)),
    ),
    gaps=(62.0, 54.0),
)

_COMMAND = "ros2 run sensor_simulator\ntemperature_publisher"
_EXECUTABLE = "install/.../lib/sensor_simulator/\ntemperature_publisher"
_ENTRY = "sensor_simulator.\ntemperature_publisher:main"
_ENTRY_POINT = Diagram(
    "From the command to the node",
    "You type ros2 run sensor_simulator temperature_publisher: a package and an executable. That "
    "starts the executable install/.../lib/sensor_simulator/temperature_publisher, which colcon "
    "makes from the entry point. It looks up the entry point, "
    "sensor_simulator.temperature_publisher:main: a module and a function. That names main(), a "
    "function in temperature_publisher.py, which creates the node temperature_sensor.",
    (
        Box(_COMMAND, "program", 0, 0),
        Box("what you type:\npackage and executable", "text", 1, 0),
        Box(_EXECUTABLE, "file", 0, 1),
        Box("the executable, which colcon\nmakes from the entry point", "text", 1, 1),
        Box(_ENTRY, "file", 0, 2),
        Box("the entry point:\nmodule and function", "text", 1, 2),
        Box("main()", "file", 0, 3),
        Box("a function in\ntemperature_publisher.py", "text", 1, 3),
        Box(_SENSOR, "node", 0, 4),
        Box("the node that it creates", "text", 1, 4),
    ),
    (
        Arrow(_COMMAND, _EXECUTABLE, "starts"),
        Arrow(_EXECUTABLE, _ENTRY, "looks up"),
        Arrow(_ENTRY, "main()", "names"),
        Arrow("main()", _SENSOR, "creates"),
    ),
    gaps=(24.0, 36.0),
)

#: Every diagram, by the name that a page asks for.
DIAGRAMS = {
    "00": _page("nodes, and the topic between them", *_RUNNING),
    "01": _page("the workspace, and terminals", _WORKSPACE, *_TERMINALS),
    "02": _page("the package, and what describes it", _PACKAGE, _ABOUT, _INSTALL),
    "03": _page("the publisher", _PUBLISHER, _SENSOR, _TOPIC),
    "04": _page("the subscriber", _SUBSCRIBER, _MONITOR, _TOPIC),
    "05": _page("how a file becomes a program", _PUBLISHER, _ABOUT, _SUBSCRIBER, *_PROGRAMS),
    "06": _page("build, source, run", *_RUNNING, *_TERMINALS, *_PROGRAMS, _PUBLISHER, _SUBSCRIBER),
    "07": _beyond(
        _page("commands that look at a running system", *_RUNNING, _LOOKING),
        *(_LOOKING, "program", "The commands ros2 node, topic and param look at what runs."),
        Arrow(_TOPIC, _LOOKING),
    ),
    "08": _beyond(
        _page("what becomes of a message on its way", *_RUNNING, _QUALITY),
        *(_QUALITY, "file", "Quality of service decides how /temperature carries messages."),
        Arrow(_QUALITY, _TOPIC),
    ),
    "09": _page("two programs, put to the test", *_RUNNING, *_TERMINALS),
    "10": _page("what can go wrong between two nodes", *_RUNNING),
    "11": _beyond(
        _page("a topic, recorded and replayed", _TOPIC, _BAG, _MONITOR),
        *(_BAG, "file", "A bag records what is published on /temperature, and replays it."),
        Arrow(_TOPIC, _BAG),
        Arrow(_BAG, _TOPIC),
    ),
    "12": _beyond(
        _page("what nodes have besides topics", _SENSOR, _MONITOR, _SERVICE),
        *(_SERVICE, "topic", "One node asks another one by a service or an action."),
        Arrow(_MONITOR, _SERVICE),
        Arrow(_SERVICE, _SENSOR, is_sideways=True),
    ),
    "13": _GREENHOUSE,
    "workspace": _FOLDERS,
    "overlay": _OVERLAY,
    "entry point": _ENTRY_POINT,
}
