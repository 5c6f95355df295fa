from rosbeat.workspace.terminals.history import KEPT_CHARACTERS, KEPT_LINES, History


def test_lines_are_numbered_and_found_by_number():
    history = History()
    for number in range(5):
        history.add(str(number), 100 + number, typed=number == 0)
    assert [line.text for line in history.since(3)] == ["3", "4"]
    assert history.since(0)[0].typed
    assert history.since(4)[0].time_ns == 104
    assert history.since(5) == []
    assert history.end == 5


def test_old_lines_are_forgotten_and_counted():
    history = History()
    for number in range(5 * KEPT_LINES):
        history.add(str(number), 0)
    gone, first, *_, last = history.text().splitlines()
    assert gone == f"... {4 * KEPT_LINES:,} earlier lines are not kept ..."
    assert (first, last) == (str(4 * KEPT_LINES), str(5 * KEPT_LINES - 1))
    assert len(history.since(0)) <= 2 * KEPT_LINES
    assert history.since(history.end - 1)[0].text == last


def test_long_lines_are_forgotten_sooner():
    history = History()
    for _ in range(1000):
        history.add("x" * 20_000, 0)
    assert sum(len(line.text) for line in history.since(0)) <= 2 * KEPT_CHARACTERS
    assert len(history.text()) < KEPT_CHARACTERS + 1000
    assert history.end == 1000


def test_an_empty_history_has_no_text():
    assert History().text() == ""
