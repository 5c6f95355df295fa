"""Brings `.venv` to where a command needs it; does nothing when it is there already.

Python's own venv module makes `.venv`, `installing` fills it, and a node has to hear another one.
The stamp, written last, says that all of this was done, and from what.
"""

from __future__ import annotations

import fcntl
import hashlib
import importlib.util
import json
import os
import platform
import shutil
import sys
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from course_tool import installing, running, surroundings
from course_tool.layout import LEVELS, Layout
from course_tool.problems import (
    Problem,
    Untouched,
    disk_full,
    installer_stopped,
    say,
    venv_module_missing,
)

GIGABYTE = 10**9
FIRST_TIME = 1.5 * GIGABYTE
"""The environment and the installer's cache, when nothing is there yet."""
REFRESH = 0.3 * GIGABYTE

#: To be raised when this tool lays out an environment in another way.
_REVISION = "4"
# Without `site`, so that nothing installed in the environment has a say.
_WHO = "import sys; print('%d.%d' % sys.version_info[:2], sys.base_prefix)"
_ROS_DEADLINE = 60.0
_WRONG_MIDDLEWARE = 102


def ready(layout: Layout, level: str) -> dict[str, str]:
    """Make `.venv` complete for a level and return the environment to run its programs in.

    Raises:
        Problem: If it cannot be made, filled, or no message arrives in it.
    """
    clean = surroundings.cleaned(os.environ, layout)
    if not is_satisfied(layout, level):
        check_writable(layout.root)
        check_space(layout.root, REFRESH if layout.uv.exists() else FIRST_TIME)
        with exclusive(layout.environment):
            # Perhaps the command that was here before us did it.
            if not is_satisfied(layout, level):
                _complete(layout, at_least(layout, level), clean.environ)
        clean = surroundings.cleaned(os.environ, layout)
    for note in clean.notes:
        say(note)
    return surroundings.inside(clean.environ, layout)


def _complete(layout: Layout, level: str, environ: Mapping[str, str]) -> None:
    say(_heading(layout))
    make_or_keep(layout, environ)
    before = layout.stamp.read_bytes() if layout.stamp.exists() else None
    layout.stamp.unlink(missing_ok=True)
    try:
        installing.fill(layout, level, environ)
        say("  4/4  listening for a first ROS message")
        # Cleaned again: what this ROS offers is known only now that it is installed.
        fresh = surroundings.cleaned(os.environ, layout).environ
        heard = ask_ros(layout, surroundings.inside(fresh, layout))
    except Untouched:
        # Whoever is offline keeps an environment that works, instead of having it made again.
        if before:
            layout.stamp.write_bytes(before)
        raise
    say(f"       heard after {heard['milliseconds']:.0f} ms (rclpy {heard['rclpy']})")
    write_stamp(layout, level)


def _heading(layout: Layout) -> str:
    python = f"Python {platform.python_version()}"
    if layout.stamp.exists():
        return f"Something changed since .venv was made; refreshing it with {python}."
    if layout.venv.exists():
        return f"Completing .venv with {python}."
    return f"Preparing .venv with {python}. The first time takes about a minute and 1.5 GB."


# What must hold before anything is installed.


def check_writable(folder: Path) -> None:
    """Refuse a checkout in which nothing can be made.

    Raises:
        OSError: With the reason, of which `course_tool.cli` makes a problem.
    """
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryFile(dir=folder):
        pass


def check_space(folder: Path, needed: float) -> None:
    """Refuse to start what the disk cannot hold: `needed` bytes."""
    free = shutil.disk_usage(folder).free
    if free < needed:
        figures = f"{free / GIGABYTE:.1f} GB free, {needed / GIGABYTE:.1f} needed"
        raise disk_full(str(folder), figures)


@contextmanager
def exclusive(folder: Path) -> Iterator[None]:
    """Hold a folder for this process; wait, and say so, while another command holds it.

    The lock is on the folder itself, so it leaves no file and ends with the process.
    """
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            say(
                "Another command of the course is at work in this folder; "
                "waiting until it is done ..."
            )
            fcntl.flock(descriptor, fcntl.LOCK_EX)
        except OSError:
            pass  # a file system without such locks (some network drives): go on without
        yield
    finally:
        os.close(descriptor)


# The virtual environment itself.


def make_or_keep(layout: Layout, environ: Mapping[str, str]) -> None:
    """Leave a usable `.venv` as it is; make it, or make it again, otherwise."""
    reason = why_unusable(layout, environ)
    if reason is None:
        return
    if not all(importlib.util.find_spec(name) for name in ("venv", "ensurepip")):
        raise venv_module_missing()
    if os.path.lexists(layout.venv):
        say(f"  .venv {reason}; it is made again")
        _remove(layout.venv)
    say("  1/4  making .venv")
    made = running.quiet([sys.executable, "-I", "-m", "venv", layout.venv], environ)
    if not made.ok:
        is_debian = "ensurepip" in made.text
        raise venv_module_missing() if is_debian else installer_stopped(made.text, layout.venv)


def why_unusable(layout: Layout, environ: Mapping[str, str]) -> str | None:
    """Return why a `.venv` cannot be used, as the end of a sentence, or None if it can.

    One without a stamp was interrupted. Which of its packages are whole cannot be told, and from
    the installer's cache a new one takes seconds.
    """
    if not os.path.lexists(layout.python) or not layout.stamp.exists():
        return "is not finished"
    who = running.quiet([layout.python, "-I", "-S", "-c", _WHO], environ, timeout=30)
    if not who.ok:
        return "has a Python that does not run"
    version, _, base = who.text.strip().partition(" ")
    is_same = os.path.realpath(base) == os.path.realpath(sys.base_prefix)
    if not is_same or version != "{}.{}".format(*sys.version_info[:2]):
        return f"belongs to another Python ({version}, {base})"
    script = layout.venv / "bin" / "activate"
    text = script.read_text(encoding="utf-8", errors="replace") if script.exists() else ""
    return None if str(layout.venv) in text else "was made in another place"


def _remove(venv: Path) -> None:
    """Remove `.venv`; of a link, only the link."""
    if venv.is_symlink() or venv.is_file():
        venv.unlink()
    else:
        shutil.rmtree(venv)


# The stamp.


def fingerprint(layout: Layout, level: str) -> str:
    """Return a hash of everything that a level's environment depends on.

    The place is part of it: a moved environment still names its old one in its scripts.
    """
    digest = hashlib.sha256()
    version = "{}.{}".format(*sys.version_info[:2])
    for text in (_REVISION, level, version, str(layout.venv)):
        digest.update(text.encode("utf-8", "surrogateescape") + b"\0")
    projects = [folder / "pyproject.toml" for folder in layout.own_packages]
    locks = [layout.lock(level), layout.lock("build")]
    for path in [*locks, *projects, *installing.underlay_templates()]:
        digest.update((path.read_bytes() if path.exists() else b"") + b"\0")
    return digest.hexdigest()


def stamped_level(layout: Layout) -> str | None:
    """Return the level that `.venv` was completed for, or None if it was not."""
    return _stamp(layout).get("level")


def at_least(layout: Layout, level: str) -> str:
    """Return the higher of a level and the one that is there: nobody loses tools."""
    return max(level, stamped_level(layout) or level, key=LEVELS.index)


def is_satisfied(layout: Layout, level: str) -> bool:
    """Tell whether the environment is complete, fresh and good for a level."""
    stamp = _stamp(layout)
    if not stamp or not os.access(layout.python, os.X_OK):
        return False
    enough = LEVELS.index(stamp["level"]) >= LEVELS.index(level)
    return enough and stamp["fingerprint"] == fingerprint(layout, stamp["level"])


def write_stamp(layout: Layout, level: str) -> None:
    """Say that the environment is complete: the whole stamp, or nothing."""
    unfinished = layout.stamp.with_suffix(".new")
    stamp = {"level": level, "fingerprint": fingerprint(layout, level)}
    unfinished.write_text(json.dumps(stamp) + "\n", encoding="utf-8")
    unfinished.replace(layout.stamp)


def _stamp(layout: Layout) -> dict[str, str]:
    """Return the stamp, empty when there is none that can be read."""
    try:
        data = json.loads(layout.stamp.read_text(encoding="utf-8"))
        return data if data["level"] in LEVELS and data["fingerprint"] else {}
    except (OSError, ValueError, KeyError, TypeError):
        return {}


# ROS, asked in a process of its own, with a deadline.


def ask_ros(layout: Layout, environ: Mapping[str, str]) -> dict[str, Any]:
    """Return what ROS says of itself in `.venv`, after one node has heard another.

    Raises:
        Problem: If it cannot be asked, or no message arrives.
    """
    script = Path(__file__).with_name("ros_check.py")
    result = running.quiet([layout.python, script], environ, timeout=_ROS_DEADLINE)
    facts = _facts(result.last_line) if result.ok else {}
    if not facts:
        cure = "Remove the folder .venv and run the same command again."
        if result.code == _WRONG_MIDDLEWARE:
            cure = "Unset RMW_IMPLEMENTATION: this ROS brings rmw_fastrtps_cpp."
        raise Problem(
            "ROS 2 is installed in .venv, but a first node does not start.",
            "No page of the course would run, so it is not opened.",
            cure + "\nIf it stays like this, send the lines below to the course's issue tracker.",
            "\n".join(result.text.strip().splitlines()[-12:]),
        )
    if facts["milliseconds"] is None:
        raise Problem(
            "A first node publishes, and a subscriber in the same process hears nothing.",
            "ROS 2 starts here, but its messages do not travel.",
            "Look whether ROS_DOMAIN_ID, ROS_AUTOMATIC_DISCOVERY_RANGE or\n"
            "FASTRTPS_DEFAULT_PROFILES_FILE is set to something unusual, and whether the\n"
            "loopback interface is up:  ip link show lo",
        )
    return facts


def _facts(line: str) -> dict[str, Any]:
    try:
        facts = json.loads(line)
    except ValueError:
        return {}
    return facts if isinstance(facts, dict) else {}
