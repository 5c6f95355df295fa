from rosbeat.records import queue_steps
from rosbeat.viz.queue_story import describe, moments


def test_a_drop_and_its_cause_are_one_moment():
    found = moments(queue_steps([0, 1, 2], [5], 2))
    assert [(one.arrived, one.dropped, one.taken) for one in found] == [
        (1, 0, 0),
        (2, 0, 0),
        (3, 1, 0),
        (0, 0, 2),
    ]
    assert [one.waiting for one in found] == [(1,), (1, 2), (2, 3), (3,)]


def test_the_queue_in_words():
    assert describe(moments(queue_steps([0] * 5, [10**9], 3)), 3) == (
        "A queue of depth 3, from 0 s to 1 s: 5 messages arrived. 1 was taken: number 3. "
        "2 were dropped: numbers 1 and 2. 2 wait at the end: numbers 4 and 5. "
        "At its fullest the queue held 3 messages."
    )


def test_nothing_dropped_nothing_taken():
    said = describe(moments(queue_steps([0], [], 3)), 3)
    assert "at 0 s: 1 message arrived. None was taken. None was dropped." in said
