import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from course_tool import installing, running
from course_tool.messages import Problem, Untouched

ROOT = Path(__file__).resolve().parents[2]


def flat(command):
    return " ".join(str(part) for part in command)


def test_everything_is_installed_by_hash_and_without_a_compiler(layout):
    command = flat(installing.lock_command(layout, "test"))
    assert "--require-hashes" in command
    assert "--only-binary :all: --no-binary empy" in command
    assert command.endswith(f"-r {layout.lock('test')}")


def test_our_own_packages_are_installed_in_place_without_a_network(layout):
    command = flat(installing.own_command(layout))
    assert "--offline --no-deps --no-build-isolation" in command
    assert f"--editable {layout.root} --editable {layout.root}/src/ros2_command" in command


def test_uv_is_fetched_once(made, monkeypatch):
    runs = []

    def quiet(command, env, timeout=None):
        runs.append(flat(command))
        if "--target" in map(str, command):
            made.uv.parent.mkdir(parents=True)
            made.uv.touch()
            (made.uv_home / "uv-1.2.3.dist-info").mkdir()
        return running.Result(0, "")

    monkeypatch.setattr(running, "quiet", quiet)
    monkeypatch.setattr(running, "stream", lambda *args: running.Result(0, ""))
    for _ in range(2):
        installing.fill(made, "course", {})
    fetches = [run for run in runs if "--target" in run]
    assert len(fetches) == 1
    assert "--require-hashes" in fetches[0]
    assert fetches[0].endswith(f"-r {made.lock('bootstrap')}")


def test_without_a_network_uv_is_not_half_there(made, monkeypatch):
    made.uv_home.mkdir()
    text = "ERROR: No matching distribution found for uv==1.2.3"
    monkeypatch.setattr(running, "quiet", lambda command, env: running.Result(1, text))
    with pytest.raises(Untouched, match="cannot be reached"):
        installing.fill(made, "course", {})
    assert not made.uv_home.exists()


def test_a_disk_that_fills_while_installing(made, monkeypatch):
    monkeypatch.setattr(running, "quiet", lambda command, env: running.Result(0, ""))
    text = "error: failed to copy file: No space left on device (os error 28)"
    monkeypatch.setattr(running, "stream", lambda *args: running.Result(2, text))
    with pytest.raises(Problem, match="not enough room"):
        installing.fill(made, "course", {})


def test_installers_never_bring_a_python_and_ignore_other_environments(made, monkeypatch):
    seen = {}

    def stream(command, env, shown):
        seen.update(env)
        return running.Result(0, "")

    monkeypatch.setattr(running, "quiet", lambda command, env, **_: running.Result(0, ""))
    monkeypatch.setattr(running, "stream", stream)
    installing.fill(
        made, "course", {"UV_PYTHON": "3.9", "VIRTUAL_ENV": "/other", "UV_INDEX": "mine"}
    )
    assert seen["UV_PYTHON_DOWNLOADS"] == "never"
    assert seen["UV_INDEX"] == "mine"
    assert "UV_PYTHON" not in seen
    assert "VIRTUAL_ENV" not in seen


def test_progress_shows_what_is_fetched_and_not_every_name():
    shown = installing._WORTH_SHOWING.match
    assert shown("Downloading numpy (16.1MiB)")
    assert shown("   Building empy==3.3.4")
    assert shown("Installed 188 packages in 606ms")
    assert not shown(" + numpy==2.4.6")
    assert not shown("warning: Failed to hardlink files; falling back to full copy.")


def test_a_cache_on_another_file_system_is_copied_from(layout, monkeypatch):
    devices = {"cache": 1, ".venv": 2}
    monkeypatch.setattr(installing, "_device", lambda path: devices[path.name])
    assert installing.link_mode(layout, {"UV_CACHE_DIR": "/big/cache"}) == "copy"
    devices["cache"] = 2
    assert installing.link_mode(layout, {"UV_CACHE_DIR": "/big/cache"}) is None


@pytest.fixture
def started(made):
    """Start a Python as `.venv` would, and return what its environment says."""
    module = made.root / "src" / "rosbeat" / "environment.py"
    module.parent.mkdir(parents=True)
    module.write_text((ROOT / "src" / "rosbeat" / "environment.py").read_text())
    installing.write_start_hook(made)
    code = (
        f"import site; site.addsitedir({str(made.site_packages)!r}); import json, os; "
        "print(json.dumps({k: v for k, v in os.environ.items() if k.startswith('ROS_')}))"
    )

    def start():
        done = subprocess.run(
            [sys.executable, "-I", "-S", "-c", code],
            env={"PATH": os.defpath},
            capture_output=True,
            text=True,
            check=True,
        )
        assert done.stderr == ""
        return json.loads(done.stdout)

    start.module = module
    return start


def test_every_python_sets_what_nodes_need(started):
    found = started()
    assert found["ROS_AUTOMATIC_DISCOVERY_RANGE"] == "LOCALHOST"
    assert found["ROS_PYTHON_CHECK_FIELDS"] == "1"


@pytest.mark.parametrize("harm", ["gone", "broken"])
def test_a_broken_rosbeat_does_not_disturb_python(started, harm):
    if harm == "gone":
        started.module.unlink()
    else:
        started.module.write_text("this is not Python (")
    assert started() == {}


def test_a_hook_is_written_over_an_older_one(made):
    installing.write_start_hook(made)
    installing.write_start_hook(made)
    assert (made.site_packages / "zz_rosbeat_environment.pth").read_text().count("\n") == 1


def test_jupyterlab_opens_without_questions(made):
    installing.write_lab_defaults(made)
    written = made.venv / "share" / "jupyter" / "lab" / "settings" / "overrides.json"
    (settings,) = json.loads(written.read_text()).values()
    assert settings == {"checkForUpdates": False, "fetchNews": "false"}


def test_jupyterlab_stays_without_what_tests_bring_along(made):
    installing.write_lab_defaults(made)
    folder = made.venv / "etc" / "jupyter"
    files = sorted((folder / "jupyter_server_config.d").glob("*.json"))
    assert [path.name for path in files][-1] == "zz_course.json"
    server = json.loads(files[-1].read_text())["ServerApp"]["jpserver_extensions"]
    assert "nbgrader.server_extensions.formgrader" in server
    assert set(server.values()) == {False}
    lab = json.loads((folder / "labconfig" / "page_config.json").read_text())
    assert lab["disabledExtensions"]["@jupyter/nbgrader"] is True
