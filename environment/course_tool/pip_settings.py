"""Passes on what a person told pip: uv does not read pip's configuration."""

from __future__ import annotations

import ast
import re
from collections.abc import Mapping

_PASSED_ON = {
    "index-url": "UV_DEFAULT_INDEX",
    "cert": "SSL_CERT_FILE",
    "proxy": "ALL_PROXY",
    "trusted-host": "UV_INSECURE_HOST",
}
_SAME_THING = {
    "UV_DEFAULT_INDEX": ("UV_INDEX_URL",),
    "ALL_PROXY": ("HTTPS_PROXY", "https_proxy", "all_proxy"),
}
_ORDER = ("global", "install", ":env:")
_LINE = re.compile(r"^(global|install|:env:)\.([a-z-]+)=(.*)$")
_USUAL_INDEX = re.compile(r"^https://pypi\.org/simple/?$")


def for_uv(listing: str, environ: Mapping[str, str]) -> dict[str, str]:
    """Return the variables that tell uv what pip knows and uv does not.

    Args:
        listing: What `pip config list` prints.
        environ: The environment; what it already tells uv is not changed.
    """
    settings = _settings(listing)
    return {
        variable: " ".join(settings[key].split())
        for key, variable in _PASSED_ON.items()
        if key in settings
        and not _said_already(variable, environ)
        and not _USUAL_INDEX.match(settings[key])
    }


def _said_already(variable: str, environ: Mapping[str, str]) -> bool:
    return any(environ.get(name) for name in (variable, *_SAME_THING.get(variable, ())))


def _settings(listing: str) -> dict[str, str]:
    """Return pip's settings; the environment counts more than the section for `install`."""
    found = [match.groups() for line in listing.splitlines() if (match := _LINE.match(line))]
    found.sort(key=lambda entry: _ORDER.index(entry[0]))
    return {key: _value(text) for _, key, text in found}


def _value(text: str) -> str:
    try:
        return str(ast.literal_eval(text))
    except (ValueError, SyntaxError):
        return text
