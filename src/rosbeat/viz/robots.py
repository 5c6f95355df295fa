"""Draw a robot in its room, seen from above: the map, the way it went, what its scanner saw."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import cos, degrees, dist, isfinite, pi, sin
from typing import Any

from matplotlib.patches import Polygon, Rectangle

from rosbeat.errors import PictureError, called_as
from rosbeat.records import Sample
from rosbeat.viz import theme
from rosbeat.viz.arguments import Observed, observed
from rosbeat.viz.canvas import ROOM, Canvas, Entry, blank
from rosbeat.viz.picture import Picture
from rosbeat.viz.text_format import count, number

#: What a robot of the course publishes, below its own name: where it is, what is around it, and
#: what the room looks like. None but the pose has to be there.
_POSE, _SCAN, _MAP = "pose", "scan", "map"
_OCCUPIED = 50
#: The room without a map: so many meters around where the robot was.
_AROUND = 0.5
_BODY = 0.17
_WAY = theme.Style(theme.BLUE, "", "-")
_SECOND = theme.Style(theme.BLUE, "o", "")
_SEEN = theme.Style(theme.VERMILLION, "x", "")
_BED = theme.Style(theme.FRAME, "s", "")
#: A drive of more seconds than this has a mark every ten.
_FEW_SECONDS = 30.0
_WIDEST = 420.0
#: Meters below which a robot has not moved.
_NOTHING = 0.005

Place = tuple[float, float]
#: From meters in the room to pixels of the picture.
Scale = Callable[[Place], Place]


@dataclass(frozen=True)
class Grid:
    """Hold a map: which cells of a room are occupied.

    Attributes:
        cells: From -1 (unknown) over 0 (free) to 100, row by row from the lower left.
        width: Cells in a row.
        side: Length of a cell's side in meters.
        corner: The lower left corner, in meters.
    """

    cells: Sequence[int]
    width: int
    side: float
    corner: Place = (0.0, 0.0)

    @property
    def size(self) -> Place:
        """Return the lengths of the sides, in meters."""
        return self.width * self.side, len(self.cells) // max(self.width, 1) * self.side

    def runs(self) -> list[tuple[float, float, float]]:
        """Return the occupied stretches of each row: left end, lower end and length, in meters."""
        stretches = []
        for row in range(len(self.cells) // self.width):
            begin = None
            for column in range(self.width + 1):
                at = row * self.width + column
                is_occupied = column < self.width and self.cells[at] >= _OCCUPIED
                if is_occupied and begin is None:
                    begin = column
                elif not is_occupied and begin is not None:
                    x, y = self.corner[0] + begin * self.side, self.corner[1] + row * self.side
                    stretches.append((x, y, (column - begin) * self.side))
                    begin = None
        return stretches


@dataclass(frozen=True)
class Drive:
    """Hold what is known of a robot's drive.

    Attributes:
        times: When it told where it was, in seconds of virtual time, ascending.
        places: Where it was then, in meters.
        theta: Which way it looked in the end, in radians, counterclockwise from the x axis.
        seen: Where its last scan met something.
        nearest: The shortest range of that scan in meters; None without a scan.
        grid: The map; None without one.
    """

    times: tuple[float, ...]
    places: tuple[Place, ...]
    theta: float
    seen: tuple[Place, ...] = ()
    nearest: float | None = None
    grid: Grid | None = None

    @property
    def length(self) -> float:
        """Return how far it drove, in meters."""
        return sum(dist(*ends) for ends in pairwise(self.places))

    def marked(self) -> list[Place]:
        """Return where it was at each full second, or at each tenth one of a long drive."""
        every = 1.0 if self.times[-1] - self.times[0] <= _FEW_SECONDS else 10.0
        places, due = [], self.times[0]
        for time, place in zip(self.times, self.places, strict=True):
            if time >= due - 1e-9:
                places.append(place)
                due += every
        return places

    def bounds(self) -> tuple[float, float, float, float]:
        """Return what the picture shows: the ends of both axes, in meters."""
        if self.grid is not None:
            (left, bottom), (wide, high) = self.grid.corner, self.grid.size
            return left, bottom, left + wide, bottom + high
        points = [*self.places, *self.seen]
        xs, ys = [x for x, _ in points], [y for _, y in points]
        return min(xs) - _AROUND, min(ys) - _AROUND, max(xs) + _AROUND, max(ys) + _AROUND


@called_as("viz.robot(ros)")
def robot(source: Observed, name: str = "rosie") -> Picture:
    """Draw a robot in its room: where it drove, where it is, what its scanner sees.

    Args:
        source: A session, or what it observed.
        name: Below which its topics are: `pose` (`geometry_msgs/msg/Pose2D`), and, if there are
            any, `scan` (`sensor_msgs/msg/LaserScan`) and `map` (`nav_msgs/msg/OccupancyGrid`).

    Raises:
        PictureError: If `source` is no session, or no robot of this name told where it is.
    """
    drive = drive_of(observed(source, "a session").samples, name)
    left, bottom, right, top = drive.bounds()
    scale = min(ROOM / (right - left), _WIDEST / (top - bottom))
    entries = [Entry("its way, with a mark every second", _WAY)] if drive.length > _NOTHING else []
    if entries and drive.times[-1] - drive.times[0] > _FEW_SECONDS:
        entries = [Entry("its way, with a mark every 10 seconds", _WAY)]
    if drive.seen:
        entries.append(Entry("what its scanner sees now", _SEEN))
    if drive.grid is not None:
        entries.append(Entry("walls and beds", _BED))
    with blank((top - bottom) * scale, entries=entries) as canvas:
        origin = (theme.MARGIN + (ROOM - (right - left) * scale) / 2, canvas.bottom)

        def at(place: Place) -> Place:
            return (
                origin[0] + (place[0] - left) * scale,
                origin[1] + (place[1] - bottom) * scale,
            )

        _draw_room(canvas, drive, at, scale)
        _draw_robot(canvas, drive, at, scale)
        return Picture(canvas.figure, _description(drive, name), f"{name.title()} from above")


def drive_of(samples: Sequence[Sample], name: str) -> Drive:
    """Return what a robot told of its drive.

    Raises:
        PictureError: If it told nothing.
    """
    base = f"/{name.strip('/')}/"
    poses = [
        sample
        for sample in samples
        if sample.topic == base + _POSE and {"x", "y", "theta"} <= sample.data.keys()
    ]
    if not poses:
        raise PictureError(
            f"Nothing was published on {base}{_POSE} that says where a robot is.",
            "The picture is drawn from a robot's own messages, of type geometry_msgs/msg/Pose2D.",
            "Add the robot, and run the session: `ros.add(Rover)`, `ros.run(seconds=5)`.",
        )
    here = poses[-1].data
    scan, grid = _last(samples, base + _SCAN, "ranges"), _last(samples, base + _MAP, "info")
    ranges = _ranges(scan) if scan else []
    return Drive(
        tuple(pose.time for pose in poses),
        tuple((float(pose.data["x"]), float(pose.data["y"])) for pose in poses),
        float(here["theta"]),
        tuple(
            (
                here["x"] + length * cos(here["theta"] + angle),
                here["y"] + length * sin(here["theta"] + angle),
            )
            for angle, length in ranges
        ),
        min((length for _, length in ranges), default=None),
        _grid(grid) if grid else None,
    )


def _last(samples: Sequence[Sample], topic: str, field: str) -> Mapping[str, Any] | None:
    messages = [sample.data for sample in samples if sample.topic == topic and field in sample.data]
    return messages[-1] if messages else None


def _ranges(scan: Mapping[str, Any]) -> list[tuple[float, float]]:
    """Return the angle and the range of each ray that met something."""
    return [
        (scan["angle_min"] + rank * scan["angle_increment"], float(length))
        for rank, length in enumerate(scan["ranges"])
        if isfinite(length) and scan["range_min"] <= length < scan["range_max"]
    ]


def _grid(told: Mapping[str, Any]) -> Grid | None:
    info = told["info"]
    corner = info["origin"]["position"]
    if not info["width"] or not told["data"]:
        return None
    place = (float(corner["x"]), float(corner["y"]))
    return Grid(tuple(told["data"]), int(info["width"]), float(info["resolution"]), place)


# The picture.


def _draw_room(canvas: Canvas, drive: Drive, at: Scale, scale: float) -> None:
    left, bottom, right, top = drive.bounds()
    corner, size = at((left, bottom)), ((right - left) * scale, (top - bottom) * scale)
    canvas.axes.add_patch(
        Rectangle(corner, *size, fc=theme.FRAME_FILL, ec=theme.FRAME, lw=1.5, zorder=0.5)
    )
    if drive.grid is None:
        return
    for x, y, length in drive.grid.runs():
        # A little higher than a cell, so that no hair of the ground is seen between two rows.
        canvas.axes.add_patch(
            Rectangle(
                at((x, y)),
                length * scale,
                drive.grid.side * scale + 0.4,
                fc=theme.FRAME,
                ec="none",
                zorder=1,
            )
        )


def _draw_robot(canvas: Canvas, drive: Drive, at: Scale, scale: float) -> None:
    way = [at(place) for place in drive.places]
    canvas.axes.plot(*zip(*way, strict=True), color=theme.BLUE, lw=1.6, zorder=2)
    if drive.length > _NOTHING:
        for place in drive.marked():
            canvas.mark(*at(place), _SECOND, 3.0)
    for place in drive.seen:
        canvas.mark(*at(place), _SEEN, 4.0, width=1.2)
    x, y = way[-1]
    body = 2 * _BODY * scale
    canvas.shape((x, y), (body, body), None, theme.NODE_FILL_STRONG, theme.BLUE, 1.5, layer=5)
    nose = [
        (x + body * 0.42 * cos(drive.theta + turn), y + body * 0.42 * sin(drive.theta + turn))
        for turn in (0.0, 0.78 * pi, -0.78 * pi)
    ]
    canvas.axes.add_patch(Polygon(nose, fc=theme.BLUE, ec="none", zorder=6))


# Words.


def _description(drive: Drive, name: str) -> str:
    who = name.strip("/").title()
    (x, y), angle = drive.places[-1], round(degrees(drive.theta)) % 360
    sentences = [f"{who} from above."]
    if drive.grid is not None:
        wide, high = map(number, drive.grid.size)
        sentences = [f"{who} from above, in a room {wide} m wide and {high} m deep."]
    lasted = drive.times[-1] - drive.times[0]
    if drive.length > _NOTHING:
        begin = drive.places[0]
        sentences.append(
            f"In {number(round(lasted, 1))} s {who} drove {drive.length:.1f} m, from "
            f"({begin[0]:.1f}, {begin[1]:.1f}) to ({x:.1f}, {y:.1f}), and looks along "
            f"{angle} degrees now."
        )
    else:
        sentences.append(
            f"{who} stands at ({x:.1f}, {y:.1f}), looks along {angle} degrees, and has not moved."
        )
    if drive.nearest is not None:
        sentences.append(
            f"The scanner sees {count(len(drive.seen), 'point')}; the nearest is "
            f"{drive.nearest:.1f} m away."
        )
    return " ".join(sentences)
