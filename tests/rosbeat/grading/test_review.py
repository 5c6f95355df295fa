"""The review of a class: groups of like answers, marks by hand, and who may reach the server."""

import csv
import http.client
import json
import re
from dataclasses import replace
from urllib.parse import urlencode

import pytest

from graded_classes import HOSTILE, hostile_learner
from parsed_html import Parsed, require_harmless
from reviewing import LAYOUT, NAMES, OTHER, SOLUTION, a_class_to_review, served
from rosbeat.grading.groups import groups_of, shape_of
from rosbeat.grading.marks import Gradebook

FORM = {"nav", "form", "input", "button", "textarea", "label", "kbd", "br", "script"}


# Groups.


@pytest.mark.parametrize(
    ("one", "other", "alike"),
    [
        (SOLUTION, LAYOUT, True),
        (SOLUTION, NAMES, True),
        (SOLUTION, OTHER, False),
        ("x = 1  # one\n", "x=1", True),
        ("a = 1\nb = a", "b = 1\na = b", True),
        ("a = 1\nb = a", "a = 1\nb = b", False),
        ("a = f(1)", "a = g(1)", False),
        ("self.a = self.b", "self.c = self.b", True),
        ("self.a = 1\nother.a = 2", "self.b = 1\nother.a = 2", True),
        ("self.start()", "self.stop()", False),
        ("message.data = 1.0", "message.layout = 1.0", False),
        ("for x in y: f(data=x)", "for data in y: f(data=data)", True),
        ("'/status'", "'/state'", True),  # a text that nobody uses is a comment
        ("a = '/status'", "a = '/state'", False),
        ("%%terminal\nmkdir  a", "%%terminal\nmkdir a\n", True),
        ("mkdir a", "mkdir b", False),
        ("def f(:", "def g(:", False),
        ("x = '\\d'", "x = '\\d' ", True),
        ("", " ", True),
        ("(" * 5_000, "[" * 5_000, False),
    ],
)
def test_answers_are_alike_but_for_names_and_layout(one, other, alike):
    assert (shape_of(one) == shape_of(other)) == alike


def test_groups_come_in_the_order_in_which_a_person_looks():
    groups = groups_of(a_class_to_review(7))
    assert [(one.exercise, one.first.status, len(one.members)) for one in groups] == [
        ("04a", "failed", 2),
        ("04a", "passed", 5),
        ("04b", "held", 4),
        ("04b", "held", 3),
    ]
    names = "equal to the published solution but for names and layout"
    assert [one.solution for one in groups] == ["", names, "", ""]
    book = a_class_to_review(1)
    assert {one.solution for one in groups_of(replace(book, solutions=()))} == {""}


# The server.


@pytest.fixture
def out(tmp_path):
    return tmp_path / "out"


@pytest.fixture
def server(out):
    with served(out, a_class_to_review()) as made:
        yield made


def asked(server, path="", form=None, token=None, **headers):
    """Ask for a page behind the token, or post a form to it: status, where to go on, and page."""
    connection = http.client.HTTPConnection("127.0.0.1", server.server_port, timeout=30)
    body = None if form is None else urlencode(form, doseq=True)
    names = {name.replace("_", "-"): value for name, value in headers.items()}
    method = "GET" if form is None else "POST"
    connection.request(method, f"/{token or server.token}/{path}", body, names)
    answer = connection.getresponse()
    page = answer.read().decode()
    connection.close()
    return answer.status, answer.headers, page


def lines(out):
    with (out / "manual.csv").open(encoding="utf-8-sig", newline="") as file:
        return [tuple(row.values()) for row in csv.DictReader(file)]


def test_the_overview_lists_all_groups(server):
    status, headers, page = asked(server)
    assert status == 200
    links = [attrs["href"] for tag, attrs in Parsed(page).elements if tag == "a"]
    assert links == [f"{server.root}group/{n}" for n in (0, 0, 1, 2, 3)]
    assert "but for names and layout" in page
    assert headers["Cache-Control"] == "no-store"
    assert headers["Referrer-Policy"] == "same-origin"
    nonce = re.search("script-src 'nonce-([^']+)'", headers["Content-Security-Policy"])[1]
    assert page.count(f'nonce="{nonce}"') == 2
    assert asked(server)[2] != page  # another nonce


def test_a_group_has_its_code_evidence_picture_and_learners(server):
    page = asked(server, "group/0")[2]
    text = " ".join(Parsed(page).text.split())
    for said in (
        "04a watch a fridge: group 1 of 2",
        "1 answer, ✗ not there yet",
        "For a reading of 8 the node said Warm.",
        "Squares: what the published solution did",
        "Learner 2 (0002)",
        "Points, of 2 (the judge gives 0)",
    ):
        assert said in text
    assert 'id="previous"' not in page
    assert 'id="next"' in page


def test_points_and_a_comment_for_a_group_are_in_manual_csv_and_in_the_results(server, out):
    status, headers, _ = asked(server, "group/1", {
        "member": [0, 1, 2], "points": "1,5", "comment": "Fine.\n=1+1", "next": "",
    })  # fmt: skip
    assert (status, headers["Location"]) == (303, f"{server.root}group/2")
    assert lines(out) == [
        (f"000{n}", f"Learner {n}", "04a", "1.5", "Fine.\n'=1+1") for n in (0, 1, 3)
    ]
    page = asked(server, "group/1")[2]
    assert "not yet in the results" in page
    assert page.count("1.5 of 2 points") == 3
    assert '"points": 1.5' not in (out / "results.json").read_text()
    status, headers, _ = asked(server, "regrade", {"back": "group/1"})
    assert (status, headers["Location"]) == (303, f"{server.root}group/1")
    results = json.loads((out / "results.json").read_text())
    assert [one["marks"][0]["points"] for one in results["learners"]] == [1.5, 1.5, 0, 1.5]
    assert "Fine." in (out / "feedback").joinpath("learner-0_0000.html").read_text()
    page = asked(server)[2]
    assert "All results have what you gave." in page
    assert "4 learners, 2 exercises" in page
    assert "4 learners, 2 exercises" not in asked(server)[2]


def test_only_chosen_answers_get_it_and_what_is_emptied_is_as_it_was_judged(server, out):
    asked(server, "group/1", {"member": [1], "points": "1", "comment": "x"})
    asked(server, "group/1", {"member": [0, 1], "points": "", "comment": "y"})
    assert lines(out) == [(f"000{n}", f"Learner {n}", "04a", "", "y") for n in (0, 1)]
    asked(server, "group/1", {"member": [0, 1], "points": "", "comment": ""})
    assert lines(out) == []


def test_lines_of_a_person_about_other_answers_stay(server, out):
    path = out / "manual.csv"
    path.write_text(
        "learner;points;exercise;comment\n3;1;4b;Mine\nnobody;1;04a;Who?\n2;1;4a;Old\n;;;\n"
    )
    before = path.read_bytes()
    asked(server, "group/0", {"member": [0], "points": "2", "comment": "New"})
    assert lines(out) == [
        ("3", "Learner 3", "4b", "1", "Mine"),
        ("nobody", "", "04a", "1", "Who?"),
        ("0002", "Learner 2", "04a", "2", "New"),
    ]
    assert (out / "manual.csv.before-review").read_bytes() == before
    assert "There is no learner" in asked(server)[2]
    asked(server, "group/0", {"member": [0], "points": "1", "comment": "Newer"})
    assert (out / "manual.csv.before-review").read_bytes() == before


@pytest.mark.parametrize("points", ["3", "nan", "<b>"])
def test_points_that_are_none_are_refused_and_what_was_typed_stays(server, out, points):
    before = (out / "manual.csv").read_bytes()
    form = {"member": [0], "points": points, "comment": "<i>kept</i>"}
    status, _, page = asked(server, "group/0", form)
    assert status == 422
    assert "Write a number from 0 to 2, or nothing" in page
    assert "\n&lt;i&gt;kept&lt;/i&gt;</textarea>" in page
    assert (out / "manual.csv").read_bytes() == before


def test_nothing_is_given_to_nobody(server):
    for member in ([], ["7"], ["x"], ["-1"], ["9" * 5_000]):
        status, _, page = asked(server, "group/0", {"member": member, "points": "1"})
        assert status == 422
        assert "Tick at least one" in page


def test_a_file_that_cannot_be_read_whole_is_not_written(server, out):
    (out / "manual.csv").write_text('learner,exercise,points,comment\n0001,04b,1,"open\n')
    before = (out / "manual.csv").read_bytes()
    status, _, page = asked(server, "group/0", {"member": [0], "points": "1"})
    assert status == 422
    assert "Nothing was written" in page
    assert (out / "manual.csv").read_bytes() == before


def test_a_folder_that_cannot_be_written_is_told_and_the_server_goes_on(server, out):
    (out / "class.html").unlink()
    (out / "class.html").mkdir()
    asked(server, "group/0", {"member": [0], "points": "1"})
    status, _, _ = asked(server, "regrade", {})
    assert status == 303
    assert "class.html cannot be written" in asked(server)[2]


# Who may.


@pytest.mark.parametrize("host", ["evil.example", "127.0.0.1:1", ""])
@pytest.mark.parametrize("form", [None, {"member": [0], "points": "1"}])
def test_a_request_for_another_host_is_refused(server, out, host, form):
    before = (out / "manual.csv").read_bytes()
    assert asked(server, "group/0", form, Host=host)[0] == 403
    assert (out / "manual.csv").read_bytes() == before


@pytest.mark.parametrize("origin", ["null", "http://evil.example"])
def test_a_post_from_another_page_is_refused(server, out, origin):
    before = (out / "manual.csv").read_bytes()
    form = {"member": [0], "points": "1"}
    assert asked(server, "group/0", form, Origin=origin)[0] == 403
    assert (out / "manual.csv").read_bytes() == before
    own = f"http://localhost:{server.server_port}"
    assert asked(server, "group/0", form, Origin=own, Host=own[7:])[0] == 303


def test_without_the_token_there_is_nothing_and_no_page_leads_elsewhere(server):
    for token in ("x", "%00", "..", "x" * 43, "%C3%A9"):
        assert asked(server, token=token)[::2] == (404, "")
        assert asked(server, "regrade", {}, token=token)[::2] == (404, "")
    for path in ("group/4", "group/-1", "group/x", "group/" + "9" * 50, "x", "../", "regrade"):
        assert asked(server, path)[0] == 404
    for length in ("2000000", "-1", "x", ""):
        assert asked(server, "group/0", {}, Content_Length=length)[0] == 413
    assert asked(server, "regrade", {"back": "//evil.example/"})[1]["Location"] == server.root
    assert server.server_address[0] == "127.0.0.1"
    assert len(server.token) >= 43


def test_a_strange_class_can_be_reviewed(out):
    with served(out, Gradebook("1", tuple(map(hostile_learner, HOSTILE)))) as server:
        groups = server.review.groups
        assert len(groups) > len(HOSTILE)
        pages = [asked(server, f"group/{place}")[2] for place in range(len(groups))]
        for page in (*pages, asked(server)[2]):
            require_harmless(page, FORM)
        for place, text in enumerate(HOSTILE):
            form = {"member": [0], "points": "1", "comment": text.encode(errors="replace")}
            assert asked(server, f"group/{place}", form)[0] in (303, 422)
        assert asked(server, "regrade", {})[0] == 303
