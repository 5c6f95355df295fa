"""The instrument panel over ten topics at 100 Hz: frames a second, and nothing lost."""

from __future__ import annotations

import json
import time
from typing import Any

from measuring import Row
from rclpy.node import Node
from std_msgs.msg import Float32

from rosbeat import Session
from rosbeat.panel import panel as panels

TOPICS, PERIOD = 10, 0.01
FRAMES, MOST_BYTES = 19.0, 10_000


class Source(Node):
    """Publishes on one topic at 100 Hz, and counts."""

    def __init__(self, number: int) -> None:
        super().__init__(f"source{number}")
        self.count = 0
        self.publisher = self.create_publisher(Float32, f"flow{number}", 10)
        self.create_timer(PERIOD, self.send)

    def send(self) -> None:
        self.count += 1
        self.publisher.publish(Float32(data=float(self.count % 100)))


class Browser:
    """Answers as the page does, at once, and looks at what comes."""

    def __init__(self, panel: Any) -> None:
        self.panel, self.frames, self.sizes = panel, 0, [0]
        self.totals: dict[str, int] = {}
        panel._widget.send = self.take
        panel._heard({"do": "open"})

    def take(self, frame: dict[str, Any]) -> None:
        if "number" not in frame:
            return  # the last word of a panel that closes
        self.frames += 1
        self.sizes.append(len(json.dumps(frame)))
        self.totals |= {name: topic["total"] for name, topic in frame["topics"].items()}
        self.panel._heard({"got": frame["number"]})


def measure(quick: bool) -> list[Row]:
    """Frames, their size, what is recorded, and the processor time with and without a panel."""
    seconds = 3.0 if quick else 15.0
    _, _, without = _run(seconds, watched=False)
    browser, complete, share = _run(seconds, watched=True)
    rate, size = browser.frames / seconds, max(browser.sizes[2:])
    told = f"{TOPICS} topics at {1 / PERIOD:.0f} Hz"
    return [
        Row(f"panel, {told}", f"{rate:.1f} frames/s", "", f">= {FRAMES:g}", rate >= FRAMES),
        Row("largest frame", f"{size} bytes", "", f"<= {MOST_BYTES}", size <= MOST_BYTES),
        Row("recorded while it looks", "all" if complete else "NOT ALL", "", "all", complete),
        Row(
            "processor time with a panel",
            f"{share * 100:.0f} against {without * 100:.0f} % of a core",
            f"{share / without:.2f} x",
        ),
    ]


def _run(seconds: float, watched: bool) -> tuple[Any, bool, float]:
    panels.is_for_a_browser = lambda: watched
    with Session() as ros:
        sources = [ros.add(lambda number=number: Source(number)) for number in range(TOPICS)]
        ros.start()
        panel = ros.panel()
        browser = Browser(panel) if watched else None
        processor, wall = time.process_time(), time.perf_counter()
        time.sleep(seconds)
        share = (time.process_time() - processor) / (time.perf_counter() - wall)
        ros.stop()
        sent = {source.publisher.topic_name: source.count for source in sources}
        recorded = {name: len(ros.messages(name)) for name in sent}
        time.sleep(3 * panels.POLL_PERIOD)  # for the frame with the last of them
    return browser, recorded == sent and (not browser or browser.totals == sent), share
