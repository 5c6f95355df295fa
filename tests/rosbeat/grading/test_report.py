"""The report of a class: counted, drawn, said in words, and safe whatever a learner wrote."""

import re
from dataclasses import replace
from importlib.resources import files

import pytest

from graded_classes import HOSTILE, a_class, hostile_learner, mark, one_of_each
from parsed_html import ELEMENTS, Parsed, require_harmless
from rosbeat.grading.feedback import feedback, feedback_files
from rosbeat.grading.files import number
from rosbeat.grading.marks import MISSING, Gradebook, Graded
from rosbeat.grading.rendering import (
    STATUSES,
    name,
    paragraph,
    prose,
    readable,
)
from rosbeat.grading.report import (
    class_report,
    shares,
    tally_exercises,
    tally_mistakes,
)

ONE = Gradebook("0.1.0", (one_of_each(),))
STYLE = (files("rosbeat.grading") / "templates" / "style.css").read_text("utf-8")


def text_of(page):
    return " ".join(Parsed(page).text.split())


def sections(page):
    """The sections of a page, by their headings."""
    return {part.split("</h2>")[0]: part for part in page.split("<h2>")[1:]}


# What is said.


SAID = """
1 learner, 10 exercises. 2 exercises wait for you to look at.
Judged by version 0.1.0
Median 44 %, mean 44 % of the points.
A topic name that no other node uses
Hint for the class (03b): Compare the two names letter by letter.
03 Write a publisher
Ana Muster (4711) 04b raise the alarm 04.ipynb It used more memory than there is.
Ana Muster homework (1).ipynb This is the page 03; it has another name.
The page shows that it has passed.
"""


def test_everything_is_said():
    text = text_of(class_report(ONE))
    assert [said for said in SAID.strip().split("\n") if said not in text] == []


@pytest.mark.parametrize("size", [0, 1, 100])
def test_classes_of_every_size(size):
    page = class_report(a_class(size))
    assert page == class_report(a_class(size))
    assert len(page) < 200_000
    assert {tag for tag, _ in Parsed(page).elements} <= ELEMENTS


def test_a_class_without_remarks_has_no_empty_list_of_files():
    assert "<h2>Files</h2>" in class_report(ONE)
    assert "<h2>Files</h2>" not in class_report(Gradebook("1", ()))


def test_strange_texts_stay_text():
    page = class_report(Gradebook("<b>", tuple(hostile_learner(one) for one in HOSTILE)))
    require_harmless(page)
    assert not re.search(r"https?:|url\(|@import|src=\"", class_report(a_class(3)))


# Who is named.


def test_every_learner_has_points_and_a_link_to_the_feedback():
    learners = [replace(one, name=f"Ünal & {n}") for n, one in enumerate(a_class(70).learners)]
    book = Gradebook("1", tuple(reversed(learners)))
    page = sections(class_report(book))["Learners"]
    links = [attrs["href"] for tag, attrs in Parsed(page).elements if tag == "a"]
    files = feedback_files(book)
    assert set(links) == {f"feedback/{files[one.learner]}" for one in learners}
    assert len(links) == 70
    text = text_of(page)
    one = learners[0]
    assert f"Ünal & 0 0000 {number(one.points)} ? {number(one.out_of)} 1 Ünal & 1 0001" in text


# Counting.


def learner(name, *marks):
    return Graded(name, name, "folder", marks)


def wrong(exercise, mistake, hint="h", evidence="e"):
    return mark(exercise, "failed", mistake=mistake, hint=hint, evidence=evidence)


BOOK = Gradebook(
    "1",
    (
        learner("ana", mark("03a"), wrong("04a", "boundary", "one")),
        learner("ben", wrong("03a", "boundary", "two"), wrong("04a", "boundary", "two")),
        learner("cy", mark("03a", "held"), wrong("04a", "new-to-me")),
        learner("di", mark("03a", "missing"), mark("04a", "missing")),
    ),
)


def test_a_hint_and_an_example_are_about_one_exercise():
    """Fault 10 of a review: the hint of one exercise beside what was seen in another."""
    marks = (
        wrong("08c", "boundary", "About 08c.", "Rare in 08c."),
        wrong("08c", "boundary", "About 08c.", "Seen in 08c."),
        wrong("08c", "boundary", "About 08c.", "Seen in 08c."),
        *(wrong("12d", "boundary", f"About 12d, {n}.", "Seen in 12d.") for n in range(5)),
    )
    book = Gradebook("1", tuple(learner(f"l{n}", one) for n, one in enumerate(marks)))
    (tally,) = tally_mistakes(book)
    assert (tally.example, tally.hint, tally.evidence) == ("08c", "About 08c.", "Seen in 08c.")
    text = text_of(class_report(book))
    assert "Hint for the class (08c): About 08c. Seen, for example (08c): Seen in 08c." in text
    assert "Seen in 12d" not in text


def test_a_class_is_counted():
    found = {one.exercise: one.statuses for one in tally_exercises(BOOK)}
    assert found == {
        "03a": ["passed", "failed", "held", "missing"],
        "04a": ["failed", "failed", "failed", "missing"],
    }
    first, second = tally_mistakes(BOOK)
    assert (first.mistake, first.count, first.learners) == ("boundary", 3, 2)
    assert (first.places, first.hint) == ((("04a", 2), ("03a", 1)), "two")
    assert (second.mistake, second.count) == ("new-to-me", 1)
    assert (first.example, first.evidence) == ("03a", "e")
    for many, said in (
        (6, "05a 1×"),
        (7, "and in 1 more exercise"),
        (9, "and in 3 more exercises"),
    ):
        places = tuple((f"0{n}a", 1) for n in range(many))
        assert replace(first, places=places).first_places.endswith(said)
    assert sorted(shares(BOOK)) == [0, 0, 0, 50]
    assert "Median 0 %, mean 12 % of the points" in class_report(BOOK)


# A page works from one file, whatever is in it.


def test_a_page_has_what_browsers_and_readers_need():
    parsed = Parsed(class_report(ONE))
    tags = [tag for tag, _ in parsed.elements]
    metas = [attrs for tag, attrs in parsed.elements if tag == "meta"]
    assert ("html", {"lang": "en"}) in parsed.elements
    assert {"charset": "utf-8"} in metas
    assert {"name": "viewport", "content": "width=device-width, initial-scale=1"} in metas
    (policy,) = [one["content"] for one in metas if "http-equiv" in one]
    assert policy == "default-src 'none'; style-src 'unsafe-inline'; img-src data:"
    assert not {"script", "link", "iframe", "object"} & set(tags)


def test_a_text_makes_no_elements_and_what_is_hidden_in_it_is_shown():
    for text in HOSTILE:
        for make in (name, paragraph, prose):
            made = make(text)
            made.encode("utf-8")
            assert not set("\0\x1b\u202e") & set(made)
            elements = Parsed(f"<i>{made}</i>").elements
            assert {tag for tag, _ in elements} <= {"i", "p", "pre", "bdi"}
            assert all(set(attrs) <= {"dir", "class"} for _, attrs in elements)
    assert readable("a\u202eb\0c\n\td") == "a\\u202eb\\u0000c\n\td"
    assert paragraph("a\n  b") == "<pre>a\n  b</pre>"
    assert prose("a\nb") == '<p class="said" dir="auto">a\nb</p>'
    assert paragraph(" ") == prose(" ") == ""


# Colours: text and edges can be made out, in both themes.


def colours(theme):
    """Colours of a theme by name."""
    blocks = re.findall(r":root \{([^}]*--ink[^}]*)\}", STYLE)
    assert len(blocks) == 2
    return dict(re.findall(r"--([\w-]+): (#\w+);", blocks[("light", "dark").index(theme)]))


def luminance(colour):
    """Relative luminance of a colour (WCAG 2.2)."""
    parts = [int(colour[at : at + 2], 16) / 255 for at in (1, 3, 5)]
    linear = [one / 12.92 if one <= 0.04045 else ((one + 0.055) / 1.055) ** 2.4 for one in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(one, other):
    low, high = sorted((luminance(one), luminance(other)))
    return (high + 0.05) / (low + 0.05)


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_colours_can_be_told_apart(theme):
    found = colours(theme)
    for ground in ("page", "card", "missing"):
        assert contrast(found["ink"], found[ground]) >= 4.5
    for text in ("muted", "link"):
        assert min(contrast(found[text], found[ground]) for ground in ("page", "card")) >= 4.5
    for look in STATUSES.values():
        assert contrast(found[f"on-{look.kind}"], found[look.kind]) >= 4.5
        assert look.kind == "missing" or contrast(found[look.kind], found["card"]) >= 3
    assert contrast("#000000", "#ffffff") == pytest.approx(21)


def test_both_themes_have_all_the_colours_that_are_used():
    used = set(re.findall(r"var\(--([\w-]+)\)", STYLE))
    assert used <= set(colours("light")) == set(colours("dark"))


def test_whoever_has_no_grade_is_told_so_and_is_not_counted():
    learner = one_of_each()
    absent = replace(
        learner,
        learner="absent",
        marks=tuple(replace(one, status=MISSING, points=0.0) for one in learner.marks),
        excused=True,
    )
    both = Gradebook("0.1.0", (learner, absent))
    assert len(shares(both)) == 1
    assert "no grade" in class_report(both)
    assert "No grade: nothing was handed in." in feedback(absent)
