"""Every test has terminals of its own, in a folder of its own."""

import pytest

from rosbeat.workspace.terminals import Terminals


@pytest.fixture
def home(tmp_path, monkeypatch):
    """A steady home: what terminals show names nobody and no machine."""
    folder = tmp_path / "home"
    folder.mkdir()
    monkeypatch.setenv("ROSBEAT_STEADY_HOME", str(folder))
    return folder


@pytest.fixture
def terminals(home):
    with Terminals() as opened:
        yield opened


@pytest.fixture
def terminal(terminals):
    return terminals.get("sensor")


@pytest.fixture
def seen(terminal):
    """Type into the terminal and return the lines that were shown."""

    def type_and_see(text, **options):
        shown = []
        terminal.type(text, show=shown.append, **options)
        return shown

    return type_and_see
