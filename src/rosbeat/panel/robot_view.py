"""Show a robot live on a page, from above, with buttons to drive it: `watch_robot`.

The frames come from `rosbeat.ros.robot_reporter`, a program of its own that listens in the domain
of the terminals. It runs while a browser looks: a view that is opened starts it, and one that is
closed, or whose tab says nothing for a minute, ends it.
"""

from __future__ import annotations

import json
import subprocess
import sys
import time
from pathlib import Path
from threading import RLock, Thread
from typing import Any

from IPython.display import display
from traitlets import Unicode

from rosbeat.errors import CallError, called_as
from rosbeat.panel.panel import FlowControl, PanelWidget, is_for_a_browser

_HERE = Path(__file__).parent
#: Seconds after which nobody looks any more.
_UNWATCHED = 60.0
_STILL = (
    "In JupyterLab, the live view of {name} is here: it shows where the robot is and what it sees. "
    "Run this cell to open it."
)


@called_as("watch_robot()")
def watch_robot(name: str = "rosie") -> RobotView:
    """Show a robot from above, live, with buttons to drive it.

    It listens to the topics of the robot in the domain of the terminals, and to nothing else, so it
    shows any robot that publishes them: `pose` (`geometry_msgs/msg/Pose2D`), `scan`, `map`,
    `temperature` and `lamp`, as the package `rosie` does. A button publishes on `cmd_vel`.

    Args:
        name: Below which the topics are.

    Returns:
        The view, which a cell displays.

    Raises:
        CallError: If the name is not one of ROS.
    """
    if not isinstance(name, str) or not all(
        part.isidentifier() and part.isascii() for part in name.strip("/").split("/")
    ):
        raise CallError(
            f"{name!r} is not the name of a robot.",
            "A robot's topics are below its name, and names have letters, digits and `_`.",
            'Write for example `watch_robot("rosie")`.',
        )
    return RobotView(name.strip("/"))


class RobotView:
    """Hold a live view of a robot.

    Args:
        name: Below which the robot's topics are.
    """

    def __init__(self, name: str) -> None:
        self._name = name
        self._lock = RLock()
        self._flow = FlowControl()
        self._reporter: subprocess.Popen[str] | None = None
        self._heard_at = 0.0
        self._map: dict[str, Any] | None = None
        self._is_map_new = False
        self._widget = RobotWidget(self._heard, name) if is_for_a_browser() else None

    def __repr__(self) -> str:
        return f"RobotView({self._name!r})"

    def close(self) -> None:
        """End the program that listens; the view says so, and opens anew when its cell is run."""
        self._end()

    def _ipython_display_(self) -> None:
        words = _STILL.format(name=self._name.title())
        if self._widget is None:
            display({"text/plain": words}, raw=True)
            return
        view = {"version_major": 2, "version_minor": 0, "model_id": self._widget.model_id}
        display({"application/vnd.jupyter.widget-view+json": view, "text/plain": words}, raw=True)

    def _heard(self, content: dict[str, Any]) -> None:
        with self._lock:
            self._heard_at = now = time.monotonic()
            match content:
                case {"do": "open"}:
                    self._flow.ask(now)
                    self._begin()
                case {"do": "close"}:
                    self._end()
                case {"do": "drive", "ahead": int() | float() as ahead, "turn": turn}:
                    self._tell(float(ahead), float(turn))
                case {"got": int() as number}:
                    self._flow.heard(number, now)
                    self._begin()

    def _begin(self) -> None:
        if self._reporter is not None and self._reporter.poll() is None:
            return
        # Fresh from the environment, and in no session: as a terminal would start it.
        self._reporter = subprocess.Popen(
            [sys.executable, "-m", "rosbeat.ros.robot_reporter", self._name],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            # Ctrl+C and the square of the page are meant for the cell.
            start_new_session=True,
        )
        Thread(target=self._pass_on, args=(self._reporter,), daemon=True).start()

    def _end(self) -> None:
        with self._lock:
            reporter, self._reporter = self._reporter, None
        if reporter is not None and reporter.stdin is not None:
            reporter.stdin.close()  # it ends by itself

    def _tell(self, ahead: float, turn: float) -> None:
        if self._reporter is None or self._reporter.stdin is None:
            return
        try:
            self._reporter.stdin.write(json.dumps([ahead, turn]) + "\n")
            self._reporter.stdin.flush()
        except OSError:
            self._reporter = None  # it has ended; the next message from the browser starts it anew

    def _pass_on(self, reporter: subprocess.Popen[str]) -> None:
        """Send what a reporter prints to the browser, until it ends."""
        assert reporter.stdout is not None
        for line in reporter.stdout:
            frame = json.loads(line)
            now = time.monotonic()
            with self._lock:
                if self._reporter is not reporter:
                    break
                if now - self._heard_at > _UNWATCHED:
                    self._end()
                    break
                if "map" in frame:
                    self._map, self._is_map_new = frame.pop("map"), True
                if not self._flow.may_send(now):
                    continue
                if self._map is not None and (self._flow.asked or self._is_map_new):
                    frame["map"], self._is_map_new = self._map, False
                frame["number"] = self._flow.sent(now)
            self._post(frame)
        reporter.stdout.close()
        reporter.wait()

    def _post(self, frame: dict[str, Any]) -> None:
        if self._widget is not None and self._widget.comm is not None:
            self._widget.send(frame)


class RobotWidget(PanelWidget):
    """Draw frames in the browser, and hear which buttons are pressed.

    Args:
        heard: Called with each message from the browser.
        name: The robot's name.
    """

    _esm = Unicode((_HERE / "robot_view.js").read_text(encoding="utf-8")).tag(sync=True)
    _css = Unicode((_HERE / "robot_view.css").read_text(encoding="utf-8")).tag(sync=True)
    robot = Unicode("").tag(sync=True)

    def __init__(self, heard: Any, name: str) -> None:  # noqa: ANN401 - as in PanelWidget
        super().__init__(heard)
        self.robot = name
