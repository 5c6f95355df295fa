import os
import re
import subprocess
import sys
from base64 import b64decode
from dataclasses import FrozenInstanceError
from hashlib import sha256
from html.parser import HTMLParser
from io import BytesIO
from xml.etree import ElementTree

import matplotlib as mpl
import pytest
from PIL import Image

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


def test_its_plain_text_is_the_description(picture):
    bundle = picture._repr_mimebundle_()
    assert bundle["text/plain"] == repr(picture) == picture.description
    assert set(bundle) == {"text/html", "text/plain"}


def image_of(picture):
    """The attributes of the image in a page, and the SVG in it."""
    tags = Tags()
    tags.feed(picture.html())
    head, data = tags.found["img"]["src"].split(",")
    assert head == "data:image/svg+xml;base64"
    return tags.found["img"], b64decode(data).decode()


def test_the_image_in_the_page_has_the_description_as_alt(picture):
    image, code = image_of(picture)
    assert image["alt"] == picture.description
    assert image["width"] == str(theme.WIDTH)
    assert ElementTree.fromstring(code).tag.endswith("svg")


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


def test_the_image_stands_on_a_line_of_its_own(picture):
    lines = [line for line in picture.html().splitlines() if "base64" in line]
    assert len(lines) == 1
    assert lines[0].startswith('src="data:image/svg+xml;base64,')


def test_words_of_a_page_are_escaped(picture):
    odd = Picture(picture.figure, '<b>"a" & b</b>', "odd")
    tags = Tags()
    tags.feed(odd.html())
    assert "b" not in tags.found
    assert tags.found["img"]["alt"] == odd.description
    assert ElementTree.fromstring(odd.svg()).get("aria-label") == odd.description


def test_png_carries_title_and_description_and_no_date(picture):
    with Image.open(BytesIO(picture.png())) as image:
        assert image.text == {"Title": picture.title, "Description": picture.description}
        assert image.size[0] == theme.WIDTH * theme.DENSITY


def test_a_saved_card_is_light_and_opaque_to_the_corners(picture):
    with Image.open(BytesIO(picture.png())) as image:
        corner = image.convert("RGBA").getpixel((0, 0))
    wanted = tuple(int(theme.CARD[at : at + 2], 16) for at in (1, 3, 5))
    assert all(abs(a - b) <= 1 for a, b in zip(corner, wanted, strict=False))
    assert corner[3] == 255


def test_svg_is_an_image_with_name_title_and_description(picture):
    root = ElementTree.fromstring(picture.svg())
    assert root.get("role") == "img"
    assert root.get("aria-label") == picture.description
    assert root.find("{http://www.w3.org/2000/svg}title").text == picture.title
    assert picture.description in picture.svg()


def test_two_renders_are_equal_byte_for_byte(picture):
    other = draw()
    assert picture.png() == picture.png() == other.png()
    assert picture.svg() == other.svg()


def test_another_process_makes_the_same_bytes_without_pyplot(picture):
    code = (
        "import sys; from hashlib import sha256; from rosbeat.viz import queue\n"
        "from rosbeat.records import queue_steps\n"
        "p = queue(queue_steps([0] * 4, [1], 3), 3)\n"
        "print(sha256(p.png() + p.svg().encode()).hexdigest(), 'matplotlib.pyplot' in sys.modules)"
    )
    env = {**os.environ, "PYTHONHASHSEED": "99", "PYTHONPATH": os.pathsep.join(sys.path)}
    run = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True, env=env
    )
    own = sha256(picture.png() + picture.svg().encode()).hexdigest()
    assert run.stdout.split() == [own, "False"]


def test_settings_of_the_page_change_nothing(picture):
    with mpl.rc_context({"font.size": 30, "savefig.transparent": True, "axes.edgecolor": "red"}):
        assert draw().png() == picture.png()


@pytest.mark.parametrize(("name", "head"), [("a.png", b"\x89PNG"), ("a.svg", b"<?xml")])
def test_save(picture, tmp_path, name, head):
    path = picture.save(tmp_path / name)
    assert path.read_bytes().startswith(head)
    assert picture.save(str(path)) == path


def test_save_refuses_other_endings(picture, tmp_path):
    with pytest.raises(PictureError, match=r"Save it as 'a.png'"):
        picture.save(tmp_path / "a.pdf")


def test_a_picture_does_not_change(picture):
    with pytest.raises(FrozenInstanceError):
        picture.description = "other"


def test_a_kernel_sends_the_figure_and_the_words_and_nothing_else(picture):
    formatters = pytest.importorskip("IPython.core.formatters")
    data, metadata = formatters.DisplayFormatter().format(picture)
    assert data == {"text/html": picture.html(), "text/plain": picture.description}
    assert metadata == {}
