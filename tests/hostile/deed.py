"""What one hostile submission is, and the answers that the attacks are wrapped around."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from textwrap import dedent, indent

#: What is in nothing that was handed in by this learner, and must never be in a report of theirs.
CANARY = "canary-5c1d-sings"
#: What attacks leave behind, so that it is found if it outlives its sandbox.
TRACE = "hostile-trace-7f3a"
#: Where the class's canaries lie is filled in when it is handed in; see `handing_in`.
HOME, CLASS, COURSE = "{home}", "{class}", "{course}"


@dataclass(frozen=True)
class Deed:
    """An attack from within an answer.

    Attributes:
        name: What it tries.
        answer: The text of the cell.
        words: What the mark has to say.
        exercise: The exercise that it pretends to answer.
        passes: Whether it gets its points, as it is a right answer. What it does besides gains
            nothing.
        forges: Whether it gets points by evidence that it has forged, with a right answer's times
            or values inside. It carries a remark for the instructor.
    """

    name: str
    answer: str
    words: str = ""
    exercise: str = "03a"
    passes: bool = False
    forges: bool = False


@dataclass(frozen=True)
class Upload:
    """An attack by the files that are handed in.

    Attributes:
        name: What it tries.
        files: Content by path in the learner's folder, or what makes it if that takes long: every
            process that collects tests would wait for it.
        status: What the mark of 03a has to be.
        words: What the remarks or the cause have to say.
        folder: The name of the learner's folder; made from `name` if empty.
    """

    name: str
    files: Mapping[str, bytes | Callable[[], bytes]]
    status: str = "missing"
    words: str = ""
    folder: str = ""


RIGHT = """\
class HumiditySensor(Node):
    def __init__(self):
        super().__init__("humidity_sensor")
        self.publisher_ = self.create_publisher(Float32, "humidity", 5)
        self.timer = self.create_timer(0.5, self.publish_humidity)

    def publish_humidity(self):
        self.publisher_.publish(Float32(data=45.0))
"""
#: Seven readings at the wrong times: whoever passes with it has cheated.
WRONG = RIGHT.replace("0.5", "0.7")
FRIDGE = """\
class FridgeMonitor(Node):
    def __init__(self):
        super().__init__("fridge_monitor")
        self.create_subscription(Float32, "temperature", self.temperature_callback, 10)

    def temperature_callback(self, msg):
        temp = msg.data
        status = "Warm" if temp > 8.0 else "Frost" if temp < 2.0 else "Fine"
        self.get_logger().info(f"Fridge: {temp:.2f}C - Status:{status}")
"""


def before(code, answer=RIGHT):
    """An answer below some code."""
    return f"{dedent(code).strip()}\n\n{answer}"


def within(code, answer=RIGHT):
    """An answer with some code at the end of its callback."""
    return f"{answer}{indent(dedent(code).strip(), ' ' * 8)}\n"
