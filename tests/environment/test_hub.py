"""`course hub`, up to JupyterHub itself, which tests/hub runs."""

import json
import os
from pathlib import Path

import pytest
import yaml

from course_tool import hub, installing, prepare, running

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture
def course(made, monkeypatch):
    """A checkout with `.venv`, in which installers only say that they were called."""
    made.hub.mkdir()
    for path in (made.lock("hub"), made.hub / "package.json", made.hub / "package-lock.json"):
        path.write_text("{}")
    monkeypatch.setattr(prepare, "ready", lambda layout, level: {"PATH": "/bin"})
    return made


@pytest.fixture
def ran(monkeypatch):
    """The programs that were run, by the names of their files, and what the last one became."""
    found = []

    def run(command, env, timeout=None, cwd=None):
        found.append(Path(command[0]).name)
        return running.Result(True, "")

    def become(program, command, environ):
        found.append(command[1:])

    monkeypatch.setattr(running, "quiet", run)
    monkeypatch.setattr(installing, "install", run)
    monkeypatch.setattr(os, "execve", become)
    return found


def test_it_installs_once_and_becomes_jupyterhub(course, ran):
    config = ["-f", str(course.hub / "jupyterhub_config.py")]
    hub.hub(course, ["--debug"])
    installers = [one for one in ran if one in ("uv", "npm")]
    assert (installers, ran[-1]) == (["uv", "npm"], [*config, "--debug"])
    ran.clear()
    hub.hub(course, [])
    assert ran == [config]
    course.lock("hub").write_text("changed")
    hub.hub(course, [])
    assert "npm" in ran


@pytest.mark.parametrize("options", [["-f", "mine.py"], ["--config=mine.py"]])
def test_a_configuration_of_ones_own_takes_the_place_of_the_courses(course, ran, options):
    hub.hub(course, options)
    assert ran[-1] == options


def test_a_learner_gets_the_list_of_fonts_once(course, tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    shared = course.venv / "share" / "rosbeat-hub" / "matplotlib"
    shared.mkdir(parents=True)
    (shared / "fontlist-v390.json").write_text("{}")
    own = tmp_path / "matplotlib" / "fontlist-v390.json"
    hub.bring_fonts(course)
    assert own.read_text() == "{}"
    own.write_text("mine")
    hub.bring_fonts(course)
    assert own.read_text() == "mine"


def test_the_proxy_is_locked_with_hashes_and_names_no_registry():
    lock = json.loads((ROOT / "environment/jupyterhub/package-lock.json").read_text())
    packages = [one for name, one in lock["packages"].items() if name]
    assert len(packages) > 20
    assert all(one["integrity"].startswith("sha512-") for one in packages)
    assert not any("resolved" in one for one in packages)


def test_the_values_for_kubernetes_start_what_the_hub_starts():
    """The file was not run; at least it can be read, and its command and variable are ours."""
    values = yaml.safe_load((ROOT / "environment/jupyterhub/values.yaml").read_text())
    user = values["singleuser"]
    assert user["cmd"][1:] == ["serve", "jupyterhub-singleuser"]
    assert user["extraEnv"]["ROSBEAT_MY_COURSE"].startswith(user["storage"]["homeMountPath"])
