"""From a page that was handed in to its answers, whatever has happened to the page."""

import builtins
import json
from dataclasses import replace
from pathlib import Path

import pytest

from grading_files import BLANK, DONE, cell, notebook, page
from rosbeat.exercises.registry import EXERCISES
from rosbeat.grading.answers import (
    answers_on,
    find_cells,
    remarks_on,
    statements_needed,
    without_magics,
)
from rosbeat.grading.notebook import Cell, Wanted, course_pages, read_notebook

ROOT = Path(__file__).resolve().parents[3]


@pytest.fixture(scope="module")
def course():
    return {one.number: one for one in course_pages(ROOT / "notebooks")}


@pytest.fixture
def answers(pages):
    """The answers on the small course's page 03, from cells or the text of a page."""

    def find(*cells, text=""):
        made = text or notebook(*cells, lesson="03_write")
        return answers_on(pages[0], read_notebook(made.encode()).cells)

    return find


def test_an_answer_becomes_a_job(answers):
    (one,) = answers(text=page(source=f"!pip install x\n{DONE}"))
    assert one.repairs == ("Line 1 was left out, a command of IPython: !pip install x",)
    (one,) = answers(text=page(source=DONE))
    assert (one.exercise, one.remarks, one.repairs, one.source) == ("03a", (), (), DONE)
    assert (one.job.answer, one.job.subject, one.job.replay) == (DONE, "Beat", ())
    assert json.loads(one.job.given) == EXERCISES["03a"].given()


@pytest.mark.parametrize("source", [BLANK, f"\n{BLANK}\n", "", "  \n"])
def test_what_nobody_has_touched_is_not_observed(answers, source):
    (one,) = answers(text=page(source=source))
    assert (one.job, one.remarks) == (None, ())


def test_what_the_check_cell_was_changed_to_does_not_count(answers):
    made = (cell(DONE, id="03a-cell", exercise="03a"), cell('check("03a", Cheat)', check="03a"))
    (one,) = answers(*made)
    assert one.job.subject == "Beat"


def test_what_an_answer_needs_of_earlier_cells_is_the_learners_first_then_the_courses(answers):
    made = DONE.replace("1.0", "FIRST + rclpy.x")
    (one,) = answers(
        cell("FIRST = 1"),
        cell("FIRST = 7\nunused = 3\nprint(FIRST)"),
        cell("words", "markdown"),
        cell("%%terminal a\nls"),
        cell(made, id="03a-cell", exercise="03a"),
        cell("FIRST = 3"),
    )
    assert set(one.job.earlier) == {"FIRST = 7", "import rclpy"}


def test_what_an_answer_needs_of_another_cell_is_remarked_too(answers):
    made = cell(DONE.replace("1.0", "PERIOD"), id="03a-cell", exercise="03a")
    (plain,) = answers(cell("PERIOD = 1.0"), made)
    (sly,) = answers(cell("PERIOD = f.__globals__"), made)
    (beside,) = answers(cell("x = f.__globals__"), cell("PERIOD = 1.0"), made)
    assert (plain.remarks, beside.remarks) == ((), ())
    assert sly.remarks == ("of another cell that it needs, line 1 uses __globals__",)


def test_the_whole_course_has_a_job_for_each_exercise(course):
    for number, page_of_course in course.items():
        done = read_notebook((ROOT / f"solutions/{page_of_course.lesson}.ipynb").read_bytes())
        found = answers_on(page_of_course, done.cells)
        wanted = [name for name in EXERCISES if name[:2] == number]
        assert [one.exercise for one in found] == wanted
        for one in found:
            assert one.job is not None, one
            assert one.job.subject != "None"
            is_typed = number in ("01", "02", "05", "06")
            assert bool(one.job.replay) == is_typed


def test_an_exercise_of_several_cells_is_one_answer(course):
    page_13 = course["13"]
    ids = [one.id for one in page_13.wanted if one.exercise == "13b"]
    cells = [
        replace(one, source=f"x = '{one.id}'") if one.id in ids else one for one in page_13.cells
    ]
    (one,) = (one for one in answers_on(page_13, cells) if one.exercise == "13b")
    assert len(ids) > 1
    assert (*one.job.parts, one.job.answer) == tuple(f"x = '{one}'" for one in ids)


def test_a_replay_has_this_answer_and_blanks_for_the_others(course):
    page_01 = course["01"]
    first, second = page_01.wanted[:2]
    typed = "%%terminal two\nmkdir -p x"
    cells = [
        replace(one, source=typed) if one.id in (first.id, second.id) else one
        for one in page_01.cells
    ]
    one = answers_on(page_01, cells)[1]
    assert one.job.replay.count(typed) == 1
    assert one.job.page == "01"
    assert not any("import check" in one for one in one.job.replay)


# Which cells hold answers.

OTHER = DONE.replace("Beat", "Ear")
WANTED = (
    Wanted("03a", "one", BLANK),
    Wanted("03b", "two", BLANK.replace("Beat", "Ear")),
)


def cells(*made):
    return [
        Cell(n, one.get("sort", "code"), one.get("source", DONE), one.get("id", ""),
             one.get("exercise", ""), one.get("check", ""))
        for n, one in enumerate(made)
    ]  # fmt: skip


def found(*made, wanted=WANTED[:1]):
    return find_cells(wanted, cells(*made))[0]


@pytest.mark.parametrize(
    ("made", "words"),
    [
        ({"exercise": "03a", "id": "new"}, "another id"),
        ({"source": DONE}, "by what it defines"),
        ({"source": "import rclpy\n" + DONE}, "by what it defines"),
        ({"id": "one", "sort": "markdown"}, "markdown cell"),
        ({"id": "one", "sort": "raw"}, "raw cell"),
    ],
)
def test_a_cell_that_lost_something_is_found(made, words):
    one = found({"source": "a = 1"}, made)
    assert one.place == 1
    assert words in " ".join(one.repairs)


@pytest.mark.parametrize("check", [{}, {"id": "one", "check": "03a"}])
def test_a_deleted_cell_is_missing_and_a_check_is_no_answer(check):
    one = found({"source": "a = 1"}, {"source": DONE if check else "b = 2", **check})
    assert (one.source, one.place) == ("", -1)
    assert "not on the page" in one.repairs[0]


@pytest.mark.parametrize(
    ("made", "places"),
    [
        (({"id": "one"}, {"source": OTHER}), [0, 1]),
        (({"id": "two", "source": OTHER},), [-1, 0]),
        (({"id": "two", "source": DONE},), [-1, 0]),  # a copied id
    ],
)
def test_no_cell_answers_two_exercises(made, places):
    assert [one.place for one in find_cells(WANTED, cells(*made))] == places


def test_of_several_the_last_that_is_filled_counts():
    one = found({"id": "one", "source": DONE + "# 1"}, {"id": "one", "source": DONE + "# 2"},
                {"exercise": "03a", "source": BLANK})  # fmt: skip
    assert one.place == 1
    assert "3 times" in one.repairs[0]


@pytest.mark.parametrize("source", ["\0", "(" * 10_000, "x = '\ud800'", "%%terminal a\nls ("])
def test_no_text_stops_it(source):
    assert found({"id": "one", "source": source}).source == source


PARTS = (
    Wanted("13b", "one", "class Beat(Node):\n    ____\n"),
    Wanted("13b", "two", "class Ear(Node):\n    ____\n"),
    Wanted("13b", "three", "def greenhouse():\n    ____\n"),
)
FILLED = [one.blank.replace("____", f"x = {n}") for n, one in enumerate(PARTS)]


def parts(*made):
    return find_cells(PARTS, cells(*made))


def test_each_of_several_cells_is_found_by_its_id():
    made = [
        {"source": text, "id": one.id, "exercise": "13b"}
        for text, one in zip(FILLED, PARTS, strict=True)
    ]
    for order in (made, made[::-1]):
        found = parts(*order)
        assert [one.source for one in found] == FILLED
        assert [one.repairs for one in found] == [(), (), ()]


def test_several_cells_without_ids_are_told_apart_by_what_they_define():
    found = parts(*({"source": text, "exercise": "13b"} for text in reversed(FILLED)))
    assert [one.source for one in found] == FILLED
    assert all("another id" in " ".join(one.repairs) for one in found)


# Commands of IPython.

IN_A_TEXT = "text = '''\n%time\n!ls\n'''"


@pytest.mark.parametrize(
    ("source", "plain", "said"),
    [
        ("%%time\nx = 1", "\nx = 1", 0),
        ("\n%%timeit -n 3\nx = 1", "\n\nx = 1", 0),
        ("%%capture out\n%%time\nx = 1", "\n\nx = 1", 0),
        ("x = 1\n%time y = f()\n%timeit -n 2 -r1 f()", "x = 1\ny = f()\nf()", 0),
        ("x = %time f()", "x = f()", 0),
        ("!pip install x\ny = 1", "pass\ny = 1", 1),
        ("if a:\n    !ls\n    %cd x\nb = 1", "if a:\n    pass\n    pass\nb = 1", 2),
        ("files = !ls\nx?\n?x.y\nstr.join??", "files = None\npass\npass\npass", 4),
        ("%%bash\nls", "", 1),
        ("%%writefile a.py\nx = 1", "", 1),
        (IN_A_TEXT, IN_A_TEXT, 0),
        ("a = 7\nb = a\\\n% 2", "a = 7\nb = a\\\n% 2", 0),
        ("no python (", "no python (", 0),
        ("", "", 0),
    ],
)
def test_commands_of_ipython_run_their_body_or_are_left_out(source, plain, said):
    found, sentences = without_magics(source)
    assert found == plain
    assert len(sentences) == said
    assert all(2 < len(one) < 120 for one in sentences)


# Statements of other cells.

HELPERS = ("def twice(x):\n    return x * FACTOR", "import math\nFACTOR = math.floor(2.5)")
MUTUAL = "def even(n):\n    return n == 0 or odd(n - 1)\ndef odd(n):\n    return even(n - 1)"
DEFINITIONS = "import a\nfrom b import c as d\nx: int = 1\ny, z = 1, 2\nprint(x)\nclass E: pass"


@pytest.mark.parametrize(
    ("text", "cells", "begin"),
    [
        ("print(A + 1)", ("A = 1\nB = 2\nboom()", "C = 3"), ["A = 1"]),
        ("y = twice(3)", HELPERS, ["import math", "FACTOR = ", "def twice"]),
        ("A", ("A = 1\nA = 2", "A = 3"), ["A = 2"]),
        ("A = 5\nprint(A)", ("A = 1",), []),
        ("def A(): pass\nA()", ("A = 1",), []),
        ("import x as A\nA.b", ("A = 1",), []),
        ("print(KNOWN)", ("KNOWN = 1",), []),
        ("print(len([]))", ("len = 1",), []),
        ("no python (", ("A = 1",), []),
        ("A", ("no python (", "\0", "A = 1"), ["A = 1"]),
        ("even(2)", (MUTUAL,), ["def odd", "def even"]),
        ("a, d, f", (DEFINITIONS,), ["from b import c as d", "import a"]),
        ("E, x, y", (DEFINITIONS,), ["y, z = ", "x: int", "class E"]),
    ],
)  # fmt: skip
def test_statements_that_an_answer_needs_come_in_the_order_to_run_them(text, cells, begin):
    found = statements_needed([text], cells, {"KNOWN", *dir(builtins)})
    assert len(found) == len(begin)
    assert all(map(str.startswith, found, begin)), found


# Remarks for an instructor.

IMPORTS = """from rosbeat import Session, check, clinic
import sys
import rclpy
from rclpy.node import Node
from std_msgs.msg import Float32
"""


@pytest.mark.parametrize(
    ("answer", "words"),
    [
        ("import os, math, signal, subprocess\nimport numpy as np\nx = np.clip(1, 0, 2)", ""),
        ("from std_msgs.msg import String as Word\nmsg = Float32\nmsg.data = 1.0", ""),
        ("eval('1')\nopen('x')\nvars(self)\nself.signal = 1", ""),
        ("from rosbeat import Session, clinic\nclinic.Ward(7)", ""),
        ("x = {}\nx['a'] = 1\nx.y = 2\ndel x['a']\nself.publisher.count = 3", ""),
        ("this is no python (", ""),
        ("(" * 5_000, ""),
        ("def f():\n    import ctypes", "line 2 imports ctypes"),
        ("from rosbeat.exercises import page_03", "line 1 imports rosbeat.exercises"),
        ("import sys\nsys._getframe()", "line 2 uses _getframe"),
        ("f.__globals__", "line 1 uses __globals__"),
        ("getattr(x, '__globals__')", "line 1 uses __globals__"),
        ("self.context.session_core", "line 1 uses session_core"),
        ("rclpy.spin = print", "line 1 changes rclpy"),
        ("del rclpy.spin", "line 1 changes rclpy"),
        ("rclpy.x += 1", "line 1 changes rclpy"),
        ("import json\njson.dumps = 3", "line 2 changes json"),
        ("import sys\nsys.modules['json'] = 1", "line 2 changes sys"),
    ],
    ids=range(18),
)
def test_what_reaches_for_the_observer_is_remarked_with_its_line(answer, words):
    assert remarks_on(answer, IMPORTS) == ((words,) if words else ())
