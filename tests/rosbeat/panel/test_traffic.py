"""When a frame may be sent."""

from rosbeat.panel.traffic import LONGEST_WAIT, WINDOW, Traffic


def sent_within(traffic, begin, seconds):
    """Frames that go out when somebody wants to send twenty a second."""
    times = [begin + k / 20 for k in range(round(20 * seconds))]
    return [traffic.sent(now) for now in times if traffic.may_send(now)]


def test_nothing_is_sent_before_a_browser_asks():
    traffic = Traffic()
    assert sent_within(traffic, 0, 10) == []
    traffic.ask()
    assert traffic.asked
    assert traffic.may_send(10)


def test_a_browser_that_answers_gets_every_frame():
    traffic = Traffic()
    traffic.ask()
    for k in range(200):
        assert traffic.may_send(k / 20)
        number = traffic.sent(k / 20)
        assert number == k + 1
        if number % 3 == 0:
            traffic.heard(number)
    assert not traffic.asked


def test_a_browser_that_sleeps_for_an_hour_gets_hardly_any():
    traffic = Traffic()
    traffic.ask()
    assert WINDOW + 5 < len(sent_within(traffic, 0, 3600)) < 3600 / LONGEST_WAIT + 20


def test_when_it_wakes_up_all_is_as_before():
    traffic = Traffic()
    traffic.ask()
    last = sent_within(traffic, 0, 600)[-1]
    traffic.heard(last)
    assert len(sent_within(traffic, 600, 0.3)) == WINDOW
    assert not traffic.may_send(600.4)
    assert traffic.may_send(601)


def test_a_new_view_begins_anew_although_the_old_one_never_answered():
    traffic = Traffic()
    traffic.ask()
    sent_within(traffic, 0, 100)
    traffic.ask()
    assert traffic.asked
    assert len(sent_within(traffic, 100, 0.3)) == WINDOW


def test_answers_from_elsewhere_change_nothing():
    traffic = Traffic()
    traffic.ask()
    sent_within(traffic, 0, 0.4)
    for number in (-3, 99):
        traffic.heard(number)
    assert not traffic.may_send(0.5)
