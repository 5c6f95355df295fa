"""`course hub`: JupyterHub for a class, from the checkout that all of its learners share."""

from __future__ import annotations

import hashlib
import os
import shutil
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NoReturn

from course_tool import installing, prepare, running
from course_tool.layout import Layout
from course_tool.problems import say

_CONFIGURED = ("-f", "--config")
#: What npm makes the proxy from; the second is its lock.
_PROXY = ("package.json", "package-lock.json")


def hub(layout: Layout, options: Sequence[str]) -> NoReturn:
    """Become JupyterHub with the course's configuration; options are its own.

    Args:
        layout: The checkout.
        options: What the person added; `-f FILE` takes the place of the course's configuration.

    Raises:
        Problem: If JupyterHub or its proxy cannot be installed.
    """
    environ = prepare.ready(layout, "course")
    if not _is_installed(layout):
        with prepare.exclusive(layout.environment):
            _install(layout, installing.for_installers(layout, environ))
    config = ["-f", str(layout.hub / "jupyterhub_config.py")]
    own = [] if any(one.startswith(_CONFIGURED) for one in options) else config
    program = str(layout.venv / "bin" / "jupyterhub")
    os.execve(program, [program, *own, *options], environ)


def bring_fonts(layout: Layout) -> None:
    """Copy the list of the machine's fonts into a learner's home, where Matplotlib looks for it."""
    home = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "matplotlib"
    home.mkdir(parents=True, exist_ok=True)
    for path in _fonts(layout).glob("fontlist-*.json"):
        if not (home / path.name).exists():
            shutil.copyfile(path, home / path.name)


def _shared(layout: Layout) -> Path:
    return layout.venv / "share" / "rosbeat-hub"


def _fonts(layout: Layout) -> Path:
    return _shared(layout) / "matplotlib"


def _fingerprint(layout: Layout) -> str:
    locks = [layout.lock("hub"), *(layout.hub / name for name in _PROXY)]
    return hashlib.sha256(b"\0".join(path.read_bytes() for path in locks)).hexdigest()


def _stamp(layout: Layout) -> Path:
    return layout.venv / "rosbeat-hub-stamp"


def _is_installed(layout: Layout) -> bool:
    stamp = _stamp(layout)
    return stamp.exists() and stamp.read_text(encoding="utf-8") == _fingerprint(layout)


def _install(layout: Layout, environ: Mapping[str, str]) -> None:
    """Install JupyterHub and its proxy into `.venv`, and compile all that learners import.

    Learners cannot write there, so Python would compile the same files at each start.
    """
    proxy = _shared(layout)
    proxy.mkdir(parents=True, exist_ok=True)
    for name in _PROXY:
        shutil.copy(layout.hub / name, proxy)
    npm: list[str | Path] = [layout.venv / "bin" / "npm", "ci", "--no-audit", "--no-fund"]
    # Matplotlib lists the machine's fonts before its first picture, for seconds and once per home.
    fonts: list[str | Path] = [layout.python, "-c", "import matplotlib.font_manager"]
    steps: dict[str, list[str | Path]] = {
        "JupyterHub, which hub.lock lists": installing.lock_command(layout, "hub"),
        "its proxy": [*npm, "--prefix", proxy],
        "a list of fonts": fonts,
    }
    for what, command in steps.items():
        say(f"  installing {what}")
        env = {**environ, "MPLCONFIGDIR": str(_fonts(layout))}
        installing.install(command, env, installing.install_log(layout))
    say("  installing compiled files")
    compiled = [layout.venv / "lib", layout.root / "src"]
    # Some packages bring files for other Pythons, which this one cannot compile.
    running.quiet([layout.python, "-m", "compileall", "-qq", "-j", "0", *compiled], environ)
    _stamp(layout).write_text(_fingerprint(layout), encoding="utf-8")
