"""What a build script lacks; the whole of it is in the bank of answers."""

import pytest

from rosbeat.exercises.entries import diagnose_script, differences
from rosbeat.workspace.packages import read_package
from rosbeat.workspace.setup_script import SetupScript, parse_setup
from rosbeat.workspace.stages import finished


@pytest.mark.parametrize(
    ("setup", "mistake"),
    [
        (SetupScript(problem="No such file or directory"), "marker-missing"),
        (SetupScript(problem="invalid syntax", line=3), "syntax-error"),
        (SetupScript(problem="source code string cannot contain null bytes"), "syntax-error"),
        (parse_setup(b"x = 1"), "no-setup-call"),
        (parse_setup(b"setup(entry_point={})"), "group-misspelled"),
    ],
)
def test_a_script_that_is_none(setup, mistake):
    assert diagnose_script(setup).mistake == mistake


def test_a_script_without_entries_is_one():
    assert diagnose_script(parse_setup(b"setup()")) is None


def test_what_differs_from_the_manifest(tmp_path):
    for name in ("package.xml", "setup.py"):
        (tmp_path / name).write_text(finished(name))
    assert differences(read_package(tmp_path, tmp_path)) == ()
    text = finished("setup.py").replace("0.0.0", "1.0.0").replace("Apache-2.0", "MIT")
    (tmp_path / "setup.py").write_text(text)
    (said,) = differences(read_package(tmp_path, tmp_path))
    assert "version, license" in said
