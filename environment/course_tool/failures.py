"""Reads an installer's last words and says what they mean."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

from course_tool import checks
from course_tool.messages import Problem, Untouched

_DISK = r"No space left on device|os error 28|Errno 28|Disk quota exceeded"
_CERTIFICATE = r"CERTIFICATE_VERIFY_FAILED|invalid peer certificate|UnknownIssuer|SSLError"
_HASH = r"Hash mismatch|DO NOT MATCH THE HASHES"
_NETWORK = (
    r"dns error|[Nn]ame resolution|Name or service not known|Failed to resolve|"
    r"Network is unreachable|No route to host|Connection refused|Connection reset|"
    r"NewConnectionError|ConnectTimeout|ReadTimeout|timed out|Could not connect|"
    r"error sending request|tcp connect error|Failed to fetch|ProxyError|"
    r"No matching distribution found|Temporary failure"
)
_PERMISSION = r"Permission denied|Read-only file system|os error 13|os error 30"
_BUILD = r"Failed to build|[Bb]uild backend"


def installing(text: str, place: Path) -> Problem:
    """Return the problem behind what pip or uv said before they gave up.

    Args:
        text: Their output.
        place: The environment they were filling.
    """
    for pattern, problem in _KINDS:
        if re.search(pattern, text):
            return problem(place, _end(text))
    return Problem(
        "The installer stopped, and this command does not know the reason.",
        "The environment is not complete yet; nothing of yours is touched.",
        "Run the same command again: it goes on where it stopped.\n"
        "If it stops again, remove the folder .venv and run it once more.",
        _end(text),
    )


def _disk(place: Path, details: str) -> Problem:
    return checks.disk_full(str(place), details=details)


def _certificate(place: Path, details: str) -> Problem:
    return Untouched(
        "The package index answered with a certificate that this machine does not trust.",
        "Nothing is installed over a connection that could be somebody else's.",
        "If your organisation inspects traffic, name its certificates:\n"
        "SSL_CERT_FILE=/path/to/certificates.pem ./environment/course lab\n"
        "If not, check this machine's date.",
        details,
    )


def _hash(place: Path, details: str) -> Problem:
    return Untouched(
        "A package arrived that is not the one the course was locked to.",
        "It is refused: it may be damaged, or somebody else's.",
        "Run the same command again. If that helps nothing, your package index serves other\n"
        "files than PyPI does; ask whoever looks after it.",
        details,
    )


def _network(place: Path, details: str) -> Problem:
    return Untouched(
        "The package index cannot be reached.",
        "The first start fetches about 200 packages (250 MB); later starts need no network.",
        "Check the network and run the same command again: it goes on where it stopped.\n"
        "Behind a proxy, set HTTPS_PROXY. With an index of your own, set UV_DEFAULT_INDEX and\n"
        "PIP_INDEX_URL, or index-url in pip's configuration.",
        details,
    )


def _build(place: Path, details: str) -> Problem:
    return Untouched(
        "A package could not be built from its source.",
        "Only empy and the course's own package are; a file of the course may be missing.",
        "Look with  git status  whether this checkout is complete, then run the command again.",
        details,
    )


def _permission(place: Path, details: str) -> Problem:
    return Problem(
        "The installer may not write where it needs to.",
        f"It writes in {place} and in its cache, below ~/.cache/uv.",
        "Look whether another user made them (with sudo, perhaps), and make them yours:\n"
        'sudo chown -R "$USER" .venv ~/.cache/uv',
        details,
    )


_KINDS: tuple[tuple[str, Callable[[Path, str], Problem]], ...] = (
    (_DISK, _disk),
    (_CERTIFICATE, _certificate),
    (_HASH, _hash),
    (_NETWORK, _network),
    (_PERMISSION, _permission),
    (_BUILD, _build),
)


def _end(text: str) -> str:
    return "\n".join(text.strip().splitlines()[-12:])
