"""Diagrams of the course: each is whole, tidy, told in words, and on its page."""

import re
from itertools import combinations
from pathlib import Path

import pytest

from pictures import heads, is_tidy, words_in
from rosbeat.errors import PictureError
from rosbeat.viz import diagram, theme
from rosbeat.viz.diagrams import DIAGRAMS, one_line

LESSONS = sorted((Path(__file__).parents[3] / "src" / "lessons").glob("[0-9]*.py"))


@pytest.fixture(params=DIAGRAMS)
def name(request):
    return request.param


def outlines(picture):
    """Where the boxes are: left, lower, right and upper edge of each."""
    patches = [one for one in picture.figure.axes[0].patches if one.get_zorder() == 3]
    return [one.get_window_extent().extents for one in patches]


def test_it_is_drawn_whole_and_nothing_overlaps(name):
    shown, picture = DIAGRAMS[name], diagram(name)
    assert is_tidy(picture)
    written = " ".join(words_in(picture))
    for words in (shown.heading, *(one.words for one in (*shown.arrows, *shown.frames))):
        assert words in written
    for box in shown.boxes:
        assert set(box.name.split("\n")) <= set(words_in(picture))
    assert len(heads(picture)) == len(shown.arrows)
    for one, other in combinations(outlines(picture), 2):
        apart = one[2] <= other[0] or other[2] <= one[0] or one[3] <= other[1] or other[3] <= one[1]
        assert apart
    assert picture.figure.get_figwidth() * theme.DPI <= theme.WIDTH


def test_its_words_tell_of_every_box_and_frame(name):
    said = diagram(name).description
    shown = DIAGRAMS[name]
    assert said.startswith(f"{shown.heading}. ")
    for box in (one for one in shown.boxes if one.kind != "text"):
        for word in re.findall(r"\w[\w./:-]*", one_line(box.name)):
            assert word.lower() in said.lower()
    for frame in shown.frames:
        for word in re.findall(r"\w+", frame.words):
            assert word in said
    assert ("Highlighted: " in said) == bool(shown.bright)


def test_what_is_highlighted_is_so_in_weight_and_width():
    picture = diagram("03")
    bold = {text.get_text() for text in picture.figure.axes[0].texts if text.get_weight() == "bold"}
    assert {"sensor", "publisher.py", "/temperature"} <= bold
    assert not {"monitor", "subscriber.py", "package sensor_simulator"} & bold
    widths = {one.get_linewidth() for one in picture.figure.axes[0].patches}
    assert max(widths) >= 2 * min(width for width in widths if width)


@pytest.mark.parametrize("path", LESSONS, ids=lambda path: path.stem)
def test_each_page_opens_with_its_diagram(path):
    drawn = re.findall(r"(?m)^(viz\.\w+\(.*)", path.read_text("utf-8"))
    assert drawn[0] == f'viz.diagram("{path.name[:2]}")'


def test_no_diagram_is_made_for_nobody():
    text = "".join(path.read_text("utf-8") for path in LESSONS)
    assert set(re.findall(r'viz\.diagram\("(.*?)"\)', text)) == set(DIAGRAMS)


@pytest.mark.parametrize(
    ("wrong", "part"),
    [("overlays", "Did you mean 'overlay'?"), ("robot", 'viz.diagram("03")'), (3, "entry point"),
     (None, "There is no diagram None."), ([], "There is no diagram []")],
)  # fmt: skip
def test_an_unknown_diagram_is_refused_with_the_names_of_all(wrong, part):
    with pytest.raises(PictureError) as caught:
        diagram(wrong)
    assert part in str(caught.value)
