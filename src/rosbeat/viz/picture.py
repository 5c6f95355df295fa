"""A picture: a figure together with the words that say what it shows.

**How the words reach a screen reader.** JupyterLab shows an `image/png` or `image/svg+xml` output
as an `<img>` without an `alt` attribute, whatever the output's metadata say (`renderImage` in
`@jupyterlab/rendermime`, seen in 4.6). A `text/html` output keeps `<img alt=...>` with the image
as a data URI, in documents that are not trusted as well, because JupyterLab's sanitizer allows
`figure`, and `img` with `alt` and `src`. It drops an `<svg>` element in HTML, so that a page which
nobody has run would show nothing. So a picture shows itself as HTML with an image in it, and its
plain-text form is the description, which is what terminals print and what nbval compares.

**How it follows the theme of the page.** The image is an SVG with two sets of colours; the media
feature `prefers-color-scheme` chooses one. Inside an image, browsers answer it with the property
`color-scheme` of the `<img>`. It is inherited, and JupyterLab sets it on the page's body by its
theme (seen in 4.6). Where no page sets it, the preference of the browser counts. The variables of
JupyterLab's CSS do not reach into an image. A program that knows no such rules shows the light
colours, which stand at each element.

**Why text is text.** Letters as outlines make an SVG five times as large. Every text is placed by
its beginning, its middle or its end, and measured in DejaVu Sans, which is wider than the fonts
that a browser takes in its place, so that it has room in each of them.
"""

from __future__ import annotations

import re
from base64 import b64encode
from collections.abc import Mapping
from dataclasses import dataclass
from html import escape
from io import BytesIO
from pathlib import Path

from matplotlib import style as mpl_style
from matplotlib.figure import Figure

from rosbeat.errors import PictureError
from rosbeat.viz import theme

_HTML = """<figure class="rosbeat-picture" style="margin: 0">
<img alt="{alt}" width="{width}" style="{style}"
src="data:image/svg+xml;base64,{data}">
</figure>"""
#: Nothing but the drawing; the words are beside it.
_BARE = dict.fromkeys(("Creator", "Date", "Format", "Type"))

# What is left out of matplotlib's SVG: what stands before it, names that nobody refers to, digits
# below a hundredth of a pixel (the last ones depend on the machine), and breaks in a path.
_HEAD = re.compile(r"\A.*?(?=<svg )|<metadata>.*</metadata>\s*", re.DOTALL)
_NAME = re.compile(r' id="[A-Za-z0-9.]+_\d+"')
_UNTURNED = re.compile(r' transform="rotate\(-?0 [^"]*\)"')
_ELEMENT = re.compile(r"<[^>]*>")
_DIGITS = re.compile(r"-?\d+\.\d{3,}")
_BREAKS = re.compile(r"\s*\n\s*")
_COLOUR = re.compile(r"#[0-9a-f]{6}\b")


@dataclass(frozen=True, repr=False)
class Picture:
    """Hold a figure and its text alternative; show it at the end of a cell.

    Attributes:
        figure: The matplotlib figure. It belongs to no pyplot state, so nothing shows it twice.
        description: What a sighted reader would see, in whole sentences.
        title: A few words for the metadata of saved files.
    """

    figure: Figure
    description: str
    title: str

    def __repr__(self) -> str:
        return self.description

    def svg(self, on_paper: bool = False) -> str:
        """Return the picture as SVG, named and described.

        Args:
            on_paper: Whether it has the colours for a light page alone, and does not follow the
                theme of the page.
        """
        words = {**_BARE, "Title": self.title}
        # The page may have changed matplotlib's settings; ours hold while we draw.
        with mpl_style.context(["default", theme.RC]), BytesIO() as target:
            ground = "white" if on_paper else theme.CARD
            self.figure.savefig(
                target, format="svg", dpi=theme.DPI, facecolor=ground, metadata=words
            )
            code = target.getvalue().decode("utf-8")
        code = _UNTURNED.sub("", _NAME.sub("", _HEAD.sub("", code)))
        code = _ELEMENT.sub(lambda found: _shorter(found[0]), _BREAKS.sub("\n", code))
        name = escape(self.description, quote=True)
        code = code.replace("<svg ", f'<svg role="img" aria-label="{name}" ', 1)
        return code.replace("<defs>", f"<style>{_style(code, on_paper)}</style><defs>", 1)

    def html(self) -> str:
        """Return an HTML figure that follows the theme; its image has the description as `alt`."""
        width = round(self.figure.get_figwidth() * theme.DPI)
        # Where there is even less room, the output scrolls.
        least = round(width * theme.NARROW / theme.WIDTH)
        style = f"max-width: 100%; min-width: {least}px; height: auto; border-radius: 8px"
        data = b64encode(self.svg().encode()).decode("ascii")
        alt = escape(self.description, quote=True)
        return _HTML.format(alt=alt, width=width, style=style, data=data)

    def save(self, path: str | Path) -> Path:
        """Write the picture to an SVG file.

        Args:
            path: File to write; its name ends in `.svg`.

        Returns:
            The path written.

        Raises:
            PictureError: If the name has another ending.
        """
        path = Path(path)
        if path.suffix != ".svg":
            raise PictureError(
                f"A picture cannot be saved as {path.name!r}.",
                "Pictures are saved as SVG, which is sharp at every size.",
                f"Save it as {path.stem + '.svg'!r}, or use matplotlib: "
                f"`picture.figure.savefig({path.name!r})`.",
            )
        path.write_text(self.svg(), encoding="utf-8", newline="\n")
        return path

    def _repr_mimebundle_(self, **_: object) -> Mapping[str, str]:
        return {"text/html": self.html(), "text/plain": self.description}


def _shorter(element: str) -> str:
    """Return an element of an SVG on one line, with hundredths of a pixel."""
    element = element.replace("\n", " ")
    return _DIGITS.sub(lambda found: f"{round(float(found[0]), 2) + 0.0:.7g}", element)


def _style(code: str, on_paper: bool) -> str:
    """Return the rules for an SVG: its font, and the dark counterpart of each of its colours."""
    font = f"text{{font-family:{theme.FONTS}!important}}"
    if on_paper:
        return font
    dark = {light.lower(): one.lower() for light, one in theme.DARK.items()}
    rules = (
        f'[style*="{part}: {one}"]{{{part}:{dark[one]}!important}}'
        for one in sorted(set(_COLOUR.findall(code)) & set(dark))
        for part in ("fill", "stroke")
        if f"{part}: {one}" in code
    )
    return f"{font}@media (prefers-color-scheme: dark){{{''.join(rules)}}}"
