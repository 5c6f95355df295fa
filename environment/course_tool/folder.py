"""The learner's own folder: copies of the pages, made once, and `course reset` and `course update`.

`my_course` holds what a learner works in, and git ignores it: the pages, the workspace, and the
solutions to look at. In its hidden folder `.rosbeat`, beside the progress, `shipped` keeps each
page as it was when it was copied. This tells which pages somebody has worked in, and which answers
still fit a new version of a page.

In a release (`rosbeat release`), the folder of the pages is the learner's own as it stands. Where
many learners share one checkout, `ROSBEAT_MY_COURSE` names the folder of each. `rosbeat new` makes
the same folder, in a place of the learner's, from the pages in a wheel.
"""

from __future__ import annotations

import json
import os
import platform
import subprocess
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any
from uuid import uuid4

from course_tool.installing import KERNEL
from course_tool.layout import Layout
from course_tool.prepare import check_place, check_writable, exclusive
from course_tool.problems import Problem, say

PAGES = "[0-9][0-9]_*.ipynb"
#: The page that shows the whole course, and how far somebody is.
HOME = "home.ipynb"
#: What the folder is called in a solution's banner, and by the style sheet of JupyterLab.
SOLUTIONS = "solutions"
#: The docs that pages link to, glossary and all; JupyterLab follows no link out of its folder.
DOCS = "docs"
_READ_ONLY = 0o444
_RELOAD = """\
If the page is open in JupyterLab: File, Reload Notebook from Disk, which drops unsaved changes."""
_LOCKED = {"editable": False, "deletable": False}
_BANNER = """\
<div class="alert alert-block alert-warning rosbeat-solution"><b>This is a solution</b>, to compare
yours with. It cannot be changed, and nothing that you run here counts for your progress.</div>

Your own page: [{page}](../{page})
"""

#: What JupyterLab writes into a page when it opens it. Where it is there already, a page that was
#: only looked at does not have to be saved.
_OPENED = {
    "kernelspec": {"display_name": KERNEL, "language": "python", "name": "python3"},
    "language_info": {
        "codemirror_mode": {"name": "ipython", "version": 3},
        "file_extension": ".py",
        "mimetype": "text/x-python",
        "name": "python",
        "nbconvert_exporter": "python",
        "pygments_lexer": "ipython3",
        "version": platform.python_version(),
    },
}

_Cell = dict[str, Any]


def make(layout: Layout) -> None:
    """Make the learner's folder, or add what is new; whatever is there stays as it is."""
    check_place(layout.learner)
    check_writable(layout.learner.parent)
    if os.path.lexists(layout.learner) and not layout.learner.is_dir():
        raise Problem(
            f"{layout.learner.name} is not a folder: it is a file, or a link that leads nowhere.",
            "The course keeps your pages in a folder of this name. Nothing was changed.",
            "If it is a link, connect the disk that it leads to. Otherwise rename it.",
        )
    is_new = not layout.notes.is_dir()
    layout.notes.mkdir(parents=True, exist_ok=True)
    with exclusive(layout.learner):
        _write_once(layout.notes / ".gitignore", b"*\n")
        # colcon is to build in the workspace, and to find nothing anywhere else.
        _write_once(layout.learner / "COLCON_IGNORE", b"")
        if not layout.is_release:
            for page in shipped_pages(layout):
                _copy_once(layout, page)
            _copy_home(layout)
            _show_solutions(layout)
        _show_docs(layout)
    if is_new and not layout.is_release:
        say(f"Your own pages are in the folder {layout.learner.name}.")


def shipped_pages(layout: Layout) -> list[Path]:
    """Return the course's pages, in their order."""
    return sorted(layout.shipped.glob(PAGES))


def _copy_home(layout: Layout) -> None:
    """Copy the home page whenever the course has another one; what a learner wrote is kept."""
    source, target, base = layout.shipped / HOME, layout.learner / HOME, _base_of(layout, HOME)
    if not source.exists():
        return
    content, then = source.read_bytes(), base.read_bytes() if base.exists() else b""
    mine = target.read_bytes() if target.exists() else b""
    if mine and _is_same(then, content):
        return
    if mine and not any(_is_same(mine, one) for one in (then, content)):
        say(f"There is a new {HOME}; yours is kept as {_shown(layout, _keep(target))}.")
    if not _is_same(mine, content):
        _write(target, as_opened(content))
    _write(base, content)


def _copy_once(layout: Layout, page: Path) -> None:
    """Copy a page that was not copied before, with what somebody did in the course's own."""
    base = _base_of(layout, page.name)
    if base.exists():
        return
    found = page.read_bytes()
    _write_once(layout.learner / page.name, as_opened(found))
    # Without git, nobody knows what a page was before somebody worked in it.
    _write(base, _of_git(layout, page) or (b"" if _was_run(found) else found))


# The solutions, to look at.


def _show_solutions(layout: Layout) -> None:
    """Copy the solutions to where the learner can open them, with a banner."""
    for path in (layout.root / SOLUTIONS).rglob("*"):
        if path.is_file() and "__pycache__" not in path.parts and path.name != HOME:
            content = path.read_bytes()
            _show(layout, path, as_solution(path.name, content) if path.match(PAGES) else content)


def _show_docs(layout: Layout) -> None:
    """Copy the docs to where links of pages lead; their own links lead to the learner's pages."""
    docs = layout.root / DOCS
    for path in (*docs.glob("*.md"), *docs.glob("images/*")):
        _show(layout, path, path.read_bytes().replace(b"](../notebooks/", b"](../"))


def _show(layout: Layout, path: Path, content: bytes) -> None:
    """Make a read-only file of the learner's folder follow one of the course.

    A file that can be written to is a person's own, and stays, under another name.
    """
    target = layout.learner / path.relative_to(layout.root)
    if target.exists():
        if target.read_bytes() == content:
            return
        if target.stat().st_mode & 0o222:
            say(f"Your {_shown(layout, target)} is kept as {_shown(layout, _keep(target))}.")
    _write(target, content, _READ_ONLY)


def as_solution(name: str, content: bytes) -> bytes:
    """Return a solution page that says what it is, and whose cells JupyterLab does not let change.

    The file's mode alone is not enough: it does not hold back the root user, as in a container.
    """
    page = _read(as_opened(content))
    for cell in page.get("cells", []):
        cell.setdefault("metadata", {}).update(_LOCKED)
    banner = {"cell_type": "markdown", "id": "this-is-a-solution", "metadata": dict(_LOCKED)}
    page["cells"] = [{**banner, "source": _BANNER.format(page=name)}, *page.get("cells", [])]
    return _bytes(page)


# `course reset` and `course update`.


def reset(layout: Layout, arguments: Sequence[str]) -> int:
    """Bring pages back as they are shipped; what was there is kept beside them."""
    _refuse_release(layout)
    make(layout)
    if not arguments:
        raise Problem(
            "The page is not named.",
            "Pages are brought back one by one, so that nothing goes by mistake.",
            "Name it:  ./environment/course reset 03",
        )
    for page in _named(layout, arguments):
        content = _shipped_bytes(layout, page) or page.read_bytes()
        target = layout.learner / page.name
        is_own = target.exists() and not _is_same(target.read_bytes(), content)
        before = f"; yours is kept as {_shown(layout, _keep(target))}" if is_own else ""
        _write(target, as_opened(content))
        _write(_base_of(layout, page.name), content)
        say(f"{_shown(layout, target)} is as shipped{before}.")
    say(_RELOAD)
    return 0


def update(layout: Layout, arguments: Sequence[str]) -> int:
    """Take new versions of pages: of those nobody has worked in, and of those that are named."""
    _refuse_release(layout)
    make(layout)
    named = _named(layout, arguments)
    changes = [
        _update_one(layout, page, page in named)
        for page in (named or shipped_pages(layout))
        if is_newer(layout, page)
    ]
    for line in changes or ["Your pages are those of the course."]:
        say(line)
    if any(line.startswith("updated") for line in changes):
        say(_RELOAD)
    return 0


def is_newer(layout: Layout, page: Path) -> bool:
    """Tell whether the course has another version of a page than the one that was copied."""
    target, base = layout.learner / page.name, _base_of(layout, page.name)
    if not base.exists() or not target.exists() or base.read_bytes() == page.read_bytes():
        return False  # without a target, the learner has removed the page
    content = _shipped_bytes(layout, page)
    known = base.read_bytes(), target.read_bytes()
    return bool(content) and not any(_is_same(content, one) for one in known)


def _update_one(layout: Layout, page: Path, carries: bool) -> str:
    target, base = layout.learner / page.name, _base_of(layout, page.name)
    mine, then, now = target.read_bytes(), base.read_bytes(), _shipped_bytes(layout, page)
    if _is_same(mine, then):
        # It was run perhaps; what it said is kept, but out of the way.
        _write(_free_name(layout.notes / "before" / page.name, "before"), mine)
        _write(target, as_opened(now))
        _write(base, now)
        return f"updated  {page.name}"
    if not carries:
        return (
            f"yours    {page.name}: you have worked in it, so it stays. To have the new version\n"
            f"         with your answers in it:  {layout.update_command(page.name[:2])}"
        )
    after, fit, others = carried(mine, then, now)
    kept = _keep(target)
    _write(target, after)
    _write(base, now)
    went = f"your answers to {', '.join(fit)} are in it" if fit else "no answer fits it"
    left = f"; {', '.join(others)} changed, so your answer is only in the old one" if others else ""
    old = f"The old page, with everything else that you wrote, is {_shown(layout, kept)}"
    return f"updated  {page.name}: {went}{left}.\n         {old}"


def carried(mine: bytes, then: bytes, now: bytes) -> tuple[bytes, list[str], list[str]]:
    """Put answers into a new version of their page, where the cell to fill in is the same.

    Args:
        mine: The learner's page.
        then: The page as it was when the learner got it.
        now: The new version.

    Returns:
        The new page; the ids of the exercises whose answers are in it; the ids of those whose
        answers do not fit it.
    """
    page = _read(as_opened(now))
    blanks, new = _exercises(_read(then or now)), _exercises(page)
    fit: list[str] = []
    others: list[str] = []
    answers = _exercises(_read(mine))
    for mine_cell in answers:
        name, text = _exercise(mine_cell), _text(mine_cell)
        known = [one for one in blanks if _exercise(one) == name]
        same_id = [one for one in known if one.get("id") == mine_cell.get("id")]
        blank = _text((same_id or known)[0]) if same_id or len(known) == 1 else None
        places = [one for one in new if _exercise(one) == name and _text(one) == blank]
        if text == blank:
            continue
        # Split into more cells than there were, an answer would arrive in part.
        if sum(_exercise(one) == name for one in answers) > len(known):
            places = []
        if places:
            places[0]["source"] = text
        (fit if places else others).append(name)
    return _bytes(page), [*dict.fromkeys(fit)], [*dict.fromkeys(others)]


def _exercise(cell: _Cell) -> str:
    """Return the id of the exercise that a cell is to be filled in for, or an empty text."""
    return str(cell.get("metadata", {}).get("rosbeat", {}).get("exercise", ""))


def _exercises(page: Mapping[str, Any]) -> list[_Cell]:
    return [cell for cell in page.get("cells", []) if _exercise(cell)]


def _refuse_release(layout: Layout) -> None:
    if layout.is_release:
        raise Problem(
            "In this folder, the pages of the course are your own.",
            "There is no other copy of them here: your class works in notebooks itself.",
            "Ask whoever gave you the folder for the page, and save it under another name.",
        )


def _named(layout: Layout, names: Sequence[str]) -> list[Path]:
    """Return the pages with these numbers or names."""
    pages = shipped_pages(layout)
    found = []
    for name in names:
        wanted = Path(name).name.removesuffix(".ipynb")
        number = wanted.zfill(2)
        fitting = [one for one in pages if wanted == one.stem or number == one.name[:2]]
        if not wanted or not fitting:
            raise Problem(
                f"There is no page '{name}'.",
                "Nothing was changed.",
                f"The pages are {', '.join(one.name[:2] for one in pages)}.",
            )
        found += fitting
    return found


# Files.


def _shipped_bytes(layout: Layout, page: Path) -> bytes:
    """Return a page as shipped, also if somebody has worked in the course's own copy.

    Without git, that is what the learner got; empty if nobody knows.
    """
    content, base = page.read_bytes(), _base_of(layout, page.name)
    if _read(content) and not _was_run(content):
        return content
    return _of_git(layout, page) or (base.read_bytes() if base.exists() else b"")


def _of_git(layout: Layout, page: Path) -> bytes | None:
    """Return the committed version of a page; None where git does not have it as shipped."""
    command = ["git", "-C", str(layout.root), "show", f"HEAD:./{page.relative_to(layout.root)}"]
    try:
        done = subprocess.run(command, capture_output=True, check=False, stdin=subprocess.DEVNULL)
    except OSError:
        return None
    # Somebody may have committed what they did in the page.
    return done.stdout if done.returncode == 0 and not _was_run(done.stdout) else None


def _base_of(layout: Layout, name: str) -> Path:
    # Not as .ipynb: whoever hands in the whole folder hands in each page once.
    return (layout.notes / "shipped" / name).with_suffix(".json")


def _keep(path: Path) -> Path:
    """Copy a file to a free name beside it, and return that."""
    aside = _free_name(path, "kept")
    _write(aside, path.read_bytes())
    return aside


def _free_name(path: Path, word: str) -> Path:
    number = 1
    while os.path.lexists(free := path.with_name(f"{path.stem}-{word}-{number}{path.suffix}")):
        number += 1
    return free


def _write_once(path: Path, content: bytes) -> None:
    if not path.exists():
        _write(path, content)


def _write(path: Path, content: bytes, mode: int | None = None) -> None:
    """Put a file in place in one step, so that an interruption leaves no half of it."""
    path.parent.mkdir(parents=True, exist_ok=True)
    beside = path.with_name(f".saving-{uuid4().hex[:12]}")
    try:
        beside.write_bytes(content)
        if mode is not None:
            beside.chmod(mode)
        beside.replace(path)
    finally:
        beside.unlink(missing_ok=True)


def _shown(layout: Layout, path: Path) -> str:
    return str(path.relative_to(layout.learner.parent))


# What is in a page.


def as_opened(content: bytes) -> bytes:
    """Return a page as it is when JupyterLab has opened it; what is no page stays as it is."""
    page = _read(content)
    page.get("metadata", {}).update(_OPENED)
    return _bytes(page) if page else content


def _read(content: bytes) -> dict[str, Any]:
    """Return a notebook as plain data; empty if it cannot be read."""
    try:
        page = json.loads(content)
    except ValueError:
        return {}
    cells = page.get("cells") if isinstance(page, dict) else None
    whole = isinstance(cells, list) and all(isinstance(one, dict) for one in cells)
    return page if whole else {}


def _bytes(page: Mapping[str, Any]) -> bytes:
    return (json.dumps(page, indent=1, ensure_ascii=False) + "\n").encode("utf-8")


def _text(cell: _Cell) -> str:
    source = cell.get("source", "")
    return source if isinstance(source, str) else "".join(source)


def _sources(content: bytes) -> list[tuple[str, str]]:
    """Return what a person can write in a page: the sort and the text of each cell."""
    return [(cell.get("cell_type", ""), _text(cell)) for cell in _read(content).get("cells", [])]


def _is_same(one: bytes, other: bytes) -> bool:
    """Tell whether two pages, which both can be read, differ in their outputs at most."""
    return bool(_read(one)) and _sources(one) == _sources(other)


def _was_run(content: bytes) -> bool:
    cells = _read(content).get("cells", [])
    return any(cell.get("outputs") or cell.get("execution_count") for cell in cells)
