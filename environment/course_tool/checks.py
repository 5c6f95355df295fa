"""What must hold before anything is installed. Each check raises a `Problem` or returns."""

from __future__ import annotations

import importlib.util
import os
import shutil
import sys
import tempfile
from pathlib import Path

from course_tool.layout import Layout
from course_tool.messages import Problem

GIGABYTE = 10**9
FIRST_TIME = 1.5 * GIGABYTE
"""The environment and the installer's cache, when nothing is there yet."""
REFRESH = 0.3 * GIGABYTE
OLDEST_GLIBC = (2, 28)


def before_installing(layout: Layout) -> None:
    """Check everything that installing needs."""
    check_libc(glibc_version())
    check_writable(layout.root)
    check_space(layout.root, REFRESH if layout.uv.exists() else FIRST_TIME)


def before_making_venv() -> None:
    """Check what making a virtual environment needs."""
    check_venv_module()


def glibc_version() -> str:
    """Return the version of the C library, or an empty string when it is not GNU's."""
    try:
        name = os.confstr("CS_GNU_LIBC_VERSION") or ""
    except (ValueError, OSError):
        return ""
    return name.partition(" ")[2]


def check_libc(version: str) -> None:
    """Refuse a Linux that the ROS wheels were not built for."""
    if version and tuple(int(part) for part in version.split(".")[:2]) >= OLDEST_GLIBC:
        return
    raise Problem(
        f"This Linux has {'glibc ' + version if version else 'another C library than glibc'}.",
        "The ready-made ROS 2 needs glibc 2.28 or newer (Debian 10, Ubuntu 20.04 and later).",
        "Use the container, environment/Dockerfile, or conda with environment/environment.yml;\n"
        "environment/README.md says how.",
    )


def check_venv_module() -> None:
    """Refuse a Python that cannot make virtual environments (Debian packs that apart)."""
    if all(importlib.util.find_spec(name) for name in ("venv", "ensurepip")):
        return
    raise venv_module_missing()


def venv_module_missing() -> Problem:
    """Return the problem of a Python without venv or ensurepip, with the right package's name."""
    version = "{}.{}".format(*sys.version_info[:2])
    return Problem(
        f"Python {version} is here ({sys.executable}), but its venv module is not complete.",
        "The course keeps everything it installs in .venv and needs that module to make it.",
        f"On Debian or Ubuntu:  sudo apt install python{version}-venv\n"
        "Then run the same command again.",
    )


def check_writable(folder: Path) -> None:
    """Refuse a checkout in which nothing can be made."""
    try:
        with tempfile.TemporaryFile(dir=folder):
            return
    except OSError as error:
        if error.errno == _DISK_FULL:
            raise disk_full(str(folder)) from None
        raise not_writable(folder, error.strerror or str(error)) from None


def not_writable(folder: Path, reason: str) -> Problem:
    """Return the problem of a folder that cannot be written to."""
    return Problem(
        f"Nothing can be written in {folder} ({reason}).",
        "The course makes its environment there, in .venv, and you save your notebooks there.",
        "Clone the course into a folder of your own, below your home for example.",
    )


def check_space(folder: Path, needed: float) -> None:
    """Refuse to start what the disk cannot hold."""
    free = shutil.disk_usage(folder).free
    if free < needed:
        raise disk_full(
            str(folder), f"{free / GIGABYTE:.1f} GB free, {needed / GIGABYTE:.1f} needed"
        )


def disk_full(place: str, figures: str = "", details: str = "") -> Problem:
    """Return the problem of a full disk."""
    return Problem(
        f"There is not enough room on the disk for {place}"
        + (f" ({figures})." if figures else "."),
        "ROS 2, JupyterLab and the installer's cache take about 1.5 GB the first time.",
        "Free some space and run the same command again: it goes on where it stopped.",
        details,
    )


_DISK_FULL = 28
