"""Where a class is stuck: what is read of a folder that anybody may fill, counted, and served."""

import http.client
import json
import os
import re
import socket
import stat

import pytest

from graded_classes import HOSTILE
from parsed_html import ELEMENTS, Parsed, require_harmless
from rosbeat import cli
from rosbeat.diagnosis.mistakes import MISTAKES
from rosbeat.exercises.registry import EXERCISES
from rosbeat.exercises.share import DAY, LARGEST
from rosbeat.grading.class_board import (
    DIAGRAMS,
    Advice,
    ClassServer,
    Common,
    Tally,
    _examples,
    advice,
    board_html,
    board_of,
    shortcomings,
)
from rosbeat.grading.class_folder import ClassFolder
from sharing import NOW, PASSED, Clock, class_folder, learner, record, served

LIVE = {"link", "noscript", "button", "kbd", "script", "b", "img"}


@pytest.fixture
def place(tmp_path):
    folder = tmp_path / "class"
    folder.mkdir()
    return folder


@pytest.fixture
def server(place):
    with served(class_folder(place)) as made:
        yield made


def board(place, clock=None):
    return board_of(class_folder(place, clock).read())


def records(place):
    return [list(one.records) for one in class_folder(place).read().learners]


# Counts.


def test_learners_are_counted_by_exercise(place):
    fail = record("03a", mistake="wrong-rate")
    learner(place, 1, fail, record("03a", PASSED), fail)  # who has passed once has passed
    learner(place, 2, fail, fail)
    learner(place, 3, fail, fail, fail)
    learner(place, 4, *[record("03a", mistake="wrong-rate", name="Ada")] * 5)
    learner(place, 5, record("03b", PASSED))
    learner(place, 6)
    seen = board(place)
    assert (seen.learners, seen.active) == (6, 5)
    (lesson,) = seen.lessons
    assert lesson.is_now
    assert lesson.tallies == (
        Tally("03a", EXERCISES["03a"].title, 1, 1, 2, ("Ada",)),
        Tally("03b", EXERCISES["03b"].title, 1, 0, 0),
    )
    assert seen.hardest == lesson.tallies[0]


def test_mistakes_of_the_last_ten_minutes_are_counted_by_learner(place):
    clock = Clock()
    learner(place, 1, *[record("03a", mistake="wrong-rate", ago=500)] * 9)
    learner(place, 2, record("03a", mistake="wrong-rate"), record("03a", PASSED))
    learner(place, 3, record("03b", mistake="wrong-rate"), record("03b", mistake="no-clamp"))
    learner(place, 4, record("03a", mistake="wrong-topic", name="Ada"))
    learner(place, 5, record("03a", mistake="boundary"), record("03a", mistake="new-to-me"))
    learner(place, 6, record("03a", mistake="wrong-topic", ago=601))
    assert board(place, clock).common == (
        Common("wrong-rate", "A different rate than requested", 3, 1, (("03a", 2), ("03b", 1))),
        Common("boundary", MISTAKES["boundary"].heading, 1, 0, (("03a", 1),)),
        Common("wrong-topic", MISTAKES["wrong-topic"].heading, 1, 0, (("03a", 1),), ("Ada",)),
    )
    clock.now += 150
    assert [one.learners for one in board(place, clock).common] == [2, 1, 1]
    clock.now += 500
    later = board(place, clock)
    assert (later.common, later.active, later.learners) == ((), 0, 6)
    assert [one.is_now for one in later.lessons] == [False]
    assert later.hardest is None  # nobody works on that page any more


def test_all_files_of_one_owner_are_one_learner(place):
    for number in range(9):
        learner(place, number, *[record("03a", mistake="wrong-rate")] * 3)
        os.utime(place / f"{number:032x}.jsonl", (NOW, NOW + number))
    learner(place, 8, record("03a", PASSED))
    os.utime(place / f"{8:032x}.jsonl", (NOW, NOW + 8))
    seen = board_of(ClassFolder(place, Clock()).read())
    assert (seen.learners, seen.common[0].learners) == (1, 1)
    assert seen.lessons[0].tallies[0].passed == 1
    assert board(place).learners == 9


def test_a_line_of_today_counts_and_one_of_yesterday_or_tomorrow_does_not(place):
    ages = (DAY, DAY - 1, 0, -60, -61, -(10**9))
    learner(place, 1, *[record("03a", ago=ago) for ago in ages])
    assert [NOW - one.time for one in records(place)[0]] == [DAY - 1, 0, -60]


# Hostile files.

LINES = [
    *("", "{}", "[]", "null", '"03a"', "{", "[" * 300, '{"a":' * 60, "\0" * 50, "x" * 10_000),
    record("03a", mistake="x" * 61),
    record("03a", name="x" * 41),
    record("99z"),
    record("03a", status="held"),
    record("03a").replace(str(NOW), '"now"'),
    record("03a").replace(str(NOW), "1e400"),
    record("03a").replace(str(NOW), "9" * 300),
    record("03a").replace(str(NOW), "NaN"),
    record("03a").replace(str(NOW), "-1"),
    record("03a") + record("03a"),
]


@pytest.mark.parametrize("line", LINES, ids=lambda one: one[:30])
def test_a_line_that_is_no_record_is_passed_over(place, line):
    path = learner(place, 1, record("03b"), line, record("03c"))
    with path.open("ab") as file:
        file.write(b"\xff\xfe\n\x80\xed\xa0\x80\n")  # no text
    assert [one.exercise for one in records(place)[0]] == ["03b", "03c"]


def test_only_the_end_of_a_huge_file_is_read(place):
    path = learner(place, 1)
    with path.open("wb") as file:
        file.truncate(10 << 30)  # it takes no room on the disk
        file.seek(0, os.SEEK_END)
        file.write(f"\n{record('03a')}\n".encode())
    learner(place, 2, *[record("03b")] * 100_000)
    first, second = records(place)
    assert sorted((len(first), len(second)))[0] == 1
    assert sorted((len(first), len(second)))[1] <= LARGEST // len(record("03b"))


def test_what_is_no_ordinary_file_is_not_opened(place, tmp_path, monkeypatch):
    elses = tmp_path / "elses.jsonl"
    elses.write_text(record("03a") + "\n")
    (place / f"{1:032x}.jsonl").symlink_to(elses)
    (place / f"{2:032x}.jsonl").symlink_to(place / f"{2:032x}.jsonl")
    os.mkfifo(place / f"{3:032x}.jsonl")
    (place / f"{4:032x}.jsonl").mkdir()
    (place / f"{5:032x}.jsonl").hardlink_to(elses)
    (place / f"{6:032x}.jsonl").symlink_to("/dev/zero")
    with socket.socket(socket.AF_UNIX) as made:
        monkeypatch.chdir(place)  # the path of a socket is short
        made.bind(f"{7:032x}.jsonl")
    assert class_folder(place).read().learners == ()


def test_a_folder_that_somebody_fills_is_told(place, monkeypatch):
    monkeypatch.setattr("rosbeat.grading.class_folder._ENTRIES", 5)
    for number in range(8):
        learner(place, number)
    seen = class_folder(place).read()
    assert len(seen.learners) == 5
    assert "has 3 entries too many" in seen.notices[0]


def test_a_file_that_cannot_be_read_is_told(place, monkeypatch):
    learner(place, 1, record("03a"))
    learner(place, 2, record("03a"))

    def refuse(path):
        if path.name.endswith("1.jsonl"):
            raise PermissionError
        return record("03a").encode()

    monkeypatch.setattr("rosbeat.grading.class_folder._end_of", refuse)
    seen = class_folder(place).read()
    assert len(seen.learners) == 2
    assert "1 file in the folder of the class cannot be read" in seen.notices[0]


def test_what_is_hostile_is_only_text_on_the_page(place):
    names = [one.encode("utf-8", "replace").decode()[:40] for one in HOSTILE]
    for number, name in enumerate(names):
        said = {"exercise": "03a", "status": "failed", "mistake": "wrong-rate", "time": NOW}
        learner(place, number, *[json.dumps({**said, "name": name})] * 3)
    page = board_html(board(place))
    require_harmless(page, LIVE)
    assert "&lt;script&gt;alert(1)&lt;/script&gt;" in page


# The server.


def asked(server, path="", token=None, method="GET", **headers):
    connection = http.client.HTTPConnection("127.0.0.1", server.server_port, timeout=30)
    names = {name.replace("_", "-"): value for name, value in headers.items()}
    connection.request(method, f"/{token or server.token}/{path}", None, names)
    answer = connection.getresponse()
    text = answer.read().decode()
    connection.close()
    return answer.status, answer.headers, text


def test_the_page_holds_the_board_and_may_do_nothing_else(server, place):
    learner(place, 1, *[record("04b", mistake="boundary")] * 3)
    status, headers, page = asked(server)
    assert status == 200
    assert {tag for tag, _ in Parsed(page).elements} <= ELEMENTS | LIVE
    policy = dict(one.split(" ", 1) for one in headers["Content-Security-Policy"].split("; "))
    nonce = re.search("'nonce-([^']+)'", policy["script-src"])[1]
    assert page.count(f'nonce="{nonce}"') == 2
    assert policy == {
        "default-src": "'none'",
        "base-uri": "'none'",
        "frame-ancestors": "'none'",
        "form-action": "'none'",
        "style-src": f"'nonce-{nonce}'",
        "script-src": f"'nonce-{nonce}'",
        "connect-src": "'self'",
        "img-src": "'self' data:",
    }
    assert headers["Cache-Control"] == "no-store"
    status, _, part = asked(server, "board")
    assert status == 200
    assert part in page
    words = " ".join(Parsed(part).text.split())
    for said in (
        "1 learner shares, 1 of them active in the last 10 minutes.",
        "Most are stuck on 04b raise the alarm: 1 of 1.",
        "What to say",
        "Squares: what the published solution did",
        "not an answer of this class",
    ):
        assert said in words


def test_who_may_see_the_page_is_as_in_the_review_and_nothing_is_sent_to_it(server):
    assert asked(server, token="x" * 43)[0] == 404
    assert asked(server, Host="evil.example")[0] == 403
    assert [asked(server, method=one)[0] for one in ("POST", "PUT")] == [405, 501]
    for path in ("x", "../board", "diagram/x.svg", "diagram/../../x.svg", "diagram/"):
        assert asked(server, path)[0] == 404


def test_a_diagram_of_the_course_is_shown_where_an_answer_is_no_node(server, place):
    learner(place, 1, record("05a", mistake="entry-point-form"))
    part = asked(server, "board")[2]
    source = re.search('<img src="([^"]+)"', part)[1]
    status, headers, drawn = asked(server, source)
    assert (status, headers["Content-Type"]) == (200, "image/svg+xml")
    assert drawn.startswith("<svg ")


def test_a_folder_that_goes_away_is_told_on_the_page(server, place):
    place.rmdir()
    status, _, part = asked(server, "board")
    assert status == 200
    assert "cannot be read" in Parsed(part).text


# What to show and to say.


def test_each_example_is_of_an_exercise_and_a_mistake_and_no_answer_is_in_it():
    examples = _examples()
    assert set(examples) == set(EXERCISES) - {"system"}
    for exercise, some in examples.items():
        for name, one in some.items():
            assert name == "" or name in MISTAKES, (exercise, name)
            assert not one.get("trace", {}).get("text")
            assert name == "" or (one["seen"] and one["hint"])


def test_there_is_something_to_say_about_each_mistake_of_each_exercise():
    for exercise in EXERCISES:
        found = advice("shut-down-twice", exercise)
        assert found.hint or found.first_hint or exercise == "system"
    said = advice("boundary", "04b")
    assert isinstance(said, Advice)
    assert said.drawn is not None
    assert said.drawn.bands
    assert "26" in said.seen
    assert set(DIAGRAMS) <= set(EXERCISES)


# The command.


def test_the_command_needs_a_folder(capsys, monkeypatch, tmp_path):
    monkeypatch.delenv("ROSBEAT_CLASS", raising=False)
    assert cli.main(["class"]) == cli.MISUSED
    said = capsys.readouterr().err
    assert all(part in said for part in ("No folder", "What it means:", "docs/instructors.md"))
    assert cli.main(["class", str(tmp_path / "gone")]) == cli.FAILED
    said = capsys.readouterr().err
    assert all(part in said for part in ("cannot be read", "What it means:", "What to try:"))


def test_the_command_deletes_what_was_shared(place, capsys, monkeypatch):
    learner(place, 1, record("03a"))
    learner(place, 2)
    (place / ".saving-x").write_text("")
    (place / "notes.txt").write_text("kept")
    monkeypatch.setenv("ROSBEAT_CLASS", str(place))
    assert cli.main(["class", "--forget"]) == 0
    assert f"3 files deleted in {place}." in capsys.readouterr().out
    assert [one.name for one in place.iterdir()] == ["notes.txt"]


def test_files_of_yesterday_go_when_the_page_is_opened(place, capsys, monkeypatch):
    """The command serves until Ctrl-C; here it is pressed at once."""
    old, new = learner(place, 1, record("03a")), learner(place, 2, record("03a"))
    os.utime(old, (1, 1))

    def stop(_):
        raise KeyboardInterrupt

    monkeypatch.setattr(ClassServer, "serve_forever", stop)
    assert cli.main(["class", str(place), "--no-browser"]) == 0
    assert (old.exists(), new.exists()) == (False, True)
    said = capsys.readouterr().out
    assert re.search(r"http://127\.0\.0\.1:\d+/[\w-]{43}/", said)
    assert "The address is secret" in said


@pytest.mark.parametrize(
    ("mode", "missing"),
    [
        (0o3733, []),
        (0o3753, []),
        (0o0700, ["write", "sticky", "group"]),
        (0o1777, ["list it", "group"]),
        (0o2733, ["sticky"]),
    ],
)
def test_what_a_folder_lacks_is_told(place, mode, missing):
    place.chmod(mode)
    found = shortcomings(place.stat())
    assert len(found) == len(missing)
    assert all(word in said for word, said in zip(missing, found, strict=True))
    assert stat.S_ISDIR(place.stat().st_mode)
