"""Pictures inside a page's text.

The bytes of a picture depend on the versions of matplotlib and its fonts, which differ between the
Pythons of the course; a page's words do not. Comparisons therefore look at everything else, and at
whether a picture is there. The words that describe a picture are compared like any others.
"""

from __future__ import annotations

import re

_PAYLOAD = re.compile(
    rb"(?P<data>data:image/[a-z+]+;base64,)[A-Za-z0-9+/=\\n\s]+"
    rb'|(?P<mime>"image/(?:png|jpeg)": )"[^"]*"'
)


def without_pictures(page: bytes) -> bytes:
    """Replace the payload of every picture by a word.

    Args:
        page: A page as it stands in a file.
    """
    return _PAYLOAD.sub(_word, page)


def _word(match: re.Match[bytes]) -> bytes:
    return match["data"] + b"picture" if match["data"] else match["mime"] + b'"picture"'
