"""All of the bank in one class beside honest learners: what it may not do, and what is said of it.

Nothing is held for what it imports or names: the sandbox protects, and the judge judges what was
done. Whoever forges evidence needs a solution for that (`Deed.forges`), and is remarked upon.
"""

import csv
import os
from pathlib import Path

import pytest

from hostile.brief import be_brief
from hostile.deed import CANARY, TRACE
from hostile.handing_in import DEEDS, HONEST, UPLOADS, hand_in, large
from hostile.pages import ROOT
from rosbeat.grading.ledger import Ledger
from rosbeat.grading.remarks import REACHES_INSIDE
from rosbeat.grading.results import write_results
from rosbeat.grading.run import Plan, grade
from rosbeat.grading.submissions import collect
from rosbeat.page_runs.notebook import course_pages
from rosbeat.page_runs.pool import Pool

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
        be_brief(patch)
        yield home


@pytest.fixture(scope="module")
def graded(surroundings, tmp_path_factory):
    """The class, graded in one batch: results by learner, the folder of results, and who is who."""
    folder, out = tmp_path_factory.mktemp("class"), tmp_path_factory.mktemp("grades")
    who = hand_in(folder, (surroundings, folder, ROOT))
    large(folder)
    evidence = []
    gradebook = _graded(folder, out, evidence.append)
    results = {one.learner: one for one in gradebook.learners}
    return results, out, who, evidence


def _graded(folder, out, see=lambda _: None):
    plan = Plan(tuple(PAGES.values()), "hostile", seed=4711)

    def observe(submissions):
        with Pool(2) as pool:
            for key, evidence in pool.observe(submissions):
                see(evidence)
                yield key, evidence

    with Ledger(out / "judged.jsonl") as ledger:
        found = collect(folder, plan.pages)
        gradebook = grade(found, plan, ledger, observe, lambda *_: None)
    write_results(out, gradebook)
    return gradebook


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
def test_an_attack_from_within_gains_nothing_and_the_cause_is_clear(graded, name):
    results, _, who, _ = graded
    deed, mark = DEEDS[name], _mark(results[who[name]], DEEDS[name].exercise)
    said = f"{mark.status} {mark.evidence} {mark.hint} {mark.mistake}"
    assert deed.words in said, said
    gains = deed.passes or deed.forges
    assert (mark.status, mark.points > 0) == ("passed" if gains else "failed", gains), said
    assert 10 < len(mark.cause) <= 500
    assert mark.cause.isprintable()


@pytest.mark.parametrize("name", [name for name, deed in DEEDS.items() if deed.forges])
def test_who_forges_is_remarked_upon(graded, name):
    results, _, who, _ = graded
    assert REACHES_INSIDE in {one.about for one in results[who[name]].remarks}


@pytest.mark.parametrize("name", UPLOADS)
def test_a_broken_or_forged_page_gets_its_due(graded, name):
    results, _, who, _ = graded
    upload, learner = UPLOADS[name], _of(results, who[name])
    mark = _mark(learner)
    assert upload.status in (mark.status, ""), mark
    said = " ".join([mark.cause, *(f"{r.about} {r.text}" for r in learner.remarks)])
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


def test_no_byte_leaks_into_results_or_evidence(graded):
    found = {path: data for path, data in _written(graded[1]).items() if CANARY.encode() in data}
    # Whose answer it is reads it on their own page, once, as a line of their own code.
    assert list(found) == [graded[1] / "feedback" / "honest-ana.html"]
    (page,) = found.values()
    assert page.count(CANARY.encode()) == page.count(f"# {CANARY}\n".encode()) == 1
    assert len(graded[3]) > len(DEEDS)
    assert [one for one in graded[3] if CANARY in str(one)] == []


def test_results_hold_nothing_for_terminals_or_browsers(graded):
    for path, data in _written(graded[1]).items():
        text = data.decode("utf-8")
        assert "\x1b" not in text, path
        assert "\u202e" not in text or path.suffix == ".json", path
        if path.suffix == ".html":
            assert "<script>alert" not in text, path
            assert "<img src=x" not in text, path


def test_nothing_is_left_behind(graded):
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
