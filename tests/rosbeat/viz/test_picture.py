"""A `Picture` on a page, in a file and for a screen reader; and what `rosbeat.viz` offers."""

import os
import re
import subprocess
import sys
from base64 import b64decode
from hashlib import sha256
from html.parser import HTMLParser
from io import BytesIO
from xml.etree import ElementTree

import matplotlib as mpl
import pytest
from IPython.core.formatters import DisplayFormatter
from PIL import Image

from rosbeat import viz
from rosbeat.errors import PictureError
from rosbeat.records import queue_steps
from rosbeat.viz import Picture, queue, theme


def draw():
    return queue(queue_steps([0] * 4, [1], 3), 3)


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


def test_every_colour_in_the_page_has_a_value_for_light_and_for_dark(picture):
    _, code = image_of(picture)
    rules, drawing = code.split("</style>", 1)
    light, dark = rules.split("@media (prefers-color-scheme: dark)")
    used = set(re.findall(r"var\((--[0-9a-f]{6})\)", drawing))
    assert not re.search(r"[ :\"]#[0-9a-f]{6}", drawing)
    for part in (light, dark):
        assert dict(re.findall(r"(--\w+):(#\w+);", part)).keys() == used
    assert f"--fafaf7:{theme.CARD.lower()}" in light
    assert f"--fafaf7:{theme.DARK[theme.CARD].lower()}" in dark


def test_words_of_a_page_are_escaped(picture):
    odd = Picture(picture.figure, '<b>"a" & b</b>', "odd")
    tags = Tags()
    tags.feed(odd.html())
    assert "b" not in tags.found
    assert tags.found["img"]["alt"] == odd.description
    assert ElementTree.fromstring(odd.svg()).get("aria-label") == odd.description


def test_png_carries_title_and_description_and_is_light_to_the_corners(picture):
    with Image.open(BytesIO(picture.png())) as image:
        assert image.text == {"Title": picture.title, "Description": picture.description}
        assert image.size[0] == theme.WIDTH * theme.DENSITY
        corner = image.convert("RGBA").getpixel((0, 0))
    wanted = tuple(int(theme.CARD[at : at + 2], 16) for at in (1, 3, 5))
    assert all(abs(a - b) <= 1 for a, b in zip(corner, wanted, strict=False))
    assert corner[3] == 255


def test_svg_is_an_image_with_name_title_and_description(picture):
    root = ElementTree.fromstring(picture.svg())
    assert (root.get("role"), root.get("aria-label")) == ("img", picture.description)
    assert root.find("{http://www.w3.org/2000/svg}title").text == picture.title
    assert picture.description in picture.svg()


def test_two_renders_are_equal_byte_for_byte_whatever_the_page_sets(picture):
    given = {"font.size": 33, "savefig.transparent": True, "axes.edgecolor": "red"}
    with mpl.rc_context(given):
        other = draw()
        assert mpl.rcParams["font.size"] == 33
    assert picture.png() == picture.png() == other.png()
    assert picture.svg() == other.svg()


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
        "p = viz.queue(queue_steps([0] * 4, [1], 3), 3)\n"
        "print(sha256(p.png() + p.svg().encode()).hexdigest())\n"
        "print(*(name in sys.modules for name in names))\n"
    )
    own = sha256(picture.png() + picture.svg().encode()).hexdigest()
    assert printed(code, PYTHONHASHSEED="99") == [
        *["False"] * 3, own, "True", "False", "False"
    ]  # fmt: skip


@pytest.mark.parametrize(("name", "head"), [("a.png", b"\x89PNG"), ("a.svg", b"<?xml")])
def test_save(picture, tmp_path, name, head):
    path = picture.save(tmp_path / name)
    assert path.read_bytes().startswith(head)
    assert picture.save(str(path)) == path
    with pytest.raises(PictureError, match=r"Save it as 'a.png'"):
        picture.save(tmp_path / "a.pdf")


def test_what_the_package_offers():
    assert dir(viz) == viz.__all__ == sorted(viz.__all__)
    assert all(callable(getattr(viz, name)) for name in viz.__all__)
    with pytest.raises(AttributeError, match="no attribute 'pie'"):
        _ = viz.pie
