"""What fills `.venv`: the installers, what they say when they stop, and the underlay."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from course_tool import installing, running
from course_tool.installing import pip_settings
from course_tool.problems import Problem, Untouched, installer_stopped

ROOT = Path(__file__).resolve().parents[2]


def flat(command):
    return " ".join(str(part) for part in command)


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


def test_uv_is_told_which_python_whatever_other_environments_are_active(made, monkeypatch):
    seen, commands = {}, []

    def stream(command, env, shown):
        seen.update(env)
        commands.append(command)
        return running.Result(0, "")

    monkeypatch.setattr(running, "quiet", lambda command, env, **_: running.Result(0, ""))
    monkeypatch.setattr(running, "stream", stream)
    installing.fill(made, "course", {"UV_INDEX": "mine"})
    assert seen["UV_INDEX"] == "mine"
    assert len(commands) == 2
    for command in commands:  # the option counts more than UV_PYTHON and VIRTUAL_ENV
        assert command[command.index("--python") + 1] == made.python


def test_progress_shows_what_is_fetched_and_not_every_name():
    shown = installing._WORTH_SHOWING.match
    assert shown("Downloading numpy (16.1MiB)")
    assert shown("   Building empy==3.3.4")
    assert shown("Installed 188 packages in 606ms")
    assert not shown(" + numpy==2.4.6")
    assert not shown("warning: Failed to hardlink files; falling back to full copy.")


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


def test_jupyterlab_opens_without_questions(made):
    installing.write_lab_defaults(made)
    written = made.venv / "share" / "jupyter" / "lab" / "settings" / "overrides.json"
    settings = json.loads(written.read_text())
    assert settings["@jupyterlab/apputils-extension:notification"] == {
        "checkForUpdates": False,
        "fetchNews": "false",
    }


def test_the_kernel_has_the_courses_name_and_is_the_only_one(made):
    spec = made.venv / "share" / "jupyter" / "kernels" / "python3" / "kernel.json"
    spec.parent.mkdir(parents=True)
    spec.write_text('{"argv": ["python"], "display_name": "Python 3 (ipykernel)"}')
    installing.write_lab_defaults(made)
    assert json.loads(spec.read_text()) == {"argv": ["python"], "display_name": "ROS 2 (rosbeat)"}
    config = json.loads((made.venv / "etc/jupyter/jupyter_server_config.json").read_text())
    assert config["KernelSpecManager"] == {"allowed_kernelspecs": ["python3"]}


def test_jupyterlab_stays_without_what_tests_bring_along(made):
    installing.write_lab_defaults(made)
    folder = made.venv / "etc" / "jupyter"
    files = sorted((folder / "jupyter_server_config.d").glob("*.json"))
    assert [path.name for path in files][-1] == "zz_course.json"
    server = json.loads(files[-1].read_text())["ServerApp"]["jpserver_extensions"]
    assert "nbgrader.server_extensions.formgrader" in server
    assert [name for name, is_on in server.items() if is_on] == ["rosbeat.jupyter_lease"]
    lab = json.loads((folder / "labconfig" / "page_config.json").read_text())
    assert lab["disabledExtensions"]["@jupyter/nbgrader"] is True


# What a person told pip.


INDEX = "UV_DEFAULT_INDEX"
CLOSER = """\
:env:.index-url='https://three.example'
global.index-url='https://one.example'
install.index-url='https://two.example'
"""
OTHERS = """\
global.cert='/etc/my certs.pem'
global.proxy='http://proxy.example:3128'
global.trusted-host='\\none.example\\ntwo.example'
"""


@pytest.mark.parametrize(
    ("listing", "environ", "found"),
    [
        ("global.index-url='https://pypi.org/simple'\n", {}, {}),
        ("global.index-url='https://my.example/simple'\n", {}, {INDEX: "https://my.example/simple"}),
        (CLOSER, {}, {INDEX: "https://three.example"}),
        # What was said to uv itself stays.
        ("global.index-url='https://x'\nglobal.proxy='http://p:1'\n",
         {"UV_INDEX_URL": "https://x", "HTTPS_PROXY": "http://q:2"}, {}),
        (OTHERS, {}, {"SSL_CERT_FILE": "/etc/my certs.pem",
                      "ALL_PROXY": "http://proxy.example:3128",
                      "UV_INSECURE_HOST": "one.example two.example"}),
        ("global.timeout='60'\nWARNING: nonsense\n:env:.quiet='1'\n", {}, {}),
    ],
)  # fmt: skip
def test_what_a_person_told_pip_is_told_to_uv(listing, environ, found):
    assert pip_settings(listing, environ) == found


# What installers say when they stop.

PLACE = Path("/home/ada/course/.venv")

# Lines as pip and uv print them.
NETWORK = [
    "error: Failed to fetch: `https://example.invalid/simple/anyio/`\n  Caused by: dns error",
    "Temporary failure in name resolution')': /simple/uv/",
    "ERROR: No matching distribution found for uv==0.13.9",
    "error: Request failed\n  Caused by: operation timed out",
    "  Caused by: tcp connect error: Connection refused (os error 111)",
]
DISK = [
    "ERROR: Could not install packages due to an OSError: [Errno 28] No space left on device",
    "error: failed to write to file: No space left on device (os error 28)",
    "Caused by: Disk quota exceeded (os error 122)",
]
CERTIFICATE = [
    "Caused by: invalid peer certificate: UnknownIssuer",
    "SSLCertVerificationError(1, '[SSL: CERTIFICATE_VERIFY_FAILED] certificate verify failed",
]
HASH = [
    "error: Hash mismatch for `anyio==4.16.0`",
    "ERROR: THESE PACKAGES DO NOT MATCH THE HASHES FROM THE REQUIREMENTS FILE.",
]
PERMISSION = ["error: failed to create directory `/home/ada/.cache/uv`: Permission denied"]
PLATFORM = ["  x Because numpy has no wheels with a matching platform tag (e.g., `manylinux_2_17`)"]
BUILD = ["  x Failed to build `rosbeat @ file:///home/ada/course`\n  The build backend returned"]


def kinds():
    for texts, words in (
        (NETWORK, "cannot be reached"),
        (DISK, "not enough room"),
        (CERTIFICATE, "does not trust"),
        (HASH, "not the one the course was locked to"),
        (PERMISSION, "may not write"),
        (BUILD, "could not be built"),
        (PLATFORM, "does not come ready-made for this Linux"),
    ):
        yield from ((text, words) for text in texts)
    both = "error: Failed to fetch: `anyio`\n  Caused by: No space left on device (os error 28)"
    yield both, "not enough room"


@pytest.mark.parametrize(("text", "words"), list(kinds()))
def test_last_words_are_understood(text, words):
    problem = installer_stopped(text, PLACE)
    assert words in problem.happened
    # What fails before anything changes leaves an environment as it was.
    assert isinstance(problem, Untouched) == (text in [*NETWORK, *CERTIFICATE, *HASH, *BUILD])
    assert problem.means
    assert problem.cure
    assert problem.details == "\n".join(text.strip().splitlines())


def test_an_unknown_end_says_so_and_shows_the_last_lines():
    problem = installer_stopped("\n".join(f"line {n}" for n in range(100)), PLACE)
    assert "does not know the reason" in problem.happened
    assert problem.details.splitlines() == [f"line {n}" for n in range(88, 100)]


# The underlay.

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
    installing.write_underlay(made, BARE)
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
    """And no other Python sees the packages of this one."""
    environ = sourced(shell, prefix / f"{name}.{suffix(shell)}")
    assert environ["PATH"] == f"{prefix}/bin:{os.defpath}"
    assert environ["AMENT_PREFIX_PATH"] == str(prefix)
    assert environ["ROS_DISTRO"] == "jazzy"
    assert environ["RMW_IMPLEMENTATION"] == "rmw_fastrtps_cpp"
    assert 1 <= int(environ["ROS_DOMAIN_ID"]) <= 50
    assert not {"PYTHONPATH", "LD_LIBRARY_PATH", "PYTHONHOME"} & set(environ)


@pytest.mark.parametrize(
    ("theirs", "found"),
    [
        ({"ROS_DOMAIN_ID": "77"}, {"ROS_DOMAIN_ID": "77"}),
        ({"AMENT_PREFIX_PATH": "/ws/arm"}, {"AMENT_PREFIX_PATH": "VENV:/ws/arm"}),
        # A workspace on top stays on top.
        ({"AMENT_PREFIX_PATH": "/ws/arm:VENV"}, {"AMENT_PREFIX_PATH": "/ws/arm:VENV"}),
    ],
)
def test_what_a_person_set_stays(prefix, theirs, found):
    theirs = {name: value.replace("VENV", str(prefix)) for name, value in theirs.items()}
    environ = sourced("bash", prefix / "setup.bash", environ={**BARE, **theirs})
    for name, value in found.items():
        assert environ[name] == value.replace("VENV", str(prefix))


@pytest.mark.parametrize("shell", SHELLS)
def test_sourcing_twice_is_sourcing_once(prefix, shell):
    file = prefix / f"setup.{suffix(shell)}"
    assert sourced(shell, file) == sourced(shell, file, file)


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


def test_completion_is_asked_for_once_and_read_by_bash(made, prefix, monkeypatch):
    asked = []

    def quiet(command, env, timeout):
        asked.append(Path(command[0]).name)
        return running.Result(0, f"complete -W 'run topic' {asked[-1]}\n")

    monkeypatch.setattr(running, "quiet", quiet)
    installing.write_underlay(made, BARE)
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


def test_every_mark_is_filled_in(prefix):
    for file in prefix.glob("*setup.*"):
        assert "@" not in file.read_text()
