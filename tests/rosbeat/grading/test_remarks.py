"""Names of strangers' files, made safe to print."""

import pytest

from rosbeat.grading.remarks import printable


@pytest.mark.parametrize(
    ("name", "shown"),
    [
        ("Ana Müller 03.ipynb", "Ana Müller 03.ipynb"),
        ("a\x1b[31mred", "a\\u001b[31mred"),
        ("a\nb\r\tc", "a\\u000ab\\u000d\\u0009c"),
        ("abc\u202egnp.exe", "abc\\u202egnp.exe"),
        ("zero\u200bwidth", "zero\\u200bwidth"),
        ("lone\ud800", "lone\\ud800"),
        ("日本語", "日本語"),
    ],
)
def test_no_character_of_a_name_changes_the_terminal(name, shown):
    assert printable(name) == shown


def test_a_long_name_is_cut():
    assert len(printable("x" * 10_000)) == 120
    assert printable("x" * 121) == "x" * 117 + "..."
    assert printable("x" * 120) == "x" * 120
    assert printable("\x1b" * 10_000, 12) == "\\u001b\\u0..."
    assert printable("x" * 10_000, 10_000) == "x" * 10_000
