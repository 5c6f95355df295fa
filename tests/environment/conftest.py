"""Checkouts made of nothing, so that no test touches the real one or a network."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "environment"))

from course_tool.layout import Layout  # noqa: E402


@pytest.fixture
def layout(tmp_path: Path) -> Layout:
    """A checkout with locks, in a folder whose name has a space."""
    found = Layout(tmp_path / "my course")
    found.environment.mkdir(parents=True)
    for name in ("course", "test", "build", "kilted"):
        found.lock(name).write_text(f"# {name}\n")
    found.lock("bootstrap").write_text("uv==1.2.3 \\\n    --hash=sha256:00\n")
    for folder in found.own_packages:
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "pyproject.toml").write_text("[project]\n")
    return found


@pytest.fixture
def made(layout: Layout) -> Layout:
    """The same with a `.venv` that looks finished, up to the stamp."""
    layout.site_packages.mkdir(parents=True)
    layout.python.parent.mkdir()
    executable(
        layout.python, f'echo "{sys.version_info[0]}.{sys.version_info[1]} {sys.base_prefix}"'
    )
    (layout.venv / "bin" / "activate").write_text(f"VIRTUAL_ENV='{layout.venv}'\n")
    return layout


def executable(path: Path, body: str) -> Path:
    """Write a shell script that can be run."""
    path.write_text(f"#!/bin/sh\n{body}\n")
    path.chmod(0o755)
    return path
