"""Lays out the source of the site: the pages as they are read, the documents, the landing page.

Nothing is copied by hand: the pages are those of `src/lessons/` and `solutions/`, the documents
those of `docs/`, the landing page is the README. `./environment/course site` calls this file with
the course's Python, and then `build.py`, which makes the site of it.
"""

from __future__ import annotations

import json
import re
import shutil
import subprocess
import sys
from pathlib import Path

from rosbeat.authoring.source import Course

ROOT = Path(__file__).resolve().parents[2]
HERE = Path(__file__).resolve().parent
if str(HERE) not in sys.path:  # also where this file is loaded by its path
    sys.path.insert(0, str(HERE))

from reading import HOME_LINK, for_readers  # noqa: E402 - found only from here on

#: The documents beside the pages, in the order of the sidebar.
DOCUMENTS = {
    "Help": (
        "docs/help.md", "docs/cheat_sheet.md", "docs/two_computers.md", "docs/glossary.md",
        "docs/troubleshooting.md", "environment/README.md",
    ),
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
        "src/ros2_command/README.md", "src/rosie/README.md", "docs/releasing.md",
        "docs/changelog.md",
    ),
}  # fmt: skip
#: Files that documents link to, offered as they are.
FILES = (
    "LICENSE",
    "docs/results.schema.json",
    "tests/golden/src/lessons/00_hear_a_pulse.py",
)
_COURSE = 7  # pages 00 to 06 are the course, the others are electives
_GITHUB = re.compile(
    r"(?:https://(?:[^@/]+@)?|ssh://git@|git@)github\.com[:/]([\w.-]+/[\w.-]+?)(?:\.git)?/?"
)


def stage(target: Path, repository: str = "") -> None:
    """Lay out the source of the site in an empty folder, under the names of the repository.

    Args:
        target: The folder. A link from one document to another holds there as it does in the
            repository; a page of `notebooks/` is made for readers (`reading.py`).
        repository: The owner and name on GitHub, for the links that start the course elsewhere.
    """
    course = Course(ROOT)
    lessons = [lesson for lesson in course.lessons() if lesson.number]
    (target / "notebooks").mkdir(parents=True)
    for lesson in lessons:
        name = f"{lesson.name}.ipynb"
        solution = json.loads((course.solutions / name).read_text(encoding="utf-8"))
        notebook = for_readers(solution, lesson)
        first = notebook["cells"][0]
        first["source"] = with_launch(first["source"], repository, name)
        text = json.dumps(notebook, ensure_ascii=False)
        (target / "notebooks" / name).write_text(text, encoding="utf-8")
    for name in (*(name for part in DOCUMENTS.values() for name in part), *FILES):
        (target / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(ROOT / name, target / name)
        if name.endswith(".md"):
            text = (ROOT / name).read_text(encoding="utf-8")
            (target / name).write_text(with_launch(text, repository), encoding="utf-8")
    shutil.copytree(ROOT / "docs" / "images", target / "docs" / "images")
    landing = with_launch(_landing([lesson.name for lesson in lessons]), repository)
    (target / "index.md").write_text(landing, encoding="utf-8")
    shutil.copyfile(HERE / "conf.py", target / "conf.py")
    (target / "_static").mkdir()
    for name in ("site.css", "site.js", "favicon.svg"):
        shutil.copyfile(HERE / name, target / "_static" / name)


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
    readme = HOME_LINK.sub("](#the-pages)", (ROOT / "README.md").read_text(encoding="utf-8"))
    parts = {
        "The course": [f"notebooks/{name}" for name in pages[:_COURSE]],
        "Electives": [f"notebooks/{name}" for name in pages[_COURSE:]],
        **DOCUMENTS,
    }
    for title, names in parts.items():
        listed = "\n".join(name.removesuffix(".md") for name in names)
        readme += f"\n```{{toctree}}\n:hidden:\n:caption: {title}\n\n{listed}\n```\n"
    return readme


if __name__ == "__main__":
    stage(Path(sys.argv[1]), on_github())
