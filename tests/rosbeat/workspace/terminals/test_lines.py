import pytest

from rosbeat.workspace.terminals.lines import LONGEST_LINE, LineBuilder, settle


@pytest.mark.parametrize(
    ("sent", "seen"),
    [
        ("plain", "plain"),
        ("a\tb", "a\tb"),
        ("end\r", "end"),
        ("end\r\r", "end"),
        ("10%\r50%\r100%", "100%"),
        ("long line\rshort", "shortline"),
        ("long line\r\x1b[Kshort", "short"),
        ("long line\r\x1b[0Kshort", "short"),
        ("\x1b[31mred\x1b[0m", "red"),
        ("\x1b]0;title\x07text", "text"),
        ("\x1b]0;title\x1b\\text", "text"),
        ("\x1b(Btext", "text"),
        ("abc\b\bX", "aXc"),
        ("bell\x07", "bell"),
        ("one\x1b[2K", ""),
        ("one\x1b[1Gtwo", "two"),
        ("21 °C ✓ 🤖", "21 °C ✓ 🤖"),
        ("cut off\x1b[", "cut off"),
    ],
)
def test_a_line_is_shown_by_its_last_state(sent, seen):
    assert settle(sent).startswith(seen)
    assert len(settle(sent)) <= len(seen) + 1


def test_lines_come_when_they_are_complete():
    builder = LineBuilder()
    assert builder.feed("a\r\nb") == ["a"]
    assert builder.partial == "b"
    assert builder.feed("c\r") == []
    assert builder.feed("\n\r\nd\r\ne") == ["bc", "", "d"]
    assert builder.finish() == "e"
    assert builder.partial == ""


@pytest.mark.parametrize("size", [1_000, 100_000, 1_000_000])
def test_a_line_without_end_is_cut_and_counted(size):
    builder = LineBuilder()
    for _ in range(1_000_000 // size):
        assert builder.feed("x" * size) == []
    (line,) = builder.feed("\n")
    assert line == "x" * LONGEST_LINE + f" ... {1_000_000 - LONGEST_LINE:,} more characters"
    assert builder.feed("next\n") == ["next"]


def test_a_progress_bar_is_kept_small():
    builder = LineBuilder()
    for number in range(20_000):
        builder.feed(f"\r{number} of many")
    assert builder.partial == "19999 of many"
    assert len(builder._partial) <= 3 * LONGEST_LINE
