"""The panel where nobody can use it."""

from types import SimpleNamespace

from rosbeat.panel import still as stills
from rosbeat.panel.still import is_for_a_browser, still, with_view
from rosbeat.records import GraphSnapshot


def test_the_same_nodes_give_the_same_picture(made_up):
    assert still(made_up.graph()) == still(made_up.graph())
    text = still(made_up.graph())["text/plain"]
    assert text.startswith("The instrument panel of this session. 2 nodes and 1 topic.")


def test_without_nodes_there_are_words():
    assert "no nodes yet" in still(GraphSnapshot())["text/plain"]


def test_a_view_stands_in_front_of_the_picture(made_up):
    bundle = still(made_up.graph())
    first, *rest = with_view(bundle, "id")
    assert first == "application/vnd.jupyter.widget-view+json"
    assert rest == list(bundle)


def test_a_browser_is_expected_only_behind_a_kernel(monkeypatch):
    monkeypatch.delenv("ROSBEAT_STEADY_HOME", raising=False)
    assert not is_for_a_browser()
    shell = SimpleNamespace()
    monkeypatch.setattr(stills, "get_ipython", lambda: shell)
    assert not is_for_a_browser()
    shell.kernel = object()
    assert is_for_a_browser()
    monkeypatch.setenv("ROSBEAT_STEADY_HOME", "/somewhere")
    assert not is_for_a_browser()
