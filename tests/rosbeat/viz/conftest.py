"""Records to draw, and a look at finished pictures: nothing may overlap or be cut off."""

import itertools

import pytest

from rosbeat.records import (
    NANOSECONDS,
    CallbackRecord,
    Endpoint,
    GraphSnapshot,
    Observation,
    QoS,
    Sample,
)

FLOAT = "std_msgs/msg/Float32"


class Make:
    """Short ways to make records."""

    @staticmethod
    def pub(node, topic, matched=1, type_name=FLOAT):
        return Endpoint(node, topic, type_name, "publisher", QoS(), matched)

    @staticmethod
    def sub(node, topic, matched=1, type_name=FLOAT):
        return Endpoint(node, topic, type_name, "subscription", QoS(), matched)

    @staticmethod
    def graph(*ends, alone=()):
        return GraphSnapshot(tuple(dict.fromkeys([*(end.node for end in ends), *alone])), ends)

    @staticmethod
    def sample(time, value, topic="/temperature", node="/sensor"):
        data = value if isinstance(value, dict) else {"data": value}
        return Sample(round(time * NANOSECONDS), topic, FLOAT, node, data)

    @staticmethod
    def timer(time, node="/sensor"):
        return CallbackRecord(round(time * NANOSECONDS), node, "timer", "publish", "1 s")

    @staticmethod
    def heard(time, node="/monitor", topic="/temperature"):
        return CallbackRecord(round(time * NANOSECONDS), node, "subscription", "hear", topic)

    @classmethod
    def pair(cls, count, **more):
        """A sensor that publishes once a second and a monitor that hears it."""
        times = range(1, count + 1)
        calls = [call for at in times for call in (cls.timer(at), cls.heard(at))]
        graph = cls.graph(cls.pub("/sensor", "/temperature"), cls.sub("/monitor", "/temperature"))
        samples = tuple(cls.sample(at, 20.0 + at % 7) for at in times)
        return Observation(
            count * NANOSECONDS, 7, samples, callbacks=tuple(calls), graph=graph, **more
        )


@pytest.fixture(scope="session")
def make():
    return Make


def texts(figure):
    """Every text that is shown, whichever axes it belongs to."""
    found = [text for axes in figure.axes for text in axes.texts]
    for axes in figure.axes:
        if axes.axison:
            found += [*ticks(axes.xaxis, axes.get_xlim()), *ticks(axes.yaxis, axes.get_ylim())]
            found.append(axes.xaxis.label)
    return [text for text in found if text.get_text().strip() and text.get_visible()]


def ticks(axis, limits):
    """The labels of those ticks that are in view; the others exist but are not drawn."""
    low, high = sorted(limits)
    places = axis.get_ticklocs()
    labels = zip(places, axis.get_ticklabels(), strict=True)
    return [label for place, label in labels if low <= place <= high]


@pytest.fixture(scope="session")
def words_in():
    """The words in a picture, line by line."""
    return lambda picture: [text.get_text() for text in texts(picture.figure)]


@pytest.fixture(scope="session")
def is_tidy():
    """Whether all text is inside the picture and no two texts overlap."""

    def check(picture):
        figure = picture.figure
        figure.canvas.draw()
        boxes = [(text.get_text(), text.get_window_extent()) for text in texts(figure)]
        edge = figure.bbox
        for words, box in boxes:
            inside = box.x0 >= 0 and box.y0 >= 0 and box.x1 <= edge.x1 and box.y1 <= edge.y1
            assert inside, f"{words!r} is cut off"
        for (one, a), (other, b) in itertools.combinations(boxes, 2):
            across = min(a.x1, b.x1) - max(a.x0, b.x0)
            along = min(a.y1, b.y1) - max(a.y0, b.y0)
            # Text extents include the room for letters like g; one pixel of it may be shared.
            assert across <= 1 or along <= 2, f"{one!r} overlaps {other!r}"
        return True

    return check
