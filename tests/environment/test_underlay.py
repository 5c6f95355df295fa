import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from course_tool import running, underlay

ROOT = Path(__file__).resolve().parents[2]
BARE = {"PATH": os.defpath, "HOME": "/nowhere"}
SHELLS = ["bash", *(name for name in ("dash", "zsh", "sh") if shutil.which(name))]


@pytest.fixture
def prefix(made):
    """A `.venv` in a folder with a space, made an underlay."""
    module = made.root / "src" / "rosbeat" / "environment.py"
    module.parent.mkdir(parents=True)
    shutil.copy(ROOT / "src" / "rosbeat" / "environment.py", module)
    made.python.unlink()
    made.python.symlink_to(os.path.realpath(sys.executable))
    underlay.write(made, BARE)
    return made.venv


def sourced(shell, *files, environ=BARE, after="env -0"):
    """What the environment is after files were sourced, and nothing may be said."""
    lines = "; ".join(f". '{file}'" for file in files)
    done = subprocess.run(
        [shell, "-c", f"set -eu; {lines}; {after}"],
        env=environ,
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stderr == ""
    pairs = (entry.split("=", 1) for entry in done.stdout.split("\0") if "=" in entry)
    return {name: value for name, value in pairs if name not in ("_", "PWD", "SHLVL", "OLDPWD")}


def suffix(shell):
    return shell if shell in ("bash", "zsh") else "sh"


@pytest.mark.parametrize("shell", SHELLS)
@pytest.mark.parametrize("name", ["setup", "local_setup"])
def test_sourcing_activates_ros_in_a_bare_shell(prefix, shell, name):
    environ = sourced(shell, prefix / f"{name}.{suffix(shell)}")
    assert environ["PATH"] == f"{prefix}/bin:{os.defpath}"
    assert environ["AMENT_PREFIX_PATH"] == str(prefix)
    assert environ["ROS_DISTRO"] == "jazzy"
    assert environ["RMW_IMPLEMENTATION"] == "rmw_fastrtps_cpp"
    assert 1 <= int(environ["ROS_DOMAIN_ID"]) <= 50


@pytest.mark.parametrize("shell", SHELLS)
def test_sourcing_twice_is_sourcing_once(prefix, shell):
    file = prefix / f"setup.{suffix(shell)}"
    assert sourced(shell, file) == sourced(shell, file, file)


def test_no_other_python_sees_the_packages_of_this_one(prefix):
    environ = sourced("bash", prefix / "setup.bash")
    assert not {"PYTHONPATH", "LD_LIBRARY_PATH", "PYTHONHOME"} & set(environ)


def test_what_a_person_set_stays(prefix):
    theirs = {**BARE, "ROS_DOMAIN_ID": "77", "AMENT_PREFIX_PATH": "/ws/install/arm"}
    environ = sourced("bash", prefix / "setup.bash", environ=theirs)
    assert environ["ROS_DOMAIN_ID"] == "77"
    assert environ["AMENT_PREFIX_PATH"] == f"{prefix}:/ws/install/arm"


def test_a_workspace_on_top_stays_on_top(prefix):
    both = {**BARE, "AMENT_PREFIX_PATH": f"/ws/install/arm:{prefix}"}
    environ = sourced("bash", prefix / "setup.bash", environ=both)
    assert environ["AMENT_PREFIX_PATH"] == both["AMENT_PREFIX_PATH"]


def test_nothing_stays_behind_in_the_shell(prefix):
    names = "{ compgen -v; compgen -A function; } | grep rosbeat || :"
    done = subprocess.run(
        ["bash", "-c", f". '{prefix}/setup.bash'; {names}"],
        env=BARE,
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stdout == ""


def test_a_broken_rosbeat_leaves_the_commands_where_they_are(prefix):
    module = prefix.parent / "src" / "rosbeat" / "environment.py"
    module.write_text("this is not Python (")
    assert sourced("bash", prefix / "setup.bash")["PATH"].startswith(f"{prefix}/bin:")


def test_completion_is_asked_for_once_and_read_by_bash(made, prefix, monkeypatch):
    asked = []

    def quiet(command, env, timeout):
        asked.append(Path(command[0]).name)
        return running.Result(0, f"complete -W 'run topic' {asked[-1]}\n")

    monkeypatch.setattr(running, "quiet", quiet)
    underlay.write(made, BARE)
    assert asked == ["ros2", "register-python-argcomplete"]
    after = "complete -p ros2 >&2"
    done = subprocess.run(
        ["bash", "-c", f". '{prefix}/setup.bash'; {after}"],
        env=BARE,
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stderr == "complete -W 'run topic' ros2\n"


def test_a_command_that_cannot_say_how_it_completes_is_left_out(made, prefix):
    assert list(made.completions.iterdir()) == []


def test_every_mark_is_filled_in(prefix):
    for file in prefix.glob("*setup.*"):
        assert "@" not in file.read_text()
