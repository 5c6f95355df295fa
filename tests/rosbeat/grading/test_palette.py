"""What is written can be read, in both themes and whatever colours somebody sees."""

import pytest

from rosbeat.exercises.exercise import FAILED, NOT_ATTEMPTED, PASSED
from rosbeat.grading.marks import HELD, LOOKED_AT, MISSING
from rosbeat.grading.palette import DARK, LIGHT, STATUSES, look_of, variables


def luminance(colour):
    """Relative luminance of a colour (WCAG 2.2)."""
    parts = [int(colour[at : at + 2], 16) / 255 for at in (1, 3, 5)]
    linear = [one / 12.92 if one <= 0.04045 else ((one + 0.055) / 1.055) ** 2.4 for one in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(one, other):
    low, high = sorted((luminance(one), luminance(other)))
    return (high + 0.05) / (low + 0.05)


def test_the_measure_is_right():
    assert contrast("#000000", "#ffffff") == pytest.approx(21)
    assert contrast("#777777", "#ffffff") == pytest.approx(4.48, abs=0.01)


@pytest.mark.parametrize("theme", [LIGHT, DARK], ids=["light", "dark"])
@pytest.mark.parametrize("text", ["ink", "muted", "link"])
@pytest.mark.parametrize("ground", ["page", "card"])
def test_text_can_be_read(theme, text, ground):
    assert contrast(theme[text], theme[ground]) >= 4.5


@pytest.mark.parametrize("theme", [LIGHT, DARK], ids=["light", "dark"])
@pytest.mark.parametrize("kind", [look.kind for look in STATUSES.values()])
def test_numbers_on_bars_can_be_read(theme, kind):
    assert contrast(theme[f"on-{kind}"], theme[kind]) >= 4.5


@pytest.mark.parametrize("theme", [LIGHT, DARK], ids=["light", "dark"])
@pytest.mark.parametrize("kind", ["passed", "failed", "open", "held", "seen"])
def test_edges_can_be_seen(theme, kind):
    assert contrast(theme[kind], theme["card"]) >= 3


def test_every_status_has_a_look_of_its_own():
    assert set(STATUSES) == {PASSED, FAILED, NOT_ATTEMPTED, MISSING, HELD, LOOKED_AT}
    for part in ("sign", "word", "of_class", "kind"):
        assert len({getattr(look, part) for look in STATUSES.values()}) == len(STATUSES)


def test_a_status_that_nobody_knows_is_shown_by_its_name():
    assert look_of("strange").word == "strange"


def test_both_themes_have_the_same_colours():
    assert set(LIGHT) == set(DARK)
    assert variables({"ink": "#123456"}) == "--ink: #123456;"
