"""Read lesson sources, `src/lessons/NN_slug.py` in jupytext's percent format, into plain data.

A source is a Python file that runs, with the answers in place. Each answer, and the blank that
replaces it for the learner, are between markers, on separate lines at the indentation of the code::

    # --- answer
    self.timer = self.create_timer(1.0, self.publish_temperature)
    # --- blank
    # self.timer = self.create_timer(____, ____)
    # --- end

Text that is not Python (terminal commands, files of another kind) is written in comments.
"""

from __future__ import annotations

import hashlib
import re
from collections import Counter
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import jupytext

from rosbeat.errors import LessonError

BLANK = "____"
SAVE = "%%save "

#: The page that shows the whole course; it has no number, and no exercises.
HOME = "home"

_FILE_NAME = re.compile(rf"\d\d_[a-z0-9]+(_[a-z0-9]+)*\.py|{HOME}\.py")
_EXAMPLE = ("# ---", "# title: Write a publisher", "# minutes: 40", '# needs: ["00", "03"]',
            "# summary: One sentence for lists of pages.", "# ---")  # fmt: skip
_NUMBERS = r"""(?:["']?\d\d["']?(?:, *|(?=\])))*"""
_HEADER = ("# ---", r"# title: *(.+)", r"# minutes: *(\d+)", rf"# needs: *\[({_NUMBERS})\]",
           r"# summary: *(.+)", "# ---")  # fmt: skip

_MARKER = re.compile(r"# ?%%(\s|$)")
_KNOWN_KEYS = {
    *("answers", "exercise", "check", "only", "predict", "shows", "tags", "terminal", "save"),
}
#: What a key may be where not every text or list is allowed.
_VALUES = {
    "only": ("notebook", "solution"),
    "predict": (True,),
    "shows": (True,),
    "answers": (True,),
}
# jupytext would take `# ls` for a magic, and its comment sign away.
_FORMAT = {"extension": ".py", "format_name": "percent", "comment_magics": False}
# jupytext's note to itself about blank lines; it says nothing about the cell.
_JUPYTEXT_KEYS = {"lines_to_next_cell", "lines_to_end_of_cell_marker"}

_BLOCK = re.compile(
    r"^(?P<indent> *)# --- answer\n(?P<answer>(?:.*\n)*?)(?P=indent)# --- blank\n"
    r"(?P<blank>(?:(?P=indent)#(?: .*)?\n)*?)(?P=indent)# --- end$",
    re.MULTILINE,
)
# Anything that was probably meant as a marker: other case, other spacing, a word too many.
_NEARLY = re.compile(r"^\s*#\s*-{2,}\s*(answer|blank|end)\b", re.IGNORECASE)


@dataclass(frozen=True)
class Header:
    """Hold the metadata at the top of a lesson.

    Attributes:
        title: Title of the page, beginning with a verb.
        minutes: Time that a learner needs, in minutes.
        needs: Numbers of the pages to read first, such as ``("00", "03")``.
        summary: One-sentence description for lists of pages.
    """

    title: str
    minutes: int
    needs: tuple[str, ...]
    summary: str


@dataclass(frozen=True)
class SourceCell:
    """Hold one cell of a lesson source, including its answer markers.

    Attributes:
        id: Cell id, the same in both trees.
        kind: ``"code"`` or ``"markdown"``.
        source: The text, with answers, blanks and their markers.
        line: Line of the source file on which the text begins.
        exercise: Id of the exercise that is solved here, such as ``"03a"``.
        check: Id of the exercise that is checked here.
        only: ``"notebook"`` or ``"solution"`` if the cell appears in one tree only.
        tags: Jupyter cell tags.
        answers: Whether it tells what the prediction above it is about.
        predict: Whether the learner predicts here what the cell will do.
        shows: Whether it only shows something, so that no exercise depends on it.
        magic: IPython magic that precedes the text on the page, or an empty string.
    """

    id: str
    kind: str
    source: str
    line: int
    exercise: str | None = None
    check: str | None = None
    only: str | None = None
    tags: tuple[str, ...] = ()
    answers: bool = False
    predict: bool = False
    shows: bool = False
    magic: str = ""

    @property
    def page_text(self) -> str:
        """Return the text with its magic, answer markers still included."""
        return f"{self.magic}\n{self.source}".strip("\n") if self.magic else self.source

    @property
    def saved_as(self) -> str:
        """Return the file of the workspace that this cell becomes, or an empty text."""
        return self.magic.removeprefix(SAVE).split()[0] if self.magic.startswith(SAVE) else ""

    @property
    def is_python(self) -> bool:
        """Tell whether the text is Python: no commands for a terminal, no file of another kind."""
        return self.kind == "code" and (not self.magic or Path(self.saved_as).suffix == ".py")

    @property
    def runs(self) -> bool:
        """Tell whether the kernel runs the text; of saved files it runs a package's modules."""
        return self.is_python and Path(self.saved_as).name != "setup.py"


@dataclass(frozen=True)
class Lesson:
    """Hold a parsed lesson source: its file, its header, and its cells in order."""

    path: Path
    header: Header
    cells: tuple[SourceCell, ...]

    @property
    def name(self) -> str:
        """Return the stem of the file name, such as ``03_write_a_publisher``."""
        return self.path.stem

    @property
    def number(self) -> str:
        """Return the page's number, two digits; the home page has none."""
        return "" if self.name == HOME else self.path.name[:2]


@dataclass(frozen=True)
class Block:
    """Hold an answer and the blank that replaces it.

    Attributes:
        line: Line within the cell, counted from 0, of the marker that opens the block.
        answer: Lines of the answer, unchanged.
        blank: Lines of the blank, uncommented, at the same indentation.
    """

    line: int
    answer: tuple[str, ...]
    blank: tuple[str, ...]


# The trees of a checkout.


@dataclass(frozen=True)
class Course:
    """Represent a checkout of the course, by the folder that contains ``src``."""

    root: Path

    @property
    def sources(self) -> Path:
        """Return the folder of the lesson sources."""
        return self.root / "src" / "lessons"

    @property
    def notebooks(self) -> Path:
        """Return the folder of the learner's pages."""
        return self.root / "notebooks"

    @property
    def solutions(self) -> Path:
        """Return the folder of the solution pages."""
        return self.root / "solutions"

    def lessons(self) -> list[Lesson]:
        """Read every lesson, in order; the home page comes last.

        Raises:
            LessonError: A source breaks the format.
        """
        return [read_lesson(path) for path in sorted(self.sources.glob("*.py"))]


def find_course(start: Path) -> Course:
    """Find the course that a folder is in.

    Raises:
        LessonError: Neither the folder nor one above it has ``src/lessons``.
    """
    for folder in (start, *start.parents):
        if (folder / "src" / "lessons").is_dir():
            return Course(folder)
    raise LessonError(
        f"no lessons are found from {start}.",
        "Pages are built from src/lessons in a checkout of the course.",
        "Change into the checkout, or name it with --root.",
    )


def choose(lessons: list[Lesson], names: list[str]) -> list[Lesson]:
    """Choose lessons by number, name or file.

    Args:
        lessons: The lessons to choose from.
        names: ``03``, ``03_write_a_publisher`` or a path of its source or page; none means all.

    Raises:
        LessonError: A name fits no lesson.
    """
    known = {key: one.name for one in lessons for key in (one.number, one.name) if key}
    for name in names:
        if Path(name).stem not in known:
            listed = ", ".join(lesson.name for lesson in lessons) or "none"
            raise LessonError(f"no lesson is called {name!r}.", "", f"The lessons are: {listed}.")
    wanted = {known[Path(name).stem] for name in names}
    return [lesson for lesson in lessons if not names or lesson.name in wanted]


# From a file to a lesson.


def read_lesson(path: Path) -> Lesson:
    """Read one lesson source.

    Raises:
        LessonError: The name, the header or a cell breaks the format.
    """
    if not _FILE_NAME.fullmatch(path.name):
        what = f"{path.name}: a lesson is named NN_slug.py, in lower case."
        raise LessonError(what, "The number orders the pages.", "Rename it, as 03_write_nodes.py.")
    lines = path.read_text(encoding="utf-8").splitlines(keepends=True)
    header = read_header(lines, path.name)
    first = len(_HEADER)
    while first < len(lines) and not lines[first].strip():
        first += 1
    body = "".join(lines[first:])
    markers = [n for n, line in enumerate(lines, 1) if n > first and _MARKER.match(line)]
    raw = jupytext.reads(body, fmt=_FORMAT).cells
    if len(raw) != len(markers) or not _MARKER.match(body):
        raise LessonError(
            f"{path.name}: {len(markers)} lines begin a cell, but jupytext sees {len(raw)} cells.",
            "Text stands before the first cell, or '# %%' or '# In[' stands inside a cell.",
            "Begin the text with '# %%', and use that at the start of a line for nothing else.",
        )
    seen: Counter[str] = Counter()
    pairs = zip(raw, markers, strict=True)
    return Lesson(path, header, tuple(_cell(cell, n, path.name, seen) for cell, n in pairs))


def read_header(lines: list[str], name: str) -> Header:
    """Read the comment header that opens a lesson.

    Args:
        lines: The lines of the lesson.
        name: The file's name, for messages.

    Raises:
        LessonError: A line of the header is missing, wrong or in another place.
    """
    values: list[str] = []
    for number, (pattern, example) in enumerate(zip(_HEADER, _EXAMPLE, strict=True), 1):
        line = lines[number - 1].rstrip() if number <= len(lines) else ""
        match = re.fullmatch(pattern, line)
        if not match:
            raise LessonError(
                f"{name}:{number}: the header has {line!r} where a line like {example!r} belongs.",
                "A header has four lines in this order, and nothing else, between '# ---'.",
                "Begin the file with:\n" + "\n".join(f"    {line}" for line in _EXAMPLE),
            )
        values += match.groups()
    title, minutes, needs, summary = (value.strip("\"'") for value in values)
    return Header(title, int(minutes), tuple(re.findall(r"\d\d", needs)), summary)


def _cell(cell: Any, marker: int, name: str, seen: Counter[str]) -> SourceCell:  # noqa: ANN401 - untyped
    where = f"{name}:{marker}"
    metadata = {k: v for k, v in cell.metadata.items() if k not in _JUPYTEXT_KEYS}
    _refuse_unknown(cell.cell_type, metadata, where)
    if metadata.get("shows") and {"exercise", "check", "save"} & set(metadata):
        raise LessonError(
            f"{where}: a cell that an exercise depends on does not only show something.",
            "Grading may leave out what is marked with shows=true.",
            "Take shows=true away.",
        )
    source, magic = _magic(cell.source.strip("\n"), metadata, where)
    exercise, check = metadata.get("exercise"), metadata.get("check")
    # Many cells begin with the same magic; what tells them apart is the line below it.
    opening = (f"{magic} {source}" if magic else source).split("\n", 1)[0]
    return SourceCell(
        id=_cell_id(seen, cell.cell_type, exercise or "", check or "", opening),
        kind=cell.cell_type,
        source=source,
        line=marker + 1 + len(cell.source) - len(cell.source.lstrip("\n")),
        exercise=exercise,
        check=check,
        only=metadata.get("only"),
        tags=tuple(metadata.get("tags", ())),
        answers=metadata.get("answers", False),
        predict=metadata.get("predict", False),
        shows=metadata.get("shows", False) or metadata.get("predict", False),
        magic=magic,
    )


def _cell_id(seen: Counter[str], *opening: str) -> str:
    """Return a hash of what opens a cell; cells that open alike are numbered.

    Two builds give the same ids, both trees share them, and a sentence that is changed further down
    in a cell is one changed line in each page instead of two.
    """
    stem = hashlib.sha256("\0".join(opening).encode()).hexdigest()[:10]
    seen[stem] += 1
    return stem if seen[stem] == 1 else f"{stem}-{seen[stem]}"


def _refuse_unknown(kind: str, metadata: dict[str, Any], where: str) -> None:
    if kind not in ("code", "markdown"):
        raise LessonError(f"{where}: a page has no cells of the kind {kind!r}.")
    unknown = sorted(set(metadata) - _KNOWN_KEYS)
    if unknown:
        raise LessonError(
            f"{where}: a cell marker does not know {', '.join(map(repr, unknown))}.",
            "Only what a page needs is kept, so that pages stay the same from build to build.",
            f"Use {', '.join(f'{key}=' for key in sorted(_KNOWN_KEYS))}; "
            "for prose write '# %% [markdown]'.",
        )
    for key, values in _VALUES.items():
        if key in metadata and metadata[key] not in values:
            ways = " or ".join(f"{key}={value!r}" for value in values).lower().replace("'", '"')
            raise LessonError(f"{where}: {key}= is {metadata[key]!r}.", "", f"Write {ways}.")


def _magic(source: str, metadata: dict[str, Any], where: str) -> tuple[str, str]:
    """Return a cell's text as it stands on the page, and the magic above it."""
    terminal, save = metadata.get("terminal"), metadata.get("save")
    if terminal and save:
        raise LessonError(f"{where}: terminal= and save= do not go together.")
    if terminal:
        # Without a command it is a line magic: a look, or a key that is pressed.
        text = _uncommented(source, where)
        return text, f"{'%%' if text else '%'}terminal {terminal}"
    if save:
        is_python = Path(save.split()[0]).suffix == ".py"
        return source if is_python else _uncommented(source, where), f"{SAVE}{save}"
    return source, ""


def _uncommented(source: str, where: str) -> str:
    lines = source.split("\n")
    for number, line in enumerate(lines):
        if line == "#" or (line.startswith("# ") and not _NEARLY.match(line)):
            lines[number] = line[2:]
        elif line and not _NEARLY.match(line):
            raise LessonError(
                f"{where}: {line!r} stands without a comment sign.",
                "A lesson source is Python; what is typed in a terminal is not.",
                "Begin each line of this cell with '# '.",
            )
    return "\n".join(lines)


# Answers and blanks.


def with_answers(text: str) -> str:
    """Return the text with its answers, markers and blanks gone.

    Raises:
        LessonError: A marker is wrong.
    """
    find_blocks(text)
    return _BLOCK.sub(lambda match: match["answer"][:-1], text)


def with_blanks(text: str) -> str:
    """Return the text with blanks in place of its answers.

    A blank with fewer lines than its answer says how many lines are wanted.

    Raises:
        LessonError: A marker is wrong.
    """
    find_blocks(text)
    return _BLOCK.sub(lambda match: "\n".join(_sized_blank(match)), text)


def with_blanks_in_place(text: str) -> str:
    """Return the learner's text on the lines of the source; lines that are gone are empty."""

    def in_place(match: re.Match[str]) -> str:
        return "\n" * (2 + match["answer"].count("\n")) + "\n".join([*_blank(match), ""])

    return _BLOCK.sub(in_place, text)


def find_blocks(text: str, where: str = "cell", first_line: int = 1) -> list[Block]:
    """Find the answers of a cell.

    Args:
        text: The text of a cell.
        where: The file, for messages.
        first_line: The line of the file on which the cell begins, for messages.

    Raises:
        LessonError: A marker is unclosed, nested, stray or misspelt, or a blank is not a blank.
    """
    blocks, markers = [], set()
    for match in _BLOCK.finditer(text):
        line = text.count("\n", 0, match.start())
        answer, blank = tuple(match["answer"].split("\n")[:-1]), tuple(_blank(match))
        blocks.append(Block(line, answer, blank))
        markers |= {line, line + 1 + len(answer), line + 2 + len(answer) + len(blank)}
    for number, line_text in enumerate(text.split("\n")):
        if _NEARLY.match(line_text) and number not in markers:
            what = f"{line_text.strip()!r} is not a marker of a complete block."
            raise LessonError(f"{where}:{first_line + number}: {what}", _EXPOSED, _SPELLING)
    for block in blocks:
        _require_content(block, f"{where}:{first_line + block.line}")
    return blocks


_EXPOSED = "Without strict markers an answer could end up on the learner's page."
_SPELLING = (
    "Write '# --- answer', '# --- blank' and '# --- end', in this order, each on a line of its "
    "own at the indentation of the code; begin each line of the blank there, with '# '."
)


def _blank(match: re.Match[str]) -> list[str]:
    start = len(match["indent"]) + 2
    lines = match["blank"].split("\n")[:-1]
    return [(match["indent"] + line[start:]).rstrip() for line in lines]


def _sized_blank(match: re.Match[str]) -> list[str]:
    lines = _blank(match)
    wanted = len(_lines_of_code(match["answer"].split("\n")))
    if wanted > len(_lines_of_code(lines)):
        at = next(number for number, line in enumerate(lines) if BLANK in line)
        indent = lines[at][: len(lines[at]) - len(lines[at].lstrip())]
        lines.insert(at, f"{indent}# about {wanted} lines")
    return lines


def _lines_of_code(lines: list[str]) -> list[str]:
    return [line for line in lines if line.strip() and not line.lstrip().startswith("#")]


def _require_content(block: Block, place: str) -> None:
    if not any(line.strip() for line in block.answer):
        raise LessonError(f"{place}: the block has no answer.")
    if not any(BLANK in line for line in block.blank):
        raise LessonError(
            f"{place}: the blank has no {BLANK}.",
            "A learner would not see that something is to be done here.",
            f"Put {BLANK} where the learner writes.",
        )
