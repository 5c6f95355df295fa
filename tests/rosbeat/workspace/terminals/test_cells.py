import pytest

from rosbeat.errors import TerminalError
from rosbeat.workspace.terminals.cells import line_with_blank, lines_of


def test_blank_lines_at_the_end_are_not_typed():
    assert lines_of("\necho a\r\n  echo\tb\n \n\n") == ["", "echo a", "  echo\tb"]


@pytest.mark.parametrize("key", ["\x03", "\x1b", "\r"])
def test_keys_are_refused(key, says):
    with pytest.raises(TerminalError) as caught:
        lines_of(f"echo {key} a")
    says(caught.value, "control character")


def test_a_blank_is_found_with_its_line_in_the_cell():
    assert line_with_blank(["mkdir a", "cd ____"]) == 3
    assert line_with_blank(["echo a____b"]) == 0
