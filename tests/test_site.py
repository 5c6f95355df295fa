"""What the site is built from: the executed pages, with answers folded, and every link's target.

Sphinx itself, whose warnings are errors, and the browser are in tests/browser/test_site.py.
"""

import importlib.util
import json
import re
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
PAGES = sorted(path.name for path in (ROOT / "solutions").glob("[0-9][0-9]_*.ipynb"))
LINK = re.compile(r"\]\((?!https?:)([^)#\s]+)(?:#[^)]*)?\)")
FENCE = re.compile(r"(?ms)^( *)(```+|~~~+).*?^\1\2")


@pytest.fixture(scope="module")
def build():
    spec = importlib.util.spec_from_file_location("build_site", ROOT / "docs" / "site" / "build.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def staged(build, tmp_path_factory):
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


def test_every_page_can_be_started_elsewhere_once_the_repository_is_known(build, tmp_path):
    build.stage(tmp_path, "ada/rosbeat")
    for path in (*tmp_path.rglob("*.md"), *tmp_path.rglob("*.ipynb")):
        if path.suffix == ".md":
            title, text = path.read_text("utf-8").split("\n", 1)
        else:
            title, text = "".join(cells(path)[0]["source"]).split("\n", 1)
        assert title.startswith("# ")
        page = path.name if path.suffix == ".ipynb" else "home.ipynb"
        assert text.count(f"mybinder.org/v2/gh/ada/rosbeat/HEAD?urlpath=lab/tree/{page}") == 1
        assert text.count("https://codespaces.new/ada/rosbeat") == 1


def test_a_readme_with_its_own_links_keeps_them(build):
    text = "# rosbeat\n\n[Binder](https://mybinder.org/v2/gh/ada/rosbeat/HEAD)\n"
    assert build.with_launch(text, "ada/rosbeat") == text


@pytest.mark.parametrize(
    ("remote", "found"),
    [
        ("https://github.com/ada/rosbeat", "ada/rosbeat"),
        ("https://github.com/ada/ros.beat.git", "ada/ros.beat"),
        ("https://x-access-token:secret@github.com/ada/rosbeat.git", "ada/rosbeat"),
        ("git@github.com:ada/rosbeat.git", "ada/rosbeat"),
        ("ssh://git@github.com/ada/rosbeat", "ada/rosbeat"),
        ("https://gitlab.com/ada/rosbeat.git", ""),
        ("https://example.org/github.com/ada/rosbeat", ""),
        ("", ""),
    ],
)
def test_the_repository_is_where_origin_is(build, monkeypatch, tmp_path, remote, found):
    subprocess.run(["git", "init", "-q", tmp_path], check=True)
    if remote:
        subprocess.run(["git", "remote", "add", "origin", remote], cwd=tmp_path, check=True)
    monkeypatch.setattr(build, "ROOT", tmp_path)
    assert build.on_github() == found


def test_the_version_is_the_same_wherever_it_stands():
    version = re.search(r'__version__ = "(.+)"', (ROOT / "src/rosbeat/__init__.py").read_text())
    assert f"version: {version[1]}\n" in (ROOT / "CITATION.cff").read_text()
    assert 'dynamic = ["version"]' in (ROOT / "pyproject.toml").read_text()
    assert f"[{version[1]}]" in (ROOT / "docs/changelog.md").read_text()
