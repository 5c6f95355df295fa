from __future__ import annotations

import sys
from pathlib import Path

from rosbeat.authoring.kernel import OwnInterpreter, kernel_place
from rosbeat.domains import PRIVATE_IDS


def test_every_kernel_name_means_this_interpreter():
    assert OwnInterpreter().get_kernel_spec("anything").argv[0] == sys.executable


def test_what_pytest_and_terminals_add_to_the_environment_stays_behind(monkeypatch):
    monkeypatch.setenv("PYTEST_CURRENT_TEST", "x")
    monkeypatch.setenv("COLUMNS", "20")
    with kernel_place() as place:
        assert "PYTEST_CURRENT_TEST" not in place.environment
        assert "COLUMNS" not in place.environment


def test_each_kernel_has_an_empty_workspace_and_a_domain_of_its_own(monkeypatch):
    monkeypatch.setenv("ROS_DOMAIN_ID", "7")
    with kernel_place() as one, kernel_place() as other:
        homes = {place.environment["ROSBEAT_STEADY_HOME"] for place in (one, other)}
        domains = {int(place.environment["ROS_DOMAIN_ID"]) for place in (one, other)}
        assert all(list(Path(home).iterdir()) == [] for home in homes)
    assert len(homes) == len(domains) == 2
    assert domains < set(PRIVATE_IDS)
    assert not any(Path(home).exists() for home in homes)


def test_sockets_have_short_paths_and_leave_with_the_kernel(monkeypatch, tmp_path):
    deep = tmp_path / ("x" * 100)
    deep.mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(deep))
    with kernel_place() as one, kernel_place() as other:
        assert one.folder != other.folder
        assert len(str(one.options()["ip"]) + "-5") < 107
    assert not one.folder.exists()
