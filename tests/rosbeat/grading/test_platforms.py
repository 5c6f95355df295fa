"""Every learning platform goes the whole way: download, roster, marks and feedback to upload."""

import ast
import csv
import io
import json
import re
import zipfile
from datetime import timezone
from pathlib import Path

import pytest

from downloads import DOWNLOADS, DUE, LATE, METADATA, ON_TIME, ROSTERS
from grading_files import PAGE_03, PAGE_04, zipped
from rosbeat.grading import platforms
from rosbeat.grading.platforms.base import Owner, Platform
from rosbeat.grading.submissions import collect
from small_course import PAGES

NAMES = {one.name for one in platforms.PLATFORMS}
#: Platforms that say when something was handed in, and in what time zone.
DATES = {"brightspace": None, "blackboard": None, "gradescope": timezone.utc}
BOTH = ["03_write", "04_listen"]


@pytest.fixture
def collected(run, tmp_path):
    """Type `rosbeat collect` for files in a zip or a folder, and return its JSON."""

    def collected(files, *words, packed=True):
        source = tmp_path / "download.zip"
        if packed:
            source.write_bytes(zipped(files))
        else:
            source = tmp_path / "download"
            for name, content in files.items():
                path = source / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return json.loads(run("collect", source, "--json", *words)[0].out)

    return collected


def pages_of(found):
    return {one["learner"]: [page["page"] for page in one["pages"]] for one in found["learners"]}


def test_each_platform_has_a_download_and_a_roster_here():
    assert set(DOWNLOADS) == NAMES == {*ROSTERS, "folder"}


# The download.


@pytest.mark.parametrize("packed", [False, True], ids=["folder", "zip"])
@pytest.mark.parametrize("name", DOWNLOADS)
def test_a_download_is_a_class(name, packed, collected):
    files, learners = DOWNLOADS[name]
    found = collected(files, packed=packed)
    assert pages_of(found) == dict.fromkeys(learners, BOTH)
    assert {one["system"] for one in found["learners"]} == {name}
    remarks = [*found["remarks"], *(one for each in found["learners"] for one in each["remarks"])]
    assert [one["about"] for one in remarks if one["about"] not in ("roster", "late")] == []


@pytest.mark.parametrize("name", DATES)
def test_what_a_platform_says_about_the_date_decides(name, collected):
    files, (ana, ben) = DOWNLOADS[name]
    found = collected(files, "--due", DUE if DATES[name] is None else f"{DUE}+00:00")
    late = {one["learner"]: [page["late"] for page in one["pages"]] for one in found["learners"]}
    assert late == {ana: [False] * 2, ben: [True] * 2}
    for one, moment in zip(found["learners"], (ON_TIME, LATE), strict=True):
        wanted = moment.replace(tzinfo=DATES[name]).timestamp()
        assert {page["modified"] for page in one["pages"]} == {wanted}
    assert "is 0 d 19 h after the deadline" in str(found)


def test_canvas_s_own_mark_decides(collected):
    files, (ana, ben) = DOWNLOADS["canvas"]
    found = collected(files, "--due", "2001-01-01")
    late = {one["learner"]: [page["late"] for page in one["pages"]] for one in found["learners"]}
    assert late == {ana: [False] * 2, ben: [True] * 2}


BESIDE = {
    "roster.csv": "id,name\nana,Ana\n",
    "grades.xlsx": b"PK\x03\x04 no zip file",
    "README.md": "# The class",
    "submission_metadata.yml": "submission_1: {}\n",
    "metadata.json": "{}",
    "solution.ipynb": PAGE_03,
}


@pytest.mark.parametrize("place", ["{}", "submissions/{}", "2026/submissions/{}"])
@pytest.mark.parametrize("beside", BESIDE)
@pytest.mark.parametrize("name", DOWNLOADS)
def test_a_class_with_something_beside_the_learners_stays_a_class(name, beside, place, collected):
    """Fault 3 of a review, and its whole kind: at each level, for each platform."""
    files, learners = DOWNLOADS[name]
    if beside == "submission_metadata.yml" and name == "gradescope":
        return  # that one is Gradescope's own
    files = {place.format(path): text for path, text in files.items()}
    # Among the learners, and beside the folder that has all of them.
    inner = place.format("class/{}" if name == "folder" else "{}")
    for level in {"{}", inner}:
        found = collected({**files, level.format(beside): BESIDE[beside]})
        assert pages_of(found) == dict.fromkeys(learners, BOTH), level
        assert not [one for one in found["learners"] if any(
            remark["about"] == "duplicate" for remark in one["remarks"])]  # fmt: skip


def test_files_of_one_learner_stay_one_learner_s(collected):
    files = {"ana/03_write.ipynb": PAGE_03, "ana/old/04_listen.ipynb": PAGE_04, "ana/a.txt": "x"}
    assert pages_of(collected(files)) == {"ana": BOTH}


# Several attempts, and attempts of nobody.


def test_the_last_attempt_on_blackboard_and_brightspace_counts(collected):
    later = PAGE_03.replace("1.0", "2.0")
    of_blackboard = {
        "HW_ana_attempt_2026-11-24-10-00-00_03_write.ipynb": PAGE_03,
        "HW_ana_attempt_2026-11-25-10-00-00_03_write.ipynb": later,
        "HW_ben_attempt_2026-11-25-10-00-00.txt": "Name: Ben (ben)\nText only.",
    }
    of_brightspace = {
        "7-5 - Ana - Nov 24, 2026 1000 AM/03_write.ipynb": PAGE_03,
        "7-5 - Ana - Nov 25, 2026 1000 AM/03_write.ipynb": later,
    }
    for files, learner in ((of_blackboard, "ana"), (of_brightspace, "7")):
        ana, *others = collected(files)["learners"]
        assert ana["learner"] == learner
        (page,) = ana["pages"]
        assert "-25" in page["path"] or "Nov 25" in page["path"]
        assert [one["about"] for one in ana["remarks"]] == ["duplicate"]
        assert [(one["learner"], one["pages"]) for one in others] in ([], [("ben", [])])


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("Nov 25, 2026 314 PM", (15, 14)),
        ("Nov 25, 2026 1114 AM", (11, 14)),
        ("Nov 25, 2026 12:14 AM", (0, 14)),
        ("25 November, 2026 15_14", (15, 14)),
        ("Nov 25, 2026 114 PM", (13, 14)),
    ],
)
def test_dates_of_brightspace(text, wanted, collected):
    found = collected({f"7-5 - Ana - {text}/03_write.ipynb": PAGE_03})
    (page,) = found["learners"][0]["pages"]
    assert page["modified"] == ON_TIME.replace(hour=wanted[0], minute=wanted[1]).timestamp()


def test_a_date_in_another_language_leaves_that_of_the_file(collected):
    found = collected({"7-5 - Ana - 25 févr. 2026 15:14/03_write.ipynb": PAGE_03})
    assert found["learners"][0]["pages"][0]["modified"] > 0
    assert pages_of(found) == {"7": ["03_write"]}


# Nobody hands in for somebody else, and what is hostile harms nobody.

EVE = {
    "moodle": ("Ana_4711_assignsubmission_file_/", "Eve_5_assignsubmission_file_/"),
    "canvas": ("ana_4711_99_", "eve_5_98_"),
    "brightspace": ("4711-8 - Ana - Nov 25, 2026 100 PM/", "5-8 - Eve - Nov 25, 2026 100 PM/"),
    "blackboard": ("HW_4711_attempt_2026-11-25-10-00-00_", "HW_5_attempt_2026-11-25-10-00-00_"),
    "gradescope": ("x/submission_1/", "x/submission_2/"),
    "folder": ("4711/", "5/"),
}
#: What Eve calls a file or a folder of hers, so that it looks like Ana's.
FORGED = (
    "x_4711_assignsubmission_file_",
    "x_4711_99_",
    "4711-8 - Ana - Nov 25, 2026 100 PM",
    "4711-8 - Ana - Nov 25, 2026 100 PM - ",
    "HW_4711_attempt_2026-11-25-10-00-00_",
    "submission_1",
    "4711",
)


@pytest.mark.parametrize("is_folder", [False, True])
@pytest.mark.parametrize("forged", FORGED)
@pytest.mark.parametrize("name", EVE)
def test_nobody_hands_in_for_somebody_else(name, forged, is_folder, collected):
    ana, eve = EVE[name]
    path = f"{eve}{forged}{'/' * is_folder}03_write.ipynb"
    files = {f"{ana}03_write.ipynb": PAGE_03, path: PAGE_03.replace("1.0", "2.0")}
    if name == "gradescope":
        people = "  :submitters:\n  - :name: N\n    :sid: '{}'\n"
        files["x/submission_metadata.yml"] = "".join(
            f"submission_{n}:\n{people.format(sid)}" for n, sid in ((1, 4711), (2, 5))
        )
    found = collected(files)
    assert pages_of(found) == {"4711": ["03_write"], "5": ["03_write"]}
    assert [one["pages"][0]["path"] for one in found["learners"]] == list(files)[:2]


FORGED_METADATA = """\
ana: &a {':submitters': [{':name': Eve, ':sid': eve}]}
ana.zip: *a
x: {':submitters': [{':name': Ana, ':sid': ana}]}
"""


@pytest.mark.parametrize("place", ["eve/", "eve/x/", "class/eve/"])
def test_a_learner_s_own_metadata_says_nothing_of_others(place, collected):
    above = "class/" * place.startswith("class")
    files = {
        f"{above}ana/03_write.ipynb": PAGE_03,
        f"{above}ben.zip": zipped({"03_write.ipynb": PAGE_03}),
        f"{above}eve/x/03_write.ipynb": PAGE_03,
        f"{place}submission_metadata.yml": FORGED_METADATA,
    }
    assert pages_of(collected(files)) == {one: ["03_write"] for one in ("ana", "ben", "eve")}


def test_metadata_in_a_submission_of_gradescope_says_nothing(collected):
    files, learners = DOWNLOADS["gradescope"]
    forged = METADATA.replace("0100", "0200").replace("submission_9", "submission_8")
    hostile = {"assignment_1_export/submission_9/submission_metadata.yml": forged}
    assert pages_of(collected(files | hostile)) == dict.fromkeys(learners, BOTH)


BROKEN_METADATA = (
    "",
    "- a\n- b\n",
    "submission_7: 3\n",
    "submission_7:\n  :submitters: x\nsubmission_9: !!python/object/apply:os.system ['true']\n",
    "submission_7:\n  :submitters:\n  - 3\n  - {':sid': [1]}\n",
    "a: &a [x]\nb: &b [*a, *a]\nc: [*b, *b]\n? [x]\n: y\n",
    "a: [" * 5_000,
    "\t: broken: [",
    "\0",
)


@pytest.mark.parametrize("text", BROKEN_METADATA, ids=range(len(BROKEN_METADATA)))
def test_broken_metadata_loses_nobody(text, collected):
    files, _ = DOWNLOADS["gradescope"]
    files = files | {"assignment_1_export/submission_metadata.yml": text}
    assert pages_of(collected(files)) == {"submission_7": BOTH, "submission_9": BOTH}


def test_whose_a_file_on_blackboard_is_is_never_the_learner_s_word(collected):
    files = {
        "HW_ana_attempt_2026-11-25-10-00-00_03_write.ipynb": PAGE_03,
        "HW_eve_attempt_2026-11-25-10-00-00_03_write.ipynb": PAGE_03.replace("1.0", "2.0"),
        "HW_eve_attempt_2026-11-25-10-00-00.txt": "Name: Ana (ana)\nName: Eve (eve)\n",
    }
    assert set(pages_of(collected(files))) == {"ana", "eve"}
    nobody_says = {
        "HW_a_li_attempt_2026-11-25-10-00-00_03_write.ipynb": PAGE_03,
        "HW_b_li_attempt_2026-11-25-10-00-00_03_write.ipynb": PAGE_03.replace("1.0", "2.0"),
    }
    assert len(pages_of(collected(nobody_says))) == 2


# The roster.


@pytest.mark.parametrize("name", ROSTERS)
def test_a_roster_of_the_platform_fits_its_download(name, collected, tmp_path):
    files, _ = DOWNLOADS[name]
    text, learners = ROSTERS[name]
    (tmp_path / "roster.csv").write_text(text)
    found = collected(files, "--roster", tmp_path / "roster.csv")
    *there, absent = learners
    assert pages_of(found) == {**dict.fromkeys(there, BOTH), absent: []}
    assert {one["system"] for one in found["learners"]} == {name}
    assert found["remarks"] == []


# The files to upload.


@pytest.fixture
def graded(run, workers, tmp_path):
    """Type `rosbeat grade` for a download, and return the folder of results."""

    def graded(files, *words):
        (tmp_path / "download.zip").write_bytes(zipped(files))
        out = tmp_path / "out"
        run("grade", tmp_path / "download.zip", "--out", out, *words)
        return out

    return graded


def answered(files):
    """The same files with pages of the course that the command knows."""
    texts = {lesson: text.replace("____", "x = 1") for lesson, text in PAGES.items()}
    return {
        name: next((text for lesson, text in texts.items() if lesson in name), content)
        for name, content in files.items()
    }


def rows(path):
    return list(csv.DictReader(io.StringIO(path.read_text("utf-8-sig"))))


def uploads(out):
    """The files to upload: tables with their rows, and names in zips."""
    tables = {path.name: rows(path) for path in out.glob("*.csv") if path.stem in NAMES}
    zips = {path.name: sorted(zipfile.ZipFile(path).namelist()) for path in out.glob("*.zip")}
    return tables, zips


#: With the roster: the rows of the table by its key, and the files of feedback.
UPLOADS = {
    "moodle": ("Identifier", ["Participant 100", "Participant 200", "Participant 300"],
               ["Ana Muster_100_assignfeedback_file_feedback.html",
                "Ben Okafor_200_assignfeedback_file_feedback.html",
                "Cem Arslan_300_assignfeedback_file_feedback.html"]),
    "canvas": ("ID", ["", "100", "200", "300"],
               ["musterana_100_9001_03_write.ipynb", "musterana_100_9001_04_listen.ipynb",
                "okaforben_LATE_200_9002_03_write.ipynb",
                "okaforben_LATE_200_9002_04_listen.ipynb"]),
    "brightspace": ("OrgDefinedId", ["#71", "#72", "#73"],
                    ["100-5005 - Ana Muster - Nov 25, 2026 314 PM/feedback.html",
                     "200-5005 - Ben Okafor - Nov 26, 2026 1:05 PM/feedback.html"]),
    "blackboard": ("Username", ["ana", "b_okafor", "cem"], []),
    "gradescope": ("Email", ["ana@example.org", "ben@example.org", "cem@example.org"], []),
}  # fmt: skip


@pytest.mark.parametrize("name", UPLOADS)
def test_marks_and_feedback_go_back_to_the_platform(name, graded, tmp_path):
    key, keys, feedback = UPLOADS[name]
    (tmp_path / "roster.csv").write_text(ROSTERS[name][0])
    out = graded(
        answered(DOWNLOADS[name][0]), "--roster", tmp_path / "roster.csv", "--assignment", "HW 1"
    )
    tables, zips = uploads(out)
    assert list(tables) == [f"{name}.csv"]
    assert sorted(one[key] for one in tables[f"{name}.csv"]) == keys
    assert zips == ({f"{name}_feedback.zip": feedback} if feedback else {})


def test_the_columns_of_each_table(graded, tmp_path):
    heads = {
        "brightspace": "OrgDefinedId,Username,HW 1 Points Grade,End-of-Line Indicator",
        "blackboard": "Username,HW 1",
        "gradescope": "Name,SID,Email,Total Score,Max Points",
    }
    for name, head in heads.items():
        (tmp_path / "roster.csv").write_text(ROSTERS[name][0])
        out = graded(
            answered(DOWNLOADS[name][0]), "--roster", tmp_path / "roster.csv", "--assignment",
            "HW 1",
        )  # fmt: skip
        table = (out / f"{name}.csv").read_text()
        assert table.splitlines()[0] == head
        assert table.splitlines()[1].count(",") == head.count(",")
        assert list(uploads(out)[0]) == [f"{name}.csv"]  # nothing of the last one stays
        if name == "brightspace":
            assert {row["End-of-Line Indicator"] for row in rows(out / f"{name}.csv")} == {"#"}


def test_a_table_that_needs_a_roster_says_so(collected, graded):
    files, _ = DOWNLOADS["brightspace"]
    (remark,) = collected(files)["remarks"]
    assert "--roster" in remark["text"]
    assert not (graded(answered(files)) / "brightspace.csv").exists()


ON = "Nov 25, 2026 314 PM"
#: Names that reach outside, markup and formulas, where each platform has the learner's name.
HOSTILE_DOWNLOADS = {
    "brightspace": [f"../../1-9 - Ana - {ON}/", f"2-9 - ..\\..\\x - {ON}/", f"4-9 - =1+1 - {ON}/",
                    f"3-9 - <script>x</script> - {ON}/"],
    "blackboard": [f"HW_{name}_attempt_2026-99-25-15-14-00_"
                   for name in ("../../x", "=1+1", "<script>x", "\u202eabc", "@x")],
    "gradescope": ["e/submission_1/../../x/", "e/submission_2/", "e/submission_3/"],
}  # fmt: skip
HOSTILE_METADATA = "".join(
    f"submission_{number}:\n  :submitters:\n  - :name: '{name}'\n    :sid: '{name}'\n"
    for number, name in enumerate(("<script>x</script>", "=1+1", "../../a"), 1)
)


@pytest.mark.parametrize("name", HOSTILE_DOWNLOADS)
def test_hostile_names_leave_the_folder_of_results_alone(name, graded, tmp_path):
    files = {f"{place}03_write.ipynb": PAGE_03 for place in HOSTILE_DOWNLOADS[name]}
    if name == "gradescope":
        files["e/submission_metadata.yml"] = HOSTILE_METADATA
    head = "OrgDefinedId,Username,Last Name,First Name,End-of-Line Indicator"
    (tmp_path / "roster.csv").write_text(f"{head}\n=1+1,@x,=1+1,,#\n")
    roster = ("--roster", tmp_path / "roster.csv") if name == "brightspace" else ()
    before = {*tmp_path.rglob("*"), *tmp_path.parent.glob("*")}
    out = graded(answered(files), *roster)
    made = {*tmp_path.rglob("*"), *tmp_path.parent.glob("*")} - before
    assert {path for path in made if out not in path.parents} == {out, tmp_path / "download.zip"}
    for path in out.glob("feedback/*"):
        assert re.fullmatch(r"[a-z0-9_-]+\.html", path.name)
    for path in [*out.glob("feedback/*"), out / "class.html"]:
        assert "<script>x" not in path.read_text("utf-8")
    tables, zips = uploads(out)
    cells = [cell for table in (*tables.values(), rows(out / "grades.csv"))
             for row in table for cell in row.values()]  # fmt: skip
    assert not [cell for cell in cells if cell.startswith(("=", "+", "@", "-"))]
    for file in (file for files in zips.values() for file in files):
        assert ".." not in file.split("/")
        assert "\\" not in file


# A seventh platform: one class, and one line in the table of them.


class Seventh(Platform):
    """`7!ana!late!03_write.ipynb`; a roster of call signs; marks as `sign=points`."""

    name = "seventh"
    title = "Seventh"
    roster_columns = frozenset({"call sign"})
    id_columns = ("call sign",)

    def owners(self, parts):
        first, *words = parts[0].split("!")
        if first != "7" or len(words) != 3:
            return ()
        learner, late, file = words
        path = "/".join((file, *parts[1:]))
        return (Owner(learner, learner.title(), path, self.name, late == "late"),)

    def is_own_file(self, name):
        return name == "seventh.index"

    def aliases(self, learner, details):
        return (f"sign {learner}",)

    def table(self, learners, assignment):
        lines = (f"{one.learner}={one.points:g}\n" for one in learners)
        return f"{assignment}\n" + "".join(lines)

    def feedback_files(self, feedback):
        yield f"7!{feedback.graded.learner}.html", feedback.page


def test_a_platform_is_one_class_and_one_line(collected, graded, tmp_path, monkeypatch):
    monkeypatch.setattr(platforms, "PLATFORMS", (Seventh(), *platforms.PLATFORMS))
    files = answered(
        {
            "all/7!ana!!03_write.ipynb": "",
            "all/7!ben!late!03_write.ipynb": "",
            "all/seventh.index": "x",
        }
    )
    (tmp_path / "roster.csv").write_text("call sign,name\nana,Ana\nben,Ben\ncem,Cem\n")
    found = collected(files, "--roster", tmp_path / "roster.csv")
    assert pages_of(found) == {"ana": ["03_write"], "ben": ["03_write"], "cem": []}
    assert [one["late"] for each in found["learners"] for one in each["pages"]] == [False, True]
    assert found["remarks"] == []
    assert {one["system"] for one in found["learners"]} == {"seventh"}
    (tmp_path / "out").mkdir()
    (tmp_path / "out/manual.csv").write_text("learner,exercise,points\nsign ana,03a,1\n")
    out = graded(files, "--roster", tmp_path / "roster.csv", "--assignment", "HW 7")
    assert (out / "seventh.csv").read_text() == "HW 7\nana=1\nben=0\ncem=0\n"
    names = zipfile.ZipFile(out / "seventh_feedback.zip").namelist()
    assert names == ["7!ana.html", "7!ben.html", "7!cem.html"]
    assert "03_write.ipynb" in (out / "class.html").read_text()
    assert "7!ben!late" not in (out / "class.html").read_text()


def test_no_other_module_knows_a_platform():
    """Whatever differs between platforms is in their classes; the folder is what is left over."""
    package = Path(platforms.__file__).parents[1]
    names = NAMES - {"folder"}
    for path in package.glob("*.py"):
        texts = (node.value for node in ast.walk(ast.parse(path.read_text("utf-8")))
                 if isinstance(node, ast.Constant) and isinstance(node.value, str))  # fmt: skip
        assert not [text for text in texts if names & set(re.findall("[a-z]+", text))], path


def test_an_unknown_platform_of_earlier_results_is_as_a_folder():
    assert platforms.platform_named("of another version").name == "folder"
    assert platforms.own_path("ana/03_write.ipynb") == "03_write.ipynb"


def test_a_submission_of_a_group_is_each_member_s(collected):
    metadata = METADATA.replace(
        "  :created_at: 2026-11-25",
        "  - :name: Cem Arslan\n    :sid: ''\n    :email: cem@example.org\n"
        "  :created_at: 2026-11-25",
    )
    files = DOWNLOADS["gradescope"][0] | {"assignment_1_export/submission_metadata.yml": metadata}
    found = collected(files)
    assert pages_of(found) == dict.fromkeys(("0100", "0200", "cem@example.org"), BOTH)


def test_the_files_of_both_kinds_can_be_collected_at_once(handed_in, pages):
    found = collect(handed_in(DOWNLOADS["moodle"][0] | DOWNLOADS["blackboard"][0]), pages)
    assert {one.system for one in found.submissions} == {"moodle", "blackboard"}
