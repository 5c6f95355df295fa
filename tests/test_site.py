"""What the site is built from: the executed pages, with answers folded, and every link's target.

Sphinx itself, whose warnings are errors, and the browser are in tests/browser/test_site.py.
"""

import importlib.util
import json
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
PAGES = sorted(path.name for path in (ROOT / "solutions").glob("[0-9][0-9]_*.ipynb"))
LINK = re.compile(r"\]\((?!https?:)([^)#\s]+)(?:#[^)]*)?\)")
FENCE = re.compile(r"(?ms)^( *)(```+|~~~+).*?^\1\2")


@pytest.fixture(scope="module")
def staged(tmp_path_factory):
    spec = importlib.util.spec_from_file_location("build_site", ROOT / "docs" / "site" / "build.py")
    build = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(build)
    folder = tmp_path_factory.mktemp("staged")
    build.stage(folder)
    return folder


def cells(path):
    return json.loads(path.read_text("utf-8"))["cells"]


def texts(path):
    """The markdown of a document or a page, without its blocks of code."""
    if path.suffix == ".md":
        return [FENCE.sub("", path.read_text("utf-8"))]
    return ["".join(one["source"]) for one in cells(path) if one["cell_type"] == "markdown"]


@pytest.mark.parametrize("name", PAGES)
def test_a_page_shows_what_the_repository_shows(staged, name):
    there = {one["id"]: one for one in cells(ROOT / "solutions" / name)}
    shown = cells(staged / "notebooks" / name)
    assert len(there) - len(shown) == 1  # the progress of whoever built it
    for one in shown:
        before = there[one["id"]]
        assert [out.get("text") for out in one.get("outputs", [])] == [
            out.get("text") for out in before.get("outputs", [])
        ]
        if "home.ipynb" not in "".join(before["source"]):
            assert "".join(one["source"]) == "".join(before["source"])


@pytest.mark.parametrize("name", PAGES)
def test_answers_are_folded(staged, name):
    folded = {
        one["id"]: one["metadata"]["tags"]
        for one in cells(staged / "notebooks" / name)
        if one["cell_type"] == "code" and one["metadata"]["tags"]
    }
    for one in cells(ROOT / "solutions" / name):
        source = "".join(one["source"])
        if "exercise" in one["metadata"].get("rosbeat", {}):
            assert folded[one["id"]] == ["hide-input"]
        elif "\npredict(" in source or source.startswith("quiz("):
            assert folded[one["id"]] == ["hide-cell"]


def test_every_link_leads_to_something(staged):
    dead = [
        (path.relative_to(staged).as_posix(), target)
        for path in (*staged.rglob("*.md"), *staged.rglob("*.ipynb"))
        for text in texts(path)
        for target in LINK.findall(text)
        if not (path.parent / target).exists()
    ]
    assert dead == []


def test_every_document_is_in_a_table_of_contents(staged):
    listed = set(re.findall(r"(?m)^([\w/]+)$", (staged / "index.md").read_text("utf-8")))
    documents = {
        path.relative_to(staged).with_suffix("").as_posix()
        for path in (*staged.rglob("*.md"), *staged.rglob("*.ipynb"))
    }
    assert documents - listed == {"index"}


def test_the_version_is_the_same_wherever_it_stands():
    version = re.search(r'__version__ = "(.+)"', (ROOT / "src/rosbeat/__init__.py").read_text())
    assert f"version: {version[1]}\n" in (ROOT / "CITATION.cff").read_text()
    assert 'dynamic = ["version"]' in (ROOT / "pyproject.toml").read_text()
    assert f"[{version[1]}]" in (ROOT / "docs/changelog.md").read_text()
