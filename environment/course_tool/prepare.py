"""Brings `.venv` to where a command needs it; does nothing when it is there already."""

from __future__ import annotations

import os
import platform
from collections.abc import Iterator, Mapping
from contextlib import contextmanager

from course_tool import checks, installing, making, proof, stamp, surroundings
from course_tool.exclusive import exclusive
from course_tool.layout import Layout
from course_tool.messages import Untouched, say


def ready(layout: Layout, level: str) -> dict[str, str]:
    """Make `.venv` complete for a level and return the environment to run its programs in."""
    clean = surroundings.cleaned(os.environ, layout)
    if not stamp.satisfied(layout, level):
        checks.before_installing(layout)
        with exclusive(layout.environment):
            _complete(layout, level, clean.environ)
        clean = surroundings.cleaned(os.environ, layout)
    for note in clean.notes:
        say(note)
    return surroundings.inside(clean.environ, layout)


def _complete(layout: Layout, level: str, environ: Mapping[str, str]) -> None:
    if stamp.satisfied(layout, level):
        return  # the command that was here before us did it
    level = stamp.at_least(layout, level)
    say(_heading(layout))
    making.make_or_keep(layout, environ)
    with _marked_as_unfinished(layout):
        installing.fill(layout, level, environ)
        _prove(layout)
    stamp.write(layout, level)


@contextmanager
def _marked_as_unfinished(layout: Layout) -> Iterator[None]:
    """Take the stamp away, and put it back only when nothing was changed: no network, say.

    Whoever is offline then keeps an environment that works, instead of having it made again.
    """
    before = stamp.read(layout)
    stamp.remove(layout)
    try:
        yield
    except Untouched:
        if before:
            stamp.put(layout, before)
        raise


def _prove(layout: Layout) -> None:
    say("  4/4  listening for a first ROS message")
    # Cleaned again: what this ROS offers is known only now that it is installed.
    environ = surroundings.cleaned(os.environ, layout).environ
    heard = proof.ask_ros(layout, surroundings.inside(environ, layout))
    say(f"       heard after {heard['milliseconds']:.0f} ms (rclpy {heard['rclpy']})")


def _heading(layout: Layout) -> str:
    python = f"Python {platform.python_version()}"
    if layout.stamp.exists():
        return f"Something changed since .venv was made; refreshing it with {python}."
    if layout.venv.exists():
        return f"Completing .venv with {python}."
    return f"Preparing .venv with {python}. The first time takes about a minute and 1.5 GB."
