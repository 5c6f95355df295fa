"""`rosbeat new`, as it is typed where the wheel is installed: the wheel is built, and unpacked."""

import json
import os
import re
import subprocess
import sys
import zipfile
from copy import copy
from pathlib import Path

import pytest
from packaging.requirements import Requirement

from rosbeat.cli import main

ROOT = Path(__file__).resolve().parents[2]
PAGE = "03_write_a_publisher.ipynb"
AGAIN = "Your pages are those of the course.\n"


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    """The wheel of this checkout."""
    pytest.importorskip("hatchling")
    out = tmp_path_factory.mktemp("wheel")
    build = [sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", str(out)]
    subprocess.run(build, cwd=ROOT, check=True, capture_output=True)
    (found,) = out.glob("*.whl")
    return found


class Installed:
    """An environment with the wheel, and as much of ROS and the extra as `rosbeat new` looks at."""

    def __init__(self, folder, wheel):
        self.folder, self.prefix = folder, folder / "a venv"
        make = [sys.executable, "-m", "venv", "--without-pip", str(self.prefix)]
        subprocess.run(make, check=True)
        (self.packages,) = self.prefix.glob("lib/python*/site-packages")
        with zipfile.ZipFile(wheel) as archive:
            archive.extractall(self.packages)
        self.ros = self.prefix / "share" / "ament_index" / "resource_index" / "packages" / "rclpy"
        self.ros.parent.mkdir(parents=True)
        self.ros.touch()
        for name in ("jupyterlab", "matplotlib", "msgspec"):
            (self.packages / name).mkdir()
            (self.packages / name / "__init__.py").touch()

    def run(self, *arguments, cwd=None):
        kept = ("HOME", "LANG", "PATH")
        return subprocess.run(
            [str(self.prefix / "bin" / "python"), *arguments],
            cwd=cwd or self.folder,
            env={name: os.environ[name] for name in kept if name in os.environ},
            capture_output=True,
            text=True,
            check=False,
        )

    def new(self, *arguments):
        return self.run("-m", "rosbeat", "new", *map(str, arguments))

    def shipped(self, page):
        return self.packages / "rosbeat" / "course" / "notebooks" / page


@pytest.fixture(scope="module")
def shared(tmp_path_factory, wheel):
    return Installed(tmp_path_factory.mktemp("shared"), wheel)


@pytest.fixture
def installed(tmp_path, shared):
    """The environment that all share who do not change it, and a folder of the test's own."""
    found = copy(shared)
    found.folder = tmp_path
    return found


@pytest.fixture
def fresh(tmp_path, wheel):
    """An environment of the test's own."""
    return Installed(tmp_path, wheel)


def cells(path):
    return json.loads(path.read_bytes())["cells"]


def change(path, exercise, text):
    """Write an answer, or another version of a page."""
    page = json.loads(path.read_bytes())
    for cell in page["cells"]:
        if cell["metadata"].get("rosbeat", {}).get("exercise") == exercise:
            cell["source"] = text
    path.write_text(json.dumps(page))


def test_it_makes_the_folder_that_a_checkout_has(installed):
    done = installed.new("my course")
    own = installed.folder / "my course"
    assert done.stdout.splitlines() == [
        "Your own pages are in the folder my course.",
        "Open them:",
        f"    source '{installed.prefix}/bin/activate'",
        "    cd 'my course'",
        "    jupyter lab home.ipynb",
    ]
    pages = [path.name for path in sorted((ROOT / "notebooks").glob("*.ipynb"))]
    assert [path.name for path in sorted(own.glob("*.ipynb"))] == pages
    assert (own / "solutions" / "sensor_simulator" / "setup.py").exists()
    docs = [path.name for path in (ROOT / "docs").glob("*.md")]
    assert sorted(path.name for path in (own / "docs").glob("*.md")) == sorted(docs)


def test_every_program_there_knows_the_workspace(installed):
    installed.new("mine")
    code = "import os; print(os.environ['ROS2_WORKSPACE'], os.environ['AMENT_PREFIX_PATH'])"
    own = installed.folder / "mine"
    for folder in (own, own / "solutions"):
        said = installed.run("-c", code, cwd=folder).stdout
        assert said == f"{own}/ROS2_and_RL_Tutorials {installed.prefix}\n"


def test_what_is_run_in_a_solution_there_does_not_count(installed):
    installed.new("mine")
    code = (
        "from pathlib import Path\n"
        "from rosbeat.workspace.location import is_a_solution, workspace\n"
        f"pages = Path('solutions/{PAGE}'), Path({PAGE!r})\n"
        "print(workspace(), *map(is_a_solution, pages))"
    )
    own = installed.folder / "mine"
    said = installed.run("-c", code, cwd=own)
    assert said.stdout == f"{own}/ROS2_and_RL_Tutorials True False\n", said.stderr


def test_the_environment_becomes_an_underlay(installed):
    installed.new("mine")
    setup = f"source '{installed.prefix}/setup.bash' && echo $AMENT_PREFIX_PATH"
    done = subprocess.run(["bash", "-c", setup], capture_output=True, text=True, check=True, env={})
    assert done.stdout == f"{installed.prefix}\n"


def test_an_underlay_of_somebody_else_stays(fresh):
    (fresh.prefix / "local_setup.bash").write_text("# conda's\n")
    assert fresh.new("mine").returncode == 0
    assert (fresh.prefix / "local_setup.bash").read_text() == "# conda's\n"
    assert not (fresh.prefix / "setup.bash").exists()


def test_a_second_time_it_keeps_all_work(installed):
    own = installed.folder / "mine"
    installed.new(own)
    change(own / PAGE, "03a", "my answer")
    (own / "00_hear_the_heartbeat.ipynb").unlink()
    (own / "notes.txt").write_text("mine")
    before = (own / PAGE).read_bytes()
    assert installed.new(own).stdout.startswith(AGAIN)
    assert (own / PAGE).read_bytes() == before
    assert not (own / "00_hear_the_heartbeat.ipynb").exists()
    assert (own / "notes.txt").read_text() == "mine"


def test_new_versions_of_pages_come_with_a_new_version_of_the_package(fresh):
    own = fresh.folder / "mine"
    fresh.new(own)
    change(own / PAGE, "03a", "my answer")
    change(fresh.shipped(PAGE), "03b", "newer")
    change(fresh.shipped("04_write_a_subscriber.ipynb"), "04a", "newer")
    said = fresh.new(own).stdout
    assert "updated  04_write_a_subscriber.ipynb" in said
    assert f"rosbeat new {own} --update 03" in said
    answers = [one["source"] for one in cells(own / PAGE)]
    assert "my answer" in answers
    assert "newer" not in answers
    assert "your answers to 03a are in it" in fresh.new(own, "--update", "03").stdout
    answers = [one["source"] for one in cells(own / PAGE)]
    assert {"my answer", "newer"} <= {text for text in answers if isinstance(text, str)}


def full(folder):
    (folder / "full").mkdir()
    (folder / "full" / "thesis.txt").touch()
    return folder / "full"


def a_file(folder):
    (folder / "file").touch()
    return folder / "file"


def test_a_place_that_is_not_for_pages_is_refused_in_three_parts(fresh):
    no_folder = "is not a folder: it is a file, or a link that leads nowhere."
    for place, what in (
        (full(fresh.folder), "is not empty, and `rosbeat new` has not made it."),
        (a_file(fresh.folder), no_folder),
        (a_file(fresh.folder) / "below", "Nothing can be written in"),
        # Nobody can make a folder there, the root user included.
        (Path("/proc/my_course"), "Nothing can be written in"),
    ):
        done = fresh.new(place)
        assert done.returncode == 1
        assert what in done.stderr
        assert len(re.findall(r"^  What (it means|to try):", done.stderr, re.MULTILINE)) == 2
        assert not (place / "home.ipynb").exists()
    assert not (fresh.prefix / "setup.bash").exists()


def test_the_doctor_of_a_wheel_speaks_of_no_checkout(installed):
    installed.new("mine")
    done = installed.run("-m", "rosbeat", "doctor", cwd=installed.folder / "mine")
    assert (done.returncode, done.stderr) == (1, "")  # this one has no real ROS
    assert "course files" not in done.stdout
    assert re.search(
        rf"ok +your pages +1\d in {re.escape(str(installed.folder))}/mine", done.stdout
    )


def test_a_page_that_does_not_exist_is_named(installed):
    installed.new("mine")
    done = installed.new("mine", "--update", "33")
    assert done.returncode == 1
    assert "There is no page '33'." in done.stderr


def test_without_ros_it_says_what_to_install(fresh):
    fresh.ros.unlink()
    done = fresh.new("mine")
    assert done.returncode == 1
    assert 'pip install "rosbeat[course,ros]"' in done.stderr
    assert not (fresh.folder / "mine").exists()


def test_without_the_extra_it_says_what_to_install(fresh):
    (fresh.packages / "matplotlib" / "__init__.py").unlink()
    (fresh.packages / "matplotlib").rmdir()
    done = fresh.new("mine")
    assert done.returncode == 1
    assert "has no matplotlib" in done.stderr
    assert 'pip install "rosbeat[course]"' in done.stderr
    assert not (fresh.folder / "mine").exists()


def test_in_a_checkout_it_says_what_to_type(tmp_path, capsys):
    assert main(["new", str(tmp_path / "mine")]) == 1
    assert "./environment/course lab" in capsys.readouterr().err
    assert not (tmp_path / "mine").exists()


@pytest.mark.parametrize("name", ["ros2_command", "rosie"])
def test_the_extra_asks_for_the_packages_of_this_checkout(name):
    project = (ROOT / "src" / name / "pyproject.toml").read_text()
    (version,) = re.findall(r'^version = "(.+)"', project, re.MULTILINE)
    wanted = f'"(rosbeat-{name.replace("_", "-")}.*)"'
    (asked,) = re.findall(wanted, (ROOT / "pyproject.toml").read_text())
    assert version in Requirement(asked).specifier
