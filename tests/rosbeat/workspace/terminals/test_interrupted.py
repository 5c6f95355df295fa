import pytest

from rosbeat.workspace.terminals.interrupted import told


def test_an_interrupt_shows_one_line():
    with pytest.raises(KeyboardInterrupt) as caught, told(lambda: "it goes on."):
        raise KeyboardInterrupt
    assert caught.value._render_traceback_() == ["KeyboardInterrupt: it goes on."]


def test_other_errors_pass_as_they_are():
    with pytest.raises(ValueError, match="no"), told(lambda: pytest.fail("asked")):
        raise ValueError("no")
