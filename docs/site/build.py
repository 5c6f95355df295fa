"""Builds the site of the course from its executed pages and its documents, and shows it.

Nothing is copied by hand: the pages are those of `solutions/`, the documents those of `docs/`, the
landing page is the README. `./environment/course site` calls this file in an environment that has
Sphinx (`environment/site.in`).
"""

from __future__ import annotations

import argparse
import functools
import http.server
import json
import re
import shutil
import subprocess
import sys
import tempfile
import webbrowser
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
HERE = Path(__file__).resolve().parent
#: The documents beside the pages, in the order of the sidebar.
DOCUMENTS = {
    "Help": ("docs/glossary.md", "docs/troubleshooting.md", "environment/README.md"),
    "Your own nodes": ("docs/testing.md",),
    "For instructors": (
        "docs/course_design.md", "docs/instructors.md", "docs/teaching.md", "docs/jupyterhub.md",
        "docs/autograders.md", "docs/nbgrader.md",
        "docs/sandbox.md", "docs/mistakes.md",
    ),
    "For contributors": (
        "docs/CONTRIBUTING.md", "docs/CODE_OF_CONDUCT.md", "docs/SECURITY.md",
        "docs/architecture.md", "docs/simulation.md", "docs/distributions.md",
        "docs/authoring.md", "docs/exercises.md",
        "docs/mutants.md", "docs/claims.md",
        "src/ros2_command/README.md", "src/rosie/README.md",
        "docs/releasing.md", "docs/changelog.md",
    ),
}  # fmt: skip
#: Files that documents link to, offered as they are.
FILES = (
    "LICENSE",
    "docs/results.schema.json",
    "tests/golden/src/lessons/00_hear_a_pulse.py",
)
_COURSE = 7  # pages 00 to 06 are the course, the others are electives
_RECORD = "application/vnd.rosbeat.outcome+json"
_GITHUB = re.compile(
    r"(?:https://(?:[^@/]+@)?|ssh://git@|git@)github\.com[:/]([\w.-]+/[\w.-]+?)(?:\.git)?/?"
)
_HOME = re.compile(r"\]\((?:\.\./)?(?:notebooks/)?home\.ipynb\)")


def stage(target: Path, repository: str = "") -> None:
    """Lay out the source of the site in an empty folder, under the names of the repository.

    Args:
        target: The folder. A link from one document to another holds there as it does in the
            repository; a page of `notebooks/` is the executed one of `solutions/`.
        repository: The owner and name on GitHub, for the links that start the course elsewhere.
    """
    pages = sorted((ROOT / "solutions").glob("[0-9][0-9]_*.ipynb"))
    (target / "notebooks").mkdir(parents=True)
    for page in pages:
        notebook = for_readers(json.loads(page.read_text(encoding="utf-8")))
        first = notebook["cells"][0]
        first["source"] = with_launch(first["source"], repository, page.name)
        text = json.dumps(notebook, ensure_ascii=False)
        (target / "notebooks" / page.name).write_text(text, encoding="utf-8")
    for name in (*(name for part in DOCUMENTS.values() for name in part), *FILES):
        (target / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(ROOT / name, target / name)
        if name.endswith(".md"):
            text = (ROOT / name).read_text(encoding="utf-8")
            (target / name).write_text(with_launch(text, repository), encoding="utf-8")
    shutil.copytree(ROOT / "docs" / "images", target / "docs" / "images")
    landing = with_launch(_landing([page.stem for page in pages]), repository)
    (target / "index.md").write_text(landing, encoding="utf-8")
    shutil.copyfile(HERE / "conf.py", target / "conf.py")
    (target / "_static").mkdir()
    for name in ("site.css", "favicon.svg"):
        shutil.copyfile(HERE / name, target / "_static" / name)


def for_readers(notebook: dict[str, Any]) -> dict[str, Any]:
    """Return a page with its answers folded, and without the progress of whoever built it.

    Args:
        notebook: An executed page, as nbformat 4 describes it.
    """
    cells = []
    for cell in notebook["cells"]:
        source = "".join(cell["source"])
        if cell["cell_type"] == "markdown":
            cells.append({**cell, "source": _HOME.sub("](../index.md#the-pages)", source)})
            continue
        if source.rstrip().endswith("progress()"):
            continue
        mine = cell["metadata"].get("rosbeat", {})
        tags = []
        if "exercise" in mine:
            tags = ["hide-input"]
        elif "check" in mine or re.search(r"^(predict|quiz)\(", source, re.MULTILINE):
            tags = ["hide-cell"]
        # The record of a check is for graders; its card says the same.
        outputs = [
            {**one, "data": {kind: text for kind, text in one["data"].items() if kind != _RECORD}}
            if "data" in one
            else one
            for one in cell["outputs"]
        ]
        metadata = {**cell["metadata"], "tags": tags}
        cells.append({**cell, "metadata": metadata, "outputs": outputs})
    # With IPython's lexer, a cell of %%terminal or %%save is not read as Python.
    language = {"name": "python", "pygments_lexer": "ipython3"}
    return {
        **notebook,
        "cells": cells,
        "metadata": {**notebook["metadata"], "language_info": language},
    }


def with_launch(text: str, repository: str, page: str = "home.ipynb") -> str:
    """Return a text in Markdown with a line below its title that starts the course elsewhere.

    Args:
        text: The text. It stays as it is if it leads to Binder already.
        repository: The owner and name on GitHub; without them, nobody could start it.
        page: What Binder opens, in the learner's folder.
    """
    if not repository or f"//mybinder.org/v2/gh/{repository}" in text:
        return text
    binder = f"https://mybinder.org/v2/gh/{repository}/HEAD?urlpath=lab/tree/{page}"
    links = (("Binder", binder), ("GitHub Codespaces", f"https://codespaces.new/{repository}"))
    shown = " ".join(f'<a href="{address}">{name}</a>' for name, address in links)
    title, _, rest = text.partition("\n")
    return f'{title}\n\n<p class="launch">Start without installing: {shown}</p>\n{rest}'


def on_github() -> str:
    """Return the owner and name of this repository, if `origin` is on GitHub, else nothing."""
    command = ["git", "remote", "get-url", "origin"]
    if not shutil.which("git"):
        return ""
    answer = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    found = _GITHUB.fullmatch(answer.stdout.strip())
    return found[1] if found else ""


def _landing(pages: list[str]) -> str:
    """Return the README as a landing page, with the tables of contents that Sphinx asks for."""
    readme = _HOME.sub("](#the-pages)", (ROOT / "README.md").read_text(encoding="utf-8"))
    parts = {
        "The course": [f"notebooks/{name}" for name in pages[:_COURSE]],
        "Electives": [f"notebooks/{name}" for name in pages[_COURSE:]],
        **DOCUMENTS,
    }
    for title, names in parts.items():
        listed = "\n".join(name.removesuffix(".md") for name in names)
        readme += f"\n```{{toctree}}\n:hidden:\n:caption: {title}\n\n{listed}\n```\n"
    return readme


def build(out: Path) -> int:
    """Build the site into a folder; return Sphinx's exit code. Every warning is an error."""
    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder) / "source"
        source.mkdir()
        stage(source, on_github())
        command = [sys.executable, "-m", "sphinx", "-b", "html", "-W", "--keep-going", "-q"]
        return subprocess.call([*command, "-d", f"{folder}/doctrees", str(source), str(out)])


def show(out: Path) -> None:
    """Serve a folder on localhost, open it in a browser, and wait for Ctrl+C."""
    handler = functools.partial(http.server.SimpleHTTPRequestHandler, directory=str(out))
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        address = f"http://127.0.0.1:{server.server_port}/"
        print(f"The site is at {address}\nCtrl+C stops it.", flush=True)
        webbrowser.open(address)
        try:
            server.serve_forever()
        except KeyboardInterrupt:
            print()


def main() -> int:
    """Read the command line, build the site, and show it if asked to."""
    parser = argparse.ArgumentParser(prog="./environment/course site", description=__doc__)
    parser.add_argument("folder", nargs="?", type=Path, default=ROOT / "dist" / "site",
                        help="where to (dist/site unless told)")  # fmt: skip
    parser.add_argument("--open", action="store_true", help="serve it on localhost and open it")
    options = parser.parse_args()
    code = build(options.folder)
    if code == 0:
        print(f"The site is in {options.folder}")
        if options.open:
            show(options.folder)
    return code


if __name__ == "__main__":
    sys.exit(main())
