"""An instructor opens the tables in a spreadsheet, and takes them to a learning platform."""

import csv
import io
import re
from dataclasses import replace
from html.parser import HTMLParser

import pytest

from graded_classes import HOSTILE, a_class, hostile_learner, mark, one_of_each
from rosbeat.grading.csv_exports import grades_csv
from rosbeat.grading.files import cell
from rosbeat.grading.marks import Gradebook, Graded
from rosbeat.grading.platforms import PLATFORMS, platform_named

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


def uploaded(system, made, assignment="rosbeat"):
    """What is uploaded to a platform; nothing for other platforms' learners."""
    learners = [one for one in made.learners if one.system == system]
    return platform_named(system).table(learners, assignment) if learners else ""


def moodle_csv(made):
    return uploaded("moodle", made)


def canvas_csv(made, assignment="rosbeat"):
    return uploaded("canvas", made, assignment)


#: Rows of the table of a platform, besides that of the learner and the heading.
EXTRA_ROWS = {"canvas": 1}
SYSTEMS = [one.name for one in PLATFORMS if not one.has_free_names]


@pytest.mark.parametrize("text", NASTY)
def test_hostile_names_leave_tables_whole_and_no_cell_is_a_formula_in_any_country(text):
    details = dict.fromkeys(("orgdefinedid", "username", "sid", "email"), text or "x")
    hostile = replace(hostile_learner(text), details=details)
    made = book(*(replace(hostile, system=one) for one in SYSTEMS))
    marks = sum(len(one.marks) for one in made.learners)
    tables = [(marks, grades_csv(made))]
    tables += [(1 + EXTRA_ROWS.get(one, 0), uploaded(one, made, text)) for one in SYSTEMS]
    # Where cells are parted at semicolons, a whole row of ours may be one.
    before = csv.field_size_limit(1_000_000)
    try:
        for many, table in tables:
            table.encode("utf-8")
            assert len(named(table)) == many
            assert max(len(one) for row in rows(table) for one in row) <= 32_767
            for separator in ",;\t":
                file = io.StringIO(table.removeprefix("\ufeff"), newline="")
                cells = [one for row in csv.reader(file, delimiter=separator) for one in row]
                assert not [one for one in cells if one.lstrip(' "')[:1] in FORMULA and one[1:]]
                assert all(one.isprintable() for one in cells)
    finally:
        csv.field_size_limit(before)
    shown = Shown(feedback(replace(hostile_learner(text), system="moodle")))
    assert set(shown.tags) <= {"p", "br"}
    assert "\u202e" not in shown.text


# The table to look at.


def test_there_is_a_row_for_each_learner_and_exercise():
    made, text = a_class(5), grades_csv(a_class(5))
    assert text.encode().startswith(b"\xef\xbb\xbflearner,")
    assert text.count("\r\n") == text.count("\n") == len(named(text)) + 1
    assert [(one["learner"], one["exercise"]) for one in named(text)] == [
        (one.learner, mark.exercise) for one in made.learners for mark in one.marks
    ]


def test_all_that_matters_stands_in_the_row():
    said = {"comment": "A nice\nidea.", "differs": "One. Two.", "cause": "So."}
    made = mark("04c", points=0.5, manual=True, late=True, mistake="boundary", title="calm", **said)
    assert named(grades_csv(book(of("moodle", made)))) == [
        {
            "learner": "4711", "name": "Ana Muster", "system": "moodle", "page": made.page,
            "exercise": "04c", "title": "calm", "status": "passed", "points": "0.5",
            "out_of": "1", "cause": "So.", "mistake": "boundary", "late": "yes", "judged": "0",
            "deducted": "", "manual": "yes", "comment": "A nice idea.", "differs": "One. Two.",
        }
    ]  # fmt: skip


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
    assert len(cell(f"{text}=" + "x" * 100_000)) <= 32_767


# Moodle.


COLUMNS = (
    "Identifier,Full name,Email address,Status,Grade,Maximum Grade,Grade can be changed,"
    "Last modified (submission),Last modified (grade),Feedback comments"
)


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
    assert moodle_csv(made).splitlines()[0] == COLUMNS
    assert imported(moodle_csv(made), 3.0) == {4711: 1.5}
    assert moodle_csv(book(of("folder"), of("canvas"))) == ""
    assert canvas_csv(book(of("folder"), of("moodle"))) == ""
    assert [one["Maximum Grade"] for one in named(moodle_csv(made))] == ["3", "3"]


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
    assert "One of your exercises has no points yet" in told
    assert "04b, raise the alarm: not settled yet. It used more memory than there is." in told
    assert "04c, the mean of five readings: 0.5 of 1." in told


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
    taken = taken_by_canvas(canvas_csv(made, "Übung, 3 (99)"))
    assert taken == ("Übung, 3 (99)", 3.0, {4711: "1.5", 12: ""})


@pytest.mark.parametrize("name", ["Points Possible", "x POINTS possible", "a\n    Points Possible"])
def test_no_name_says_what_the_assignment_is_worth(name):
    text = canvas_csv(book(of("canvas", name=name)))
    assert text.casefold().count("points possible") == 1
    assert taken_by_canvas(text)[2] == {4711: "1.5"}
