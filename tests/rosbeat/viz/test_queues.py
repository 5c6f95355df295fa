import pytest

from rosbeat.errors import PictureError
from rosbeat.records import queue_steps
from rosbeat.viz import queue
from rosbeat.viz.queues import MOST_MOMENTS

SECOND = 10**9


def marks(picture, marker):
    lines = picture.figure.axes[0].lines
    return sum(line.get_marker() == marker for line in lines)


def test_what_is_dropped_and_taken_is_marked_and_numbered(words_in, is_tidy):
    picture = queue(queue_steps([0] * 8, [SECOND] * 5, 5), 5)
    # One mark each, and one in the key.
    assert marks(picture, "X") == 3 + 1
    assert marks(picture, "v") == 5 + 1
    assert "depth 5" in words_in(picture)
    assert {"0 s", "1 s"} <= set(words_in(picture))
    assert is_tidy(picture)


def test_every_waiting_message_is_a_cell(words_in):
    picture = queue(queue_steps([0, 0, 0], [], 3), 3)
    assert len(picture.figure.axes[0].patches) == 1 + 2 + 3
    assert words_in(picture).count("1") == 3


def test_without_a_drop_the_key_names_none(words_in):
    assert "dropped" not in words_in(queue(queue_steps([0], [1], 1), 1))


@pytest.mark.parametrize(("count", "depth"), [(1, 1), (1, 10), (60, 3), (200, 100), (600, 7)])
def test_any_size_stays_readable(count, depth, is_tidy):
    arrivals = [k * SECOND // 10 for k in range(count)]
    assert is_tidy(queue(queue_steps(arrivals, arrivals[::3], depth), depth))


def test_too_much_is_cut_and_said(words_in):
    picture = queue(queue_steps(range(MOST_MOMENTS + 5), [], 2), 2)
    assert "5 later moments are not shown." in words_in(picture)
    assert picture.description.endswith("5 later moments are not shown.")


@pytest.mark.parametrize(
    ("steps", "depth", "words"),
    [((), 5, "no steps"), (queue_steps([0, 0], [], 2), 1, "does not fit"),
     ([1, 2], 10, "from its steps"), (5, 10, "from its steps"), ("ab", 10, "from its steps"),
     (queue_steps([0], [], 1), 0, "does not fit"), (queue_steps([0], [], 1), 2.5, "does not fit")],
)  # fmt: skip
def test_bad_input_gets_three_parts(steps, depth, words):
    with pytest.raises(PictureError, match=words) as caught:
        queue(steps, depth)
    assert caught.value.means
    assert caught.value.to_try


def test_a_drop_and_its_cause_are_one_column(words_in):
    picture = queue(queue_steps([0, 1, 2], [5], 2), 2)
    marks = {text.get_text(): text for text in picture.figure.axes[0].texts}
    below = [one for one in picture.figure.axes[0].texts if one.get_weight() == "bold"]
    assert [one.get_text() for one in below] == ["1", "2"]
    assert marks["3"].get_position()[0] == pytest.approx(below[1].get_position()[0])


def test_the_queue_in_words():
    assert queue(queue_steps([0] * 5, [SECOND], 3), 3).description == (
        "A queue of depth 3, from 0 s to 1 s: 5 messages arrived. 1 was taken: number 3. "
        "2 were dropped: numbers 1 and 2. 2 wait at the end: numbers 4 and 5. "
        "At its fullest the queue held 3 messages."
    )


def test_nothing_dropped_nothing_taken():
    said = queue(queue_steps([0], [], 3), 3).description
    assert "at 0 s: 1 message arrived. None was taken. None was dropped." in said


def test_a_message_that_comes_after_a_drop_drops_nothing():
    picture = queue(queue_steps([0, 1, 2, 4], [3], 2), 2)
    assert "1 was dropped: number 1." in picture.description
    assert marks(picture, "X") == 1 + 1
