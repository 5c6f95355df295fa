"""Bring `.venv` to where a command needs it; do nothing when it is there already.

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
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

from course_tool import installing, messages, running
from course_tool.layout import COURSE_ROS, WORKSPACE_IN, Layout
from course_tool.problems import Problem, complain, last_lines, say

GIGABYTE = 10**9
FIRST_TIME = 1.5 * GIGABYTE
"""The environment and the installer's cache, when nothing is there yet."""
REFRESH = 0.3 * GIGABYTE

_IN_QUOTES = "The scripts that colcon writes fail at that character, so no workspace works there."
#: Characters that may not be in a path, each with the reason.
_UNFIT = {
    os.pathsep: "Linux separates the folders of a list, such as PATH, by that character, so\n"
    "neither Python nor colcon can work in this folder.",
    **dict.fromkeys('"`$', _IN_QUOTES),
}
_FIRST_SPACE = "ROS 2, JupyterLab and the installer's cache take about 1.5 GB the first time."
#: To be raised when this tool lays out an environment in another way.
_REVISION = "6"
_ROS_DEADLINE = 60.0


def ready(layout: Layout, level: str) -> dict[str, str]:
    """Make `.venv` complete for a level and return the environment to run its programs in.

    Raises:
        Problem: If it cannot be made, filled, or no message arrives in it.
    """
    check_place(layout.root)
    check_place(layout.learner)
    check_place(Path(os.environ.get(WORKSPACE_IN, "")))
    clean = running.cleaned(os.environ, layout)
    if not is_satisfied(layout, level):
        check_writable(layout.root)
        check_space(layout.root, REFRESH if layout.uv.exists() else FIRST_TIME)
        with exclusive(layout.environment):
            # Perhaps the command that was here before us did it.
            if not is_satisfied(layout, level):
                _complete(layout, at_least(layout, level), clean.environ)
        clean = running.cleaned(os.environ, layout)
    for note in clean.notes:
        say(note)
    return running.inside(clean.environ, layout)


def _complete(layout: Layout, level: str, environ: Mapping[str, str]) -> None:
    python = f"Python {platform.python_version()}"
    added = additions(layout)
    if is_usable(layout):
        say(f"Something changed since {layout.venv.name} was made; refreshing it with {python}.")
    else:
        name = layout.venv.name
        say(f"Preparing {name} with {python}. The first time takes about a minute and 1.5 GB.")
        make(layout, environ)
    installing.fill(layout, level, environ)
    if added:
        added = _added_again(layout, environ)
    elif layout.ros == COURSE_ROS:
        messages.write_missing(layout)
    say("  4/4  listening for a first ROS message")
    # Cleaned again: what this ROS offers is known only now that it is installed.
    fresh = running.cleaned(os.environ, layout).environ
    heard = ask_ros(layout, running.inside(fresh, layout))
    say(f"       heard after {heard['milliseconds']:.0f} ms (rclpy {heard['rclpy']})")
    write_stamp(layout, level, added)


def _added_again(layout: Layout, environ: Mapping[str, str]) -> list[str]:
    """Add what builds messages to a refreshed environment; the course starts without it, too."""
    locks = messages.needed(layout, environ.get("PATH", os.defpath))
    try:
        messages.require_headers()
        messages.install(layout, locks, environ)
    except Problem as problem:
        complain(problem)
        messages.write_missing(layout)
        say("The course goes on without what builds messages. To try again:")
        say("  ./environment/course add messages")
        return []
    return locks


# What must hold before anything is installed.


def check_place(folder: Path) -> None:
    """Refuse a folder in which colcon cannot build, or would build into another one.

    It would cut a path with a colon in two, and install what it builds into `.venv`. Its scripts
    have paths in double quotes, in which other characters have a meaning of their own.

    Raises:
        Problem: If there is such a character in the path.
    """
    sign = next((sign for sign in str(folder) if sign in _UNFIT), "")
    if sign:
        raise Problem(
            f"There is a {sign} in the path {folder}.",
            f"{_UNFIT[sign]}\nNothing was installed or changed.",
            f"Rename the folder, or choose another one, without a {sign} in its path, and run\n"
            "the same command again.",
        )


def check_writable(folder: Path) -> None:
    """Refuse a checkout in which nothing can be made.

    Raises:
        OSError: With the reason, of which `course_tool.cli` makes a problem.
    """
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryFile(dir=folder):
        pass


def check_space(folder: Path, needed: float, why: str = _FIRST_SPACE) -> None:
    """Refuse to start what the disk cannot hold.

    Args:
        folder: Where it goes.
        needed: How many bytes it needs.
        why: What needs them, as a sentence.

    Raises:
        Problem: If there is less room.
    """
    free = shutil.disk_usage(folder).free
    if free < needed:
        raise Problem(
            f"There is not enough room on the disk for {folder} ({free / GIGABYTE:.1f} GB free, "
            f"{needed / GIGABYTE:.1f} needed).",
            why,
            "Free some space and run the same command again.",
        )


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
            say("Another command of the course works in this folder; waiting until it is done ...")
            fcntl.flock(descriptor, fcntl.LOCK_EX)
        except OSError:
            pass  # a file system without such locks (some network drives): go on without
        yield
    finally:
        os.close(descriptor)


# The virtual environment itself.


def make(layout: Layout, environ: Mapping[str, str]) -> None:
    """Make an empty `.venv`, in the place of one that cannot be used."""
    say(f"  1/4  making {layout.venv.name}")
    command = [sys.executable, "-I", "-m", "venv", "--clear", str(layout.venv)]
    is_whole = all(importlib.util.find_spec(name) for name in ("venv", "ensurepip"))
    if not is_whole or subprocess.run(command, env=dict(environ), check=False).returncode != 0:
        version = "{}.{}".format(*sys.version_info[:2])
        raise Problem(
            f"Python {version} is here ({sys.executable}), but its venv module made no "
            f"{layout.venv.name}.",
            "The course keeps everything it installs there and needs that module to make it.",
            f"On Debian or Ubuntu, it is a package:  sudo apt install python{version}-venv\n"
            "Then run the same command again.",
        )


def is_usable(layout: Layout) -> bool:
    """Tell whether `.venv` was once complete, for this Python and in this place.

    One without a stamp was interrupted. Which of its packages are whole cannot be told, and from
    the installer's cache a new one takes seconds.
    """
    return os.access(layout.python, os.X_OK) and _stamp(layout).get("made_for") == _here(layout)


def _here(layout: Layout) -> list[str]:
    version = "{}.{}".format(*sys.version_info[:2])
    return [version, os.path.realpath(sys.base_prefix), str(layout.venv)]


# The stamp.


def fingerprint(layout: Layout, level: str, added: Sequence[str] = ()) -> str:
    """Return a hash of everything that a level's environment is made from.

    Args:
        layout: The checkout.
        level: The level.
        added: The locks of what was added to it.
    """
    digest = hashlib.sha256(f"{_REVISION} {level}".encode())
    projects = [folder / "pyproject.toml" for folder in layout.own_packages]
    locks = [layout.lock(level), layout.lock("build"), layout.lock("bootstrap")]
    ours = [*installing.underlay_templates(), *installing.lab_files()]
    more = [layout.lock(name) for name in added]
    if added:
        own = messages.own_package(layout).rglob("*")
        more += [Path(messages.__file__), *sorted(path for path in own if path.is_file())]
    for path in [*locks, *projects, *ours, *more]:
        digest.update((path.read_bytes() if path.exists() else b"") + b"\0")
    return digest.hexdigest()


def stamped_level(layout: Layout) -> str | None:
    """Return the level that `.venv` was completed for, or None if it was not."""
    return _stamp(layout).get("level")


def additions(layout: Layout) -> list[str]:
    """Return the locks of what was added to `.venv`: none, or those of `course add messages`."""
    return list(_stamp(layout).get("added", []))


def at_least(layout: Layout, level: str) -> str:
    """Return the higher of a level and the one that is there: nobody loses tools."""
    return max(level, stamped_level(layout) or level, key=layout.levels.index)


def is_satisfied(layout: Layout, level: str) -> bool:
    """Tell whether the environment is complete, fresh and good for a level."""
    made = stamped_level(layout)
    index = layout.levels.index
    if made is None or not is_usable(layout) or index(made) < index(level):
        return False
    return bool(_stamp(layout)["fingerprint"] == fingerprint(layout, made, additions(layout)))


def write_stamp(layout: Layout, level: str, added: Sequence[str] = ()) -> None:
    """Say that the environment is complete: the whole stamp, or nothing.

    Args:
        layout: The checkout.
        level: What it is complete for.
        added: The locks of what was added to it.
    """
    unfinished = layout.stamp.with_suffix(".new")
    stamp = {
        "level": level,
        "added": list(added),
        "fingerprint": fingerprint(layout, level, added),
        "made_for": _here(layout),
    }
    unfinished.write_text(json.dumps(stamp) + "\n", encoding="utf-8")
    unfinished.replace(layout.stamp)


def _stamp(layout: Layout) -> dict[str, Any]:
    """Return the stamp, empty when there is none that can be read."""
    with suppress(OSError, ValueError):
        return dict(json.loads(layout.stamp.read_text(encoding="utf-8")))
    return {}


# ROS, asked in a process of its own, with a deadline.


def ask_ros(layout: Layout, environ: Mapping[str, str]) -> dict[str, Any]:
    """Return what ROS says of itself in `.venv`, after one node has heard another.

    Raises:
        Problem: If it cannot be asked, or no message arrives.
    """
    script = Path(__file__).with_name("ros_check.py")
    result = running.quiet([layout.python, script], environ, timeout=_ROS_DEADLINE)
    if not result.ok:
        raise Problem(
            f"ROS 2 is installed in {layout.venv.name}, but a first node does not start.",
            "No page of the course and no test would run, so nothing is opened or run.",
            f"Remove the folder {layout.venv.name} and run the same command again.\n"
            "If it stays like this, send the lines below to the course's issue tracker.",
            last_lines(result.text),
        )
    facts: dict[str, Any] = json.loads(result.last_line)
    if facts["milliseconds"] is None:
        raise Problem(
            "A first node publishes, and a subscriber in the same process hears nothing.",
            "ROS 2 starts here, but its messages do not travel.",
            "Look whether ROS_DOMAIN_ID, ROS_AUTOMATIC_DISCOVERY_RANGE,\n"
            "FASTDDS_DEFAULT_PROFILES_FILE or FASTRTPS_DEFAULT_PROFILES_FILE is set to something\n"
            "unusual, and whether the loopback interface is up:  ip link show lo",
        )
    return facts
