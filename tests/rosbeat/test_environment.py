import importlib.util
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from rosbeat import environment
from rosbeat.workspace import location

MODULE = Path(environment.__file__)
PREFIX = "/home/ada/course/.venv"
PROFILE = "FASTRTPS_DEFAULT_PROFILES_FILE"
FROM_PROFILE = "RMW_FASTRTPS_USE_QOS_FROM_XML"


@pytest.fixture(autouse=True)
def home(tmp_path_factory, monkeypatch):
    """A home in which nothing is set for colcon."""
    folder = tmp_path_factory.mktemp("home")
    monkeypatch.setenv("HOME", str(folder))
    return folder


@pytest.fixture
def robot(tmp_path):
    """A ROS of the user's own."""
    index = tmp_path / "share" / "ament_index" / "resource_index" / "packages"
    index.mkdir(parents=True)
    (index / "rclpy").touch()
    return str(tmp_path)


def test_an_environment_without_decisions_gets_every_default_once():
    environ = {"ROS_DOMAIN_ID": ""}
    assert environment.apply(environ, PREFIX) == environment.defaults(PREFIX)
    assert environ == environment.defaults(PREFIX)
    assert environment.apply(environ, PREFIX) == {}


def test_the_values():
    values = environment.defaults(PREFIX)
    assert values["AMENT_PREFIX_PATH"] == PREFIX
    assert values["RMW_IMPLEMENTATION"] == "rmw_fastrtps_cpp"
    assert values["ROS_AUTOMATIC_DISCOVERY_RANGE"] == "LOCALHOST"
    assert values["ROS_PYTHON_CHECK_FIELDS"] == "1"
    assert values["OPENBLAS_NUM_THREADS"] == "1"
    assert values["ROS_DISTRO"] == "jazzy"
    assert "leaseAnnouncement" in Path(values[PROFILE]).read_text()  # others are found quickly


@pytest.mark.parametrize("name", sorted({*environment.defaults(PREFIX)} - {environment.CHOSEN}))
def test_what_somebody_set_stays(name):
    environ = {name: "7"}
    set_now = environment.apply(environ, PREFIX)
    if name == "AMENT_PREFIX_PATH":
        assert environ[name] == os.pathsep.join(["7", PREFIX])
    else:
        assert environ[name] == "7"
        assert name not in set_now


def test_a_domain_that_the_course_chose_is_told_from_a_persons():
    environ = {"ROSBEAT_DOMAIN_ID": "7"}
    environment.apply(environ, PREFIX)
    assert environ["ROSBEAT_DOMAIN_ID"] == environ["ROS_DOMAIN_ID"]
    environ = {"ROS_DOMAIN_ID": "7"}
    environment.apply(environ, PREFIX)
    assert "ROSBEAT_DOMAIN_ID" not in environ


def test_a_ros_of_ones_own_keeps_its_middleware_and_distribution(robot):
    environ = {"AMENT_PREFIX_PATH": robot}
    assert environment.other_ros(environ, robot) == []
    assert environment.other_ros(environ, PREFIX) == [robot]
    environment.apply(environ, PREFIX)
    assert environ["AMENT_PREFIX_PATH"] == f"{robot}{os.pathsep}{PREFIX}"
    assert "RMW_IMPLEMENTATION" not in environ
    assert "ROS_DISTRO" not in environ
    assert environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] == "LOCALHOST"


def test_tests_get_what_sessions_need_and_keep_their_domain():
    """pytest loads the plugin wherever rosbeat is installed, also for tests without a session."""
    environ = {"ROS_PYTHON_CHECK_FIELDS": "0"}
    set_now = environment.apply_for_tests(environ)
    assert set(set_now) == {"AMENT_PREFIX_PATH", PROFILE, FROM_PROFILE}
    assert environ == {**set_now, "ROS_PYTHON_CHECK_FIELDS": "0"}


def test_a_plugin_of_pytest_changes_no_domain(tmp_path):
    (tmp_path / "test_it.py").write_text(
        "import os\n\ndef test_it():\n"
        "    assert 'ROS_DOMAIN_ID' not in os.environ\n"
        "    assert os.environ['ROS_PYTHON_CHECK_FIELDS'] == '1'\n",
        "utf-8",
    )
    # Without the hook of the course's `.venv`, which sets the rest.
    code = (
        "import os, sys; [os.environ.pop(name) for name in list(os.environ) if 'ROS' in name]; "
        "import pytest; sys.exit(pytest.main(['-q', '-p', 'no:cacheprovider']))"
    )
    run = [sys.executable, "-c", code]
    done = subprocess.run(run, cwd=tmp_path, capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stdout


@pytest.mark.parametrize(
    ("environ", "wanted"),
    [
        ({}, "1"),
        ({PROFILE: environment.discovery_profile()}, "1"),
        ({PROFILE: "/home/ada/fastdds.xml"}, None),
        ({"FASTDDS_DEFAULT_PROFILES_FILE": "/home/ada/fastdds.xml"}, None),
        ({FROM_PROFILE: "0"}, "0"),
    ],
)
def test_memory_is_taken_from_no_profile_but_the_courses(environ, wanted):
    environment.apply(environ, PREFIX)
    assert environ.get(FROM_PROFILE) == wanted
    assert (PROFILE in environ) is ("FASTDDS_DEFAULT_PROFILES_FILE" not in environ)


@pytest.mark.parametrize(
    ("version", "name", "profile"),
    [
        ("7.1.5", "jazzy", PROFILE),
        ("9.1.2", "kilted", "FASTDDS_DEFAULT_PROFILES_FILE"),
        # One that nobody has tried is not given a name.
        ("10.0.1", None, "FASTDDS_DEFAULT_PROFILES_FILE"),
    ],
)
@pytest.mark.parametrize("place", ["installed", "sourced"])
def test_a_distribution_gets_the_name_that_its_fast_dds_reads(
    tmp_path, version, name, profile, place
):
    manifest = tmp_path / "share" / "rclpy" / "package.xml"
    manifest.parent.mkdir(parents=True)
    manifest.write_text(f"<package>\n  <name>rclpy</name>\n  <version>{version}</version>\n")
    environ = {} if place == "installed" else {"AMENT_PREFIX_PATH": str(tmp_path)}
    environment.apply(environ, str(tmp_path) if place == "installed" else PREFIX)
    assert environ.get("ROS_DISTRO") == name
    assert [each for each in environment.PROFILE_VARIABLES if each in environ] == [profile]


def installed_in(folder):
    """The module as a wheel installs it, without a checkout around it."""
    alone = folder / "rosbeat" / "environment.py"
    alone.parent.mkdir(parents=True)
    shutil.copy(MODULE, alone)
    spec = importlib.util.spec_from_file_location("alone", alone)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_without_a_checkout_around_it_only_what_a_wheel_brings_is_named(tmp_path):
    module = installed_in(tmp_path / "site-packages")
    assert module.discovery_profile() == ""
    assert set(environment.defaults(PREFIX)) - set(module.defaults(PREFIX)) == {
        PROFILE,
        FROM_PROFILE,
        "COLCON_DEFAULTS_FILE",
        "ROS2_WORKSPACE",
    }
    profile = tmp_path / "site-packages" / "rosbeat" / "fastdds.xml"
    profile.touch()
    assert module.discovery_profile() == module.defaults(PREFIX)[PROFILE] == str(profile)
    assert module.defaults(PREFIX)[FROM_PROFILE] == "1"


@pytest.mark.parametrize(
    ("chosen", "parent"),
    [
        ("", MODULE.parents[2] / "my_course"),
        ("/data", Path("/data")),
        ("~/x", Path("~/x")),
    ],
)
def test_terminals_know_where_the_workspace_is(monkeypatch, chosen, parent):
    monkeypatch.setenv("ROSBEAT_WORKSPACE_IN", chosen)
    monkeypatch.delenv("ROSBEAT_STEADY_HOME", raising=False)
    expected = str(parent.expanduser() / "ROS2_and_RL_Tutorials")
    assert environment.defaults()["ROS2_WORKSPACE"] == expected == str(location.workspace())


@pytest.mark.parametrize(
    ("folder", "chosen"),
    [
        ("my_course", False),
        ("home/my_course", True),  # who shares the checkout
        ("notebooks", False),  # in a release
    ],
)
def test_the_workspace_has_one_place_before_the_learners_folder_is_made_and_after(
    tmp_path, monkeypatch, folder, chosen
):
    module = installed_in(tmp_path / "src")
    if folder != "my_course":
        (tmp_path / "my_course" / ".rosbeat").mkdir(parents=True)
    if chosen:
        monkeypatch.setenv("ROSBEAT_MY_COURSE", str(tmp_path / folder))
    if folder == "notebooks":
        (tmp_path / ".rosbeat-release.json").touch()
    (tmp_path / "notebooks").mkdir()
    place = f"{tmp_path / folder}/ROS2_and_RL_Tutorials"
    for made in (False, True):
        if made:
            (tmp_path / folder / ".rosbeat").mkdir(parents=True)
        assert module.learners_folder() == str(tmp_path / folder)
        assert module.defaults(PREFIX)["ROS2_WORKSPACE"] == place


@pytest.mark.parametrize("variable", [None, "COLCON_HOME"])
def test_what_colcon_is_told_at_home_stays(home, tmp_path, variable):
    own = tmp_path / "colcon" if variable else home / ".colcon"
    environ = {variable: str(own)} if variable else {}
    environment.apply(environ, PREFIX)
    assert Path(environ.pop("COLCON_DEFAULTS_FILE")).name == "colcon.yaml"
    own.mkdir()
    (own / "defaults.yaml").touch()
    environment.apply(environ, PREFIX)
    assert "COLCON_DEFAULTS_FILE" not in environ


def test_a_shell_gets_the_same_values(tmp_path):
    awkward = str(tmp_path / "it's here")
    done = subprocess.run(
        ["sh", "-c", f"{environment.shell_lines(awkward, {})}; env -0"],
        env={"PATH": os.defpath},
        capture_output=True,
        text=True,
        check=True,
    )
    found = dict(entry.split("=", 1) for entry in done.stdout.split("\0") if "=" in entry)
    assert environment.defaults(awkward).items() <= found.items()


def test_a_domain_is_stable_and_shared_ones_are_from_1_to_50():
    ids = {environment.usual_domain_id(f"/home/{n}/.venv", "1000") for n in range(2000)}
    assert ids == set(range(1, 51))
    assert len({environment.usual_domain_id(PREFIX, "1000") for _ in range(2)}) == 1


def test_a_domain_follows_the_real_place(tmp_path):
    (tmp_path / "real").mkdir()
    (tmp_path / "link").symlink_to(tmp_path / "real")
    assert environment.domain_id(str(tmp_path / "link")) == environment.domain_id(
        str(tmp_path / "real")
    )


def test_it_needs_nothing_of_rosbeat_and_nothing_slow():
    code = f"""
import sys
before = set(sys.modules)
import importlib.util, os
spec = importlib.util.spec_from_file_location("alone", {str(MODULE)!r})
loaded = set(sys.modules)
module = importlib.util.module_from_spec(spec)
spec.loader.exec_module(module)
module.apply()
print(sorted(set(sys.modules) - loaded))
"""
    done = subprocess.run(
        [sys.executable, "-I", "-S", "-c", code], capture_output=True, text=True, check=True
    )
    assert set(eval(done.stdout)) <= {"__future__", "binascii"}


@pytest.mark.parametrize(("prefix", "named"), [("/a b/.venv", True), ("/a/.venv", False)])
def test_a_python_without_a_space_for_what_colcon_writes_without_quotes(prefix, named):
    assert ("COLCON_PYTHON_EXECUTABLE" in environment.defaults(prefix)) is named
    assert " " not in environment.defaults(prefix).get("COLCON_PYTHON_EXECUTABLE", "")
