"""A `Picture` on a page, in a file and for a screen reader; and what `rosbeat.viz` offers."""

import os
import re
import subprocess
import sys
from base64 import b64decode
from hashlib import sha256
from html.parser import HTMLParser
from xml.etree import ElementTree

import matplotlib as mpl
import pytest
from IPython.core.formatters import DisplayFormatter

from rosbeat import viz
from rosbeat.errors import PictureError
from rosbeat.records import queue_steps
from rosbeat.viz import Picture, theme
from rosbeat.viz.queues import of_steps


def draw():
    return of_steps(queue_steps([0] * 4, [1], 3), 3)


@pytest.fixture(scope="module")
def picture():
    return draw()


class Tags(HTMLParser):
    def __init__(self):
        super().__init__()
        self.found = {}

    def handle_starttag(self, tag, attrs):
        self.found[tag] = dict(attrs)


def image_of(picture):
    """The attributes of the image in a page, and the SVG in it."""
    tags = Tags()
    tags.feed(picture.html())
    head, data = tags.found["img"]["src"].split(",")
    assert head == "data:image/svg+xml;base64"
    return tags.found["img"], b64decode(data).decode()


def test_a_kernel_sends_the_figure_and_the_words_and_nothing_else(picture):
    data, metadata = DisplayFormatter().format(picture)
    assert data == {"text/html": picture.html(), "text/plain": picture.description}
    assert metadata == {}
    assert repr(picture) == picture.description


def test_the_image_in_the_page_has_the_description_as_alt(picture):
    image, code = image_of(picture)
    assert image["alt"] == picture.description
    assert image["width"] == str(theme.WIDTH)
    assert ElementTree.fromstring(code).tag.endswith("svg")
    (line,) = [line for line in picture.html().splitlines() if "base64" in line]
    assert line.startswith('src="data:image/svg+xml;base64,')  # a line of its own


def test_every_colour_in_the_page_has_one_in_its_place_on_a_dark_page(picture):
    _, code = image_of(picture)
    rules, drawing = code.split("</style>", 1)
    _, dark = rules.split("@media (prefers-color-scheme: dark)")
    used = set(re.findall(r"((?:fill|stroke): #[0-9a-f]{6})", drawing))
    given = dict(re.findall(r'\[style\*="([^"]*)"\]{(.*?)!important}', dark))
    assert given.keys() == used
    assert set(re.findall("#[0-9a-f]{6}", drawing)) == {one[-7:] for one in used}
    assert given[f"fill: {theme.CARD.lower()}"] == f"fill:{theme.DARK[theme.CARD].lower()}"


def test_text_is_text_in_the_fonts_of_the_page(picture):
    root = ElementTree.fromstring(picture.svg())
    found = {one.text for one in root.iter("{http://www.w3.org/2000/svg}text")}
    assert found >= {"waits", "depth 3", "taken by the callback", "dropped"}
    assert "text{font-family:system-ui," in picture.svg()
    assert len(picture.svg()) < 10_000


def test_no_number_is_finer_than_a_hundredth_of_a_pixel(picture):
    tags = " ".join(re.findall("<[^>]*>", picture.svg().split("</style>", 1)[1]))
    assert not re.search(r"\d\.\d{3}", tags)
    assert "0.000000001 s" in picture.svg()  # what is written keeps its digits


def test_words_are_escaped_in_the_page_and_in_the_image(picture):
    odd = Picture(picture.figure, '<b>"a" & b</b>', "odd")
    tags = Tags()
    tags.feed(odd.html())
    assert "b" not in tags.found
    assert tags.found["img"]["alt"] == odd.description
    root = ElementTree.fromstring(odd.svg())
    assert (root.get("role"), root.get("aria-label")) == ("img", odd.description)
    assert root.find("{http://www.w3.org/2000/svg}title").text == odd.title


def test_two_renders_are_equal_byte_for_byte_whatever_the_page_sets(picture):
    given = {"font.size": 33, "savefig.transparent": True, "axes.edgecolor": "red"}
    with mpl.rc_context(given):
        other = draw()
        assert mpl.rcParams["font.size"] == 33
    assert picture.svg() == picture.svg() == other.svg()


def printed(code, **variables):
    env = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path), **variables}
    run = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True, env=env
    )
    return run.stdout.split()


def test_another_process_makes_the_same_bytes_and_loads_what_it_needs(picture):
    code = (
        "import sys, rosbeat.viz as viz; from hashlib import sha256\n"
        "names = ('matplotlib', 'rclpy', 'matplotlib.pyplot')\n"
        "print(*(name in sys.modules for name in names))\n"
        "from rosbeat.records import queue_steps\n"
        "from rosbeat.viz.queues import of_steps\n"
        "p = of_steps(queue_steps([0] * 4, [1], 3), 3)\n"
        "print(sha256(p.svg().encode()).hexdigest())\n"
        "print(*(name in sys.modules for name in names))\n"
    )
    own = sha256(picture.svg().encode()).hexdigest()
    assert printed(code, PYTHONHASHSEED="99") == [
        *["False"] * 3, own, "True", "False", "False"
    ]  # fmt: skip


def test_save(picture, tmp_path):
    path = picture.save(tmp_path / "a.svg")
    assert path.read_text(encoding="utf-8") == picture.svg()
    assert picture.save(str(path)) == path
    with pytest.raises(PictureError, match=r"Save it as 'a.svg', or use matplotlib"):
        picture.save(tmp_path / "a.png")


def test_what_the_package_offers():
    assert dir(viz) == viz.__all__ == sorted(viz.__all__)
    assert all(callable(getattr(viz, name)) for name in viz.__all__)
    with pytest.raises(AttributeError, match="no attribute 'pie'"):
        _ = viz.pie


@pytest.mark.parametrize(
    ("old", "now"), [("crossing", "message_flow"), ("differences", "comparison")]
)
def test_an_old_name_still_works_and_says_the_new_one(old, now):
    with pytest.warns(DeprecationWarning, match=f"it is called `viz.{now}` now"):
        assert getattr(viz, old) is getattr(viz, now)
