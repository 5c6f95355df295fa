"""Define how pictures look: colours, sizes and marks, for all of them.

The strong colours are those of Okabe and Ito ("Color Universal Design", 2008,
https://jfly.uni-koeln.de/color/), which people with any common kind of colour blindness can tell
apart. Green and purple are darkened until a thin line in them is readable, and the colours for
text until text is. Colour is never alone: what differs in colour differs in shape or dash as well.

A picture brings its own opaque, soft background, the card. Figures are drawn in the colours for a
light page; `DARK` has the counterpart of each for a dark page. One contrast holds for both.
"""

from __future__ import annotations

from dataclasses import dataclass

#: Width of a picture in CSS pixels, and the least one it is scaled down to: what an output has in a
#: JupyterLab window 1,000 pixels wide, with the file browser open. Every text is 11 high then.
WIDTH, NARROW = 680, 548
#: Figure units: 100 dots per inch make one CSS pixel one hundredth of an inch.
DPI = 100
#: Free space at the rim, in CSS pixels.
MARGIN = 18

#: Font size in points: 14 CSS pixels, the size of the page's own text.
TEXT = 10.0

CARD = "#FAFAF7"
INK = "#1F2933"
MUTED = "#52606D"
RULE = "#D5DAE0"

BLUE = "#0072B2"
GREEN = "#008C66"
VERMILLION = "#D55E00"
PURPLE = "#A34C80"

#: A frame around the nodes of one process.
FRAME = "#74808D"
FRAME_FILL = "#F0F3F5"

#: Bars of callbacks that take time: pale inside, so that marks and arrows on them can be seen.
SLEEP_FILL = "#CBE3F4"
WAIT_FILL = "#FFE7B8"
BAR_EDGE = "#45525F"
HATCH = "#B98A2E"

#: Shapes of the graph: pale inside, so that the name on them stays readable.
NODE_FILL = "#DDEBF6"
NODE_FILL_STRONG = "#B5D6EF"
TOPIC_FILL = "#FFF1CF"
TOPIC_FILL_STRONG = "#FFDD94"
TOPIC_EDGE = "#9A6700"
#: Text that says what is wrong, and the line that shows it.
ALERT = VERMILLION
ALERT_TEXT = "#A84300"
#: A message that was dropped, lost, or too old when its turn came.
DROPPED, DROPPED_TEXT = ALERT, ALERT_TEXT
#: A message that a callback took.
TAKEN = GREEN
TAKEN_TEXT = "#00694D"

#: Background tints of threshold bands, from the lowest to the highest, then around again.
BANDS = ("#D9EBF8", "#E8F5EA", "#FCE3CE", "#F5E6EF")

#: From each colour to the one in its place on a dark page.
DARK = {
    CARD: "#1B1F24",
    INK: "#E8ECF0",
    MUTED: "#A7B2BD",
    RULE: "#3D4650",
    BLUE: "#56B4E9",
    GREEN: "#28A97F",
    VERMILLION: "#F5853F",
    PURPLE: "#D58AB8",
    FRAME: "#8793A0",
    FRAME_FILL: "#242A31",
    SLEEP_FILL: "#1D4157",
    WAIT_FILL: "#4F3D14",
    BAR_EDGE: "#B4BFCA",
    HATCH: "#86672A",
    NODE_FILL: "#1C3342",
    NODE_FILL_STRONG: "#1F4A66",
    TOPIC_FILL: "#3A2F12",
    TOPIC_FILL_STRONG: "#503E10",
    TOPIC_EDGE: "#D9A53A",
    ALERT_TEXT: "#FFA46B",
    TAKEN_TEXT: "#5FD6B1",
    **dict(zip(BANDS, ("#1D3342", "#21362A", "#45331F", "#3A2836"), strict=True)),
}


@dataclass(frozen=True)
class Style:
    """Describe how one series of a picture is marked, in three ways at once.

    Attributes:
        colour: Line colour.
        marker: Matplotlib marker.
        dash: Matplotlib line style, by name or as (offset, on-off lengths in points).
    """

    colour: str
    marker: str
    dash: str | tuple[float, tuple[float, ...]]


@dataclass(frozen=True)
class Bar:
    """Describe how a stretch of time is marked: by its colour and by its hatch.

    Attributes:
        fill: Colour inside.
        hatch: Matplotlib hatch; empty for none.
    """

    fill: str
    hatch: str


#: A callback that takes time, and why.
SLEEP = Bar(SLEEP_FILL, "")
WAIT = Bar(WAIT_FILL, "////")

#: One style per series, in order of use.
STYLES = (
    Style(BLUE, "o", "-"),
    Style(VERMILLION, "s", "--"),
    Style(GREEN, "^", "-."),
    Style(PURPLE, "D", ":"),
    Style(INK, "v", (0, (7, 2))),
)

#: The fonts of JupyterLab, in which a browser shows text that was measured in the theme's own.
FONTS = "system-ui,-apple-system,'Segoe UI',Helvetica,Arial,'DejaVu Sans',sans-serif"

#: What matplotlib needs to know; everything else is its default, whatever a page has set.
RC = {
    "font.family": "DejaVu Sans",
    "font.size": TEXT,
    "text.color": INK,
    "text.parse_math": False,
    # Without hinting a text is as wide as its letters are at any size.
    "text.hinting": "none",
    "axes.edgecolor": RULE,
    "axes.labelcolor": INK,
    "axes.facecolor": "none",
    "axes.unicode_minus": True,
    "xtick.color": RULE,
    "ytick.color": RULE,
    "xtick.labelcolor": MUTED,
    "ytick.labelcolor": MUTED,
    "figure.facecolor": CARD,
    "savefig.facecolor": CARD,
    "svg.hashsalt": "rosbeat",
    "svg.fonttype": "none",
    "path.simplify": True,
}


def style(number: int) -> Style:
    """Return the style of series `number`, counted from 0; after the last the first comes again."""
    return STYLES[number % len(STYLES)]
