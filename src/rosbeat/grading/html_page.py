"""An HTML page that works from one file: safe text, and the frame around it.

A page has no script and asks the network for nothing; its Content-Security-Policy says so to the
browser as well. Whatever comes from a submission goes through `shown`, `paragraph` or `name`.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import cache
from html import escape
from importlib.resources import files

from rosbeat.exercises.cards import clipped
from rosbeat.grading.palette import DARK, LIGHT, variables
from rosbeat.grading.remarks import printable

_POLICY = "default-src 'none'; style-src 'unsafe-inline'; img-src data:"
#: Rows of a table that anybody reads; whoever wants all of them has `grades.csv`.
MOST_ROWS = 500
#: Characters of a text that needs no cutting, whatever it is.
_SHORT = 200
#: Rows from which on a table is folded up.
_FOLDED_FROM = 12

_DOCUMENT = """<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="{policy}">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<meta name="referrer" content="no-referrer">
<title>{title}</title>
<style>
{style}</style>
</head>
<body>
{body}
</body>
</html>
"""


def document(title: str, *body: str) -> str:
    """Make a page.

    Args:
        title: Its title, any text.
        body: Its parts as HTML that is escaped already; empty ones are left out.
    """
    return _DOCUMENT.format(
        policy=_POLICY,
        title=shown(title, 200),
        style=_style(),
        body="\n".join(part for part in body if part),
    )


@cache
def _style() -> str:
    sheet = (files("rosbeat.grading") / "html_page.css").read_text(encoding="utf-8")
    return sheet.replace("/* light */", variables(LIGHT)).replace("/* dark */", variables(DARK))


def visible(text: str) -> str:
    r"""A text in which nothing is hidden: control and direction characters as `\u....`.

    Line breaks and tabs stay; unlike a name, a text may be long.

    Args:
        text: Any text.
    """
    if text.isprintable():
        return text  # nearly always, and many times faster
    return "".join(one if one.isprintable() or one in "\n\t" else printable(one) for one in text)


def shown(text: str, most: int = 0) -> str:
    """A text as HTML, in one go.

    Args:
        text: Any text.
        most: Characters that are shown; 0 for as much as anybody reads.
    """
    text = clipped(text.replace("\r\n", "\n")) if len(text) > _SHORT or "\n" in text else text
    if most and len(text) > most:
        text = f"{text[: most - 1]}…"
    return escape(visible(text))


def name(text: str) -> str:
    """A name as HTML; one that is written from right to left disturbs nothing around it.

    Args:
        text: Any text.
    """
    return f"<bdi>{escape(printable(text))}</bdi>"


def paragraph(text: str) -> str:
    """A text as HTML, as a block of its own; several lines keep their shape.

    Args:
        text: Any text; nothing is made of an empty one.
    """
    if not text.strip():
        return ""
    text = shown(text)
    return f"<pre>{text}</pre>" if "\n" in text else f'<p dir="auto">{text}</p>'


def prose(text: str) -> str:
    """What a person has written, as HTML: line breaks stay, and nothing else of its shape.

    Args:
        text: Any text; nothing is made of an empty one.
    """
    return f'<p class="said" dir="auto">{shown(text)}</p>' if text.strip() else ""


def section(heading: str, *parts: str) -> str:
    """A part of a page with its heading.

    Args:
        heading: HTML.
        parts: HTML; if all are empty, there is no section.
    """
    if not any(parts):
        return ""
    body = "\n".join(part for part in parts if part)
    return f"<section>\n<h2>{heading}</h2>\n{body}\n</section>"


def table(
    caption: str, head: Sequence[str], rows: Iterable[Sequence[str]], most: int = MOST_ROWS
) -> str:
    """A table; the first cell of each row is its heading.

    Args:
        caption: What it shows, HTML.
        head: The headings of the columns, HTML.
        rows: The cells, HTML.
        most: Rows that are shown; more are counted.

    Returns:
        HTML; an empty text if there are no rows.
    """
    rows = list(rows)
    if not rows:
        return ""
    columns = "".join(f'<th scope="col">{one}</th>' for one in head)
    lines = [f"<tr>{_cells(row)}</tr>" for row in rows[:most]]
    if len(rows) > most:
        more = f"And {len(rows) - most} more; the file grades.csv has all of them."
        lines.append(f'<tr><td colspan="{len(head)}">{more}</td></tr>')
    body = "\n".join(lines)
    return (
        f"<table>\n<caption>{caption}</caption>\n<thead><tr>{columns}</tr></thead>\n"
        f"<tbody>\n{body}\n</tbody>\n</table>"
    )


def _cells(row: Sequence[str]) -> str:
    first, *others = row
    return f'<th scope="row">{first}</th>' + "".join(f"<td>{one}</td>" for one in others)


def folded(summary: str, body: str, is_open: bool = False) -> str:
    """Something that unfolds when it is asked for.

    Args:
        summary: What is in it, HTML.
        body: HTML; nothing is made of an empty one.
        is_open: Whether it is unfolded to begin with.
    """
    if not body:
        return ""
    return (
        f"<details{' open' if is_open else ''}>\n<summary>{summary}</summary>\n{body}\n</details>"
    )


def listed(caption: str, head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A table that is folded up if it is long.

    Args:
        caption: What it shows, HTML.
        head: The headings of the columns, HTML.
        rows: The cells, HTML.
    """
    rows = list(rows)
    made = table(caption, head, rows)
    return folded(f"{caption} ({len(rows)})", made) if len(rows) >= _FOLDED_FROM else made
