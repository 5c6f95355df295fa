"""Points and comments that a person gives, and that stay."""

from dataclasses import replace

import pytest

from graded_classes import HOSTILE, hostile_learner, mark
from rosbeat.errors import GradingError
from rosbeat.grading.manual_marks import (
    apply_manual,
    read_manual,
    write_template,
)
from rosbeat.grading.marks import Gradebook, Graded
from rosbeat.grading.remarks import Remark

HEAD = "learner,exercise,points,comment\n"


@pytest.fixture
def book():
    marks = (
        mark("03a", "failed", out_of=4.0, judged=0.0, cause="It is late."),
        mark("03b", "held", out_of=2.0, cause="It used up the memory.", evidence="e", hint="h"),
    )
    ana, ben = (Graded(one, f"{one.title()} X", "folder", marks) for one in ("ana", "ben"))
    return Gradebook("0.1.0", (ana, ben), (Remark("left-out", "a", "b"),))


@pytest.fixture
def given(tmp_path, book):
    """What a gradebook becomes, and the remarks that were added, with this text in the file."""

    def given(text):
        path = tmp_path / "manual.csv"
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        made = apply_manual(book, read_manual(path))
        assert made.remarks[: len(book.remarks)] == book.remarks
        return made, made.remarks[len(book.remarks) :]

    return given


def only(book, learner, exercise):
    (graded,) = [one for one in book.learners if one.learner == learner]
    (found,) = [one for one in graded.marks if one.exercise == exercise]
    return found


def test_points_and_a_comment_are_put_in(given, book):
    made, remarks = given(HEAD + "ana,03a,3,A nice idea.\n")
    before, after = only(book, "ana", "03a"), only(made, "ana", "03a")
    cause = "Set by hand to 3 of 4. It is late."
    assert after == replace(before, points=3.0, manual=True, comment="A nice idea.", cause=cause)
    assert remarks == ()
    assert (made.learners[1], after.status) == (book.learners[1], "failed")


def test_a_comment_alone_changes_nothing_else(given, book):
    made, remarks = given(
        HEAD + 'ana,03a,,Look again.\nana,,,"Well done,\nall of it."\nana,03b,,x\n'
    )
    ana = book.learners[0]
    marks = tuple(
        replace(one, comment=said)
        for one, said in zip(ana.marks, ("Look again.", "x"), strict=True)
    )
    assert made.learners[0] == replace(ana, comment="Well done,\nall of it.", marks=marks)
    assert (remarks, marks[1].status) == ((), "held")


def test_what_was_held_has_been_looked_at_and_says_nothing_else(given):
    made, _ = given(HEAD + "ana,03b,1,Fine.\n")
    after = only(made, "ana", "03b")
    assert (after.status, after.points, after.manual) == ("looked at", 1.0, True)
    assert (after.judged, after.cause) == (0.0, "Looked at by the instructor.")
    assert (after.comment, after.evidence, after.hint, after.mistake) == ("Fine.", "", "", "")


def test_points_by_hand_are_a_grade_for_somebody_who_handed_in_nothing(book, tmp_path):
    path = tmp_path / "manual.csv"
    path.write_text(HEAD + "ana,03a,3,An exam instead.\n")
    marks = tuple(replace(one, status="missing") for one in book.learners[0].marks)
    absent = tuple(replace(one, marks=marks, excused=True) for one in book.learners)
    ana, ben = apply_manual(replace(book, learners=absent), read_manual(path)).learners
    assert (ana.grade, ben.grade) == (3.0, None)


@pytest.mark.parametrize(
    "text",
    [
        "learner;exercise;points;comment\r\nana;03a;1,5;Gut, weiter so\r\n",
        "\ufefflearner;exercise;points;comment\nana;03a;1,5;Gut, weiter so\n",
        'learner,exercise,points,comment\nana,03a,1.5,"Gut, weiter so"\n',
        'learner,exercise,points,comment\nana,03a,"1,5","Gut, weiter so"\n',
        "learner,exercise,points,comment\nana,03a,1.5,Gut, weiter so\n",
        'exercise,points,learner,comment\n3A,1.5,Ana X,"Gut, weiter so"\n',
        "learner\tname\texercise\tpoints\tcomment\nana\tx\t03a\t1.5\tGut, weiter so\n",
        "ana;03a;1,5;Gut, weiter so\n",
    ],
)
def test_every_dialect_means_the_same(given, text):
    made, remarks = given(text)
    after = only(made, "ana", "03a")
    assert (after.points, after.comment) == (1.5, "Gut, weiter so")
    assert remarks == ()


@pytest.mark.parametrize(
    "data",
    [(HEAD + "ana,03a,1,Schön gelöst\n").encode("latin-1"), HEAD.encode("utf-16"), b"\x89PNG\0",
     b"a\0b", (HEAD + 'ana,03a,1,"never closed\nben,03a,2,y\n').encode(), bytes(range(256))],
    ids=["latin-1", "utf-16", "picture", "nul", "quotation mark", "bytes"],
)  # fmt: skip
def test_what_is_not_csv_in_utf_8_is_refused_before_marks_are_lost(given, data, says):
    with pytest.raises(GradingError) as caught:
        given(data)
    says(caught.value, "manual.csv cannot be read", 'Save it as "CSV UTF-8"')


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("nobody,03a,1,x", "no learner 'nobody'"),
        (",03a,1,x", "names no learner"),
        ("ana,99z,1,x", "no exercise '99z'"),
        ("ana,03a,five,x", "'five' is not a number"),
        ("ana,03a,-1,x", "from 0 to 4, not -1"),
        ("ana,03a,4.01,x", "from 0 to 4"),
        ("ana,03a,nan,x", "from 0 to 4"),
        ("ana,03a,inf,x", "from 0 to 4"),
        ("ana,03a,1e999,x", "from 0 to 4"),
        ("ana,,3,x", "belong to an exercise"),
    ],
)
def test_a_line_that_cannot_be_used_is_told_and_costs_no_other(given, book, line, said):
    made, remarks = given(f"{HEAD}{line}\nben,03a,2,y\n")
    (remark,) = remarks
    assert (remark.about, remark.path) == ("manual", "manual.csv, line 2")
    assert said in remark.text
    assert only(made, "ben", "03a").points == 2.0
    assert "Nothing is taken from this line." in remark.text
    assert made.learners[0] == book.learners[0]  # not even the comment


def test_the_later_of_two_lines_counts_and_nothing_of_the_earlier_is_lost(given):
    made, remarks = given(HEAD + "ana,03a,1,first\nana,03a,2,\nana,3a,,last\n")
    after = only(made, "ana", "03a")
    assert (after.points, after.comment) == (2.0, "last")
    first_only, _ = given(HEAD + "ana,03a,1,first\nana,03a,2,\n")
    assert only(first_only, "ana", "03a").comment == "first"
    assert [one.path for one in remarks] == ["manual.csv, line 3", "manual.csv, line 4"]


def test_a_table_without_points_and_comments_is_told(given, book):
    made, remarks = given("learner,exercise,remark\nana,03a,x\n")
    assert made.learners == book.learners
    assert "no column points" in remarks[0].text


# The template.


def test_the_template_has_what_is_held_and_can_be_filled_in(tmp_path, book):
    path = tmp_path / "manual.csv"
    assert write_template(path, book)
    text = path.read_text("utf-8-sig")
    assert text.split() == [
        "learner,name,exercise,points,comment", "ana,Ana", "X,03b,,", "ben,Ben", "X,03b,,"
    ]  # fmt: skip
    assert apply_manual(book, read_manual(path)) == book
    path.write_text(text.replace("ana,Ana X,03b,,", "ana,Ana X,03b,1,So, la la"))
    after = only(apply_manual(book, read_manual(path)), "ana", "03b")
    assert (after.points, after.comment) == (1.0, "So, la la")


@pytest.mark.parametrize(
    "written",
    [
        HEAD + "ana,03a,3,\n",
        HEAD,
        "my notes, please keep them",
        "learner,name,exercise,points,comment\nana,Ana,03b,2,\n",
        "learner,name,exercise,points,comment,why\nana,Ana,03b,,,\n",
    ],
)
def test_what_a_person_has_written_is_never_overwritten(tmp_path, book, written):
    path = tmp_path / "manual.csv"
    path.write_text(written)
    before = path.read_bytes()
    assert not write_template(path, book)
    assert path.read_bytes() == before


@pytest.mark.parametrize("text", [*filter(None, HOSTILE), '=HYPERLINK("x")'])
def test_a_hostile_learner_can_be_given_points_through_the_template(tmp_path, text):
    book = Gradebook("0.1.0", (hostile_learner(text),))
    path = tmp_path / "manual.csv"
    write_template(path, book)
    lines = path.read_text("utf-8-sig").splitlines()
    assert len(lines) == 2
    assert lines[1].strip('"')[0] not in "=+-@"
    path.write_text("\n".join((lines[0], lines[1].removesuffix(",,") + ",1,x")))
    made = apply_manual(book, read_manual(path))
    assert made.remarks == ()
    assert {one.points for one in made.learners[0].marks} == {1.0}
