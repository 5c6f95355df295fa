"""Words for people: progress, and every problem that installing knows, in three parts."""

from __future__ import annotations

import re
import shlex
import sys
from pathlib import Path
from textwrap import indent

_LABELS = ("What happened:", "What it means here:", "What to try:")
_WIDTH = 21


class Problem(Exception):  # noqa: N818 - not always an error
    """Something a person has to know: what happened, what it means here, what to try.

    Attributes:
        details: The last words of the program that failed, if one did.
    """

    def __init__(self, happened: str, means: str, cure: str, details: str = "") -> None:
        super().__init__(happened)
        self.happened = happened
        self.means = means
        self.cure = cure
        self.details = details

    def text(self) -> str:
        """Return the problem as a person reads it."""
        parts = zip(_LABELS, (self.happened, self.means, self.cure), strict=True)
        rows = [label.ljust(_WIDTH) + part.replace("\n", f"\n{'':21}") for label, part in parts]
        if self.details.strip():
            rows += ["", "Its last words:", indent(self.details.strip(), "    ")]
        return "\n".join(rows)


class Untouched(Problem):
    """A problem that came up before anything in the environment was changed."""


def say(text: str = "") -> None:
    """Print a line of progress, at once."""
    print(text, flush=True)


def complain(problem: Problem) -> None:
    """Print a problem on standard error."""
    print(f"\n{problem.text()}\n", file=sys.stderr, flush=True)


def not_writable(folder: Path, reason: str) -> Problem:
    """Return the problem of a folder that cannot be written to."""
    return Problem(
        f"Nothing can be written in {folder} ({reason}).",
        "The course makes its environment there, in .venv, and you save your notebooks there.",
        "Clone the course into a folder of your own, below your home for example.",
    )


def of_another_user(place: str, folder: Path, reason: str) -> Problem:
    """Return the problem of a learner's folder in which files belong to somebody else."""
    return Problem(
        f"{place} cannot be read or written ({reason}).",
        "The course keeps your pages there. Another user made the folder, with sudo perhaps.",
        f"Make it yours, and run the same command again:\n"
        f'sudo chown -R "$USER" {shlex.quote(str(folder))}',
    )


def disk_full(place: str, figures: str = "", details: str = "") -> Problem:
    """Return the problem of a full disk."""
    return Problem(
        f"There is not enough room on the disk for {place}{f' ({figures})' if figures else ''}.",
        "ROS 2, JupyterLab and the installer's cache take about 1.5 GB the first time.",
        "Free some space and run the same command again: it goes on where it stopped.",
        details,
    )


def venv_module_missing() -> Problem:
    """Return the problem of a Python without venv or ensurepip (Debian packs them apart)."""
    version = "{}.{}".format(*sys.version_info[:2])
    return Problem(
        f"Python {version} is here ({sys.executable}), but its venv module is not complete.",
        "The course keeps everything it installs in .venv and needs that module to make it.",
        f"On Debian or Ubuntu:  sudo apt install python{version}-venv\n"
        "Then run the same command again.",
    )


def installer_stopped(output: str, place: Path) -> Problem:
    """Return the problem behind what pip or uv said before they gave up.

    Args:
        output: What they printed.
        place: The environment they were filling.
    """
    details = "\n".join(output.strip().splitlines()[-12:])
    if re.search(_DISK, output):
        return disk_full(str(place), details=details)
    for kind, pattern, happened, means, cure in _KINDS:
        if re.search(pattern, output):
            return kind(happened, means.format(place=place), cure, details)
    return Problem(
        "The installer stopped, and this command does not know the reason.",
        "The environment is not complete yet; nothing of yours is touched.",
        "Run the same command again: it goes on where it stopped.\n"
        "If it stops again, remove the folder .venv and run it once more.",
        details,
    )


_DISK = r"No space left on device|os error 28|Errno 28|Disk quota exceeded"
_NETWORK = (
    r"dns error|[Nn]ame resolution|Name or service not known|Failed to resolve|"
    r"Network is unreachable|No route to host|Connection refused|Connection reset|"
    r"NewConnectionError|ConnectTimeout|ReadTimeout|timed out|Could not connect|"
    r"error sending request|tcp connect error|Failed to fetch|ProxyError|"
    r"No matching distribution found|Temporary failure"
)
#: What to look for in an installer's output, in this order, and what it means.
_KINDS = (
    (
        Problem,
        r"no wheels with a matching (platform|Python ABI) tag|not compatible with this platform",
        "ROS 2 does not come ready-made for this Linux.",
        "Its packages need glibc 2.28 or newer (Debian 10, Ubuntu 20.04 and later).",
        "./environment/container\n"
        "It opens the course in a container, with Docker or podman.\n"
        "environment/README.md also has the way with conda.",
    ),
    (
        Untouched,
        r"CERTIFICATE_VERIFY_FAILED|invalid peer certificate|UnknownIssuer|SSLError",
        "The package index answered with a certificate that this machine does not trust.",
        "Nothing is installed over a connection that could be somebody else's.",
        "If your organisation inspects traffic, name its certificates:\n"
        "SSL_CERT_FILE=/path/to/certificates.pem ./environment/course lab\n"
        "If not, check this machine's date.",
    ),
    (
        Untouched,
        r"Hash mismatch|DO NOT MATCH THE HASHES",
        "A package arrived that is not the one the course was locked to.",
        "It is refused: it may be damaged, or somebody else's.",
        "Run the same command again. If that helps nothing, your package index serves other\n"
        "files than PyPI does; ask whoever looks after it.",
    ),
    (
        Untouched,
        _NETWORK,
        "The package index cannot be reached.",
        "The first start fetches about 200 packages (250 MB); later starts need no network.",
        "Check the network and run the same command again: it goes on where it stopped.\n"
        "Behind a proxy, set HTTPS_PROXY. With an index of your own, set UV_DEFAULT_INDEX and\n"
        "PIP_INDEX_URL, or index-url in pip's configuration.",
    ),
    (
        Problem,
        r"Permission denied|Read-only file system|os error 13|os error 30",
        "The installer may not write where it needs to.",
        "It writes in {place} and in its cache, below ~/.cache/uv.",
        "Look whether another user made them (with sudo, perhaps), and make them yours:\n"
        'sudo chown -R "$USER" .venv ~/.cache/uv',
    ),
    (
        Untouched,
        r"Failed to build|[Bb]uild backend|Distribution not found at",
        "A package could not be built from its source.",
        "Only empy and the course's own package are; a file of the course may be missing.",
        "./environment/course doctor  says whether files of the course are missing, and how to\n"
        "bring them back. Then run the command again.",
    ),
)
