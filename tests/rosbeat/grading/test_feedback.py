"""The page of one learner: everything that was found, in kind and exact words."""

import re
import subprocess
import sys
from dataclasses import replace
from html import unescape
from io import BytesIO
from zipfile import ZipFile

import nbformat
import pytest

from bank.class_of_learners import hand_in
from bank.pages import ROOT
from graded_classes import HOSTILE, hostile_learner, mark, observation, one_of_each
from parsed_html import ELEMENTS, Parsed, require_harmless
from rosbeat.exercises.scenarios import TypedIn
from rosbeat.grading.feedback import FeedbackZips, feedback, feedback_notebook
from rosbeat.grading.marks import Gradebook, Graded, Solution
from rosbeat.grading.platforms import PLATFORMS
from rosbeat.grading.remarks import Remark
from rosbeat.grading.rendering import STATUSES
from rosbeat.grading.report import class_report
from rosbeat.page_runs.submitted_page import NOT_THERE
from rosbeat.page_runs.traces import trace_of
from rosbeat.records import Observation, Sample


@pytest.fixture(scope="module")
def page():
    return feedback(one_of_each())


@pytest.fixture(scope="module")
def text(page):
    return " ".join(Parsed(page).text.split())


#: What the page of `one_of_each` says, in order.
SAID = """
Feedback for Ana Muster
7.5 of 17 points so far
You have come far.
homework (1).ipynb
In 60 s there were 60 messages on /temperature.
A topic name that no other node uses.
Compare the two names letter by letter.
Open the page and run hint("03b").
it has no name for this mistake yet
There is still a blank, ____.
04b raise the alarm: no points yet
It used more memory than there is.
The page shows that it has passed.
Your instructor has set the points
A nice idea. Next time with a shorter name?
It has the exercises 05a, 05b.
looked at by your instructor, 1 of 1 point Points Your instructor has set the points
From your instructor Fine, for once.
R2 It closes it again below 26. (optional)
The window stayed open at 25.
"""


def test_everything_is_said_and_each_status_has_its_sign_and_its_word(page, text):
    missing = [said for said in SAID.strip().split("\n") if said not in text]
    missing += [one.word for one in STATUSES.values() if f"{one.sign} {one.word}" not in text]
    assert missing == []
    assert "<pre>KeyError: &#39;x&#39;.\n  line 2</pre>" in page


@pytest.mark.parametrize("text", HOSTILE, ids=range(len(HOSTILE)))
def test_a_strange_text_stays_text(text):
    page = feedback(hostile_learner(text))
    require_harmless(page)
    assert len(page) < 400_000


def said_of(**values):
    graded = Graded("4711", "Ana", "folder", (mark("04a", **values),))
    return " ".join(Parsed(feedback(graded)).text.split())


def test_an_answer_that_is_nowhere_is_said_to_be_so_once():
    text = said_of(status="not attempted", evidence=NOT_THERE)
    assert text.count(NOT_THERE) == 1


# The learner's own code, and what it did.

CODE = """\
class Monitor(Node):
    def __init__(self):
        super().__init__('monitor')
        self.x"""


def seen_of(expected="", **values):
    values = {"status": "failed", "source": CODE} | values
    graded = Graded("4711", "Ana", "folder", (mark("04a", **values),))
    return feedback(graded, (Solution("04a", "", expected),))


def marked(page):
    return re.findall(r'<mark class="line"><span class="hidden">\(look here\) </span>(.*)\n', page)


@pytest.mark.parametrize(
    ("evidence", "lines"),
    [
        ("It raised AttributeError. Line 4: `self.x`.", ["        self.x"]),
        ("It raised AttributeError. Line 1: `self.x`.", ["        self.x"]),
        ("It raised AttributeError. Line 4: `self.y`.", []),
        ("It raised AttributeError.", []),
        ("Line 99999999999999999999: ``", []),
    ],
)
def test_lines_that_were_named_are_marked(evidence, lines):
    page = seen_of(evidence=evidence)
    assert marked(page) == lines
    assert page.count("(look here)") == len(lines)


def test_the_answer_is_shown_as_it_is_unless_nobody_filled_it_in():
    text = re.sub("<[^>]+>", "", re.search('(?s)<pre class="code.*?</pre>', seen_of())[0])
    assert unescape(text) == f"{CODE}\n"
    for status in ("missing", "not attempted"):
        assert "pre class=" not in seen_of(status=status, comment="x")


def test_a_picture_shows_what_was_done_beside_what_the_solution_did():
    own, right = observation(words=("Fine", "Warm")), observation(words=("Fine", "Fine"))
    page = seen_of(trace_of(right), trace=trace_of(own))
    (drawn,) = [attrs for tag, attrs in Parsed(page).elements if attrs.get("class") == "trace"]
    assert drawn["role"] == "img"
    assert drawn["aria-label"] == (
        "Published on /status. published solution: 2 messages from 0 s to 1 s, the first ones: "
        "Fine; this answer: 2 messages from 0 s to 1 s, the first ones: Fine, Warm. Log lines of "
        "monitor. published solution: 2 lines from 0 s to 1 s, the first ones: Fine; this answer: "
        "2 lines from 0 s to 1 s, the first ones: Fine, Warm. Input: what others published on "
        "/temperature. 2 messages from 0 s to 1 s, values from 5 to 6."
    )
    assert page.count('<g class="expected">') == page.count('<g class="own">') == 2


MANY = trace_of(observation(words=[f"w{n}" for n in range(5_000)]))
TYPED = trace_of(TypedIn("ws", (), 1, "ws$ mkdir a/b\nmkdir: cannot create directory"))


@pytest.mark.parametrize(
    ("trace", "status", "said"),
    [
        (trace_of(replace(observation(), samples=())), "failed", "this answer: nothing"),
        (MANY, "failed", "5000 messages"),
        (TYPED, "failed", "<pre>ws$ mkdir a/b\nmkdir: cannot create directory</pre>"),
        (trace_of(observation()), "passed", ""),
        *((none, "failed", "") for none in ("", "{", "[]", '{"lanes":3}')),
    ],
    ids=["nothing done", "many messages", "a terminal", "right", *range(4)],
)
def test_what_is_drawn_of_an_answer(trace, status, said):
    page = seen_of(trace_of(observation()), status=status, trace=trace)
    assert ("<figure>" in page) == bool(said)
    assert said in page
    assert len(page) < 60_000


def test_forged_evidence_makes_a_small_trace_or_none():
    """Whoever forges evidence may put anything into it, and as much as a sandbox lets out."""
    many = [Sample(n, f"/t{n}" * 99, "std_msgs/msg/String", "/a", {"data": "W" * 999})
            for n in range(20_000)]  # fmt: skip
    assert len(trace_of(Observation(9, 0, tuple(many), subject="/a"))) < 10_000
    for value in (10**400, float("nan"), {"a": [[]] * 999}, None, b""):
        sample = Sample(1, "/t", "std_msgs/msg/String", "/a", {"data": value})
        assert len(trace_of(Observation(9, 0, (sample,), subject="/a"))) < 1_000


# Zips to upload.


def zipped(*learners):
    zips = FeedbackZips()
    for one in learners:
        zips.add(one, f"<p>{one.name}</p>")
    data = {one.name: zips.zip_for(one.name) for one in PLATFORMS}
    made = {f"{name}_feedback.zip": ZipFile(BytesIO(one)) for name, one in data.items() if one}
    return {name: {one: file.read(one) for one in file.namelist()} for name, file in made.items()}


def taken_by_moodle(names):
    """What `importziplib.php` makes of file names: participant, plugin, and the learner's name."""
    found = {}
    for name in names:
        assert not name.startswith((".", "~"))
        assert "/" not in name
        _, participant, kind, plugin, rest = name.split("_", 4)
        found[int(participant)] = kind, plugin, rest
    return found


@pytest.mark.parametrize("called", ["Ana Muster", "A_1_2/..\\b", ".hidden", "~", "", *HOSTILE[:5]])
def test_moodle_takes_the_feedback_of_its_learners(called):
    ana = Graded("4711", called, "moodle", (mark(),))
    (files,) = zipped(ana, Graded("12", "Bo", "folder", (mark(),))).values()
    assert taken_by_moodle(files) == {4711: ("assignfeedback", "file", "feedback.html")}


def of_canvas(*files):
    marks = (mark("03a", "failed", source=CODE, evidence="Seen.", mistake="boundary"),
             mark("04a", out_of=3.0))  # fmt: skip
    return Graded("20001", "Ana", "canvas", marks, comment="Well *done*.", files=files)


PATH = "all/petrovana_LATE_20001_778899_03_write-1.ipynb"


def test_canvas_takes_a_notebook_for_each_page_under_its_own_name():
    """`infer_comment_context_from_filename`: the first two numbers are learner and attachment."""
    page = mark("03a").page
    found = zipped(of_canvas((page, PATH), (mark("04a").page, "x/20001_zip/04.ipynb")))
    ((name, content),) = found["canvas_feedback.zip"].items()
    assert name == PATH.split("/")[1]
    assert [one for one in name.split("_") if one.isdigit()][:2] == ["20001", "778899"]
    notebook = nbformat.reads(content.decode(), 4)
    nbformat.validate(notebook)
    kinds = [cell.cell_type for cell in notebook.cells]
    assert kinds == ["markdown", "markdown", "code"]
    first, second, code = (cell.source for cell in notebook.cells)
    assert "Feedback: 03 Write a publisher: 0 of 1 point" in first
    assert "Well *done*." in first
    assert "Seen." in second
    assert "04a" not in second
    assert code == CODE
    assert zipped(of_canvas((page, PATH))) == zipped(of_canvas((page, PATH)))


@pytest.mark.parametrize("text", HOSTILE, ids=range(len(HOSTILE)))
def test_a_strange_text_makes_no_markdown_in_a_feedback_notebook(text):
    graded = hostile_learner(text)
    notebook = nbformat.reads(feedback_notebook(graded, graded.marks[0].page), 4)
    for cell in notebook.cells:
        if cell.cell_type == "markdown":
            assert {tag for tag, _ in Parsed(cell.source).elements} <= ELEMENTS
            assert all(block.startswith("<") for block in cell.source.split("\n\n") if block)


def test_what_only_an_instructor_reads_is_told_to_nobody_else():
    remark = Remark("reaches-inside", "ana/04.ipynb", "It imports gc.")
    graded = replace(one_of_each(), remarks=(remark,))
    assert "imports gc" not in feedback(graded)
    assert "imports gc" in class_report(Gradebook("1", (graded,)))


# From a learner's page to the picture.


@pytest.mark.ros
def test_what_a_node_did_is_shown_beside_what_the_published_solution_did(tmp_path):
    hand_in(tmp_path / "class", 2)
    out = tmp_path / "out"
    typed = [sys.executable, "-m", "rosbeat", "grade", tmp_path / "class", "--out", out]
    subprocess.run([*typed, "--lessons", "04"], cwd=ROOT, check=True, capture_output=True)
    pages = [path.read_text("utf-8") for path in sorted((out / "feedback").iterdir())]
    assert len(pages) == 2
    for page in pages:
        assert "not there yet" in page
        assert page.count("<figure>") == page.count('<article class="failed">') > 0
        assert "published solution" in page
        assert page.count('<pre class="code"') == page.count("<article")
    assert "FridgeMonitor" not in (out / "results.json").read_text("utf-8")
