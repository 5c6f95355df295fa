"""The picture of a subscription's queue: what waits, what is taken and what is dropped."""

import pytest

from pictures import is_tidy, lines, words_in
from record_builders import at, call, graph_of, heard, pub, sample, sub
from rosbeat.errors import PictureError
from rosbeat.records import Observation, QoS, queue_steps
from rosbeat.viz import queue
from rosbeat.viz.queues import MOST_MOMENTS, of_steps


@pytest.mark.parametrize(
    ("arrivals", "taken", "depth", "dropped", "words"),
    [
        ([0] * 8, [at(1)] * 5, 5, 3, "8 messages arrived."),
        ([0] * 5, [at(1)], 3, 2,
         "A queue of depth 3, from 0 s to 1 s: 5 messages arrived. 1 was taken: number 3. "
         "2 were dropped: numbers 1 and 2. 2 wait at the end: numbers 4 and 5. "
         "At its fullest the queue held 3 messages."),
        ([0], [], 3, 0, "at 0 s: 1 message arrived. None was taken. None was dropped."),
        ([0, 1, 2, 4], [3], 2, 1, "1 was dropped: number 1."),
        (range(0, 12), [12] * 3, 3, 9, "9 were dropped: numbers 1 to 9."),
    ],
)  # fmt: skip
def test_what_is_dropped_and_taken_is_marked_and_said(arrivals, taken, depth, dropped, words):
    picture = of_steps(queue_steps(arrivals, taken, depth), depth)
    assert words in picture.description
    # One mark each, and one in the key.
    assert len(lines(picture, "X")) == dropped + (dropped > 0)
    assert len(lines(picture, "v")) == len(taken) + (len(taken) > 0)
    assert ("dropped" in words_in(picture)) == (dropped > 0)
    assert {f"depth {depth}", "0 s"} <= set(words_in(picture))
    assert is_tidy(picture)


def test_every_waiting_message_is_a_cell():
    picture = of_steps(queue_steps([0, 0, 0], [], 3), 3)
    assert len(picture.figure.axes[0].patches) == 1 + 2 + 3
    assert words_in(picture).count("1") == 3


@pytest.mark.parametrize(("count", "depth"), [(1, 1), (1, 10), (60, 3), (200, 100), (600, 7)])
def test_any_size_stays_readable(count, depth):
    arrivals = [k * at(0.1) for k in range(count)]
    assert is_tidy(of_steps(queue_steps(arrivals, arrivals[::3], depth), depth))


def test_too_much_is_cut_and_said():
    picture = of_steps(queue_steps(range(MOST_MOMENTS + 5), [], 2), 2)
    assert "5 later moments are not shown." in words_in(picture)
    assert picture.description.endswith("5 later moments are not shown.")


def test_a_drop_and_its_cause_are_one_column():
    texts = of_steps(queue_steps([0, 1, 2], [5], 2), 2).figure.axes[0].texts
    below = [one for one in texts if one.get_weight() == "bold"]
    assert [one.get_text() for one in below] == ["1", "2"]
    places = {one.get_text(): one.get_position() for one in texts}
    assert places["3"][0] == pytest.approx(below[1].get_position()[0])


def busy(*calls, ends=()):
    """Return what a busy monitor with a queue of 3 observes while four messages come."""
    here = sub("/monitor", "/temperature", qos=QoS(depth=3))
    graph = graph_of(pub("/sensor", "/temperature"), here, *ends)
    samples = tuple(sample(time, 20.0) for time in (1, 2, 3, 4))
    return Observation(at(5), 7, samples, callbacks=calls, graph=graph)


class Session:
    def observation(self):
        return busy(heard(5), heard(5))


@pytest.mark.parametrize("source", [Session(), Session().observation()])
@pytest.mark.parametrize("topic", ["temperature", "/temperature", None])
def test_a_session_knows_what_came_what_was_taken_and_the_depth(source, topic):
    said = queue(source, topic).description
    assert said == of_steps(queue_steps([at(one) for one in (1, 2, 3, 4)], [at(5)] * 2, 3), 3
    ).description  # fmt: skip
    assert "A queue of depth 3" in said
    assert "1 was dropped: number 1." in said


def test_of_several_subscriptions_one_is_chosen_by_its_node():
    seen = busy(heard(2), heard(4, node="/lamp"), ends=[sub("/lamp", "/temperature")])
    with pytest.raises(PictureError, match="one subscription, and here are 2") as caught:
        queue(seen, "temperature")
    assert 'node="/monitor"' in caught.value.to_try
    assert "1 was taken: number 1." in queue(seen, "temperature", node="monitor").description
    assert "A queue of depth 10" in queue(seen, "temperature", node="/lamp").description


@pytest.mark.parametrize(
    ("seen", "topic", "words"),
    [
        (busy(), "temprature", "There is no topic 'temprature'"),
        (busy(ends=[sub("/lamp", "/lights")]), None, "one subscription, and here are 2"),
        (Observation(0, 7), None, "Nobody subscribes"),
        (busy(ends=[sub("/lamp", "/lights", 0)]), "lights", "nothing to draw"),
        (busy(heard(5), call(5, "/monitor", "hear", "expired", "/temperature")), None, "expired"),
    ],
)
def test_what_is_no_queue_of_one_subscription_is_refused(seen, topic, words):
    with pytest.raises(PictureError, match=words):
        queue(seen, topic)


def test_steps_still_make_a_picture_and_a_warning():
    steps = queue_steps([0, 1, 2], [5], 2)
    for old in ((steps, 2), (steps, None, 2)):
        with pytest.warns(DeprecationWarning, match="takes a session"):
            assert queue(*old).svg() == of_steps(steps, 2).svg()
