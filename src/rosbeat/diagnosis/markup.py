"""Turn a sentence in which code stands between backquotes into HTML."""

from __future__ import annotations

import re
from collections.abc import Callable
from html import escape

_CODE = re.compile(r"`([^`\n]+)`")


def in_html(text: str, code: Callable[[str], str] = escape) -> str:
    """Return the HTML of a text; what stands between backquotes becomes a `<code>` element.

    Args:
        text: Any text.
        code: Makes the HTML of what is inside such an element.
    """
    plain_and_code = _CODE.split(text)
    return "".join(
        f"<code>{code(part)}</code>" if number % 2 else escape(part)
        for number, part in enumerate(plain_and_code)
    )
