"""Page 05: what the bank of answers cannot show of setup.py; and the suspects."""

import pytest

from rosbeat.diagnosis.mistakes import MISTAKES
from rosbeat.diagnosis.packages import FLAWS
from rosbeat.exercises import workspace_model
from rosbeat.exercises.page_05 import EXERCISES
from rosbeat.workspace.catching_up import finished

setup_05a, _ = EXERCISES
PROGRAMS = ("temperature_publisher", "temperature_subscriber")
BOTH = {one: (f"p.{one}:main",) for one in PROGRAMS}


@pytest.fixture
def judged(tmp_path):
    """Write a setup.py into a workspace with both nodes, and judge it."""
    package = tmp_path / "src" / "sensor_simulator"
    code = package / "sensor_simulator"
    code.mkdir(parents=True)
    (package / "package.xml").write_text(finished("package.xml"))
    for name in ("__init__", *PROGRAMS):
        (code / f"{name}.py").write_text("def main():\n    pass\n")
    (package / "setup.cfg").write_text("[install]\ninstall_scripts=$base/lib/sensor_simulator\n")

    def judge(*edits):
        text = finished("setup.py")
        for old, new in edits:
            assert old in text
            text = text.replace(old, new)
        (package / "setup.py").write_bytes(text.encode())
        return setup_05a.judged(setup_05a.scenario(tmp_path))

    return judge


def test_what_differs_from_the_manifest_is_a_remark(judged):
    assert judged().remarks == ()
    (said,) = judged(("0.0.0", "1.0.0"), ("Apache-2.0", "MIT")).remarks
    assert "version, license" in said


@pytest.mark.parametrize(
    ("old", "new", "evidence"),
    [
        ("publisher:main',", "publisher:main'", "comma is missing"),
        ("publisher:main", "publisher.py:main", "names a file"),
        ("publisher:main", "publisher", "no function in it"),
        ("publisher:main", "publsher:main", "which does not exist"),
        ("publisher =", "publisher ==", "more than one `=`"),
        ("subscriber:main", "publisher:main", "temperature_subscriber would call"),
        ("['package.xml']", "[]", "leaves out package.xml"),
        ("'temperature_subscriber = ", "*more(), '", "has no `=`"),
        ("\n", "\n\0", "cannot be read"),
    ],
)
def test_a_wrong_script_says_what_is_wrong(judged, old, new, evidence):
    outcome = judged((old, new))
    assert outcome.status == "failed"
    assert evidence in outcome.evidence
    assert outcome.hint


def test_a_function_of_the_other_file_leads_somewhere(judged):
    swapped = (("publisher:main", "x:main"), ("subscriber:main", "publisher:main"),
               ("x:main", "subscriber:main"))  # fmt: skip
    renamed = (("'temperature_publisher =", "'sensor ="),
               ("'temperature_subscriber =", "'temperature_publisher ="))  # fmt: skip
    for edits in (swapped, renamed):
        outcome = judged(*edits)
        assert outcome.mistake == "other-function"
        assert "leads nowhere" not in str(outcome)


def test_every_flaw_of_an_entry_point_has_words():
    assert set(workspace_model.FLAW_HINTS) == set(FLAWS)
    assert {one.mistake for one in FLAWS.values()} <= set(MISTAKES)


def test_each_suspect_of_05a_calls_other_functions():
    tracks = [one.model(BOTH) for one in workspace_model._SUSPECTS]
    assert len({str(track) for track in (*tracks, BOTH)}) == len(tracks) + 1
