"""Whose a file is, from where it lies."""

import pytest

from rosbeat.grading.learners import Whose, own_path, whose, without_wrapper


@pytest.mark.parametrize(
    ("path", "owner"),
    [
        ("ana/03.ipynb", Whose("ana", "ana", "03.ipynb", "folder")),
        ("ana/deep/03.ipynb", Whose("ana", "ana", "deep/03.ipynb", "folder")),
        (
            "Ana Muster_4711_assignsubmission_file_/03.ipynb",
            Whose("4711", "Ana Muster", "03.ipynb", "moodle"),
        ),
        (
            "Ana Muster_4711_assignsubmission_file_03_a.ipynb",
            Whose("4711", "Ana Muster", "03_a.ipynb", "moodle"),
        ),
        (
            "Jo_van_Os_12_assignsubmission_onlinetext_/text.html",
            Whose("12", "Jo_van_Os", "text.html", "moodle"),
        ),
        (
            "musterana_LATE_4711_998877_03_a-2.ipynb",
            Whose("4711", "musterana", "03_a.ipynb", "canvas", late=True, attempt=2),
        ),
        (
            "musterana_4711_998877_03_a.ipynb",
            Whose("4711", "musterana", "03_a.ipynb", "canvas"),
        ),
        (
            "musterana_4711_998877_work/03.ipynb",
            Whose("4711", "musterana", "work/03.ipynb", "canvas"),
        ),
    ],
)
def test_a_path_says_whose_it_is(path, owner):
    assert whose(tuple(path.split("/"))) == owner


@pytest.mark.parametrize("path", ["03.ipynb", "03_write_a_publisher.ipynb", "a_b.ipynb"])
def test_a_path_that_names_nobody_is_nobody_s(path):
    assert whose((path,)) is None


@pytest.mark.parametrize(
    ("paths", "level"),
    [
        (["class/ana/03", "class/ben/03"], 1),
        (["a/b/ana/03", "a/b/ben/03"], 2),
        (["ana/03", "ben/03"], 0),
        (["ana/03", "ana/04"], 0),
        (["class/ana/03", "class/notes"], 0),
        (["A_1_assignsubmission_file_/x/03", "A_1_assignsubmission_file_/y/03"], 0),
        (["class/A_1_assignsubmission_file_/x/03"], 1),
        ([], 0),
    ],
)
def test_folders_around_everything_are_left_out(paths, level):
    assert without_wrapper([tuple(path.split("/")) for path in paths]) == level


@pytest.mark.parametrize(
    ("path", "own"),
    [
        ("Ana Muster_4711_assignsubmission_file_/old/03.ipynb", "old/03.ipynb"),
        ("Ana Muster_4711_assignsubmission_file_03.ipynb", "03.ipynb"),
        ("musterana_LATE_4711_998877_03-1.ipynb", "03.ipynb"),
        ("ana/03.ipynb", "03.ipynb"),
        ("stray.ipynb", "stray.ipynb"),
        ("Ana_4711_assignsubmission_file_", "Ana_4711_assignsubmission_file_"),
        ("", ""),
    ],
)
def test_a_file_as_its_learner_knows_it(path, own):
    assert own_path(path) == own
