"""Build the two trees of pages from a lesson, in steps that each change the page.

The steps are in `notebook_page` and `solution_page`. Until the last one, a cell's metadata hold the
line of the source.
"""

from __future__ import annotations

import os
import re
import tempfile
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import groupby
from pathlib import Path
from typing import Any

import nbformat
from nbformat import NotebookNode, v4

from rosbeat.authoring.execution import DISPLAY_NAME, KERNEL_NAME, run_page
from rosbeat.authoring.source import HOME, Lesson, SourceCell, with_answers, with_blanks
from rosbeat.errors import LessonError

#: nbval's tag for a cell whose output is stored and not compared.
UNCOMPARED = "nbval-ignore-output"

_USUAL_POINTS = 1
_NBGRADER_SCHEMA = 3
_NO_ROLE = {"grade": False, "locked": False, "solution": False, "task": False}
_PAGE_KEYS = ("kernelspec", "language_info", "title", "rosbeat")
_CELL_KEYS = ("nbgrader", "rosbeat", "tags")

_CELL_FILE = re.compile(r"[^\s\"'(]*ipykernel_\d+[^\s\"')]*\.py|(?<=\()\d+\.py(?=, line)")
_COLOUR = re.compile(r"\x1b\[[0-9;]*m")
#: A frame of an installed library, with its line of code; and what marks a part of a line.
_LIBRARY_FRAME = re.compile(r'(?m)^  File "[^"\n]*site-packages[^"\n]*", line .*\n(?:    .*\n)*')
_MARKS = re.compile(r"(?m)^    [ ^~]*[\^~][ ^~]*\n")
_UNREPEATABLE = {
    "a memory address": re.compile(r"\b0x[0-9a-f]{6,}\b"),
    # The colours of `%%terminal` are the same everywhere: bold, three numbers, and their ends.
    "a terminal colour": re.compile(r"\x1b\[(?!(?:0|1|39|38;2;\d+;\d+;\d+)m)"),
}


def notebook_page(
    lesson: Lesson,
    points: Mapping[str, int] | None = None,
    lessons: Sequence[Lesson] = (),
) -> NotebookNode:
    """Make the page a learner opens: blanks, no outputs.

    Args:
        lesson: The lesson source.
        points: What each exercise is worth, by its id; one point where nothing is said.
        lessons: All lessons of the course, in order; the page links to its neighbours.

    Raises:
        LessonError: An answer marker is wrong.
    """
    page = assemble(lesson, "notebook", with_blanks, lessons)
    return _finished(page, points)


def solution_page(
    lesson: Lesson,
    folder: Path,
    fresh: bool = False,
    points: Mapping[str, int] | None = None,
    lessons: Sequence[Lesson] = (),
    run: Callable[[NotebookNode, Path], object] = run_page,
) -> NotebookNode:
    """Make the solution page: answers, run from top to bottom, outputs stored.

    Args:
        lesson: The lesson source.
        folder: The kernel's current directory, and where the page is kept.
        fresh: Store new outputs in cells of which the outputs are not compared, too.
        points: What each exercise is worth, by its id; one point where nothing is said.
        lessons: All lessons of the course, in order.
        run: Runs the page in the folder; by default in a fresh kernel of its own.

    Raises:
        LessonError: An answer marker is wrong, a cell fails, or an output is not repeatable.
    """
    page = assemble(lesson, "solution", with_answers, lessons)
    run(page, folder)
    merge_streams(page)
    quiet_failures(page)
    refuse_unrepeatable(page)
    if not fresh:
        keep_uncompared(page, folder / f"{lesson.name}.ipynb")
    return _finished(page, points)


def to_bytes(page: NotebookNode) -> bytes:
    """Return a page as it stands in a file."""
    nbformat.validate(page)
    text: str = nbformat.writes(page)
    return (text.rstrip("\n") + "\n").encode()


def read_page(path: Path) -> NotebookNode | None:
    """Read a page; None if there is no notebook in the file."""
    try:
        return nbformat.read(path, as_version=4)
    except Exception:  # whatever the file is, it is nothing that the builder wrote
        return None


# Before a page runs.

#: At the foot of every page, for who is stuck.
_HELP = "**Help:** " + " \N{MIDDLE DOT} ".join(
    f"[{name}](../docs/{place})"
    for name, place in (
        *(("cheat sheet", "cheat_sheet.md"), ("glossary", "glossary.md")),
        ("troubleshooting", "troubleshooting.md"),
        *(("keys", "help.md#keys"), ("doctor", "help.md#doctor")),
        ("where to ask", "help.md#where-to-ask"),
    )
)
_GLOSSARY = Path("docs", "glossary.md")
_TO_GLOSSARY = re.compile(r"(?<=\]\(\.\./docs/glossary\.md)#([\w-]+)(?=\))")
_ENTRY = re.compile(r"^## ([^\n]+)\n\n(.+?)\s+Page\s+\d\d:", re.MULTILINE | re.DOTALL)
_LINK_TEXT = re.compile(r"\[([^\]]+)\]\([^)]+\)")
#: What answers a prediction: whoever has compared theirs sees it open (`exercises/widgets.js`).
_FOLDED = """\
<details class="rosbeat-answer"><summary>After your prediction: what happened</summary>

{}

</details>"""


def assemble(
    lesson: Lesson, tree: str, text: Callable[[str], str], lessons: Sequence[Lesson]
) -> NotebookNode:
    """Make a page that has not run, with links to its neighbours and to help at its end.

    Args:
        lesson: The lesson source.
        tree: `notebook` or `solution`; cells meant for the other one are left out.
        text: Fills the answers of a code cell in, or puts blanks in their place.
        lessons: All lessons of the course, in order; without any there is nothing to link to.
    """
    is_folded = tree == "notebook"
    cells = [_cell(cell, text, is_folded) for cell in lesson.cells if cell.only in (None, tree)]
    _define_terms(cells, lesson)
    if lessons:
        cells.append(v4.new_markdown_cell("\n\n".join([*_neighbours(lesson, lessons), _HELP])))
        # Not the same on every page: grading takes ids for a sign of which page a notebook is.
        cells[-1].id = f"foot-{lesson.number or lesson.name}"
    page = v4.new_notebook(cells=cells)
    # Fixed, so that a newer nbformat does not rewrite every page.
    page.nbformat, page.nbformat_minor = 4, 5
    page.metadata.kernelspec = {
        "display_name": DISPLAY_NAME,
        "language": "python",
        "name": KERNEL_NAME,
    }
    page.metadata.language_info = {"name": "python"}
    page.metadata.title = lesson.header.title
    page.metadata.rosbeat = {"lesson": lesson.name}
    return page


def _cell(cell: SourceCell, text: Callable[[str], str], is_folded: bool) -> Any:  # noqa: ANN401 - untyped library
    is_code = cell.kind == "code"
    make = v4.new_code_cell if is_code else v4.new_markdown_cell
    made = make(text(cell.page_text) if is_code else cell.page_text)
    if cell.answers and is_folded:
        made.source = _FOLDED.format(cell.page_text)
    made.id = cell.id
    made.metadata.line = cell.line
    if cell.tags:
        made.metadata.tags = list(cell.tags)
    roles = {"exercise": cell.exercise, "check": cell.check}
    marks: dict[str, object] = {role: name for role, name in roles.items() if name}
    if cell.shows:
        marks["shows"] = True
    if marks:
        made.metadata.rosbeat = marks
    return made


def definitions(glossary: str) -> dict[str, str]:
    """Return what each term of the glossary means, in plain words, by the anchor of its entry."""
    return {
        # As the site and JupyterLab make an anchor of a heading.
        re.sub(r"[^a-z0-9 -]", "", term.lower()).replace(" ", "-"): " ".join(
            re.sub("[*`]", "", _LINK_TEXT.sub(r"\1", meaning)).split()
        )
        for term, meaning in _ENTRY.findall(glossary)
    }


def _define_terms(cells: list[Any], lesson: Lesson) -> None:
    """Let each link to the glossary show what the term means when somebody points at it."""
    path = lesson.path.parents[2] / _GLOSSARY
    known = definitions(path.read_text(encoding="utf-8")) if path.exists() else {}

    def titled(link: re.Match[str]) -> str:
        meaning = known.get(link[1], "").replace('"', '\\"')
        return f'{link[0]} "{meaning}"' if meaning else link[0]

    for cell in cells:
        if cell.cell_type == "markdown":
            cell.source = _TO_GLOSSARY.sub(titled, cell.source)


def _neighbours(lesson: Lesson, lessons: Sequence[Lesson]) -> list[str]:
    """Return the line with links to the pages before and after, if this is one of them."""
    pages = [one for one in lessons if one.number]
    names = [one.name for one in pages]
    if lesson.name not in names:
        return []
    at = names.index(lesson.name)
    has_home = any(one.name == HOME for one in lessons)
    before, after = pages[:at][-1:], pages[at + 1 :][:1]
    links = [
        *(f"\N{LEFTWARDS ARROW} {_link(one)}" for one in before),
        *([f"[The whole course]({HOME}.ipynb)"] if has_home else []),
        *(f"{_link(one)} \N{RIGHTWARDS ARROW}" for one in after),
    ]
    return [" | ".join(links)] if links else []


def _link(lesson: Lesson) -> str:
    return f"[{lesson.number} {lesson.header.title}]({lesson.name}.ipynb)"


def _finished(page: NotebookNode, points: Mapping[str, int] | None) -> NotebookNode:
    mark_for_nbgrader(page, points or {})
    keep_known_metadata(page)
    return page


def mark_for_nbgrader(page: NotebookNode, points: Mapping[str, int]) -> None:
    """Tell nbgrader what the cells of exercises and checks are.

    An institution that runs nbgrader can use the pages as they are; the course itself looks at
    nothing of this. The cells of an answer become solution cells, which learners change; the check
    below them becomes a locked cell, which nbgrader puts back before it grades, and which gives the
    points. The fields are those of the schema's version 3 (`nbgrader/nbgraderformat/v3.py`).

    Args:
        page: The page.
        points: What each exercise is worth, by its id; one point where nothing is said.
    """
    parts: Counter[str] = Counter()
    for cell in page.cells:
        role = cell.metadata.get("rosbeat", {})
        if "exercise" in role:
            parts[role.exercise] += 1
            part = parts[role.exercise]
            # A second cell of the same exercise has a name of its own.
            name = role.exercise if part == 1 else f"{role.exercise}-{part}"
            cell.metadata.nbgrader = _role(name, solution=True)
        elif "check" in role:
            worth = points.get(role.check, _USUAL_POINTS)
            name = f"{role.check}-check"
            cell.metadata.nbgrader = _role(name, grade=True, locked=True, points=worth)


def _role(name: str, **known: int) -> NotebookNode:
    fields = {**_NO_ROLE, "grade_id": name, "schema_version": _NBGRADER_SCHEMA, **known}
    return NotebookNode(fields)


def keep_known_metadata(page: NotebookNode) -> None:
    """Drop metadata that Jupyter, nbclient or the builder added on the way.

    Versions of Python, times of execution and editors' notes would change from build to build.
    """
    page.metadata = _only(page.metadata, _PAGE_KEYS)
    page.metadata.language_info = {"name": "python"}
    for cell in page.cells:
        cell.metadata = _only(cell.metadata, _CELL_KEYS)
        for output in cell.get("outputs", ()):
            if "metadata" in output:
                output.metadata = NotebookNode()


def _only(metadata: NotebookNode, names: tuple[str, ...]) -> NotebookNode:
    return NotebookNode({name: metadata[name] for name in names if name in metadata})


# The outputs that a run leaves.


def merge_streams(page: NotebookNode) -> None:
    """Join the chunks of a stream between two other outputs, stdout before stderr.

    A kernel sends what is printed whenever a timer says so; where the pieces are cut, and how the
    two streams interleave, is chance and must not show in a page.
    """
    for cell in _code(page):
        merged: list[Any] = []
        for is_stream, group in groupby(cell.outputs, lambda one: one.output_type == "stream"):
            outputs = list(group)
            merged += _joined(outputs) if is_stream else outputs
        cell.outputs = merged


def _joined(run: list[Any]) -> Iterator[NotebookNode]:
    for name in ("stdout", "stderr"):
        text = "".join(stream.text for stream in run if stream.name == name)
        if text:
            yield v4.new_output("stream", name=name, text=text)


def quiet_failures(page: NotebookNode) -> None:
    """Reduce every traceback to the error's name and message.

    Frames name files of the machine and lines of the Python version that built the page. Of one
    that a simulated program printed, the learner's own lines stay.
    """
    for cell in _code(page):
        for output in cell.outputs:
            if output.output_type == "error":
                output.evalue = quiet_message(output.evalue)
                output.traceback = f"{output.ename}: {output.evalue}".split("\n")
            elif output.output_type == "stream" and output.name == "stderr":
                output.text = quiet_traceback(output.text)


def quiet_message(message: str) -> str:
    """Replace the names of a kernel's temporary files, and drop colours."""
    return _CELL_FILE.sub("cell", _COLOUR.sub("", message))


def quiet_traceback(printed: str) -> str:
    """Leave the learner's own frames in tracebacks that a program printed, without files.

    The frames of libraries are other ones in another version, and so are the marks below a line.
    """
    return quiet_message(_MARKS.sub("", _LIBRARY_FRAME.sub("", printed)))


def refuse_unrepeatable(page: NotebookNode) -> None:
    """Require that outputs name no address, no folder of this machine and no colour.

    Raises:
        LessonError: A text output holds one of them.
    """
    here = {f"{path}/" for path in (Path.home(), os.getcwd(), tempfile.gettempdir())} - {"//"}
    for cell in _code(page):
        for line in [] if _is_uncompared(cell) else _printed_lines(cell):
            reasons = [name for name, pattern in _UNREPEATABLE.items() if pattern.search(line)]
            reasons += ["a folder of this machine"] if any(path in line for path in here) else []
            if reasons:
                where = f"{page.metadata.rosbeat.lesson}.py:{cell.metadata.line}"
                raise LessonError(
                    f"{where}: the output shows {reasons[0]}: {line.strip()!r}.",
                    "The page would be different on the next run or the next machine.",
                    "Print a value instead of an object, or a path relative to the page.",
                )


def _printed_lines(cell: Any) -> Iterator[str]:  # noqa: ANN401 - untyped library
    for output in cell.outputs:
        plain = output.get("data", {}).get("text/plain", "")
        for text in (output.get("text", ""), output.get("evalue", ""), plain):
            yield from text.splitlines()


def keep_uncompared(page: NotebookNode, path: Path) -> None:
    """Take outputs of tagged cells from the page that is there already.

    What two processes really say to each other cannot come out the same twice. Nothing compares the
    output of such a cell, another cell asserts what matters in it, and a rebuild changes nothing.

    Args:
        page: The page that has run.
        path: The page that is there; it need not exist, nor be readable.
    """
    there = read_page(path)
    stored = filter(_is_uncompared, there.cells if there else ())
    before = {(one.id, one.source): one.outputs for one in stored}
    for cell in filter(_is_uncompared, page.cells):
        kept = before.get((cell.id, cell.source), [])
        if [one.output_type for one in kept] == [one.output_type for one in cell.outputs]:
            cell.outputs = kept


def _is_uncompared(cell: Any) -> bool:  # noqa: ANN401 - untyped library
    return cell.cell_type == "code" and UNCOMPARED in cell.metadata.get("tags", ())


def _code(page: NotebookNode) -> Iterator[Any]:
    return (cell for cell in page.cells if cell.cell_type == "code")
