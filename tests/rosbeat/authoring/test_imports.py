"""The builder knows nothing of ROS, and only the command line knows the builder."""

from __future__ import annotations

import ast
import sys
from pathlib import Path

import pytest

PACKAGE = Path(__file__).parents[3] / "src" / "rosbeat"
AUTHORING = PACKAGE / "authoring"
THIRD_PARTY = {"jupytext", "nbformat", "nbclient", "jupyter_client"}
ALLOWED = ("rosbeat.errors", "rosbeat.domains", "rosbeat.authoring")


def imports(path):
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            yield node.module or ""


@pytest.mark.parametrize("path", sorted(AUTHORING.rglob("*.py")), ids=lambda path: path.stem)
def test_authoring_imports_errors_domains_and_jupyter_only(path):
    for name in imports(path):
        root = name.split(".")[0]
        is_ours = name.startswith(ALLOWED)
        assert is_ours or root in THIRD_PARTY or root in sys.stdlib_module_names, name


def test_only_the_command_line_imports_authoring():
    users = {
        path.relative_to(PACKAGE).as_posix()
        for path in PACKAGE.rglob("*.py")
        if AUTHORING not in path.parents and any("authoring" in name for name in imports(path))
    }
    assert users == {"cli.py"}
