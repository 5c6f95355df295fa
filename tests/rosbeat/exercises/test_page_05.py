"""Page 05: what the bank of answers cannot show of setup.py; and the suspects."""

import pytest

from rosbeat.diagnosis.mistakes import MISTAKES
from rosbeat.diagnosis.packages import FLAWS
from rosbeat.exercises import workspace_model
from rosbeat.exercises.page_05 import EXERCISES
from rosbeat.workspace.catching_up import finished

setup_05a, _ = EXERCISES
PROGRAMS = ("temperature_publisher", "temperature_subscriber")


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


def test_every_flaw_of_an_entry_point_has_words():
    assert set(workspace_model.FLAW_HINTS) == set(FLAWS)
    assert {one.mistake for one in FLAWS.values()} <= set(MISTAKES)
