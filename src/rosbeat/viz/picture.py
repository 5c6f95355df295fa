"""A picture: a figure together with the words that say what it shows.

**How the words reach a screen reader.** JupyterLab shows an `image/png` output as an `<img>`
without an `alt` attribute, whatever the output's metadata say (`renderImage` in
`@jupyterlab/rendermime`, seen in 4.6). A `text/html` output keeps `<img alt=...>` with the image
as a data URI, in documents that are not trusted as well, because JupyterLab's sanitizer allows
`figure`, and `img` with `alt` and `src`. So a picture shows itself as HTML, and its plain-text form
is the description, which is what terminals print and what nbval compares.

**How it follows the theme of the page.** The image is an SVG with two sets of colours; the media
feature `prefers-color-scheme` chooses one. Inside an image, browsers answer it with the property
`color-scheme` of the `<img>`. It is inherited, and JupyterLab sets it on the page's body by its
theme (seen in 4.6). Where no page sets it, the preference of the browser counts.
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
from PIL import Image
from PIL.PngImagePlugin import PngInfo

from rosbeat.errors import PictureError
from rosbeat.viz import theme

_COLOURS = 255
_HTML = """<figure class="rosbeat-picture" style="margin: 0">
<img alt="{alt}" width="{width}" style="max-width: 100%; height: auto; border-radius: 8px"
src="data:image/svg+xml;base64,{data}">
</figure>"""
#: Nothing but the drawing; the words are beside it.
_BARE = dict.fromkeys(("Creator", "Date", "Format", "Type"))
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

    def png(self) -> bytes:
        """Return the picture as PNG for a light page, `theme.DENSITY` image pixels per CSS pixel.

        Title and description are inside.
        """
        words = PngInfo()
        words.add_text("Title", self.title)
        words.add_itxt("Description", self.description)
        full = self._print("png", {"Software": None}, theme.DPI * theme.DENSITY)
        with Image.open(BytesIO(full)) as image, BytesIO() as target:
            # A palette makes the file a third as large, and nobody sees the difference.
            few = image.convert("RGB").quantize(_COLOURS, dither=Image.Dither.NONE)
            few.save(target, "PNG", pnginfo=words, optimize=True)
            return target.getvalue()

    def svg(self) -> str:
        """Return the picture as SVG for a light page, named and described for screen readers."""
        words = {"Title": self.title, "Description": self.description, "Date": None}
        code = self._print("svg", words, theme.DPI).decode("utf-8")
        name = escape(self.description, quote=True)
        return code.replace("<svg ", f'<svg role="img" aria-label="{name}" ', 1)

    def html(self) -> str:
        """Return an HTML figure that follows the theme; its image has the description as `alt`."""
        width = min(theme.WIDTH, round(self.figure.get_figwidth() * theme.DPI))
        data = b64encode(self._in_both_themes().encode()).decode("ascii")
        return _HTML.format(alt=escape(self.description, quote=True), width=width, data=data)

    def save(self, path: str | Path) -> Path:
        """Write the picture to a file, with title and description in its metadata.

        Args:
            path: File to write; its ending, `.png` or `.svg`, chooses the format.

        Returns:
            The path written.

        Raises:
            PictureError: If the ending is another one.
        """
        path = Path(path)
        if path.suffix == ".png":
            path.write_bytes(self.png())
        elif path.suffix == ".svg":
            path.write_text(self.svg(), encoding="utf-8", newline="\n")
        else:
            raise PictureError(
                f"A picture cannot be saved as {path.name!r}.",
                "The ending of the file name chooses the format; .png and .svg are known.",
                f"Save it as {path.stem + '.png'!r}.",
            )
        return path

    def _repr_mimebundle_(self, **_: object) -> Mapping[str, str]:
        return {"text/html": self.html(), "text/plain": self.description}

    def _in_both_themes(self) -> str:
        """Return the picture as SVG whose colours are variables, with values for both themes."""
        code = self._print("svg", _BARE, theme.DPI).decode("utf-8")
        dark = {light.lower(): one.lower() for light, one in theme.DARK.items()}
        used = sorted(set(_COLOUR.findall(code)) & set(dark))
        light = "".join(f"--{one[1:]}:{one};" for one in used)
        other = "".join(f"--{one[1:]}:{dark[one]};" for one in used)
        query = "@media (prefers-color-scheme: dark)"
        rules = f"<style>:root{{{light}}}{query}{{:root{{{other}}}}}</style>"
        code = _COLOUR.sub(
            lambda found: f"var(--{found[0][1:]})" if found[0] in dark else found[0], code
        )
        return code.replace("<defs>", f"{rules}<defs>", 1)

    def _print(self, form: str, words: Mapping[str, str | None], dpi: int) -> bytes:
        # The page may have changed matplotlib's settings; ours hold while we draw.
        with mpl_style.context(["default", theme.RC]), BytesIO() as target:
            self.figure.savefig(target, format=form, dpi=dpi, metadata=dict(words))
            return target.getvalue()
