"""One submission: a page, or a folder with pages directly in it, as autograders get it."""

import json
import os
import re
import shutil
import signal
import subprocess
from pathlib import Path

import pytest
from jsonschema import Draft202012Validator

from graded_classes import HOSTILE, hostile_learner, mark
from grading_files import cell, notebook, zipped
from rosbeat import cli
from rosbeat.errors import CommandError, StoppedError
from rosbeat.grading import commands
from rosbeat.grading.commands import WAITS
from rosbeat.grading.marks import Gradebook, Graded
from rosbeat.grading.one_submission import FORMAT, FORMS, finding
from rosbeat.grading.platforms.autograders import AUTOGRADERS
from rosbeat.grading.remarks import REACHES_INSIDE, Remark
from rosbeat.grading.results import VERSION
from rosbeat.page_runs.jobs import LOST, Evidence, PageEvidence
from rosbeat.records import Part
from small_course import PAGES

ROOT = Path(__file__).resolve().parents[3]
SCHEMA = json.loads((ROOT / "docs/results.schema.json").read_text("utf-8"))


def complaints(document, kind):
    schema = {**SCHEMA["$defs"][kind], "$defs": SCHEMA["$defs"]}
    Draft202012Validator.check_schema(schema)
    return [one.message for one in Draft202012Validator(schema).iter_errors(document)]


@pytest.fixture
def ana(course, tmp_path):
    """The folder of one learner, with a page directly in it."""
    return tmp_path / "class/ana"


@pytest.fixture
def graded(run, workers):
    """Type `rosbeat grade` with JSON, and return it."""

    def graded(*words, code=0):
        said, ended = run("grade", *words, "--json")
        assert ended == code
        assert said.out.isascii()
        document = json.loads(said.out)
        assert complaints(document, "submission") == []
        assert document["exit"] == code
        return document

    return graded


# What counts as one submission.


def test_a_page_a_folder_and_a_zip_file_give_the_same(graded, ana, tmp_path, monkeypatch):
    page = ana / "03_write.ipynb"
    (tmp_path / "ana.zip").write_bytes(zipped({page.name: page.read_bytes()}))
    first = graded(page)
    assert (first["format"], first["version"]) == (FORMAT, VERSION)
    assert first["learner"] == "ana"
    assert [one["exercise"] for one in first["exercises"]] == ["03a"]
    assert first["exercises"][0]["status"] == "failed"
    assert "ZeroDivisionError" in first["exercises"][0]["evidence"]
    assert graded(ana) == graded(tmp_path / "ana.zip") == first
    monkeypatch.chdir(ana)
    assert graded("03_write.ipynb") == graded(".") == first
    assert not list(tmp_path.glob("**/results.json"))
    assert sorted(path.name for path in ana.iterdir()) == ["03_write.ipynb"]


def test_several_pages_of_one_learner(graded, ana):
    (ana / "04_listen.ipynb").write_text(PAGES["04_listen"].replace("____", "x = 1"))
    (ana / "notes.txt").write_text("mine")
    found = graded(ana)
    assert [one["exercise"] for one in found["exercises"]] == ["03a", "04a"]
    assert [one["about"] for one in found["remarks"]] == ["left-out"]
    assert found["out_of"] == sum(one["out_of"] for one in found["exercises"])
    assert [one["exercise"] for one in graded(ana, "--lessons", "04")["exercises"]] == ["04a"]
    there, missing = graded(ana / "03_write.ipynb", "--lessons", "03", "04")["exercises"]
    assert (there["status"], missing["status"], missing["points"]) == ("failed", "missing", 0)


def test_what_exercises_are_worth_and_lateness_count_here_too(graded, all_right, ana, tmp_path):
    os.utime(ana / "03_write.ipynb", (1_000_001, 1_000_001))
    (tmp_path / "points.csv").write_text("03a,10\n")
    words = ("--points", tmp_path / "points.csv", "--due", "1970-01-12T13:46:40Z")
    found = graded(ana, *words, "--late", "10%/day")
    assert (found["points"], found["out_of"]) == (9, 10)
    assert [one["about"] for one in found["remarks"]] == ["late"]


def test_with_a_folder_for_results_there_are_all_of_them_and_the_same_is_printed(
    graded, run, ana, tmp_path, workers
):
    first = graded(ana)
    found = graded(ana, "--out", tmp_path / "out")
    assert found == first
    whole = json.loads((tmp_path / "out/results.json").read_text())
    assert whole["learners"][0]["learner"] == "ana"
    assert whole["learners"][0]["marks"] == found["exercises"]
    assert (tmp_path / "out/feedback/ana.html").is_file()
    done = len(workers.jobs)
    assert graded(ana, "--out", tmp_path / "out", "--only", "03a") == first
    assert len(workers.jobs) == done + 1


def test_a_class_needs_a_folder_and_stays_a_class(run, workers, ana, tmp_path, says):
    shutil.copy(ana / "03_write.ipynb", tmp_path / "class")  # beside the learners
    with pytest.raises(CommandError) as caught:
        run("grade", tmp_path / "class", "--json")
    says(caught.value, "--out is missing", "2 learners handed in", "--out ~/class/grades")
    canvas = tmp_path / "canvas/petrovana_20001_778899_03_write.ipynb"
    canvas.parent.mkdir()
    shutil.copy(ana / "03_write.ipynb", canvas)
    with pytest.raises(CommandError):
        run("grade", canvas.parent)
    assert workers.jobs == []
    for option in ("--roster", "--only"):
        with pytest.raises(CommandError) as caught:
            run("grade", ana, option, "x")
        says(caught.value, f"{option} needs --out")


def test_one_submission_is_collected(run, ana):
    said, code = run("collect", ana)
    assert code == 0
    assert said.out.splitlines()[1].split() == ["ana", "yes"]


# Bad files.

BAD = {
    "empty": ("03_write.ipynb", "", "the file is empty"),
    "blank": ("03_write.ipynb", "\n \n", "the file is empty"),
    "broken": ("03_write.ipynb", PAGES["03_write"][:300], "the file is not whole"),
    "text": ("03_write.ipynb", "x = 1", "it is not JSON"),
    "no-cells": ("03_write.ipynb", "{}", "it has no cells"),
    "binary": ("03_write.ipynb", b"\xff\xfe\0", "it is not UTF-8"),
    "other": ("week.ipynb", notebook(cell("x = 1")), "not a page of this course"),
}


@pytest.mark.parametrize("kind", BAD)
@pytest.mark.parametrize("as_folder", [False, True])
@pytest.mark.parametrize("form", ["text", "json", "gradescope", "prairielearn"])
def test_a_bad_file_is_refused_in_three_parts(
    course, workers, tmp_path, capsys, kind, as_folder, form
):
    name, content, why = BAD[kind]
    (tmp_path / "bad").mkdir()
    page = tmp_path / "bad" / name
    page.write_bytes(content if isinstance(content, bytes) else content.encode())
    source = page.parent if as_folder else page
    assert cli.main(["grade", str(source), "--format", form]) == cli.FAILED
    said = capsys.readouterr()
    assert why in said.err
    assert "What it means: " in said.err
    assert "What to try: " in said.err
    assert name in said.err
    assert workers.jobs == []
    if form == "text":
        assert said.out == ""
        return
    document = json.loads(said.out)
    if form == "json":
        assert complaints(document, "refused") == []
        assert why in document["error"]["what"]
    elif form == "gradescope":
        assert complaints_of_gradescope(document) == []
        assert document["score"] == 0
        assert why in document["output"]
    else:
        assert complaints_of_prairielearn(document) == []
        assert document["gradable"] is False
        assert why in document["format_errors"][0]


@pytest.mark.parametrize("form", ["text", "json", "gradescope", "prairielearn"])
def test_what_is_no_page_and_no_folder_is_refused(course, tmp_path, capsys, form):
    (tmp_path / "photo.png").write_bytes(b"\x89PNG")
    for name, why in (("photo.png", "is not a zip file"), ("none.ipynb", "does not exist")):
        assert cli.main(["grade", str(tmp_path / name), "--format", form]) == cli.FAILED
        said = capsys.readouterr()
        assert why in said.err
        assert said.out == ""
    (tmp_path / "nothing").mkdir()
    assert cli.main(["grade", str(tmp_path / "nothing"), "--format", form]) == cli.FAILED
    assert "it is empty" in capsys.readouterr().err


def test_of_two_pages_the_one_that_cannot_be_read_waits_for_a_person(graded, ana):
    (ana / "04_listen.ipynb").write_text("")
    found = graded(ana, code=WAITS)
    assert [one["status"] for one in found["exercises"]] == ["failed", "held"]
    assert "The file is empty" in found["exercises"][1]["cause"]


def test_an_answer_that_nobody_could_watch_waits_for_a_person(graded, ana, workers, monkeypatch):
    def lose(self, submissions):
        for key, job in (one for some in submissions for one in some):
            yield key, PageEvidence(dict.fromkeys(job.subjects, Evidence(LOST)))

    monkeypatch.setattr(workers, "observe", lose)
    assert graded(ana, code=WAITS)["exercises"][0]["status"] == "held"


def test_whoever_stops_it_hears_that_nothing_is_kept(run, ana, workers, monkeypatch, says):
    def stop(self, submissions):
        os.kill(os.getpid(), signal.SIGINT)
        yield from ()

    monkeypatch.setattr(workers, "observe", stop)
    with pytest.raises(StoppedError) as caught:
        run("grade", ana)
    says(caught.value, "Without --out, nothing is kept", "Type the command again")


# For a person.


def test_a_person_reads_verdict_points_evidence_and_hint(run, workers, ana):
    said, code = run("grade", ana)
    assert code == 0
    lines = said.out.splitlines()
    assert lines[0].startswith("\N{BALLOT X} 03a ")
    assert re.search(r": failed, 0 of \d points\.$", lines[0])
    assert "ZeroDivisionError" in lines[1]
    assert any(line.startswith("  Hint: ") for line in lines)
    assert re.fullmatch(r"0 of \d points\.", lines[-1])


def test_everything_is_told_of_an_exercise():
    parts = (Part("R1", "It beeps.", True), Part("R2", "It stops.", False, "It beeps on."))
    one = mark("13b", "failed", mistake="wrong-rate", evidence="3 of 4.", hint="Look.")
    text = finding(
        one.__class__(**{**vars(one), "parts": parts, "remarks": ("Nice.",), "differs": "Odd."})
    )
    lines = text.splitlines()
    assert lines[0] == "3 of 4."
    assert lines[1].startswith("This is called: ")
    assert "\N{CHECK MARK} R1: It beeps." in lines
    assert "\N{BALLOT X} R2: It stops." in lines
    assert lines[-4:] == ["It beeps on.", "Hint: Look.", "Remark: Nice.", "Odd."]


@pytest.mark.parametrize("text", HOSTILE)
@pytest.mark.parametrize("form", [*FORMS, *AUTOGRADERS])
def test_no_text_reaches_anybody_as_it_is(text, form):
    book = Gradebook("0.1.0", (hostile_learner(text),), (Remark(text, text, text),))
    written = {**FORMS, **AUTOGRADERS}[form].result(book, 0)
    if form == "text":
        assert all(line.isprintable() for line in written.split("\n"))
    else:
        assert written.isascii()
    if form in AUTOGRADERS:
        complain = {
            "gradescope": complaints_of_gradescope,
            "prairielearn": complaints_of_prairielearn,
        }
        document = json.loads(written)
        assert complain[form](document) == []
        assert len(written) < 1_000_000
        for value in texts_in(document):
            assert all(line.isprintable() for line in value.split("\n"))


def texts_in(value):
    """Every text in a document, but names of fields."""
    if isinstance(value, dict | list):
        for one in value.values() if isinstance(value, dict) else value:
            yield from texts_in(one)
    elif isinstance(value, str):
        yield value


# What the platforms publish.

VISIBLE = {"enum": ["hidden", "after_due_date", "after_published", "visible"]}
STYLE = {"enum": ["text", "html", "simple_format", "md", "ansi"]}
TEXT, NUMBER, ANYTHING = {"type": "string"}, {"type": "number"}, {"type": "object"}
#: "Output format" in Gradescope's Autograder Specifications, with all fields that it names. A score
#: is required, at the top or in each test.
GRADESCOPE = {
    "type": "object",
    "additionalProperties": False,
    "anyOf": [
        {"required": ["score"]},
        {
            "required": ["tests"],
            "properties": {"tests": {"items": {"required": ["score"]}}},
        },
    ],
    "properties": {
        **{"score": NUMBER, "execution_time": NUMBER, "output": TEXT, "output_format": STYLE},
        **{"test_output_format": STYLE, "test_name_format": STYLE, "visibility": VISIBLE},
        **{"stdout_visibility": VISIBLE, "extra_data": ANYTHING},
        "leaderboard": {"type": "array"},
        "tests": {
            "type": "array",
            "items": {
                "type": "object",
                "additionalProperties": False,
                "properties": {
                    **{"score": NUMBER, "max_score": NUMBER, "name": TEXT, "name_format": STYLE},
                    **{"status": {"enum": ["passed", "failed"]}, "number": TEXT, "output": TEXT},
                    **{"output_format": STYLE, "visibility": VISIBLE, "extra_data": ANYTHING},
                    "tags": {"type": "array", "items": TEXT},
                },
            },
        },
    },
}
#: "Grading results" in PrairieLearn's guide to external grading: `score` is required unless the
#: submission is not gradable. Other fields may be there; these are those that are shown.
PRAIRIELEARN = {
    "type": "object",
    "if": {"properties": {"gradable": {"const": False}}, "required": ["gradable"]},
    "else": {"required": ["score"]},
    "properties": {
        "gradable": {"type": "boolean"},
        "score": {"type": "number", "minimum": 0, "maximum": 1},
        "format_errors": {"anyOf": [TEXT, {"type": "array", "items": TEXT}]},
        **{"message": TEXT, "output": TEXT},
        "tests": {
            "type": "array",
            "items": {
                "type": "object",
                # If any test lacks its points, no test shows them.
                "required": ["points", "max_points"],
                "properties": {
                    **{"name": TEXT, "description": TEXT, "points": NUMBER, "max_points": NUMBER},
                    **{"message": TEXT, "output": TEXT},
                },
            },
        },
    },
}


def complaints_of_gradescope(document):
    return [one.message for one in Draft202012Validator(GRADESCOPE).iter_errors(document)]


def complaints_of_prairielearn(document):
    return [one.message for one in Draft202012Validator(PRAIRIELEARN).iter_errors(document)]


@pytest.fixture
def three():
    """A right answer, one with a part of its points, and one that is held."""
    marks = (
        mark("03a", points=2.0, out_of=2.0),
        mark("03b", "failed", points=1.0, out_of=2.0, evidence="<b>3 & 4</b>\nmore", hint="Look."),
        mark("03c", "held", points=0.0, out_of=4.0, cause="Held: lost.", answer="x", file="a"),
    )
    remarks = (Remark(REACHES_INSIDE, "a", "SECRET"), Remark("late", "a.ipynb", "It is late."))
    return Gradebook("0.1.0", (Graded("ana", "Ana", "folder", marks, remarks),))


def test_gradescope_gets_what_it_publishes(three):
    document = json.loads(AUTOGRADERS["gradescope"].result(three, 3))
    assert complaints_of_gradescope(document) == []
    assert document["score"] == 3
    assert [(one["score"], one["max_score"]) for one in document["tests"]] == [
        (2, 2),
        (1, 2),
        (0, 4),
    ]
    assert [one["status"] for one in document["tests"]] == ["passed", "failed", "failed"]
    assert [one["name"][:3] for one in document["tests"]] == ["03a", "03b", "03c"]
    assert {document["output_format"], *(one["output_format"] for one in document["tests"])} == {
        "text"
    }
    assert "<b>3 & 4</b>\nmore" in document["tests"][1]["output"]
    assert "A person has to look" in document["tests"][2]["output"]
    assert "a.ipynb: It is late." in document["output"]
    assert "SECRET" not in json.dumps(document)


def test_prairielearn_gets_what_it_publishes(three):
    document = json.loads(AUTOGRADERS["prairielearn"].result(three, 3))
    assert complaints_of_prairielearn(document) == []
    assert document["gradable"] is True
    assert document["score"] == 3 / 8
    assert [(one["points"], one["max_points"]) for one in document["tests"]] == [
        (2, 2), (1, 2), (0, 4)
    ]  # fmt: skip
    assert "Hint: Look." in document["tests"][1]["output"]
    assert "a.ipynb: It is late." in document["message"]
    assert "SECRET" not in json.dumps(document)


@pytest.mark.parametrize("form", AUTOGRADERS)
def test_all_that_a_platform_hands_over_is_one_learners(run, workers, ana, tmp_path, form):
    """Learners upload folders, with the solutions and with names that another platform made."""
    submission = tmp_path / "submission"
    page = (ana / "03_write.ipynb").read_text()
    for name in ("my_course/03_write.ipynb", "my_course/solutions/03_write.ipynb"):
        (submission / name).parent.mkdir(parents=True, exist_ok=True)
        (submission / name).write_text(page.replace("'ana'", repr(name)))
    (submission / "my_course/petrovana_20001_778899_03_write.ipynb").write_text("")
    said, code = run("grade", submission, "--format", form)
    assert code == 0
    assert len(json.loads(said.out)["tests"]) == 1
    (job,) = workers.jobs
    assert any("x = 'my_course/03_write.ipynb'" in one.source for one in job.cells)
    assert "does not count" in json.dumps(json.loads(said.out))


def test_the_command_knows_the_same_forms():
    parser = cli._parser()
    for form in (*FORMS, *AUTOGRADERS):
        assert parser.parse_args(["grade", "x", "--format", form]).format == form
    assert parser.parse_args(["grade", "x", "--json"]).format == "json"
    with pytest.raises(CommandError):
        parser.parse_args(["grade", "x", "--json", "--format", "gradescope"])


# The documentation.


def test_the_json_is_documented():
    text = (ROOT / "docs/autograders.md").read_text("utf-8")
    kinds = SCHEMA["$defs"]
    rows = dict(re.findall(r"(?m)^\| `(\w+)` \| ([^|]+) \|", text))
    for kind in ("submission", "refused", "mark"):
        for name, said in kinds[kind]["properties"].items():
            assert rows[name].split()[0] == said.get("type", rows[name].split()[0]), name
    assert rows.keys() == {name for kind in ("submission", "refused", "mark")
                           for name in kinds[kind]["properties"]}  # fmt: skip
    assert kinds["submission"]["properties"]["format"]["const"] == FORMAT
    assert kinds["submission"]["properties"]["version"]["const"] == VERSION


@pytest.fixture
def files():
    """The files that instructors copy from the page about autograders, by name."""
    text = (ROOT / "docs/autograders.md").read_text("utf-8")
    found = {}
    for kind, body in re.findall(r"(?ms)^```(\w+)\n(.*?)^```$", text):
        named = re.search(r"(?m)^# ([\w.]+): ", body)
        found[named[1] if named else kind] = body
    return found


def test_the_files_to_copy_are_whole(files):
    scripts = ("setup.sh", "run_autograder", "grade.sh")
    for name in scripts:
        assert files[name].startswith("#!/usr/bin/env bash\n")
        done = subprocess.run(["bash", "-n"], input=files[name], text=True, capture_output=True)
        assert (done.returncode, done.stderr) == (0, "")
    options = json.loads(files["json"])["externalGradingOptions"]
    assert options["entrypoint"] == "/grade/tests/grade.sh"
    assert options["timeout"] <= 600  # what PrairieLearn allows
    (page,) = (ROOT / "notebooks").glob("03_*.ipynb")
    assert f'file-names="{page.name}"' in files["html"]


@pytest.mark.parametrize(
    ("name", "form", "result"),
    [
        ("run_autograder", "gradescope", "results/results.json"),
        ("grade.sh", "prairielearn", "/grade/results/results.json"),
    ],
)
def test_the_files_to_copy_type_what_the_command_knows(files, name, form, result):
    (typed,) = re.findall(r"bin/rosbeat (grade .*)", files[name].replace("\\\n", " "))
    words, _, target = typed.partition(" > ")
    options = cli._parser().parse_args(words.split())
    assert (options.format, options.lessons) == (form, ["03"])
    assert options.unsafe_no_sandbox
    assert target == result


@pytest.mark.parametrize("name", ["setup.sh", "Dockerfile.prairielearn"])
def test_the_folders_that_are_closed_to_pages_are_those_of_the_checkout(files, name):
    (folders,) = re.findall(r"chmod -R go= (.*)", files[name].replace("\\\n", " "))
    assert "solutions" in folders.split()
    for folder in folders.split():
        # `course prepare` makes the learner's folder.
        assert folder == "my_course" or (ROOT / folder).is_dir(), folder


# For real.


def test_a_page_without_a_sandbox_is_another_user_than_root(capsys, tmp_path):
    (page,) = (ROOT / "solutions").glob("03_*.ipynb")
    document = json.loads(page.read_text("utf-8"))
    for one in document["cells"]:
        if one["metadata"].get("rosbeat", {}).get("exercise") == "03a":
            one["source"] = (
                'import os\nraise RuntimeError(f\'user {os.getuid()} {open("x", "w")}\')'
            )
    (tmp_path / page.name).write_text(json.dumps(document), "utf-8")
    words = ["grade", str(tmp_path), "--json", "--unsafe-no-sandbox"]
    assert cli.main(words) == WAITS  # it shows that it has passed
    evidence = json.loads(capsys.readouterr().out)["exercises"][0]["evidence"]
    (user,) = re.findall(r"user (\d+) <", evidence)
    places = (Path(os.__file__), Path(commands.__file__))
    open_to_all = all(one.stat().st_mode & 1 for place in places for one in place.parents)
    assert (int(user) == os.getuid()) is (os.getuid() != 0 or not open_to_all)


@pytest.mark.parametrize("form", ["json", "gradescope", "prairielearn"])
def test_page_03_is_graded_within_seconds(capsys, form):
    (page,) = (ROOT / "solutions").glob("03_*.ipynb")
    before = os.times()
    assert cli.main(["grade", str(page), "--format", form, "--workers", "1"]) == 0
    document = json.loads(capsys.readouterr().out)
    after = os.times()
    # Processor time of this process and of those that it has started and waited for.
    taken = sum(after[:4]) - sum(before[:4])
    assert taken < 5
    if form == "json":
        assert complaints(document, "submission") == []
        assert document["points"] == document["out_of"] == 8
    elif form == "gradescope":
        assert complaints_of_gradescope(document) == []
        assert document["score"] == 8
    else:
        assert complaints_of_prairielearn(document) == []
        assert document["score"] == 1
