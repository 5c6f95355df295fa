"""Page 05: what the bank of answers cannot show of setup.py."""

from bank.workspaces import Desk
from rosbeat.exercises.page_05 import EXERCISES


def test_what_differs_from_the_manifest_is_a_remark(tmp_path):
    Desk(tmp_path).furnish(with_package=True)
    script = tmp_path / "src" / "sensor_simulator" / "setup.py"
    said = []
    for old, new in (("", ""), ("0.0.0", "1.0.0"), ("Apache-2.0", "MIT")):
        script.write_text(script.read_text().replace(old, new))
        said.append(EXERCISES[0].judged(EXERCISES[0].scenario(tmp_path)).remarks)
    assert said[0] == ()
    assert "version, license" in said[2][0]
