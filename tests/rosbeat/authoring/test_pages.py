"""The two trees of pages: what a lesson becomes, byte for byte.

`tests/golden` holds a small lesson and both of its pages. After a wanted change:
`rosbeat build --root tests/golden`, and look at the difference.
"""

from __future__ import annotations

import re
from functools import partial
from pathlib import Path

import pytest
from nbformat import v4

from rosbeat.authoring import pages
from rosbeat.authoring.pages import notebook_page, solution_page
from rosbeat.authoring.source import Course, read_lesson
from rosbeat.errors import LessonError

GOLDEN = Course(Path(__file__).parents[2] / "golden")
NAME = "00_hear_a_pulse.ipynb"

#: The solution page of a lesson, without running it.
solution_draft = partial(solution_page, folder=Path(), fresh=True, run=lambda page, folder: page)


@pytest.fixture(scope="module")
def lesson():
    return GOLDEN.lessons()[0]


def test_the_learners_page_is_golden(lesson):
    made = pages.to_bytes(pages.notebook_page(lesson))
    assert made == (GOLDEN.notebooks / NAME).read_bytes()


def test_the_solution_page_is_golden_outputs_included(lesson, tmp_path):
    made = pages.to_bytes(pages.solution_page(lesson, tmp_path))
    assert made == (GOLDEN.solutions / NAME).read_bytes()


def test_one_changed_sentence_is_one_changed_line_in_each_page(lesson, tmp_path):
    old, new = "It is short, it needs no ROS", "It is brief, it needs no ROS"
    source = tmp_path / lesson.path.name
    source.write_text(lesson.path.read_text().replace(old, new))
    other = read_lesson(source)
    for make in (pages.notebook_page, solution_draft):
        before, after = (pages.to_bytes(make(x)).splitlines() for x in (lesson, other))
        changed = [pair for pair in zip(before, after, strict=True) if pair[0] != pair[1]]
        assert len(changed) == 1


# Before a page runs.

HEAR, SAY, HOME = "00_hear_it", "01_say_it", "home"


@pytest.fixture
def course(checkout):
    checkout.write("", name=HEAR)
    checkout.write("", name=SAY, title="Say it")
    checkout.write("", name=HOME, title="Find your way")
    return checkout.course.lessons()


@pytest.mark.parametrize("make", [notebook_page, solution_draft])
def test_a_page_ends_with_links_to_its_neighbours_the_whole_course_and_help(course, make):
    feet = [make(lesson, lessons=course).cells[-1] for lesson in course]
    hear, say, home = (foot.source.split("\n\n") for foot in feet)
    assert hear[:-1] == ["[The whole course](home.ipynb) | [01 Say it](01_say_it.ipynb) →"]
    assert say[:-1] == ["← [00 Hear it](00_hear_it.ipynb) | [The whole course](home.ipynb)"]
    (helping,) = home
    assert hear[-1] == say[-1] == helping
    names = ["cheat sheet", "glossary", "troubleshooting", "keys", "doctor", "where to ask"]
    links = re.findall(r"\[([^\]]+)\]\(\.\./([^)#]+)#?([^)]*)\)", helping)
    assert [name for name, _, _ in links] == names
    for _, place, anchor in links:  # JupyterLab makes anchors of headings as they are
        text = (GOLDEN.root.parents[1] / place).read_text()
        assert not anchor or f"\n## {anchor.replace('-', ' ')}\n" in text
    assert [foot.cell_type for foot in feet] == ["markdown"] * 3
    assert [foot.id for foot in feet] == ["foot-00", "foot-01", "foot-home"]


def test_a_link_to_the_glossary_says_what_the_term_means(checkout):
    glossary = checkout.course.root / "docs" / "glossary.md"
    glossary.parent.mkdir()
    entry = '"Not *a* number": see\nalso [the\nfloat](#float). Page 00: [hear](a.ipynb).'
    glossary.write_text(
        f"# Glossary\n\n## NaN\n\n{entry}\n\n## node\n\nA part. Page 01: [b](b.ipynb).\n"
    )
    links = "[**NaN**](../docs/glossary.md#nan), [other](../docs/glossary.md#other)"
    lesson = checkout.lesson(f"# %% [markdown]\n# {links}\n")
    text = notebook_page(lesson).cells[-1].source
    meaning = r'"\"Not a number\": see also the float."'
    assert text == links.replace("#nan", f"#nan {meaning}")


MAGICS = """
    # %% terminal="build"
    # cd ws
    # # a comment of bash
    # --- answer
    # mkdir -p one/two
    # --- blank
    # # mkdir ____
    # --- end
    #
    # ls

    # %% terminal="sensor --ctrl-c"

    # %% save="src/p/package.xml"
    # <package>
    #   <name>p</name>

    # %% save="src/p/setup.py"
    setup(
        # --- answer
        entry="sensor = p.sensor:main",
        # --- blank
        # entry=____,
        # --- end
    )
"""


def test_what_stands_behind_comment_signs_stands_bare_on_the_page(checkout):
    lesson = checkout.lesson(MAGICS)
    _, terminal, key, xml, setup = (cell.source for cell in solution_draft(lesson).cells)
    bash = "%%terminal build\ncd ws\n# a comment of bash\n{}\n\nls"
    assert terminal == bash.format("mkdir -p one/two")
    assert key == "%terminal sensor --ctrl-c"
    assert xml == "%%save src/p/package.xml\n<package>\n  <name>p</name>"
    python = "%%save src/p/setup.py\nsetup(\n    entry={},\n)"
    assert setup == python.format('"sensor = p.sensor:main"')
    blank = [cell.source for cell in notebook_page(lesson).cells]
    assert (blank[1], blank[4]) == (bash.format("mkdir ____"), python.format("____"))


# What a page tells nbgrader, for which `tests/with_nbgrader` then runs nbgrader itself.

GRADED = """
# %%
import time

# %% exercise="00a"
def f():
    # --- answer
    return 1
    # --- blank
    # return ____
    # --- end

# %% terminal="one" exercise="00a"
# # --- answer
# ls
# # --- blank
# # ____
# # --- end

# %% check="00a"
check("00a", f)

# %% save="src/a.py" exercise="00b"
# --- answer
b = 1
# --- blank
# b = ____
# --- end

# %% check="00b"
check("00b", b)
"""
NOTHING = {"grade": False, "locked": False, "solution": False, "task": False, "schema_version": 3}


def told(page):
    return [cell.metadata.nbgrader for cell in page.cells if "nbgrader" in cell.metadata]


@pytest.mark.parametrize("make", [notebook_page, solution_draft])
def test_answers_are_solutions_and_checks_give_the_points(checkout, make):
    page = make(checkout.lesson(GRADED), points={"00a": 4})
    check = {**NOTHING, "grade": True, "locked": True}
    assert told(page) == [
        {**NOTHING, "solution": True, "grade_id": "00a"},
        {**NOTHING, "solution": True, "grade_id": "00a-2"},
        {**check, "grade_id": "00a-check", "points": 4},
        {**NOTHING, "solution": True, "grade_id": "00b"},
        {**check, "grade_id": "00b-check", "points": 1},
    ]


# The outputs of a page that has run.


def outputs_after(step, page, *given):
    step(page, *given)
    return page.cells[0].outputs


def ran(*outputs, **metadata):
    cell = v4.new_code_cell("x", outputs=list(outputs), metadata={"line": 7, **metadata})
    made = v4.new_notebook(cells=[cell])
    made.metadata.rosbeat = {"lesson": "00_hear_it"}
    return made


def stream(text, name="stdout"):
    return v4.new_output("stream", text=text, name=name)


def result(text):
    return v4.new_output("execute_result", {"text/plain": text}, execution_count=1)


def test_chunks_become_one_text_per_stream_between_two_other_outputs():
    chunks = [stream("!", "stderr"), stream("b"), stream(""), stream("c")]
    page = ran(stream("a"), result("1"), *chunks)
    outputs = outputs_after(pages.merge_streams, page)
    assert [output.get("text", "result") for output in outputs] == ["a", "result", "bc", "!"]


def test_a_failure_keeps_its_message_and_loses_its_frames():
    error = v4.new_output(
        "error", ename="E", evalue="no \x1b[31mway\x1b[0m\n(123.py, line 1)", traceback=["frame"]
    )
    (output,) = outputs_after(pages.quiet_failures, ran(error))
    assert output.evalue == "no way\n(cell, line 1)"
    assert output.traceback == ["E: no way", "(cell, line 1)"]


def test_of_a_printed_traceback_the_learners_own_lines_stay():
    printed = (
        "Traceback (most recent call last):\n"
        '  File "/tmp/ipykernel_12/34.py", line 9, in main\n'
        "    rclpy.shutdown()\n"
        "    ~~~~~~~~~~~~~~^^\n"
        '  File "/x/site-packages/rclpy/__init__.py", line 134, in shutdown\n'
        "    _shutdown(context=context)\n"
        "    ^^^^^^^^^^\n"
        "RCLError: no\n"
    )
    (output,) = outputs_after(pages.quiet_failures, ran(stream(printed, "stderr")))
    assert output.text == (
        "Traceback (most recent call last):\n"
        '  File "cell", line 9, in main\n'
        "    rclpy.shutdown()\n"
        "RCLError: no\n"
    )


@pytest.mark.parametrize("text", ["<Node at 0x7f12ab34cd56>", "\x1b[31mred\x1b[0m", "/tmp/x/y"])
def test_an_output_that_cannot_be_repeated_is_refused(text, monkeypatch):
    monkeypatch.setattr("tempfile.gettempdir", lambda: "/tmp")
    for output in (stream(text), result(text)):
        with pytest.raises(LessonError, match=r"00_hear_it\.py:7"):
            pages.refuse_unrepeatable(ran(output))
    pages.refuse_unrepeatable(ran(stream(text), tags=["nbval-ignore-output"]))
    pages.refuse_unrepeatable(ran(stream("[INFO] [sensor]: 21.5 (0x10)"), result("1")))


def tagged(text, *, source="roll()", tags=(pages.UNCOMPARED,), cell_id="a"):
    output = v4.new_output("stream", text=text, name="stdout")
    cell = v4.new_code_cell(source, outputs=[output], metadata={"tags": list(tags)})
    cell.id = cell_id
    return v4.new_notebook(cells=[cell])


def rebuilt(path, new):
    (output,) = outputs_after(pages.keep_uncompared, new, path)
    return output.get("text")


@pytest.fixture
def stored(tmp_path):
    path = tmp_path / "page.ipynb"
    path.write_bytes(pages.to_bytes(tagged("3\n")))
    return path


def test_a_tagged_cell_keeps_the_output_it_has(stored):
    assert rebuilt(stored, tagged("5\n")) == "3\n"


@pytest.mark.parametrize(
    "change", [{"source": "roll(2)"}, {"tags": ()}, {"cell_id": "b"}], ids=lambda c: next(iter(c))
)
def test_a_changed_cell_gets_its_new_output(stored, change):
    assert rebuilt(stored, tagged("5\n", **change)) == "5\n"


def test_another_kind_of_output_is_stored(stored):
    failed = tagged("5\n")
    failed.cells[0].outputs = [v4.new_output("error", ename="E", evalue="no", traceback=[])]
    assert rebuilt(stored, failed) is None


@pytest.mark.parametrize("content", [None, b"{"])
def test_a_page_that_cannot_be_read_has_nothing_to_keep(tmp_path, content):
    path = tmp_path / "page.ipynb"
    if content is not None:
        path.write_bytes(content)
    assert rebuilt(path, tagged("5\n")) == "5\n"


# What answers a prediction.


@pytest.mark.parametrize("tree", ["notebook", "solution"])
def test_what_answers_a_prediction_is_folded_on_the_learners_page_only(checkout, tree):
    lesson = checkout.lesson("# %% [markdown] answers=true\n# **Two.**")
    page = pages.assemble(lesson, tree, str, ())
    (text,) = [cell.source for cell in page.cells if "**Two.**" in cell.source]
    if tree == "solution":
        assert text == "**Two.**"
        return
    # Without the empty lines, Markdown inside would be shown as it is written.
    assert text.startswith('<details class="rosbeat-answer"><summary>')
    assert "</summary>\n\n**Two.**\n\n</details>" in text
