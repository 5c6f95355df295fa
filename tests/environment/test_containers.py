"""Starting without installing: the container's script, Binder's files and the dev container's."""

import json
import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
BINDER = ROOT / ".binder"


@pytest.fixture
def checkout(tmp_path):
    """A checkout with the script, in a folder with a space."""
    folder = tmp_path / "a course" / "environment"
    folder.mkdir(parents=True)
    shutil.copy(ROOT / "environment" / "container", folder)
    return folder.parent


@pytest.fixture
def machine(tmp_path, checkout):
    """Run the script with a PATH that has these engines, which print what they are asked."""

    def run(engines, *arguments):
        programs = tmp_path / "bin"
        programs.mkdir()
        for tool in ("bash", "dirname"):
            (programs / tool).symlink_to(shutil.which(tool))
        for name in engines:
            (programs / name).write_text(f'#!/bin/sh\nprintf "[%s]" {name} "$@"\necho\n')
            (programs / name).chmod(0o755)
        return subprocess.run(
            [programs / "bash", checkout / "environment" / "container", *arguments],
            env={"PATH": str(programs)},
            capture_output=True,
            text=True,
            check=False,
        )

    return run


@pytest.mark.parametrize("engines", [["docker"], ["podman"], ["docker", "podman"]])
def test_the_image_is_built_and_opened(machine, checkout, engines):
    done = machine(engines)
    assert (done.returncode, done.stderr) == (0, "")
    build, run = done.stdout.splitlines()
    there = checkout / "environment"
    assert build.startswith(f"[{engines[0]}][build][--platform][linux/amd64]")
    assert build.endswith(f"[--file][{there}/Dockerfile][{there}/..]")
    assert "[--publish][127.0.0.1:8888:8888]" in run
    assert run.endswith("[--volume][rosbeat:/home/learner/rosbeat/my_course][rosbeat]")


def test_another_command_runs_in_it(machine):
    done = machine(["docker"], "./environment/course", "update")
    assert done.stdout.splitlines()[1].endswith("[rosbeat][./environment/course][update]")


def test_the_pages_of_a_class_are_kept_as_well(machine, checkout):
    (checkout / ".rosbeat-release.json").write_text("{}")
    assert "[rosbeat-class:/home/learner/rosbeat/notebooks]" in machine(["docker"]).stdout


def test_without_an_engine_three_parts_say_so(machine):
    done = machine([])
    assert done.returncode == 1
    for label in ("What happened:", "What it means here:", "What to try:"):
        assert label in done.stderr


def test_the_volume_is_where_the_image_has_the_pages():
    text = (ROOT / "environment" / "Dockerfile").read_text()
    assert "WORKDIR /home/learner/rosbeat\n" in text
    assert "./environment/course prepare" in text


def test_binder_hands_its_command_over(tmp_path):
    tool = tmp_path / "environment" / "course"
    tool.parent.mkdir()
    tool.write_text('#!/bin/sh\nprintf "[%s]" "$@"\n')
    tool.chmod(0o755)
    command = [BINDER / "start", "jupyter-lab", "--ip=0.0.0.0", "two words"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=True)
    assert done.stdout == "[serve][jupyter-lab][--ip=0.0.0.0][two words]"


@pytest.mark.parametrize("name", ["start", "postBuild"])
def test_binder_can_run_its_scripts(name):
    assert os.access(BINDER / name, os.X_OK)


def test_the_dev_container_ends_at_a_stage_that_there_is():
    text = (ROOT / ".devcontainer" / "devcontainer.json").read_text()
    found = json.loads(re.sub(r"(?m)^\s*//.*$", "", text))
    stages = re.findall(r"(?m)^FROM \S+ AS (\w+)$", (ROOT / "environment/Dockerfile").read_text())
    assert found["build"]["target"] == stages[0]
    assert (ROOT / ".devcontainer" / found["build"]["dockerfile"]).exists()
