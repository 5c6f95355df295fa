"""The colours can be read and told apart, by people who see colour differently as well."""

from itertools import combinations

import numpy as np
import pytest

from rosbeat.viz import theme

# Machado, Oliveira and Fernandes, "A Physiologically-based Model for Simulation of Color Vision
# Deficiency", IEEE Transactions on Visualization and Computer Graphics 15(6), 2009: severity 1.0,
# for linear RGB.
# fmt: off
VISION = {
    "full": np.eye(3),
    "protanopia": np.array([[0.152286, 1.052583, -0.204868],
                            [0.114503, 0.786281, 0.099216],
                            [-0.003882, -0.048116, 1.051998]]),
    "deuteranopia": np.array([[0.367322, 0.860646, -0.227968],
                              [0.280085, 0.672501, 0.047413],
                              [-0.011820, 0.042940, 0.968881]]),
    "tritanopia": np.array([[1.255528, -0.076749, -0.178779],
                            [-0.078411, 0.930809, 0.147602],
                            [0.004733, 0.691367, 0.303900]]),
}
# IEC 61966-2-1 (sRGB), D65.
TO_XYZ = np.array([[0.4124564, 0.3575761, 0.1804375],
                   [0.2126729, 0.7151522, 0.0721750],
                   [0.0193339, 0.1191920, 0.9503041]])
# fmt: on
WHITE = np.array([0.95047, 1.0, 1.08883])

TEXT_ON = {
    theme.INK: (theme.CARD, theme.NODE_FILL, theme.NODE_FILL_STRONG, theme.TOPIC_FILL,
                theme.TOPIC_FILL_STRONG, theme.FRAME_FILL),
    theme.MUTED: (theme.CARD, theme.TOPIC_FILL, theme.TOPIC_FILL_STRONG, theme.FRAME_FILL),
    theme.ALERT_TEXT: (theme.CARD, theme.TOPIC_FILL, theme.TOPIC_FILL_STRONG),
    theme.TAKEN_TEXT: (theme.CARD,),
}  # fmt: skip

TOGETHER = {
    "series": [look.colour for look in theme.STYLES],
    "callbacks": [theme.BLUE, theme.TAKEN, theme.PURPLE, theme.ALERT],
    "queue": [theme.BLUE, theme.TAKEN, theme.ALERT, theme.INK],
    "arrows": [theme.INK, theme.ALERT],
    "shapes": [theme.BLUE, theme.TOPIC_EDGE],
    "bands": list(theme.BANDS[:3]),
    "bars": [theme.SLEEP.fill, theme.WAIT.fill],
}

# CIE76 distances; 2.3 is just noticeable (Mahy et al., 1994). Bands have names and dashed limits.
LEAST = {"bands": 4.0}

#: On a light page a colour is itself.
PALETTES = {"light": {colour: colour for colour in theme.DARK}, "dark": theme.DARK}


@pytest.fixture(params=PALETTES)
def palette(request):
    return PALETTES[request.param]


def linear(colour):
    part = np.array([int(colour[at : at + 2], 16) for at in (1, 3, 5)]) / 255
    return np.where(part <= 0.04045, part / 12.92, ((part + 0.055) / 1.055) ** 2.4)


def contrast(one, other):
    """WCAG 2.2, "contrast ratio"."""
    low, high = sorted(linear(colour) @ [0.2126, 0.7152, 0.0722] for colour in (one, other))
    return (high + 0.05) / (low + 0.05)


def lab(rgb):
    part = TO_XYZ @ np.clip(rgb, 0, 1) / WHITE
    x, y, z = np.where(part > 0.008856, np.cbrt(part), 7.787 * part + 16 / 116)
    return np.array([116 * y - 16, 500 * (x - y), 200 * (y - z)])


def distance(one, other, vision):
    return float(np.linalg.norm(lab(vision @ linear(one)) - lab(vision @ linear(other))))


def test_the_measures_agree_with_known_values():
    assert contrast("#000000", "#FFFFFF") == pytest.approx(21)
    assert distance("#000000", "#FFFFFF", VISION["full"]) == pytest.approx(100, abs=0.01)
    # The classic pair: what full vision tells apart, a deuteranope hardly does.
    olive, brown = "#7A7A00", "#A05A00"
    assert distance(olive, brown, VISION["deuteranopia"]) < distance(olive, brown, VISION["full"])


def test_every_colour_has_a_counterpart_on_a_dark_page():
    values = {name: value for name, value in vars(theme).items() if name.isupper()}
    colours = {one for one in values.values() if isinstance(one, str) and one.startswith("#")}
    assert colours | set(theme.BANDS) == set(theme.DARK)


GROUNDS = (theme.CARD, theme.FRAME_FILL)
BARS = (theme.BLUE, theme.TAKEN, theme.PURPLE, theme.BAR_EDGE)
LEAST_CONTRAST = {
    "text": (4.5, [(text, ground) for text, grounds in TEXT_ON.items() for ground in grounds]),
    "outlines": (3, [(line, ground) for ground in GROUNDS for line in
                     (theme.FRAME, theme.BLUE, theme.TOPIC_EDGE, theme.ALERT)]),
    "lines": (3, [(look.colour, ground) for look in theme.STYLES
                  for ground in (*GROUNDS, *theme.BANDS)]),
    "names on bars": (7, [(theme.INK, look.fill) for look in (theme.SLEEP, theme.WAIT)]),
    "marks on bars": (3, [(mark, look.fill) for mark in BARS
                          for look in (theme.SLEEP, theme.WAIT)]),
    "ink": (7, [(theme.INK, theme.CARD)]),
}  # fmt: skip


@pytest.mark.parametrize("case", LEAST_CONTRAST)
def test_contrast(palette, case):
    least, pairs = LEAST_CONTRAST[case]
    found = {pair: contrast(*(palette[colour] for colour in pair)) for pair in pairs}
    assert min(found.values()) >= least, found


def test_the_card_is_soft_and_belongs_to_its_page():
    assert contrast(theme.CARD, "#FFFFFF") < 1.1
    assert contrast(theme.DARK[theme.CARD], "#111111") < 1.2


@pytest.mark.parametrize("vision", VISION)
@pytest.mark.parametrize("group", TOGETHER)
def test_colours_used_together_can_be_told_apart(palette, group, vision):
    pairs = combinations([palette[colour] for colour in TOGETHER[group]], 2)
    near = {pair: distance(*pair, VISION[vision]) for pair in pairs}
    assert min(near.values()) >= LEAST.get(group, 12.0), near


def test_nothing_differs_in_colour_alone():
    assert len({look.marker for look in theme.STYLES}) == len(theme.STYLES)
    assert len({look.dash for look in theme.STYLES}) == len(theme.STYLES)
    assert theme.style(len(theme.STYLES)) == theme.style(0)
    assert theme.SLEEP.hatch != theme.WAIT.hatch


def test_a_picture_fits_the_page():
    assert theme.WIDTH <= 800
    assert theme.TEXT * theme.DPI / 72 * theme.NARROW / theme.WIDTH >= 11
