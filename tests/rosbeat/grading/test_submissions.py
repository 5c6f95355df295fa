"""What can be submissions at all."""

import pytest

from grading_files import PAGE_03
from rosbeat.errors import GradingError
from rosbeat.grading.collecting import collect
from rosbeat.grading.ledger import FILE as LEDGER
from rosbeat.grading.release import MARKER
from rosbeat.grading.submissions import require_apart, require_submissions

MOODLE = "Ana_1_assignsubmission_file_/essay.docx"


@pytest.fixture
def require(handed_in, pages):
    def require(files, pages_named=False):
        root = handed_in(files)
        require_submissions(root, collect(root, pages), pages_named)

    return require


@pytest.mark.parametrize("named", [False, True])
@pytest.mark.parametrize("more", [{}, {"ben/essay.docx": "x"}, {"03_write.ipynb": PAGE_03}])
def test_one_page_of_one_learner_is_a_class(require, more, named):
    require({"ana/03_write.ipynb": PAGE_03, **more}, named)


@pytest.mark.parametrize(
    ("files", "said"),
    [
        ({".DS_Store": ""}, "it is empty"),
        ({"03_write.ipynb": PAGE_03}, "its one file is no learner's page of this course"),
        ({"a.txt": "x", "b.txt": "y"}, "of its 2 files none is a learner's page"),
        ({LEDGER: "", "feedback/ana.html": "x"}, "it is a folder of results"),
        ({MARKER: "", "notebooks/03_write.ipynb": PAGE_03}, "is what learners get, a release"),
    ],
)
@pytest.mark.parametrize("named", [False, True])
def test_what_is_no_class_is_refused(require, files, said, named, says):
    with pytest.raises(GradingError) as caught:
        require(files, named)
    says(caught.value, said, "Moodle or Canvas", "Nothing was written", "docs/instructors.md")


@pytest.mark.parametrize("files", [{MOODLE: "x"}, {"ana/03_write.ipynb": ""}, {"ana/x.ipynb": "{"}])
def test_whoever_tried_is_a_class_if_it_is_known_what_counts(require, files):
    require(files, pages_named=True)
    with pytest.raises(GradingError):
        require(files)


def test_an_empty_folder_is_refused(tmp_path, pages, says):
    folder = tmp_path / "empty"
    folder.mkdir()
    with pytest.raises(GradingError) as caught:
        require_submissions(folder, collect(folder, pages), pages_named=False)
    says(caught.value, "it is empty")


def test_a_name_cannot_reach_the_terminal(require):
    with pytest.raises(GradingError) as caught:
        require({"ana/\x1b[31m.docx": "x"})
    assert "\x1b" not in str(caught.value)


@pytest.mark.parametrize(
    ("out", "is_apart"),
    [("class", False), ("class/grades", False), ("grades/../class/x", False), ("class2", True),
     ("grades", True), (".", True)],
)  # fmt: skip
def test_results_do_not_lie_among_submissions(tmp_path, out, is_apart, says):
    (tmp_path / "class").mkdir()
    if is_apart:
        require_apart(tmp_path / "class", tmp_path / out)
        return
    with pytest.raises(GradingError) as caught:
        require_apart(tmp_path / "class", tmp_path / out)
    says(caught.value, "in the folder of the submissions", "--out ~/class/grades")
