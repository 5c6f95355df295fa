"""Who is in the class, and who is meant in a table that went through a person's hands."""

from datetime import datetime

import pytest

from grading_files import PAGE_03
from rosbeat.errors import GradingError
from rosbeat.grading.deadlines import read_due
from rosbeat.grading.files import cell
from rosbeat.grading.marks import Graded
from rosbeat.grading.roster import Lookup, Person, UnusableError, read_roster, with_roster
from rosbeat.grading.submissions import collect

DUE = read_due("2026-11-30 18:00")
MOODLE = """\
Identifier,"Full name","Email address",Status,Grade,"Maximum Grade","Grade can be changed"
"Participant 11","Ana Petrov",a@x.org,"Submitted for grading",,8.00,Yes
"Participant 12","Ben O'Kafor",b@x.org,"No submission",,8.00,Yes
"""
MOODLE_PEOPLE = """\
"First name","Last name","ID number","Email address"
Ana,Petrov,s4711,a@x.org
Ben,O'Kafor,,b@x.org
"""
CANVAS = """\
Student,ID,SIS User ID,SIS Login ID,Section,Publishers (4711)
,,,,,Manual Posting
    Points Possible,,,,,8
"Petrov, Ana",11,x11,ana,A,
"O'Kafor, Ben",12,x12,ben,A,
"Student, Test",99,,abc,A,
"""


@pytest.fixture
def read(tmp_path):
    def read(text, due=DUE):
        path = tmp_path / "class.csv"
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return read_roster(path, due)

    return read


@pytest.mark.parametrize(
    ("text", "people"),
    [
        ("ana\nben\n", [("ana", ""), ("ben", "")]),
        ("\ufeffAna Petrov\r\n\r\n  Ben \r\n", [("Ana Petrov", ""), ("Ben", "")]),
        ("Petrov, Ana\nOkafor, Ben\n", [("Petrov, Ana", ""), ("Okafor, Ben", "")]),
        ("4711,Ana Petrov\n4712,Ben\n", [("4711", "Ana Petrov"), ("4712", "Ben")]),
        ("id;name\n4711;Ana\n;Ben\n", [("4711", "Ana"), ("", "Ben")]),
        ("Name\tID\nAna\t4711\n", [("4711", "Ana")]),
        (MOODLE, [("11", "Ana Petrov"), ("12", "Ben O'Kafor")]),
        (MOODLE_PEOPLE, [("s4711", "Ana Petrov"), ("", "Ben O'Kafor")]),
        (CANVAS, [("11", "Petrov, Ana"), ("12", "O'Kafor, Ben")]),
    ],
    ids=["ids", "names", "last names first", "numbers", "columns", "tabs", "moodle",
         "moodle participants", "canvas"],
)  # fmt: skip
def test_a_roster_is_read_as_it_is(read, text, people):
    found = read(text)
    assert [(one.id, one.name) for one in found.people] == people
    assert found.system == {MOODLE: "moodle", CANVAS: "canvas"}.get(text, "")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "names no learner"),
        ("id,name\n", "names no learner"),
        ("Nom,Courriel,Groupe\nAna,a@x,A\n", "names no learner"),
        ('name\n"Ana\nBen\n', "line 2 is not CSV"),
        ("name,due\nAna,soon\n", "line 2: 'soon' is neither a day nor a time"),
        ("name,extension\nAna,3 moons\n", "line 2: '3 moons' is neither"),
        ("id,extension\nana,3\n", "Give it with --due"),
    ],
)
def test_what_cannot_be_used_is_refused_with_a_sentence(read, text, said, says):
    with pytest.raises(GradingError) as caught:
        read(text, due=None if "--due" in said else DUE)
    says(caught.value, said)


@pytest.mark.parametrize(
    ("column", "text", "due"),
    [
        ("due", "2026-12-05 12:00", datetime(2026, 12, 5, 12).timestamp()),
        ("due", "", None),
        ("extension", "2026-12-05 12:00", datetime(2026, 12, 5, 12).timestamp()),
        ("extension", "3", DUE + 3 * 86_400),
        ("extension", "+1.5 d", DUE + 36 * 3_600),
        ("extension", "12h", DUE + 12 * 3_600),
        ("extension", "1 week", DUE + 7 * 86_400),
    ],
)
def test_a_learner_may_have_another_deadline(read, column, text, due):
    assert read(f"id,{column}\nana,{text}\n").people == (Person(2, "ana", "", due),)


# With what was handed in.


@pytest.fixture
def joined(read, handed_in, pages):
    """The class with its roster: systems by learner, remarks, and the deadlines."""

    def join(text, folders):
        files = {f"{one}/03_write.ipynb": PAGE_03 for one in folders}
        found, due_of = with_roster(collect(handed_in(files), pages), read(text), DUE)
        own = {one.learner: due_of(one) - DUE for one in found.submissions if due_of(one) != DUE}
        return (
            {one.learner: (one.system, len(one.pages)) for one in found.submissions},
            [(remark.about, remark.text) for remark in found.remarks],
            own,
        )

    return join


IN_MOODLE = "Ana Petrov_11_assignsubmission_file_"


@pytest.mark.parametrize(
    ("text", "folders", "wanted"),
    [
        ("ana\nben\n", ["ana"], {"ana": ("folder", 1), "ben": ("folder", 0)}),
        ("Ana Petrov\nBen\n", ["petrov_ana"], {"petrov_ana": ("folder", 1), "Ben": ("folder", 0)}),
        (MOODLE, [IN_MOODLE], {"11": ("moodle", 1), "12": ("moodle", 0)}),
        (MOODLE_PEOPLE, [IN_MOODLE], {"11": ("moodle", 1), "Ben O'Kafor": ("folder", 0)}),
        ("11\n12\n", [IN_MOODLE], {"11": ("moodle", 1), "12": ("moodle", 0)}),
        (CANVAS, ["petrovana_11_9_x"], {"11": ("canvas", 1), "12": ("canvas", 0)}),
        ("O'Kafor, Ben\n", ["okaforben_12_9_x"], {"12": ("canvas", 1)}),
        ("Ben O'Kafor\n", ["okaforben_12_9_x"], {"12": ("canvas", 1)}),
        (CANVAS, ["ana petrov"], {"ana petrov": ("folder", 1), "12": ("canvas", 0)}),
    ],
)
def test_who_handed_in_nothing_is_in_the_class(joined, text, folders, wanted):
    found, remarks, _ = joined(text, folders)
    assert found == wanted
    assert remarks == []


def test_another_learner_of_the_same_name_is_not_taken_for_one_with_an_id(joined):
    text = MOODLE.replace("Participant 11", "Participant 13")
    found, remarks, _ = joined(text, [IN_MOODLE])
    assert found == {"11": ("moodle", 1), "12": ("moodle", 0), "13": ("moodle", 0)}
    assert remarks == [("roster", "Ana Petrov (11) handed in and is not on the roster.")]


def test_two_of_one_name_are_told_and_nobody_gets_a_zero_for_it(joined):
    folders = ["Kim Li_1_assignsubmission_file_", "Kim Li_2_assignsubmission_file_"]
    found, remarks, own = joined("name,extension\nKim Li,3\nKim Li,\n", folders)
    assert found == {"1": ("moodle", 1), "2": ("moodle", 1)}
    assert [text for _, text in remarks] == [
        "'Kim Li' are 2 learners who handed in; write the id."
    ] * 2
    assert own == {}


KIMS = ["Kim Li_20028_assignsubmission_file_"]


def test_the_id_decides_between_two_of_one_name_and_nobody_vanishes(joined):
    """Fault 2 of a review: one of them had no row, and the other got her extension."""
    text = "id,name,extension\n20008,Kim Li,3 days\n20028,Kim Li,\n"
    found, remarks, own = joined(text, KIMS)
    assert found == {"20008": ("moodle", 0), "20028": ("moodle", 1)}
    assert remarks == []
    assert own == {"20008": 3 * 86_400}


@pytest.mark.parametrize(
    ("text", "folders", "learners", "remarks"),
    [
        # Numbers of students, which Moodle does not know: the name is all there is.
        ("x1,Kim Li,3\nx2,Kim Li,\n", KIMS, {"20028", "x1", "x2"}, 2),
        ("x1,Kim Li,3\nx2,Kim Li,\nx3,Kim Li,\n",
         [*KIMS, "Kim Li_2_assignsubmission_file_"], {"20028", "2", "x1", "x2", "x3"}, 3),
        ("x1,Kim Li,3\nx2,Kim Li,\n",
         [*KIMS, "Kim Li_2_assignsubmission_file_"], {"20028", "2"}, 2),
        ("x1,Kim Li,\nx2,Bo Li,3\n", KIMS, {"20028", "x2"}, 0),
        # Whoever has another id is another person, and is told not to be on the roster.
        ("1,Ana,3\n2,Kim Li,\n", [*KIMS, "Ana_1_assignsubmission_file_"],
         {"1", "2", "20028"}, 1),
        ("20028,Kim Li,\n,Kim Li,3\n", KIMS, {"20028", "Kim Li"}, 1),
        ("20028,Kim Li,\n20028,Kim Li,\n", KIMS, {"20028"}, 1),
        # Folders are called by the id or by the name, as it came.
        ("1,Ana Petrov,\n2,Ben Okafor,3\n", ["1", "ben okafor"], {"1", "ben okafor"}, 0),
    ],
)  # fmt: skip
def test_each_line_with_an_id_of_its_own_has_a_row(joined, text, folders, learners, remarks):
    found, told, own = joined(f"id,name,extension\n{text}", folders)
    assert set(found) == learners
    assert len(told) == remarks
    assert set(own) <= set(found)
    assert "20028" not in own  # nobody gets the extension of somebody of the same name


def test_whoever_is_named_twice_is_told(joined):
    found, remarks, own = joined("id,extension\nana,\nben,\nana,1\nben,\n", ["ana"])
    assert found == {"ana": ("folder", 1), "ben": ("folder", 0)}
    assert [text for _, text in remarks] == [
        "Line 2 names ana already.",
        "Line 3 names ben already.",
    ]
    assert own == {"ana": 86_400}


# Finding a learner.

FORMULA = '=HYPERLINK("http://a.b")'


def lookup(*learners):
    return Lookup(Graded(*one, "folder", ()) for one in learners)


CLASS = lookup(
    ("0047", "Ana Muster"), ("ben", "Ben"), ("Cy", "Cy One"), ("cy", "Cy Two"), ("0", "Zero"),
    (FORMULA, FORMULA), ("a\u202eb", "Deniz"), ("e1", "Kim Twin"), ("e2", "Kim Twin"), ("E 3", ""),
)  # fmt: skip


@pytest.mark.parametrize(
    ("text", "learner"),
    [
        ("0047", "0047"),
        ("47", "0047"),
        ("Ana Muster", "0047"),
        ("Muster, Ana", "0047"),
        (" ana   muster ", "0047"),
        ("'ben", "ben"),
        ("Cy", "Cy"),
        ("cy", "cy"),
        ("0", "0"),
        ("00", "0"),
        (FORMULA, FORMULA),
        (cell(FORMULA), FORMULA),
        (cell("a\u202eb"), "a\u202eb"),
        ("e 3", "E 3"),
    ],
)
def test_a_learner_is_found(text, learner):
    assert CLASS.find(text).learner == learner


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "names no learner"),
        ("nobody", "There is no learner 'nobody'"),
        ("CY", "2 learners; write the id"),
        ("Kim Twin", "2 learners; write the id"),
        ("48", "There is no learner"),
        ("x\x1b" * 9_999, "\\\\u001b"),
    ],
)
def test_whoever_is_not_there_or_not_one_is_told(text, said):
    with pytest.raises(UnusableError) as caught:
        CLASS.find(text)
    assert said in str(caught.value)
    assert "\x1b" not in str(caught.value)
    assert len(str(caught.value)) < 120
    assert "the column learner of grades.csv" in caught.value.to_try


def test_a_learner_is_found_by_what_moodle_s_worksheet_says():
    both = Lookup(
        Graded(one, "Ana", system, ()) for one, system in (("11", "moodle"), ("12", "canvas"))
    )
    for text in ("Participant 11", " participant  11 "):
        assert both.find(text).learner == "11"
    with pytest.raises(UnusableError, match="There is no learner"):
        both.find("Participant 12")
