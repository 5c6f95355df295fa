"""`course add messages` and `remove messages`: what is installed, repaired, said and undone."""

import os
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path

import pytest

from course_tool import additions, cli, installing, messages, prepare
from course_tool.problems import Problem

ROOT = Path(__file__).resolve().parents[2]
VERSION = "{}.{}".format(*sys.version_info[:2])
TAG = "cp{}{}".format(*sys.version_info[:2])
HEADERS = f"/opt/python/{TAG}-{TAG}/include/python{VERSION}"
NUMPY = f"/opt/python/{TAG}-{TAG}/lib/python{VERSION}/site-packages/numpy/_core/include"


def programs(folder, *names):
    folder.mkdir(exist_ok=True)
    for name in names:
        (folder / name).touch(mode=0o755)
    return str(folder)


@pytest.fixture
def machine(made, tmp_path, monkeypatch):
    """A machine with CMake and a compiler, on which nothing is installed or built for real."""
    monkeypatch.setenv("PATH", programs(tmp_path / "bin", "gcc", "g++", "cmake", "make"))
    ran = []

    def install(command, environ, log, cwd=None):
        ran.append([str(part) for part in command])
        if "--install" in command:
            module = made.site_packages / "rosie_interfaces" / "srv.py"
            module.parent.mkdir()
            module.touch()
            Path(cwd, "install_manifest.txt").write_text(f"{module}\n")

    monkeypatch.setattr(installing, "fill", lambda layout, level, environ: None)
    monkeypatch.setattr(installing, "install", install)
    monkeypatch.setattr(installing, "for_installers", lambda layout, environ: environ)
    monkeypatch.setattr(prepare, "ask_ros", lambda *_: {"milliseconds": 1.0, "rclpy": "7"})
    monkeypatch.setattr(prepare, "check_space", lambda folder, needed, why="": None)
    monkeypatch.setattr(messages, "require_headers", lambda: None)
    monkeypatch.setattr(messages.running, "with_ros", lambda environ, layout: dict(environ))
    monkeypatch.setattr(prepare, "make", lambda layout, environ: None)
    for lock, pins in (
        ("messages", "lark==1\nros-a==1"),
        ("cmake", "cmake==3"),
        ("course", "b==1"),
    ):
        made.lock(lock).write_text(f"{pins}\n")
    made.lock("compiler").write_text("ziglang==1\nb==1\n")
    prepare.ready(made, "course")
    del ran[:]
    return ran


@pytest.mark.parametrize(
    ("names", "locks"),
    [
        (("gcc", "g++", "cmake", "make"), ["messages"]),
        (("clang", "clang++", "cmake", "ninja"), ["messages"]),
        (("gcc", "g++"), ["messages", "cmake"]),
        (("gcc", "g++", "cmake"), ["messages", "cmake"]),
        (("gcc", "cmake", "make"), ["messages", "compiler"]),
        ((), ["messages", "cmake", "compiler"]),
    ],
)
def test_what_the_machine_lacks_comes_in_wheels(layout, tmp_path, names, locks):
    path = programs(tmp_path / "bin", *names)
    own = programs(layout.venv, *()) and programs(layout.venv / "bin", "cmake", "cc", "c++", "make")
    assert messages.needed(layout, f"{own}{os.pathsep}{path}") == locks


def test_it_is_announced_installed_remembered_and_removed(made, machine, capsys):
    before = {path for path in made.venv.rglob("*") if path != made.stamp}
    assert additions.add(made, ["messages"]) == 0
    said = capsys.readouterr().out
    assert said.index("5 MB of disk") < said.index("installing what messages.lock lists")
    assert "CMake and the compiler are those of this machine" in said
    assert "ros2 pkg create --build-type ament_cmake" in said
    assert [str(made.lock("messages")) in command for command in machine] == [True, *[False] * 3]
    assert prepare.additions(made) == ["messages"]
    assert prepare.is_satisfied(made, "course")
    del machine[:]

    assert additions.add(made, ["messages"]) == 0
    assert machine == []
    assert "is here already" in capsys.readouterr().out

    assert additions.remove(made, ["messages"]) == 0
    assert machine[0][-4:] == ["cmake", "lark", "ros-a", "ziglang"]  # the course has b as well
    assert {path for path in made.venv.rglob("*") if path != made.stamp} == before
    assert prepare.additions(made) == []
    assert additions.remove(made, ["messages"]) == 0
    assert "nothing was removed" in capsys.readouterr().out


def test_a_new_version_of_the_environment_keeps_it(made, machine):
    additions.add(made, ["messages"])
    del machine[:]
    made.lock("course").write_text("b==2\n")
    prepare.ready(made, "test")
    assert str(made.lock("messages")) in machine[0]
    assert prepare.additions(made) == ["messages"]
    assert prepare.stamped_level(made) == "test"
    del machine[:]
    made.lock("messages").write_text("lark==2\n")
    assert not prepare.is_satisfied(made, "course")
    prepare.ready(made, "course")
    assert str(made.lock("messages")) in machine[0]


def test_a_refresh_that_cannot_add_it_again_opens_the_course_without_it(
    made, machine, monkeypatch, capsys
):
    def refuse():
        raise Problem("There is no Python.h.", "a", "b")

    additions.add(made, ["messages"])
    made.lock("course").write_text("b==2\n")
    monkeypatch.setattr(messages, "require_headers", refuse)
    prepare.ready(made, "course")
    assert prepare.is_satisfied(made, "course")
    assert prepare.additions(made) == []
    said = capsys.readouterr()
    assert "There is no Python.h." in said.err
    assert "To try again:\n  ./environment/course add messages" in said.out


def test_an_interrupted_addition_is_none(made, machine, monkeypatch):
    def stop(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr(messages, "repair", stop)
    with pytest.raises(KeyboardInterrupt):
        additions.add(made, ["messages"])
    assert prepare.additions(made) == []
    assert prepare.is_satisfied(made, "course")


@pytest.mark.parametrize("arguments", [[], ["message"], ["messages", "now"]])
@pytest.mark.parametrize("command", ["add", "remove"])
def test_a_name_that_is_none_changes_nothing(capsys, command, arguments):
    assert cli.main([command, *arguments]) == 1
    said = capsys.readouterr().err
    assert f"Type:  ./environment/course {command} messages" in said


def test_a_python_without_headers_is_said_before_anything_is_installed(monkeypatch, tmp_path):
    monkeypatch.setattr(sysconfig, "get_path", lambda name: str(tmp_path))
    with pytest.raises(Problem, match=r"there is no .*/Python\.h") as caught:
        messages.require_headers()
    assert f"sudo apt install python{VERSION}-dev" in caught.value.cure


def test_a_compiler_that_does_not_work_is_no_installer_that_stopped(made, machine, monkeypatch):
    def install(command, environ, log, cwd=None):
        if "--build" in command:
            raise Problem("The installer stopped.", "a", "b", "cc1: not found")

    monkeypatch.setattr(installing, "install", install)
    with pytest.raises(Problem, match="rosie_interfaces, a first package") as caught:
        additions.add(made, ["messages"])
    assert caught.value.details == "cc1: not found"
    assert prepare.additions(made) == []


# What is changed in the wheels.


def test_the_builders_folders_are_replaced_and_brought_back(made, tmp_path):
    cached = tmp_path / "cache.cmake"
    text = f'INCLUDE "{HEADERS};{NUMPY}"\nOTHER "/opt/python/other"\n'
    cached.write_text(text)
    file = made.venv / "share" / "std_msgs" / "cmake" / "export.cmake"
    file.parent.mkdir(parents=True)
    os.link(cached, file)  # as uv installs it
    messages.repair(made)
    ours = f"{sysconfig.get_path('include')};{made.site_packages}/numpy/_core/include"
    assert file.read_text() == f'INCLUDE "{ours}"\nOTHER "/opt/python/other"\n'
    assert cached.read_text() == text
    messages.repair(made, back=True)
    assert file.read_text() == text


def test_cmake_knows_the_environment_and_a_compiler_in_wheels(made, tmp_path):
    """The folder of the checkout has a space in its name."""
    cmake = made.site_packages / "cmake" / "data" / "bin" / "cmake"
    cmake.parent.mkdir(parents=True)
    cmake.write_text(
        '#!/bin/sh\necho "$CMAKE_PREFIX_PATH|$VIRTUAL_ENV|$CMAKE_GENERATOR|$*"\n"$CXX" a\n'
    )
    zig = made.site_packages / "ziglang" / "zig"
    zig.parent.mkdir()
    zig.write_text('#!/bin/sh\necho "zig $*"\n')
    for program in (cmake, zig):
        program.chmod(0o755)
    messages._write_tools(made, messages.LOCKS, "/nowhere")
    done = subprocess.run(
        [made.venv / "bin" / "cmake", "-S", "x y"],
        env={"PATH": os.defpath, "CMAKE_PREFIX_PATH": "/ws/install"},
        capture_output=True,
        text=True,
        check=True,
    )
    first = f"/ws/install:{made.venv}|{made.venv}|Ninja|-S x y\n"
    assert done.stdout == f"{first}zig c++ a\n"


@pytest.mark.parametrize("is_there", [True, False])
def test_without_the_addition_the_machines_cmake_is_used_or_the_way_to_one_named(
    made, tmp_path, is_there
):
    messages.write_missing(made)
    ours, theirs = made.venv / "bin", tmp_path / "their bin"
    theirs.mkdir()
    if is_there:
        (theirs / "cmake").write_text('#!/bin/sh\necho "theirs $*"\n')
        (theirs / "cmake").chmod(0o755)
    done = subprocess.run(
        ["cmake", "-S", "x y"],
        env={"PATH": f"{ours}{os.pathsep}{theirs}"},
        capture_output=True,
        text=True,
        check=False,
    )
    if is_there:
        assert (done.stdout, done.returncode) == ("theirs -S x y\n", 0)
    else:
        assert done.returncode == 127
        assert done.stderr.startswith("# There is no CMake here.")
        assert "./environment/course add messages" in done.stderr


# For real.

NEW_PACKAGE = r"""
mkdir -p ws/src && cd ws/src
ros2 pkg create --build-type ament_cmake --license Apache-2.0 tutorial_interfaces
cd tutorial_interfaces && mkdir msg srv
echo "int64 num" > msg/Num.msg
printf 'geometry_msgs/Point center\nfloat64 radius\n' > msg/Sphere.msg
printf 'int64 a\nint64 b\nint64 c\n---\nint64 sum\n' > srv/AddThreeInts.srv
sed -i 's#^if(BUILD_TESTING)#find_package(geometry_msgs REQUIRED)\n\
find_package(rosidl_default_generators REQUIRED)\n\
rosidl_generate_interfaces(${PROJECT_NAME} "msg/Num.msg" "msg/Sphere.msg" "srv/AddThreeInts.srv"\n\
  DEPENDENCIES geometry_msgs)\n&#' CMakeLists.txt
sed -i 's#  <export>#  <depend>geometry_msgs</depend>\n\
  <buildtool_depend>rosidl_default_generators</buildtool_depend>\n\
  <exec_depend>rosidl_default_runtime</exec_depend>\n\
  <member_of_group>rosidl_interface_packages</member_of_group>\n&#' package.xml
cd ../..
"""
USE = r"""
. install/setup.bash
ros2 interface show tutorial_interfaces/msg/Num
ros2 interface show rosie_interfaces/srv/AddTwoInts
ros2 topic echo --once /sphere tutorial_interfaces/msg/Sphere &
ros2 topic pub --once -w 1 /sphere tutorial_interfaces/msg/Sphere '{radius: 2.5}'
wait
python3 - <<'END'
import rclpy
from rclpy.node import Node
from rosie_interfaces.srv import AddTwoInts
from tutorial_interfaces.srv import AddThreeInts

rclpy.init()
node = Node("sums")
node.create_service(AddThreeInts, "three", lambda asked, answer: add(asked, answer))
client = node.create_client(AddThreeInts, "three")

def add(asked, answer):
    answer.sum = asked.a + asked.b + asked.c
    return answer

assert client.wait_for_service(20)
future = client.call_async(AddThreeInts.Request(a=1, b=2, c=3))
rclpy.spin_until_future_complete(node, future, timeout_sec=20)
print("sum", future.result().sum, AddTwoInts.Response(sum=4))
END
"""


@pytest.mark.thorough
@pytest.mark.timeout(1800)
def test_a_package_of_messages_as_in_the_official_tutorial(tmp_path):
    """In a checkout of its own, which is made, added to, used, and brought back."""
    checkout = tmp_path / "a course"
    left_out = shutil.ignore_patterns(".git", ".venv*", "my_course", "__pycache__", "dist")
    shutil.copytree(ROOT, checkout, ignore=left_out, symlinks=True)
    dropped = ("ROS", "RMW", "AMENT", "FASTDDS", "FASTRTPS", "VIRTUAL_ENV", "PYTEST", "COLCON")
    environ = {name: value for name, value in os.environ.items() if not name.startswith(dropped)}
    environ["PATH"] = os.pathsep.join(
        part for part in environ["PATH"].split(os.pathsep) if ".venv" not in part
    )

    def course(*arguments, fails=False):
        done = subprocess.run(
            [checkout / "environment" / "course", *arguments],
            env=environ,
            cwd=tmp_path,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            check=False,
        )
        if "The installer stopped" in done.stdout:
            pytest.skip("wheels cannot be had here")
        assert bool(done.returncode) is fails, done.stdout
        return done.stdout

    def installed():
        venv = checkout / ".venv"
        kept = (path for path in venv.rglob("*") if path.is_file() and path.suffix != ".pyc")
        others = (path for path in kept if path.name not in ("install.log", "rosbeat-stamp.json"))
        return {path: path.stat().st_size for path in others}

    assert "course add messages" in course(
        "shell", "-c", f"{NEW_PACKAGE} colcon build --event-handlers console_direct+", fails=True
    )
    before = installed()
    course("add", "messages")
    output = course("shell", "-c", f"cd ws && rm -r build && colcon build && {USE.strip()}")
    for line in ("Summary: 1 package finished", "int64 num", "radius: 2.5", "sum 6"):
        assert line in output
    course("remove", "messages")
    assert installed() == before
