import ast
import os
import shutil
import subprocess
import sys
from xml.etree import ElementTree

import pytest

OUTPUT = """\
going to create a new package
package name: sensor_simulator
destination directory: {place}
package format: 3
version: 0.0.0
description: TODO: Package description
maintainer: ['ada <ada@example.com>']
licenses: ['TODO: License declaration']
build type: ament_python
dependencies: ['rclpy', 'std_msgs']
node_name: n1
library_name: l1
creating folder ./sensor_simulator
creating ./sensor_simulator/package.xml
creating source folder
creating folder ./sensor_simulator/sensor_simulator
creating ./sensor_simulator/setup.py
creating ./sensor_simulator/setup.cfg
creating folder ./sensor_simulator/resource
creating ./sensor_simulator/resource/sensor_simulator
creating ./sensor_simulator/sensor_simulator/__init__.py
creating folder ./sensor_simulator/test
creating ./sensor_simulator/test/test_copyright.py
creating ./sensor_simulator/test/test_flake8.py
creating ./sensor_simulator/test/test_pep257.py
creating ./sensor_simulator/sensor_simulator/n1.py
creating folder ./sensor_simulator/sensor_simulator/l1
creating ./sensor_simulator/sensor_simulator/l1/__init__.py

[WARNING]: Unknown license 'TODO: License declaration'.  This has been set in the package.xml, \
but no LICENSE file has been created.
It is recommended to use one of the ament license identifiers:
Apache-2.0
BSL-1.0
BSD-2.0
BSD-2-Clause
BSD-3-Clause
GPL-3.0-only
LGPL-3.0-only
MIT
MIT-0
"""
TREE = [
    "package.xml", "resource/sensor_simulator", "sensor_simulator/__init__.py",
    "sensor_simulator/l1/__init__.py", "sensor_simulator/n1.py", "setup.cfg", "setup.py",
    "test/test_copyright.py", "test/test_flake8.py", "test/test_pep257.py",
]  # fmt: skip
NAMES = ["alpha", "beta"]
CREATE = ("pkg", "create", "--build-type", "ament_python")
WHO = ("--maintainer-name", "ada", "--maintainer-email", "ada@example.com")


def test_create_prints_and_makes_what_the_original_does(ros2, tmp_path):
    words = (*CREATE, "sensor_simulator", "--dependencies", "rclpy", "std_msgs")
    done = ros2(*words, "--node-name", "n1", "--library-name", "l1", *WHO, cwd=tmp_path)
    assert done.stdout == OUTPUT.format(place=tmp_path)
    assert done.stderr == ""
    root = tmp_path / "sensor_simulator"
    files = sorted(path.relative_to(root).as_posix() for path in root.rglob("*") if path.is_file())
    assert files == TREE
    assert not any(os.access(path, os.X_OK) for path in root.rglob("*") if path.is_file())
    ran = subprocess.run(
        [sys.executable, root / TREE[4]], capture_output=True, text=True, check=True
    )
    assert ran.stdout == "Hi from sensor_simulator.\n"


def test_create_elsewhere_with_a_license(ros2, tmp_path):
    words = (*CREATE, "p", "--license", "MIT", "--destination-directory", "a/b", *WHO)
    out = ros2.out(*words, cwd=tmp_path)
    assert "creating folder a/b/p\n" in out
    assert "WARNING" not in out
    assert "LICENSE" not in out
    assert (tmp_path / "a/b/p/LICENSE").read_text().startswith("Permission is hereby granted")


def test_a_linter_that_is_missing_skips_its_test(ros2, tmp_path):
    """ament_copyright is on no registry, so the generated tests must do without it."""
    ros2(*CREATE, "p", "--node-name", "n1", cwd=tmp_path)
    ran = subprocess.run(
        [sys.executable, "-m", "pytest", "-rs", "-p", "no:cacheprovider", "test/test_copyright.py"],
        cwd=tmp_path / "p", env=ros2.environment | {"PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1"},
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert "could not import 'ament_copyright.main'" in ran.stdout, ran.stderr
    assert ran.returncode == 5, ran.stdout  # no test is left, and none has failed


def test_texts_are_escaped(ros2, tmp_path):
    strange = 'it\'s <b> & "c"'
    ros2(*CREATE, "p", "--description", strange, "--maintainer-name", strange,
         "--maintainer-email", "a@b.de", "--license", strange, cwd=tmp_path)  # fmt: skip
    root = ElementTree.parse(tmp_path / "p" / "package.xml").getroot()
    assert [root.findtext(tag) for tag in ("description", "maintainer", "license")] == [strange] * 3
    tree = ast.parse((tmp_path / "p" / "setup.py").read_text())
    texts = [node.value for node in ast.walk(tree) if isinstance(node, ast.Constant)]
    assert texts.count(strange) == 3


def test_the_default_address_of_a_name_with_spaces_can_be_built(ros2, tmp_path):
    out = ros2.out(*CREATE, "p", "--maintainer-name", "Ada L", cwd=tmp_path,
                   GIT_CONFIG_GLOBAL="/dev/null", GIT_CONFIG_SYSTEM="/dev/null")  # fmt: skip
    assert "maintainer: ['Ada L <Ada_L@todo.todo>']" in out


def test_a_second_time_is_refused(ros2, tmp_path):
    (tmp_path / "p").mkdir()
    assert ros2.error(*CREATE, "p", cwd=tmp_path) == (
        "\nAborted!\nThe directory already exists: ./p\nEither remove the directory or choose a "
        "different destination directory or package name\n"
    )


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("my-pkg",), "Try 'my_pkg'."),
        (("class",), "a keyword of the Python language"),
        (("_pkg",), "begins with a letter"),
        (("päckage",), "letters a to z"),
        (("random",), "standard library has a module 'random'"),
        (("rclpy",), "is already installed with ROS 2"),
        (("p", "--description", "a\x01b"), "--description contains characters"),
        (("p", "--maintainer-name", os.fsdecode(b"\xff")), "--maintainer-name contains characters"),
        (("test",), "can't be named 'test'"),
        (("p", "--node-name", "__init__"), "two underscores"),
        (("p", "--node-name", "talk.py"), "Try 'talk'."),
        (("p", "--library-name", "../x"), "cannot be the name of a library"),
        (("p", "--dependencies", "p"), "cannot depend on itself"),
        (("p", "--dependencies", "rclpy,"), "cannot be the name of a package"),
        (("p", "--destination-directory", "file"), "is a file"),
        (("p", "--destination-directory", "inner"), "is a package itself"),
        (("p", "--build-type", "cmake"), "left out here"),
    ],
)
def test_what_cannot_work_is_refused_before_anything_is_made(ros2, tmp_path, words, said):
    (tmp_path / "file").touch()
    (tmp_path / "inner").mkdir()
    (tmp_path / "inner" / "package.xml").touch()
    before = sorted(tmp_path.rglob("*"))
    done = ros2(*CREATE, *words, cwd=tmp_path, code=1)
    assert said in done.stderr
    assert done.stdout == ""
    assert sorted(tmp_path.rglob("*")) == before


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("p",), "p"),
        (
            ("p", "--license", "MIT", "--description", "a b", "--library-name=l"),
            "p --license MIT --description 'a b' --library-name=l",
        ),
        (
            ("p", "--build-type", "ament_cmake", "--maintainer-name", "ada", "--dependencies", "a"),
            "p --maintainer-name ada --dependencies a",
        ),
        (("--build=ament_cmake", "p"), "p"),
    ],
)
def test_another_build_type_says_what_to_type_with_all_that_was_given(ros2, tmp_path, words, said):
    done = ros2("pkg", "create", *words, cwd=tmp_path)
    assert "build type: ament_cmake\n" in done.stdout
    assert f" made with:  ros2 pkg create --build-type ament_python {said}\n" in done.stderr
    assert "no rclcpp" in done.stderr
    assert all(line.startswith("# ") for line in done.stderr.splitlines())


CPP_LOG = """\
build type: ament_cmake
dependencies: ['rclcpp']
node_name: n
library_name: my_lib
creating folder ./p
creating ./p/package.xml
creating source and include folder
creating folder ./p/src
creating folder ./p/include/p
creating ./p/CMakeLists.txt
creating ./p/src/n.cpp
creating ./p/include/p/my_lib.hpp
creating ./p/src/my_lib.cpp
creating ./p/include/p/visibility_control.h
"""


def commands(path):
    """What CMake does: the lines of a file without its comments."""
    lines = (line.split("#")[0].rstrip() for line in path.read_text().splitlines())
    return [line for line in lines if line]


def test_a_package_for_cpp(ros2, tmp_path):
    words = ("pkg", "create", "p", "--dependencies", "rclcpp")
    out = ros2.out(*words, "--node-name", "n", "--library-name", "my_lib", "--license", "MIT",
                   cwd=tmp_path)  # fmt: skip
    assert out.endswith(CPP_LOG)
    root = ElementTree.parse(tmp_path / "p" / "package.xml").getroot()
    tags = [(child.tag, child.text) for child in root if child.tag.endswith("depend")]
    assert tags == [
        ("buildtool_depend", "ament_cmake_ros"), ("depend", "rclcpp"),
        ("test_depend", "ament_lint_auto"), ("test_depend", "ament_lint_common"),
    ]  # fmt: skip
    assert root.findtext("export/build_type") == "ament_cmake"
    lines = commands(tmp_path / "p" / "CMakeLists.txt")
    assert lines[:2] == ["cmake_minimum_required(VERSION 3.8)", "project(p)"]
    for line in (
        *("find_package(ament_cmake REQUIRED)", "find_package(ament_cmake_ros REQUIRED)"),
        *("find_package(rclcpp REQUIRED)", "add_library(my_lib src/my_lib.cpp)"),
        *('target_compile_definitions(my_lib PRIVATE "P_BUILDING_LIBRARY")', '  "rclcpp"'),
        *("add_executable(n src/n.cpp)", "target_link_libraries(n my_lib)"),
        *("ament_export_libraries(", "  ament_lint_auto_find_test_dependencies()"),
    ):
        assert line in lines
    assert lines[-1] == "ament_package()"
    assert "class MyLib\n" in (tmp_path / "p" / "include" / "p" / "my_lib.hpp").read_text()
    assert "#ifndef P__MY_LIB_HPP_" in (tmp_path / "p" / "include" / "p" / "my_lib.hpp").read_text()


def test_a_package_for_messages_has_what_its_files_need(ros2, tmp_path):
    ros2("pkg", "create", "--build-type", "ament_cmake", "q", cwd=tmp_path)
    root = tmp_path / "q"
    made = sorted(str(path.relative_to(root)) for path in root.rglob("*"))
    assert made == ["CMakeLists.txt", "include", "include/q", "package.xml", "src"]
    assert "find_package(ament_cmake REQUIRED)" in commands(root / "CMakeLists.txt")
    tools = ElementTree.parse(root / "package.xml").getroot().findall("buildtool_depend")
    assert [one.text for one in tools] == ["ament_cmake"]


@pytest.mark.skipif(not shutil.which("cmake"), reason="needs cmake")
def test_cmake_can_read_what_is_made(ros2, tmp_path):
    """Up to the first package that is not there, which is the first that is looked for."""
    ros2("pkg", "create", "p", "--node-name", "n", "--library-name", "l", cwd=tmp_path)
    done = subprocess.run(
        ["cmake", "-S", "p", "-B", "b"], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert "Parse error" not in done.stderr


def test_equal_names_of_node_and_library(ros2, tmp_path):
    words = (*CREATE, "p", "--node-name", "same", "--library-name", "same")
    assert ros2(*words, cwd=tmp_path).stderr == (
        "[WARNING] node name can not be equal to the library name\n"
        "[WARNING] renaming node to same_node\n"
    )


def test_licenses_are_listed(ros2, tmp_path):
    out = ros2.out(*CREATE, "p", "--license", "?", cwd=tmp_path)
    assert out.splitlines()[:2] == ["Supported licenses:", "Apache-2.0"]
    assert not list(tmp_path.iterdir())


@pytest.fixture
def prefix(tmp_path):
    index = tmp_path / "share" / "ament_index" / "resource_index" / "packages"
    index.mkdir(parents=True)
    for name in ("beta", "alpha"):
        (index / name).touch()
        (tmp_path / "share" / name).mkdir()
    text = '<?xml version="1.0"?>\n<package format="3">\n  <name>alpha</name>\n</package>\n'
    (tmp_path / "share" / "alpha" / "package.xml").write_text(text)
    folder = tmp_path / "lib" / "alpha"
    folder.mkdir(parents=True)
    (folder / "talk").write_text("#!/bin/sh\n")
    (folder / "talk").chmod(0o755)
    (folder / "notes").touch()
    return tmp_path


def test_reading_the_index(ros2, prefix):
    place = {"AMENT_PREFIX_PATH": f"/nowhere:{prefix}"}
    # The wheels add their own prefix after those of the variable, so more than this is found.
    assert [one for one in ros2.out("pkg", "list", **place).split() if one in NAMES] == NAMES
    assert ros2.out("pkg", "prefix", "alpha", **place) == f"{prefix}\n"
    assert ros2.out("pkg", "prefix", "--share", "alpha", **place) == f"{prefix}/share/alpha\n"
    assert ros2.out("pkg", "executables", **place).startswith("alpha talk\n")
    full = ros2.out("pkg", "executables", "--full-path", "alpha", **place)
    assert full == f"{prefix}/lib/alpha/talk\n"
    assert ros2.out("pkg", "executables", "beta", **place) == ""
    xml = '<package format="3">\n  <name>alpha</name>\n</package>\n'
    assert ros2.out("pkg", "xml", "alpha", **place) == xml
    assert ros2.out("pkg", "xml", "-t", "name", "alpha", **place) == "alpha\n"


def test_what_is_not_in_the_index(ros2, prefix):
    place = {"AMENT_PREFIX_PATH": str(prefix)}
    said = ros2.error("pkg", "executables", "alhpa", **place)
    assert said == "Package 'alhpa' not found\n# Did you mean 'alpha'?\n"
    assert ros2.error("pkg", "prefix", "zzz", **place).startswith(
        "Package not found\n# If you have"
    )
    assert ros2.error("pkg", "xml", "-t", "nme", "alpha", **place) == (
        "XML tag not found\n# Did you mean 'name'?\n"
    )
    assert ros2.error("pkg", "xml", "zzz", **place).startswith("Package not found\n")
    assert ros2.error("pkg", "xml", "beta", **place).startswith("Package XML manifest not found\n")


def test_a_closed_pipe_is_silent(ros2):
    command = " ".join(ros2.words("pkg", "list"))
    done = subprocess.run(
        ["bash", "-c", f"set -o pipefail; {command} | true"], env=ros2.environment,
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert (done.returncode, done.stderr) == (0, "")
