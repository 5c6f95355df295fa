"""Input that no picture can be drawn from is refused in three parts, with the nearest name."""

import math
from functools import partial

import pytest

from record_builders import graph_of, pair, pub, sample
from rosbeat.comparisons import compare
from rosbeat.errors import PictureError
from rosbeat.records import GraphSnapshot, LogRecord, Observation
from rosbeat.viz import comparison, graph, message_flow, queue, timeline, values
from rosbeat.viz.queues import of_steps

ONE = pair(1)
SENT = [LogRecord(0, "INFO", "one", "5", "", 0)]
POSE = {"x": 1.0, "y": 2.0, "name": "a"}
TWO = [sample(1, 2.0), sample(1, 2.0, topic="/x")]


class Session:
    def observation(self):
        return ONE


def compared(*numbers):
    samples = [sample(time, value) for time, value in enumerate(numbers)]
    return compare(samples, samples, "temperature")


# fmt: off
REFUSED = {
    # What is no run, no graph, no log lines, no queue, no comparison.
    **{f"{draw.__name__} {wrong!r}": (partial(draw, wrong), type(wrong).__name__)
       for draw in (graph, timeline, values) for wrong in (None, 3, "text", Session, [1])},
    **{f"message_flow {wrong!r}": (partial(message_flow, wrong, []), "two processes")
       for wrong in (5, "a text", [1, 2], None)},
    "a receiver": (lambda: message_flow(SENT, 5), "two processes"),
    "queue": (lambda: queue(5), "cannot be drawn from 'int'"),
    "a comparison": (lambda: comparison(3), "cannot be drawn from 'int'"),
    # Nothing to draw.
    "no node": (lambda: graph(GraphSnapshot()), "no node to draw"),
    "only hidden nodes": (lambda: graph(graph_of(alone=["/_hidden"])), "no node to draw"),
    "no event": (lambda: timeline(Observation(0, 7)), "nothing to put on a timeline"),
    "no steps": (lambda: of_steps((), 5), "nothing to draw"),
    "no number": (lambda: message_flow([LogRecord(0, "INFO", "one", "Started", "", 0)], []),
                  "no message to draw"),
    "no messages": (lambda: values([]), "no messages"),
    "no finite value": (lambda: values([sample(1, math.nan)]),
                        "Every value is infinite or not a number"),
    "no finite difference": (lambda: comparison(compared(math.nan)), "no value to draw"),
    # Names, with the nearest one.
    "node": (lambda: graph(ONE, highlight="senser"), "Did you mean '/sensor'"),
    "topic of a timeline": (lambda: timeline(ONE, topics="temprature"),
                            "Did you mean '/temperature'"),
    "topic of values": (lambda: values([sample(1, 2.0)], "/tmperature"),
                        "Did you mean '/temperature'"),
    "a name like no other": (lambda: values([sample(1, 2.0)], "zzz"), "Check the name"),
    "two topics": (lambda: values(TWO), "Choose one: /temperature, /x"),
    "a field of several": (lambda: values([sample(1, POSE)]), "Choose a field: 'x' or 'y'"),
    **{f"field {field}": (partial(values, [sample(1, 1.0)], field=field), "'data'")
       for field in ("dta", "data.x")},
    "field of two runs": (lambda: comparison(compared(1.0), field="x"), "have no field 'x'"),
    # Numbers.
    **{f"value {value!r}": (partial(values, [sample(1, value)]), "is not a number")
       for value in ("warm", [1.0, 2.0], None, "long " * 20)},
    "no value of two runs": (lambda: comparison(compared("warm")), "is not a number"),
    **{f"until {until}": (partial(timeline, ONE, until=until), "cannot end at")
       for until in (-1, math.nan, "soon")},
    **{f"since {since}": (partial(timeline, ONE, since=since), "cannot begin at")
       for since in (-1, math.inf, "soon")},
}
# fmt: on


@pytest.mark.parametrize("case", REFUSED, ids=str)
def test_it_gets_three_parts(case, says):
    draw, words = REFUSED[case]
    with pytest.raises(PictureError) as caught:
        draw()
    says(caught.value, words)


def test_a_session_an_observation_and_its_parts_can_be_drawn():
    assert graph(Session()).svg() == graph(ONE).svg() == graph(ONE.graph).svg()
    assert timeline(Session()).svg() == timeline(ONE).svg()
    drawn = {values(one).svg() for one in (Session(), ONE, ONE.samples, iter(ONE.samples))}
    assert len(drawn) == 1


def test_names_forgive_the_slash_and_repetition():
    twice = values(TWO, ["x", "/x"]).description
    assert twice == values(TWO, "x").description
    assert "/rosout" not in timeline(ONE).description
    assert graph(graph_of(pub("/a", "/t")), highlight="a").svg()


@pytest.mark.parametrize(
    ("value", "field", "words"),
    [
        (True, "", "It is 1."),
        (7, "", "It is 7."),
        ({"header": {"frame_id": "map"}, "position": {"x": 1.5, "y": 2.0}}, "position.x", "1.5."),
    ],
)
def test_any_number_in_a_message_can_be_drawn(value, field, words):
    picture = values([sample(1, value)], **({"field": field} if field else {}))
    assert words in picture.description
