"""The panel itself: frames on time, and an end without remains."""

import threading

import comm
import pytest
from ipywidgets.widgets.widget import _instances

from rosbeat.panel import panel as panels
from rosbeat.panel.panel import Panel


@pytest.fixture
def in_a_browser(monkeypatch):
    """As in a kernel that has a browser."""
    monkeypatch.setattr(panels, "is_for_a_browser", lambda: True)
    shown = []
    monkeypatch.setattr(panels, "display", lambda data, **about: shown.append((data, about)))
    monkeypatch.setattr(panels, "update_display", lambda data, **about: shown.append((data, about)))
    return shown


@pytest.fixture
def panel(in_a_browser, made_up):
    made = Panel(made_up)
    yield made
    made.close()


@pytest.fixture
def frames(panel):
    """What is sent; the browser answers nothing by itself."""
    sent = []
    panel._widget.send = sent.append
    return sent


def threads():
    return [one for one in threading.enumerate() if one.name == "rosbeat panel"]


def test_nothing_is_sent_until_a_browser_opens_it(panel, frames, made_up, eventually):
    looks = []
    made_up.conditions = lambda: looks.append(1) or {}
    eventually(lambda: len(looks) > 3)
    assert frames == []
    panel._heard({"do": "open"})
    eventually(lambda: frames)
    assert frames[0]["whole"]
    assert frames[0]["number"] == 1


def test_frames_are_numbered_and_stop_when_nobody_answers(panel, frames, eventually):
    panel._heard({"do": "open"})
    eventually(lambda: len(frames) >= 6)
    panel._heard({"got": 6})
    eventually(lambda: len(frames) >= 8)
    assert [frame["number"] for frame in frames] == list(range(1, len(frames) + 1))
    assert [frame["whole"] for frame in frames] == [True] + [False] * (len(frames) - 1)


def test_a_second_view_gets_everything(panel, frames, eventually):
    panel._heard({"do": "open"})
    eventually(lambda: len(frames) >= 2)
    before = len(frames)
    panel._heard({"do": "open"})
    eventually(lambda: any(frame["whole"] for frame in frames[before:]))


def test_a_click_reaches_the_session_and_a_refusal_the_browser(panel, frames, made_up, eventually):
    panel._heard({"do": "open"})
    panel._heard({"do": "pause", "node": "/sensor"})
    assert made_up.asked == [("pause", "/sensor")]
    panel._heard({"do": "nonsense"})
    eventually(lambda: any("does not understand" in frame.get("note", "") for frame in frames))


def test_at_the_end_of_a_cell_it_shows_a_view_with_a_picture_behind(panel, in_a_browser):
    panel._ipython_display_()
    ((data, about),) = in_a_browser
    view = data["application/vnd.jupyter.widget-view+json"]
    assert view["model_id"] == panel._widget.model_id
    assert "/sensor" in data["text/plain"]
    assert data["text/html"].startswith("<figure")
    panel.close()
    assert in_a_browser[1] == ({k: data[k] for k in ("text/html", "text/plain")}, about)


def test_without_a_browser_it_is_a_picture_and_no_thread(made_up, monkeypatch):
    shown = []
    monkeypatch.setattr(panels, "display", lambda data, **about: shown.append(data))
    for _ in range(2):
        made = Panel(made_up)
        made._ipython_display_()
        made.close()
    assert threads() == []
    assert shown[0] == shown[1]
    assert set(shown[0]) == {"text/html", "text/plain"}


def test_closing_leaves_nothing_behind(in_a_browser, made_up):
    before = len(comm.get_comm_manager().comms), len(_instances)
    made = [Panel(made_up) for _ in range(3)]
    assert len(threads()) == 3
    for one in made:
        one.close()
        one.close()
        assert repr(one) == "Panel(closed)"
    assert threads() == []
    assert (len(comm.get_comm_manager().comms), len(_instances)) == before
    assert made_up.asked == [("release",)] * 3


def test_looks_are_twenty_a_second_and_those_that_were_missed_are_not_made_up_for():
    assert panels.next_look(10.0, now=10.01) == pytest.approx(10.05)
    assert panels.next_look(10.0, now=13.0) == 13.0
