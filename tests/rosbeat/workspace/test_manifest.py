import pytest

from rosbeat.workspace.manifest import Manifest, parse_manifest, read_manifest
from rosbeat.workspace.stages import finished

BOMB = b"""<?xml version="1.0"?>
<!DOCTYPE a [<!ENTITY x "ha"><!ENTITY y "&x;&x;&x;&x;">]>
<package format="3"><name>&y;</name></package>"""


def test_what_it_says():
    manifest = parse_manifest(finished("package.xml").encode())
    assert (manifest.name, manifest.version) == ("sensor_simulator", "0.0.0")
    assert manifest.build_type == "ament_python"
    assert {"rclpy", "std_msgs"} <= set(manifest.depends)
    assert manifest.description
    assert manifest.license
    assert "@" in manifest.email
    assert manifest.problem == ""


def test_what_is_absent_is_empty():
    assert parse_manifest(b"<package><name> a </name></package>") == Manifest(
        name="a", tags=("name",)
    )


@pytest.mark.parametrize(
    "data",
    [BOMB, BOMB.decode().encode("utf-16"), b"", b"<package>", b"\xff\xfe\x00", b"x" * 1_000_001,
     b'<?xml version="1.0" encoding="no-such"?><a/>'],
)  # fmt: skip
def test_a_bad_one_has_a_problem_and_nothing_else(data):
    manifest = parse_manifest(data)
    assert manifest.problem
    assert manifest == Manifest(problem=manifest.problem)


def test_one_that_is_not_there(tmp_path):
    assert "No such file" in read_manifest(tmp_path / "package.xml").problem
    assert read_manifest(tmp_path).problem
