"""An instructor opens the tables in a spreadsheet, and takes them to Moodle and Canvas."""

import csv
import io
import re
from dataclasses import replace
from html.parser import HTMLParser

import pytest

from graded_classes import HOSTILE, a_class, hostile_learner, mark, one_of_each
from rosbeat.errors import GradingError
from rosbeat.grading.csv_table import MOST_OF_A_CELL, cell, number
from rosbeat.grading.marks import Gradebook, Graded
from rosbeat.grading.remarks import Remark
from rosbeat.grading.tables import canvas_csv, grades_csv, moodle_csv

NASTY = [
    *HOSTILE,
    '=HYPERLINK("http://a.b","x")',
    "+1",
    "-1+1",
    "@a",
    "\t=1",
    "x;=1",
    'a;"=1";=2',
    ';"";=cmd|',
    "x;;=1",
    "; =1",
    "Points Possible",
]
FORMULA = set("=+-@＝＋－＠")


def rows(text):
    assert "\ufeff" not in text[1:]
    return list(csv.reader(io.StringIO(text.removeprefix("\ufeff"), newline=""), strict=True))


def named(text):
    head, *others = rows(text)
    return [dict(zip(head, one, strict=True)) for one in others]


def of(system, *marks, learner="4711", name="Ana Muster", comment=""):
    marks = marks or (mark(points=1.5, out_of=2.0), mark("03b", "failed", out_of=1.0))
    return Graded(learner, name, system, marks, (), comment)


def book(*learners):
    return Gradebook("0.1.0", learners)


@pytest.fixture
def wide_cells():
    """Where cells are parted at semicolons, a whole row of ours may be one."""
    before = csv.field_size_limit(1_000_000)
    yield
    csv.field_size_limit(before)


# The table to look at.


def test_there_is_a_row_for_each_learner_and_exercise_with_its_cause():
    made = a_class(5)
    table = named(grades_csv(made))
    assert [(one["learner"], one["exercise"]) for one in table] == [
        (one.learner, mark.exercise) for one in made.learners for mark in one.marks
    ]
    assert all(one["cause"] for one in table)
    assert {one["status"] for one in table} >= {"passed", "failed", "missing", "held"}


def test_all_that_matters_stands_in_the_row():
    said = {"comment": "A nice\nidea.", "repairs": ("One.", "Two."), "cause": "So."}
    made = mark("04c", points=0.5, manual=True, late=True, mistake="boundary", title="calm", **said)
    assert named(grades_csv(book(of("moodle", made)))) == [
        {
            "learner": "4711", "name": "Ana Muster", "system": "moodle", "page": made.page,
            "exercise": "04c", "title": "calm", "status": "passed", "points": "0.5",
            "out_of": "1", "cause": "So.", "mistake": "boundary", "late": "yes", "judged": "0",
            "manual": "yes", "comment": "A nice idea.", "repairs": "One. Two.",
        }
    ]  # fmt: skip


def test_excel_is_told_that_it_is_utf_8():
    assert grades_csv(book()).encode().startswith(b"\xef\xbb\xbflearner,")


def test_lines_end_as_spreadsheets_write_them():
    text = grades_csv(book(of("moodle")))
    assert text.count("\r\n") == text.count("\n") == 3


@pytest.mark.parametrize("text", NASTY)
@pytest.mark.parametrize("separator", ",;\t")
def test_no_cell_is_a_formula_in_any_country(text, separator, wide_cells):
    made = book(*(replace(hostile_learner(text), system=one) for one in ("moodle", "canvas", text)))
    for table in (grades_csv(made), moodle_csv(made), canvas_csv(made)):
        file = io.StringIO(table.removeprefix("\ufeff"), newline="")
        for row in csv.reader(file, delimiter=separator):
            assert not [one for one in row if one.lstrip(' "')[:1] in FORMULA and len(one) > 1]
            assert all(one.isprintable() for one in row)


@pytest.mark.parametrize("text", NASTY)
def test_hostile_names_leave_the_tables_whole(text):
    made = book(*(replace(hostile_learner(text), system=one) for one in ("moodle", "canvas")))
    assert len(named(grades_csv(made))) == 14
    assert len(named(moodle_csv(made))) == 1
    assert len(named(canvas_csv(made))) == 2
    for table in (grades_csv(made), moodle_csv(made), canvas_csv(made)):
        assert max(len(one) for row in rows(table) for one in row) <= 32_767
        table.encode("utf-8")


# A cell of a table.


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("Ana Müller", "Ana Müller"),
        ("日本語 👩🏽", "日本語 👩🏽"),
        ('=HYPERLINK("http://a.b","x")', '\'=HYPERLINK("http://a.b","x")'),
        ("+1+1", "'+1+1"),
        ("-2+3+cmd|' /C calc'!A0", "'-2+3+cmd|' /C calc'!A0"),
        ("@SUM(A1)", "'@SUM(A1)"),
        ("  =1+1", "'  =1+1"),
        ("\t=1+1", "' =1+1"),
        ("\r=1+1", "' =1+1"),
        ('"=1+1', "'\"=1+1"),
        ("＝1+1", "'＝1+1"),
        ("'=1+1", "'=1+1"),
        ("a;=1+1", "a;'=1+1"),
        ('a;"=1+1', "a;\"'=1+1"),
        ("; ;@a", "; ;'@a"),
        ("a=b, c-d; e", "a=b, c-d; e"),
        ("-", "-"),
        ("= ", "= "),
        ("\0=1+1", "\\u0000=1+1"),
        ("\u202e=1+1", "\\u202e=1+1"),
        ("one\r\ntwo\u2028three\tfour", "one two three four"),
        ("\x1b[31mred", "\\u001b[31mred"),
        ("\ud800", "\\ud800"),
        ("", ""),
    ],
)
def test_a_text_stays_a_text(text, shown):
    assert cell(text) == shown
    assert cell(shown) == shown


def test_a_cell_fits_into_a_spreadsheet():
    assert len(cell("x" * 100_000)) == MOST_OF_A_CELL
    assert len(cell("=" * 100_000)) <= 32_767


@pytest.mark.parametrize(
    ("value", "shown"),
    [(2, "2"), (2.0, "2"), (0.5, "0.5"), (1 / 3, "0.33333"), (10.0, "10"), (100, "100"),
     (0.0, "0"), (-0.0, "0"), (-1e-9, "0"), (1e-5, "0.00001"), (0.1 + 0.2, "0.3")],
)  # fmt: skip
def test_a_number_is_short(value, shown):
    assert number(value) == shown


# Moodle.


def test_moodle_gets_the_columns_that_its_worksheet_has():
    head = rows(moodle_csv(book(of("moodle"))))[0]
    assert head == [
        "Identifier", "Full name", "Email address", "Status", "Grade", "Maximum Grade",
        "Grade can be changed", "Last modified (submission)", "Last modified (grade)",
        "Feedback comments",
    ]  # fmt: skip
    assert head.index("Feedback comments") > 0  # Moodle takes no feedback from the first column


def imported(text, maximum):
    """What Moodle's importer would take: `importgradeslib.php` and `process_import_grades`."""
    taken = {}
    for row in named(text):
        user = int(row["Identifier"][len("Participant ") :])
        assert "Last modified (grade)" in row
        grade = row["Grade"]
        if grade == "" or not 0 <= float(grade) <= maximum:
            continue
        taken[user] = float(grade)
    return taken


def test_moodle_takes_the_grades_of_its_own_learners():
    held = of("moodle", mark(points=2.0, out_of=2.0), mark("03b", "held"), learner="12")
    made = book(of("moodle"), held, of("canvas", learner="13"), of("folder", learner="ana"))
    assert imported(moodle_csv(made), 3.0) == {4711: 1.5}
    assert [one["Maximum Grade"] for one in named(moodle_csv(made))] == ["3", "3"]


def test_without_learners_of_a_system_there_is_no_file_for_it():
    assert moodle_csv(book(of("folder"), of("canvas"))) == ""
    assert canvas_csv(book(of("folder"), of("moodle"))) == ""
    assert moodle_csv(book()) == canvas_csv(book()) == ""


def feedback(graded):
    return named(moodle_csv(book(graded)))[0]["Feedback comments"]


class Shown(HTMLParser):
    """What a browser makes of HTML: tags and text."""

    def __init__(self, text):
        super().__init__()
        self.tags, self.text = [], ""
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attrs):
        assert attrs == []
        self.tags.append(tag)

    def handle_data(self, data):
        self.text += data


def test_the_feedback_tells_points_comment_and_each_exercise():
    made = of("moodle", mark(points=1.0, cause="a <= b; -3 + 4 == 1"), comment="Well done.\nAna")
    shown = Shown(feedback(made))
    assert "1 of 1 points." in shown.text
    assert "Well done." in shown.text
    assert "a <= b; -3 + 4 == 1" in shown.text
    assert set(shown.tags) == {"p", "br"}


def test_the_feedback_says_when_there_are_no_points_yet():
    told = Shown(feedback(one_of_each())).text
    assert "Your instructor will look" in told
    assert "04b, raise the alarm: not settled yet. It used more memory than there is." in told
    assert "04c, the mean of five readings: 0.5 of 1." in told
    assert not one_of_each().is_settled
    assert of("moodle").is_settled


def test_the_feedback_says_that_a_file_is_not_whole():
    told = Shown(
        feedback(of("moodle", mark("03a", "held", file="a/03.ipynb", cause="It stops.")))
    ).text
    assert "One of your files is not whole" in told
    assert "Your instructor will look" not in told
    assert "03a, another sensor: not settled yet. It stops." in told


def test_the_feedback_tells_what_is_odd_about_files():
    path = "Hao Li_20008_assignsubmission_file_/Abgabe <b>.docx"
    remark = Remark("left-out", path, "It is no notebook, so it is left out.")
    told = Shown(feedback(replace(of("moodle", mark()), remarks=(remark,) * 12))).text
    assert told.count("Abgabe <b>.docx: It is no notebook, so it is left out.") == 10
    assert "assignsubmission" not in told
    assert "And 2 more remarks about your files." in told


@pytest.mark.parametrize("text", NASTY)
def test_no_text_becomes_markup_in_the_feedback(text):
    made = replace(hostile_learner(text), system="moodle")
    shown = Shown(feedback(made))
    assert set(shown.tags) <= {"p", "br"}
    assert "\u202e" not in feedback(made)


def test_a_long_feedback_breaks_off_between_two_paragraphs():
    marks = [mark(f"{n:02}a", cause="x<" * 2_000) for n in range(14)] * 5
    told = feedback(of("moodle", *marks))
    assert told.endswith("</p>")
    assert 20_000 < len(told) <= 32_000


# Canvas.


def taken_by_canvas(text):
    """What Canvas's importer would make of it: `lib/gradebook_importer.rb`."""
    head, possible, *students = rows(text)
    assert "Student" in head[0]
    assert "ID" in head[1]
    assert re.search(r"SIS\s+User\s+ID", head[2])
    assert re.search(r"SIS\s+Login\s+ID", head[3])
    assert "Section" in head[4]
    assert "Points Possible" in possible[0]
    assert not any("Points Possible" in one[0] for one in students)
    assert all(len(one) == len(head) == 6 for one in (possible, *students))
    return head[5], float(possible[5]), {int(one[1]): one[5] for one in students}


def test_canvas_takes_the_points_of_its_own_learners():
    held = of("canvas", mark(points=2.0, out_of=2.0), mark("03b", "held"), learner="12")
    made = book(of("canvas"), held, of("moodle", learner="13"))
    taken = taken_by_canvas(canvas_csv(made, "Publishers (99)"))
    assert taken == ("Publishers (99)", 3.0, {4711: "1.5", 12: ""})


@pytest.mark.parametrize("name", ["Points Possible", "x POINTS possible", "a\n    Points Possible"])
def test_no_name_says_what_the_assignment_is_worth(name):
    text = canvas_csv(book(of("canvas", name=name)))
    assert text.casefold().count("points possible") == 1
    assert taken_by_canvas(text)[2] == {4711: "1.5"}


@pytest.mark.parametrize(
    "title", ["", " ", "ID", "Section", "Final Score", "current grade", "My Override Score"]
)
def test_a_title_that_canvas_keeps_for_itself_is_refused(title):
    with pytest.raises(GradingError, match="title of an assignment") as caught:
        canvas_csv(book(of("canvas")), title)
    assert caught.value.means
    assert caught.value.to_try


@pytest.mark.parametrize("assignment", ["rosbeat", "Übung 3 (4711)", "a, b"])
def test_the_title_stands_as_it_was_given(assignment):
    assert taken_by_canvas(canvas_csv(book(of("canvas")), assignment))[0] == assignment
