"""A session that a test makes up."""

from dataclasses import dataclass, field

import pytest

from rosbeat.panel.charts import Arrival
from rosbeat.panel.sampling import News
from rosbeat.records import Endpoint, GraphSnapshot, Sample

FLOAT = "std_msgs/msg/Float32"


def sample(value, topic="/temperature", node="/sensor", time_ns=0, field="data"):
    return Sample(time_ns, topic, FLOAT, node, {field: value})


def two_nodes(topic="/temperature"):
    ends = (
        Endpoint("/sensor", topic, FLOAT, "publisher", None, 1),
        Endpoint("/monitor", topic, FLOAT, "subscription", None, 1),
    )
    return GraphSnapshot(("/sensor", "/monitor"), ends)


@dataclass
class MadeUp:
    """Instruments that show what the test wants, and note what is asked of them."""

    seconds: float = 0.0
    snapshot: GraphSnapshot = field(default_factory=two_nodes)
    waiting: list = field(default_factory=list)
    said: list = field(default_factory=list)
    failed: list = field(default_factory=list)
    asked: list = field(default_factory=list)
    states: dict = field(default_factory=lambda: {"/monitor": "running", "/sensor": "running"})

    def now_ns(self):
        return round(self.seconds * 1e9)

    def is_live(self):
        return True

    def news(self):
        news = News(tuple(self.waiting), tuple(self.said), tuple(self.failed))
        self.waiting, self.said, self.failed = [], [], []
        return news

    def graph(self):
        return self.snapshot

    def conditions(self):
        return dict(self.states)

    def hear(self, value, count=1, **about):
        about.setdefault("time_ns", self.now_ns())
        self.waiting.append(Arrival(count, sample(value, **about)))

    def __getattr__(self, name):
        if name not in ("pause", "resume", "stop", "start", "publish", "repeat", "disturb",
                        "load", "release"):  # fmt: skip
            raise AttributeError(name)
        return lambda *given: self.asked.append((name, *given))


@pytest.fixture
def made_up():
    return MadeUp()
