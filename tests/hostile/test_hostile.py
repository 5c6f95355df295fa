"""All of the bank in one class beside honest learners: what it may not do, and what is said of it.

The attacks from within answers run twice: as `rosbeat grade` does it, which holds what reaches for
Python's inner parts, and without that inspection, so that sandbox, seal and frozen course are seen
to hold by themselves. What they cannot hold is marked in the bank (`inspected_only`).
"""

import csv
import json
import os
from pathlib import Path

import pytest

from hostile.deed import CANARY, TRACE
from hostile.handing_in import DEEDS, HONEST, UPLOADS, hand_in, large, placed
from hostile.pages import ROOT
from rosbeat.exercises.registry import EXERCISES
from rosbeat.grading.course_pages import course_pages
from rosbeat.grading.grade_class import Plan, grade
from rosbeat.grading.jobs import Job
from rosbeat.grading.judging import judge
from rosbeat.grading.ledger import Ledger
from rosbeat.grading.marks import settle
from rosbeat.grading.output import write_results
from rosbeat.grading.pool import Pool
from rosbeat.grading.submissions import collect
from rosbeat.grading.tasks import imports_of, subject_of

pytestmark = [pytest.mark.ros, pytest.mark.timeout(600), pytest.mark.xdist_group("hostile")]
PAGES = {
    page.number: page for page in course_pages(ROOT / "notebooks") if page.number in ("03", "04")
}


@pytest.fixture(scope="module")
def surroundings(tmp_path_factory):
    """Canaries in the environment and in a home, and workers that lose patience early."""
    home = tmp_path_factory.mktemp("home")
    (home / "secret.txt").write_text(CANARY)
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ROSBEAT_TEST_SECRET", CANARY)
        patch.setenv("HOME", str(home))
        patch.setenv("PYTHONPATH", str(Path(__file__).parents[1]), prepend=os.pathsep)
        patch.setattr("rosbeat.grading.pool._MODULE", "hostile.brief_worker")
        yield home


@pytest.fixture(scope="module")
def graded(surroundings, tmp_path_factory):
    """The class, graded in one batch: results by learner, the folder of results, and who is who."""
    folder, out = tmp_path_factory.mktemp("class"), tmp_path_factory.mktemp("grades")
    who = hand_in(folder, (surroundings, folder, ROOT))
    large(folder)
    gradebook = _graded(folder, out)
    results = {one.learner: one for one in gradebook.learners}
    return results, out, who, gradebook


@pytest.fixture(scope="module")
def alone(surroundings, graded):
    """Every attack from within an answer, run although nobody has inspected it."""
    class_folder = graded[1]
    jobs = [(deed.name, _job(deed, (surroundings, class_folder, ROOT))) for deed in DEEDS.values()]
    with Pool(2) as pool:
        return {
            name: (observed, judge(EXERCISES[DEEDS[name].exercise], observed))
            for name, observed in pool.observe(jobs)
        }


def _graded(folder, out):
    plan = Plan(tuple(PAGES.values()), "hostile")
    with Ledger(out / "judged.jsonl") as ledger, Pool(2) as pool:
        found = collect(folder, plan.pages)
        gradebook = settle(grade(found, plan, ledger, pool.observe, lambda *_: None), found)
    write_results(out, gradebook)
    return gradebook


def _job(deed, places):
    page = PAGES[deed.exercise[:2]]
    given = json.dumps(EXERCISES[deed.exercise].given(), sort_keys=True)
    answer = placed(deed.answer, places)
    return Job(
        deed.exercise, subject_of(page, deed.exercise), answer, (), imports_of(page), given=given
    )


def _mark(learner, exercise="03a"):
    return next(one for one in learner.marks if one.exercise == exercise)


def _written(out):
    return {path: path.read_bytes() for path in out.rglob("*") if path.is_file()}


def test_the_bank_is_large_enough():
    assert len(DEEDS) + len(UPLOADS) + 2 >= 60


def test_every_learner_has_a_line(graded):
    results, out, who, _ = graded
    expected = len(HONEST) + len(who) + 2
    assert len(results) == expected
    with (out / "grades.csv").open(encoding="utf-8-sig", newline="") as file:
        rows = list(csv.DictReader(file))
    assert len({next(iter(row.values())) for row in rows}) == expected
    assert len(list((out / "feedback").iterdir())) == expected


@pytest.mark.parametrize("name", DEEDS)
def test_an_attack_from_within_is_held_or_fails_and_the_cause_is_clear(graded, name):
    results, _, who, _ = graded
    deed, mark = DEEDS[name], _mark(results[who[name]], DEEDS[name].exercise)
    assert (mark.status, deed.words in mark.cause) == (deed.status, True), mark.cause
    assert mark.points == (mark.out_of if deed.status == "passed" else 0)
    assert 10 < len(mark.cause) <= 500
    assert mark.cause.isprintable()


@pytest.mark.parametrize("name", DEEDS)
def test_what_nobody_inspects_does_not_pass_either(alone, name):
    observed, outcome = alone[name]
    deed = DEEDS[name]
    said = f"{outcome.status} {outcome.evidence} {outcome.hint} {outcome.mistake}"
    assert deed.alone in said, (said, observed)
    passes = deed.inspected_only or deed.status == "passed"
    assert (outcome.status == "passed") == passes, (said, observed)


@pytest.mark.parametrize("name", UPLOADS)
def test_a_broken_or_forged_page_gets_its_due(graded, name):
    results, _, who, _ = graded
    upload, learner = UPLOADS[name], _of(results, who[name])
    mark = _mark(learner)
    assert upload.status in (mark.status, ""), mark
    said = " ".join([mark.cause, *mark.repairs, *(f"{r.about} {r.text}" for r in learner.remarks)])
    assert upload.words in said, said
    assert len(mark.cause) > 10


def _of(results, folder):
    """A learner by the name of the folder, however that is written."""
    found = [one for one in results.values() if folder.strip() in (one.learner, one.name)]
    return found[0] if found else results[folder]


def test_large_and_linked_files_are_not_read(graded):
    results = graded[0]
    assert "200 MB" in str(results["large"].remarks)
    assert "link" in str(results["linked"].remarks)
    for learner in ("large", "linked"):
        assert (_mark(results[learner]).status, results[learner].points) == ("held", 0)


def test_honest_marks_are_what_they_are_without_the_others(graded, surroundings, tmp_path):
    with_all = {name: graded[0][name] for name in HONEST}
    folder = tmp_path / "class"
    from hostile.pages import PAGE, page

    for name, answer in HONEST.items():
        (folder / name).mkdir(parents=True)
        (folder / name / PAGE).write_bytes(page(answer))
    gradebook = _graded(folder, tmp_path / "out")
    assert {one.learner: one.marks for one in gradebook.learners} == {
        name: one.marks[: len(gradebook.learners[0].marks)] for name, one in with_all.items()
    }
    assert [_mark(one).status for one in gradebook.learners] == ["passed", "failed", "failed"]


def test_no_byte_leaks_into_results_or_evidence(graded, alone):
    assert [path for path, data in _written(graded[1]).items() if CANARY.encode() in data] == []
    leaks = [name for name, (seen, _) in alone.items() if CANARY in f"{seen.evidence}{seen.text}"
             f"{seen.output}{seen.code}"]  # fmt: skip
    assert leaks == []


def test_results_hold_nothing_for_terminals_or_browsers(graded):
    for path, data in _written(graded[1]).items():
        text = data.decode("utf-8")
        assert "\x1b" not in text, path
        assert "\u202e" not in text or path.suffix == ".json", path
        if path.suffix == ".html":
            assert "<script>alert" not in text, path
            assert "<img src=x" not in text, path


def test_nothing_is_left_behind(graded, alone):
    processes = [
        path for path in Path("/proc").glob("[0-9]*/cmdline") if TRACE.encode() in _read(path)
    ]
    files = [name for place in ("/tmp", "/dev/shm") for name in os.listdir(place) if TRACE in name]
    mounts = [line for line in Path("/proc/self/mountinfo").read_text().splitlines()
              if "/rosbeat-" in line]  # fmt: skip
    assert (processes, files, mounts) == ([], [], [])


def _read(path):
    try:
        return path.read_bytes()
    except OSError:
        return b""
