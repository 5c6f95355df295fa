import pytest

from rosbeat.workspace.terminals.marks import MORE, PROMPT, Mark, MarkScanner

TEXT = "one\n\x1b]7771;t.;P;3;/a b\x07two\x1b]7771;t.;M;;\x07"
PARTS = ["one\n", Mark(PROMPT, 3, "/a b"), "two", Mark(MORE, 0, "")]


def joined(parts):
    """Neighbouring texts as one."""
    found = []
    for part in parts:
        if isinstance(part, str) and found and isinstance(found[-1], str):
            found[-1] += part
        else:
            found.append(part)
    return found


def test_marks_are_taken_out():
    assert MarkScanner("t.").feed(TEXT) == PARTS


@pytest.mark.parametrize("size", range(1, 12))
def test_marks_are_found_wherever_the_reads_cut(size):
    scanner = MarkScanner("t.")
    pieces = [TEXT[at : at + size] for at in range(0, len(TEXT), size)]
    assert joined(part for piece in pieces for part in scanner.feed(piece)) == PARTS


def test_the_mark_of_another_terminal_is_text():
    other = "\x1b]7771;u.;P;0;/\x07"
    assert MarkScanner("t.").feed(other) == [other]


def test_a_mark_that_never_ends_is_let_go():
    scanner = MarkScanner("t.")
    assert scanner.feed("\x1b]7771;t.;P;0;/") == []
    assert joined(scanner.feed("x" * 9000)) == ["\x1b]7771;t.;P;0;/" + "x" * 9000]


def test_other_sequences_are_not_held_back():
    assert MarkScanner("t.").feed("a\x1b[31mb") == ["a\x1b[31mb"]
