"""Fills `.venv` from a lock: uv (through pip), everything else (through uv), and what is ours."""

from __future__ import annotations

import json
import os
import re
import shutil
from collections.abc import Mapping
from pathlib import Path

from course_tool import failures, pip_settings, running, underlay
from course_tool.layout import Layout
from course_tool.messages import say

_WORTH_SHOWING = re.compile(
    r"^\s*(Downloading|Downloaded|Building|Built|Prepared|Uninstalled|Installed|Updated)\b"
)

# Runs at the start of every Python of the environment. `_rosbeat_environment` is a link to
# src/rosbeat/environment.py: a broken `rosbeat` must not disturb, so the package is not imported.
_AT_START = (
    "import sys; exec('try:\\n import _rosbeat_environment as e; e.apply()\\n"
    "except Exception:\\n pass')\n"
)

# No question about news at the first start, no look-up of newer versions: a person's own settings
# in JupyterLab still win.
_LAB_DEFAULTS = {
    "@jupyterlab/apputils-extension:notification": {
        "checkForUpdates": False,
        "fetchNews": "false",
    }
}

# What tests bring along, and learners do not have: JupyterLab stays as learners know it.
_ONLY_FOR_TESTS = {
    "servers": (
        "notebook",
        "nbgrader.server_extensions.formgrader",
        "nbgrader.server_extensions.validate_assignment",
        "nbgrader.server_extensions.assignment_list",
        "nbgrader.server_extensions.course_list",
    ),
    "labs": ("@jupyter/nbgrader", "@jupyter-notebook/lab-extension"),
}


def fill(layout: Layout, level: str, environ: Mapping[str, str]) -> None:
    """Install what a level's lock says, and the course's own packages."""
    env = _for_installers(layout, environ)
    if not _uv_is_current(layout):
        say("  2/4  fetching uv, the installer")
        _fetch_uv(layout, env)
    env = {**env, **_pip_settings(layout, env)}
    lock = layout.lock(level)
    count = len(re.findall(r"^[\w.-]+==", lock.read_text(encoding="utf-8"), re.MULTILINE))
    say(f"  3/4  installing what {lock.name} lists ({count} packages at most)")
    _run(layout, lock_command(layout, level), env)
    _run(layout, own_command(layout), env)
    write_start_hook(layout)
    write_lab_defaults(layout)
    underlay.write(layout, environ)


def lock_command(layout: Layout, level: str) -> list[str | Path]:
    """Return the command that installs what a lock lists.

    Not `uv pip sync`: the ROS wheels carry .egg-info folders of their own, which a second sync
    takes for packages that nobody asked for, and removes `rclpy` with them.
    """
    return [
        *(layout.uv, "pip", "install", "--python", layout.python, "--require-hashes"),
        # The lock is complete, and leaves out one package that must not come (override.in).
        "--no-deps",
        # No compiler is needed: empy, one Python file, is the only package without a wheel.
        *("--only-binary", ":all:", "--no-binary", "empy"),
        *("--build-constraint", layout.lock("build"), "-r", layout.lock(level)),
    ]


def own_command(layout: Layout) -> list[str | Path]:
    """Return the command that installs the course's own packages, to be edited in place."""
    return [
        *(layout.uv, "pip", "install", "--python", layout.python, "--offline"),
        *("--no-deps", "--no-build-isolation"),
        *(part for folder in layout.own_packages for part in ("--editable", folder)),
    ]


def write_start_hook(layout: Layout) -> None:
    """Make every Python of the environment set what nodes need, before anything is imported."""
    link = layout.site_packages / "_rosbeat_environment.py"
    link.unlink(missing_ok=True)
    link.symlink_to(layout.root / "src" / "rosbeat" / "environment.py")
    # "zz": .pth files run in this order, and ROS's own starts Python once more.
    hook = layout.site_packages / "zz_rosbeat_environment.pth"
    hook.write_text(_AT_START, encoding="utf-8")


def write_lab_defaults(layout: Layout) -> None:
    """Make a first JupyterLab open without asking anything, and without what is for tests only."""
    share, etc = layout.venv / "share" / "jupyter", layout.venv / "etc" / "jupyter"
    off = dict.fromkeys(_ONLY_FOR_TESTS["servers"], False)
    _write_json(share / "lab" / "settings" / "overrides.json", _LAB_DEFAULTS)
    # "zz": of files that say different things, the last one in the alphabet counts.
    server = etc / "jupyter_server_config.d" / "zz_course.json"
    _write_json(server, {"ServerApp": {"jpserver_extensions": off}})
    lab = {"disabledExtensions": dict.fromkeys(_ONLY_FOR_TESTS["labs"], True)}
    _write_json(etc / "labconfig" / "page_config.json", lab)


def _write_json(path: Path, content: object) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(content, indent=2) + "\n", encoding="utf-8")


def link_mode(layout: Layout, environ: Mapping[str, str]) -> str | None:
    """Return "copy" when uv's cache is on another file system, where it cannot link from."""
    home = environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache")
    cache = Path(environ.get("UV_CACHE_DIR") or os.path.join(home, "uv"))
    return None if _device(cache) == _device(layout.venv) else "copy"


def _for_installers(layout: Layout, environ: Mapping[str, str]) -> dict[str, str]:
    ours = {
        "UV_PYTHON_DOWNLOADS": "never",
        "PIP_DISABLE_PIP_VERSION_CHECK": "1",
        "PIP_USER": "0",
    }
    env = {**environ, **ours}
    for name in ("UV_PYTHON", "VIRTUAL_ENV", "CONDA_PREFIX"):
        env.pop(name, None)
    mode = link_mode(layout, environ)
    if mode and not env.get("UV_LINK_MODE"):
        env["UV_LINK_MODE"] = mode
    # pip's own default is five tries; without a network that only delays the message.
    env.setdefault("PIP_RETRIES", "2")
    return env


def _uv_is_current(layout: Layout) -> bool:
    lock = layout.lock("bootstrap").read_text(encoding="utf-8")
    version = re.search(r"^uv==(\S+)", lock, re.MULTILINE)
    assert version, "bootstrap.lock names uv"
    return layout.uv.exists() and (layout.uv_home / f"uv-{version[1]}.dist-info").is_dir()


def _fetch_uv(layout: Layout, env: Mapping[str, str]) -> None:
    shutil.rmtree(layout.uv_home, ignore_errors=True)
    command: list[str | Path] = [
        *(layout.python, "-I", "-m", "pip", "install", "--quiet", "--require-hashes"),
        *("--only-binary", ":all:", "--target", layout.uv_home),
        *("-r", layout.lock("bootstrap")),
    ]
    result = running.quiet(command, env)
    if not result.ok:
        shutil.rmtree(layout.uv_home, ignore_errors=True)
        raise failures.installing(result.text, layout.venv)


def _pip_settings(layout: Layout, env: Mapping[str, str]) -> dict[str, str]:
    listing = running.quiet([layout.python, "-I", "-m", "pip", "config", "list"], env)
    return pip_settings.for_uv(listing.text, env) if listing.ok else {}


def _run(layout: Layout, command: list[str | Path], env: Mapping[str, str]) -> None:
    result = running.stream(command, env, lambda line: bool(_WORTH_SHOWING.match(line)))
    if not result.ok:
        raise failures.installing(result.text, layout.venv)


def _device(path: Path) -> int:
    existing = next(part for part in (path, *path.parents) if part.exists())
    return existing.stat().st_dev
