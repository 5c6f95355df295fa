"""A session that a test makes up."""

from dataclasses import dataclass, field

import pytest

from record_builders import graph_of, pub, sample, sub
from rosbeat.panel.sampling import News
from rosbeat.records import GraphSnapshot


def two_nodes():
    return graph_of(pub("/sensor", "/temperature"), sub("/monitor", "/temperature"))


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
        self.waiting.append((count, sample(self.seconds, value, **about)))

    def __getattr__(self, name):
        if name not in ("pause", "resume", "stop", "start", "publish", "repeat", "disturb",
                        "load", "release"):  # fmt: skip
            raise AttributeError(name)
        return lambda *given: self.asked.append((name, *given))


@pytest.fixture
def made_up():
    return MadeUp()
