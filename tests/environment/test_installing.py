"""What fills `.venv`: the installers, what they say when they stop, and the underlay."""

import json
import os
import pty
import shutil
import subprocess
import sys
from contextlib import suppress
from pathlib import Path

import pytest

from course_tool import installing, running
from course_tool.installing import pip_settings
from course_tool.problems import Problem

ROOT = Path(__file__).resolve().parents[2]


def test_pip_installs_uv_and_uv_everything_else(made, monkeypatch):
    """Into this environment, whatever other ones are active, and from files with known hashes."""
    made.lock("course").write_text("a==1\nb==2\n")
    ran, environs = [], []

    def install(command, env, log):
        ran.append([str(part) for part in command])
        environs.append(env)

    monkeypatch.setattr(running, "quiet", lambda *given, **more: running.Result(True, CLOSER))
    monkeypatch.setattr(installing, "install", install)
    installing.fill(made, "course", {"UV_INDEX": "mine"})
    pip, locked, own = ran
    assert pip[0] == str(made.python)
    assert {"--require-hashes", str(made.lock("bootstrap"))} < set(pip)
    assert {"--require-hashes", str(made.lock("course")), str(made.lock("build"))} < set(locked)
    assert {"--offline", *map(str, made.own_packages)} < set(own)
    for command, env in zip((locked, own), environs[1:], strict=True):
        # The option counts more than UV_PYTHON and VIRTUAL_ENV.
        assert command[command.index("--python") + 1] == str(made.python)
        assert (env["UV_INDEX"], env[INDEX]) == ("mine", "https://three.example")


def test_an_installer_that_stops_is_said_in_three_parts(tmp_path):
    log = tmp_path / "install.log"
    log.write_text("of another installer\n")
    code = "import sys; print(' + a==1'); sys.exit('no wheel')"
    with pytest.raises(Problem, match="The installer stopped") as caught:
        installing.install([sys.executable, "-uc", code], os.environ, log)
    for words in ("HTTPS_PROXY", "1.5 GB of disk", "./environment/container", "remove the folder"):
        assert words in caught.value.cure
    assert caught.value.cure.endswith(f"All that it said is in {log}")
    assert caught.value.details == "+ a==1\nno wheel"
    assert log.read_text() == "of another installer\n + a==1\nno wheel\n"


MANY = "import time\nfor number in range(244): print(f' + package-{number}==1.0')"
INSTALL = """\
import os, sys
sys.path.insert(0, {environment!r})
from pathlib import Path
from course_tool import installing
print("  3/4  installing", flush=True)
installing.install([sys.executable, "-c", {many!r}], os.environ, Path({log!r}))
print("  4/4  listening")
"""


@pytest.mark.parametrize("is_watched", [True, False])
def test_a_first_start_is_quiet(tmp_path, is_watched):
    """In a terminal, one line changes; in a pipe, as in CI, there is none."""
    log = tmp_path / "install.log"
    environment = str(ROOT / "environment")
    code = INSTALL.format(environment=environment, many=MANY, log=str(log))
    command, environ = [sys.executable, "-c", code], {**os.environ, "TERM": "xterm"}
    if is_watched:
        main, other = pty.openpty()
        process = subprocess.Popen(command, env=environ, stdout=other)
        os.close(other)
        said = b""
        with suppress(OSError):  # the end
            while part := os.read(main, 65536):
                said += part
        os.close(main)
        assert process.wait(60) == 0
        rows = said.decode().replace("\r\n", "\n").split("\n")
        shown = [row.rpartition("\x1b[K")[2] for row in rows]
        assert "package-0==1.0" in rows[1]
    else:
        done = subprocess.run(command, env=environ, capture_output=True, text=True, check=True)
        shown = done.stdout.split("\n")
        assert done.stderr == ""
    assert shown == ["  3/4  installing", "  4/4  listening", ""]
    assert len(log.read_text().splitlines()) == 244


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
    # Messages name the lines of cells.
    assert settings["@jupyterlab/notebook-extension:tracker"]["codeCellConfig"]["lineNumbers"]


def test_the_kernel_has_the_courses_name_and_is_the_only_one(made):
    spec = made.venv / "share" / "jupyter" / "kernels" / "python3" / "kernel.json"
    spec.parent.mkdir(parents=True)
    spec.write_text('{"argv": ["python"], "display_name": "Python 3 (ipykernel)"}')
    installing.write_lab_defaults(made)
    assert json.loads(spec.read_text()) == {"argv": ["python"], "display_name": "ROS 2 (rosbeat)"}
    config = json.loads((made.venv / "etc/jupyter/jupyter_server_config.json").read_text())
    assert config["KernelSpecManager"] == {"allowed_kernelspecs": ["python3"]}


def test_every_kernel_of_the_environment_brings_the_course(made):
    installing.write_lab_defaults(made)
    config = json.loads((made.venv / installing.KERNEL_CONFIG).read_text())
    assert config == {"InteractiveShellApp": {"extra_extensions": ["rosbeat"]}}


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
    file = prefix / f"{name}.{suffix(shell)}"
    environ = sourced(shell, file, file)  # twice is once
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
        return running.Result(True, f"complete -W 'run topic' {asked[-1]}\n")

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
