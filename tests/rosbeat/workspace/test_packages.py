"""What is read from the files of a package, and what is wrong with its entry points."""

import shutil

import pytest

from bank.reading import answers
from rosbeat.diagnosis.packages import Manifest, SetupScript
from rosbeat.diagnosis.topic_snapshot import StaleBuild
from rosbeat.workspace.packages import find_packages, parse_manifest, read_package, stale_builds
from rosbeat.workspace.prerequisites import NODES, PACKAGE, finished

NAME = f"{PACKAGE}.{NODES[0]}"
PUBLISHER = f"{PACKAGE}/{NODES[0]}.py"
HEAD = "from setuptools import setup\npackage_name = 'p'\nsetup(name=package_name, entry_points={\n"
BOMB = b"""<?xml version="1.0"?>
<!DOCTYPE a [<!ENTITY x "ha"><!ENTITY y "&x;&x;&x;&x;">]>
<package format="3"><name>&y;</name></package>"""


@pytest.fixture
def setup_of(root, package):
    """Write the setup.py of the package, and return what is read."""

    def setup_of(text):
        data = text if isinstance(text, bytes) else text.encode()
        (package / "setup.py").write_bytes(data)
        return read_package(package, root).setup

    return setup_of


def scripts(*lines):
    return HEAD + "'console_scripts': [\n" + "\n".join(lines) + "\n]})\n"


def edit(package, text="# more\n"):
    path = package / PUBLISHER
    path.write_text(path.read_text() + text)


def test_the_finished_one(root, package):
    found = read_package(package, root)
    assert found.name == PACKAGE
    assert found.scripts_are_found
    assert found.has_marker
    assert found.has_init
    assert found.modules == NODES
    assert found.flaws == ()
    assert found.installed is None
    assert found.module_with_syntax_error() is None
    assert found.setup.package_name == PACKAGE
    assert [one.executable for one in found.setup.entry_points] == list(NODES)
    first = found.setup.entry_points[0]
    assert (first.module, first.function) == (NAME, "main")
    assert first.text in finished("setup.py")


def test_what_is_missing_or_broken(root, package):
    (package / "setup.cfg").write_text("[install\nnonsense")
    (package / "resource" / PACKAGE).unlink()
    (package / PACKAGE / "__init__.py").unlink()
    (package / PACKAGE / "broken.py").write_text("def f(:\n")
    (package / "test").mkdir()
    (package / "test" / "test_a.py").touch()
    found = read_package(package, root)
    assert [found.has_marker, found.has_init, found.scripts_are_found] == [False] * 3
    assert found.module_with_syntax_error() == ("broken", "line 1 (`def f(:`)")
    assert found.tests == ("test_a.py",)


def test_packages_are_found_where_colcon_finds_them(root, package):
    shutil.copytree(package, root / "docs" / "copy")
    shutil.copytree(package, root / "kept" / "copy")
    (root / "kept" / "COLCON_IGNORE").touch()
    shutil.copytree(package, root / ".hidden" / "copy")
    shutil.copytree(package, package / "inner")
    assert find_packages(root) == [root / "docs" / "copy", package]


# The manifest.


def test_what_a_manifest_says(root, package):
    manifest = read_package(package, root).manifest
    assert (manifest.name, manifest.version) == (PACKAGE, "0.0.0")
    assert manifest.build_type == "ament_python"
    assert {"rclpy", "std_msgs"} <= set(manifest.depends)
    assert manifest.description
    assert manifest.license
    assert "@" in manifest.email
    assert parse_manifest(b"<package><name> a </name></package>") == Manifest("a", tags=("name",))


@pytest.mark.parametrize(
    "data",
    [BOMB, BOMB.decode().encode("utf-16"), b"", b"<package>", b"\xff\xfe\x00", b"x" * 1_000_001,
     b'<?xml version="1.0" encoding="no-such"?><a/>'],
)  # fmt: skip
def test_a_bad_manifest_has_a_problem_and_nothing_else(data):
    manifest = parse_manifest(data)
    assert manifest.problem
    assert manifest == Manifest(problem=manifest.problem)


# The build script.


def imported(call):
    return f"from setuptools import setup\nsetup({call})\n"


def parts(setup):
    return [(one.executable, one.module, one.function, one.joined) for one in setup.entry_points]


def texts(setup):
    return [one.text for one in setup.entry_points]


TWICE = HEAD.replace("setup(name", "if True:\n    package_name = 'q'\nsetup(name")


@pytest.mark.parametrize(
    ("text", "read", "expected"),
    [
        # Adjacent strings: two entries without a comma, one text in two parts, and two `=`.
        (scripts("'a = p.a:main'", "'b = p.b:main',"),
         lambda setup: [one.joined for one in setup.entry_points], [True]),
        (scripts("'a = '", "'p.a:main',"), parts, [("a", "p.a", "main", False)]),
        (scripts("'a = b = c:d'"), lambda setup: setup.entry_points[0].joined, False),
        # A part is absent.
        (scripts("'a = p.a',", "'b',"), parts,
         [("a", "p.a", "", False), ("b", "", "", False)]),
        # What cannot be found out is not guessed, and what stands beside it is read.
        *((imported(f"name='p', entry_points={given}"),
           lambda setup: (setup.entry_points, setup.incomplete, setup.problem), ((), True, ""))
          for given in ("{'console_scripts': names()}", "{}, **more", "['a = b:c']")),
        # Data files are missing only if all of them are known.
        *((imported(f"name='p', data_files={files}"), lambda setup: setup.left_out, missing)
          for files, missing in (("[]", ("resource/p", "package.xml")), ("unknown()", ()),
                                 ("[('a', 'b', 'c')]", ()))),
        # Literals are read without running anything; a name that is assigned twice is none.
        ("raise SystemExit(3)\n" + scripts("'a = p.a:main'"),
         lambda setup: (texts(setup), setup.incomplete), (["a = p.a:main"], False)),
        (TWICE + "'console_scripts': []})\n", lambda setup: setup.package_name, "q"),
        # Entries in the wrong group.
        *((f"setup({given})", lambda setup: setup.misspelled_group, found) for given, found in (
            ("entry_point={}", "entry_point"),
            ("entry_points={'console_script': []}", "console_script"),
            ("entry_points={'console_scripts': []}", ""),
            ("entry_points={'gui_scripts': ['a = p.a:main']}", ""),
            ("entry_points={'pytest11': []}", ""), ("name='p'", ""))),
        # Whether the code is installed.
        *((f"from setuptools import *\nsetup({given})\n",
           lambda setup: setup.installs(PACKAGE), found) for given, found in (
            ("packages=find_packages()", True),
            ("packages=find_packages(exclude=['test'])", True),
            ("packages=find_packages('.', exclude=['sensor*'])", False),
            ("packages=find_packages(include=['sensor_simulator', 'q.*'])", True),
            ("packages=find_packages(include=['q'])", False),
            ("packages=find_packages(exclude=unknown())", True),
            ("packages=['sensor_simulator']", True), ("packages=['q']", False),
            ("packages=[]", False), ("packages=5", True), ("packages=[unknown()]", True),
            ("", False), ("**unknown()", True))),
    ],
)  # fmt: skip
def test_what_is_read_of_a_script(setup_of, package, text, read, expected):
    (package / "test").mkdir()
    assert read(setup_of(text)) == expected


@pytest.mark.parametrize("text", [HEAD, "x = 'a\n", "x = 1\n", "", "\0", "(" * 500, b"\xff"])
def test_a_bad_script_has_a_problem_and_nothing_else(setup_of, text):
    setup = setup_of(text)
    assert setup.problem
    assert "detected" not in setup.problem
    assert setup == SetupScript(problem=setup.problem, place=setup.place)


@pytest.mark.parametrize(
    "answer",
    [
        one
        for one in answers()
        if (one.exercise, one.status) == ("05a", "passed") and not one.before
    ],
    ids=lambda one: one.name,
)
def test_what_is_calculated_is_found_by_running_it(setup_of, answer):
    setup = setup_of(answer.text)
    assert not setup.incomplete
    assert set(NODES) <= {one.executable for one in setup.entry_points}


def test_a_script_that_does_not_end_is_given_up(setup_of, monkeypatch):
    monkeypatch.setattr("rosbeat.workspace.packages._DEADLINE", 0.3)
    setup = setup_of("while True: pass\n" + HEAD + "'console_scripts': [f'a = {package_name}']})\n")
    assert (setup.package_name, setup.incomplete) == ("p", True)


def test_what_a_script_prints_and_where_it_runs(setup_of, capfd):
    text = "import os, sys\nprint('{', __file__, sys.argv)\nassert os.path.exists('package.xml')\n"
    assert not setup_of(text + scripts("'a = ' + 'p.a:main'[:],")).incomplete
    assert capfd.readouterr() == ("", "")


def test_entry_points_in_setup_cfg(root, package, setup_of):
    path = package / "setup.cfg"
    path.write_text(path.read_text() + "[options.entry_points]\nconsole_scripts =\n  a = b:c\n")
    # setuptools reads them only if setup.py has none of its own.
    assert "a" not in [one.executable for one in read_package(package, root).setup.entry_points]
    setup_of("from setuptools import setup\nsetup(packages=['sensor_simulator'])\n")
    found = read_package(package, root)
    assert [(one.text, one.file) for one in found.setup.entry_points] == [("a = b:c", "setup.cfg")]
    assert [flaw.kind for flaw in found.flaws] == ["no-module"]
    assert found.setup.groups == ("console_scripts",)
    assert found.scripts_are_found


# What is wrong with an entry point.


@pytest.mark.parametrize(
    ("entry", "kind", "right"),
    [
        (f"sensor = {NAME}:main", None, ""),
        (f"sensor = {NAME}:TemperatureSensor", None, ""),
        (f"sensor = {NAME}:main [a==1]", None, ""),
        (f"sensor = {NAME}:maine", "no-function", "main"),
        (f"sensor = {NAME}", "no-function-part", "main"),
        (f"sensor = {NAME}.py:main", "suffix", NAME),
        (f"sensor = {NAME}:main()", "called", "main"),
        (f"sensor = {NAME.replace('.', '/')}:main", "slash", NAME),
        (f"sensor = {PACKAGE}.temprature_publisher:main", "no-module", NAME),
        ("sensor = temperature_publisher:main", "no-module", NAME),
        ("sensor = nothing.like_it:main", "no-module", ""),
        (f"my sensor = {NAME}:main", "form", ""),
        ("sensor", "form", ""),
        (f"sensor == {NAME}:main", "form", ""),
    ],
)
def test_each_flaw_is_named(root, package, setup_of, entry, kind, right):
    setup_of(scripts(f"'{entry}',"))
    flaws = read_package(package, root).flaws
    assert [(one.kind, one.right) for one in flaws] == ([(kind, right)] if kind else [])


@pytest.mark.parametrize(
    ("text", "kind", "place"),
    [
        ("x = 1\ndef f(:\n    pass\n", "syntax-error", "line 2 (`def f(:`)"),
        ("return 3", "syntax-error", "line 1"),
        ("x = '\\d'\nmain = lambda: 0", None, ""),
        ("from a import b as main", None, ""),
        ("if True:\n    def main(): pass", None, ""),
        ("from a import *", None, ""),
        ("", "no-function", ""),
    ],
)
def test_the_module_of_an_entry_point(root, package, text, kind, place):
    (package / PUBLISHER).write_text(text)
    flaws = read_package(package, root).flaws
    assert [(one.kind, one.place) for one in flaws] == ([(kind, place)] if kind else [])


# The build.


def test_built_and_not_edited(root, package, installed):
    found = read_package(package, root).installed
    assert found.prefix == installed
    assert found.executables == NODES
    assert not found.linked
    assert found.changed == ()
    assert stale_builds("/temperature", root) == ()


def test_edited_since(root, package, installed):
    edit(package)
    (package / PACKAGE / "other.py").write_text("x = 1\n")
    assert read_package(package, root).installed.changed == (f"{PACKAGE}/other.py", PUBLISHER)
    assert stale_builds("/temperature", root) == (StaleBuild(PACKAGE, NODES[0], PUBLISHER),)
    assert stale_builds("/humidity", root) == ()


def test_built_with_links(root, package, installed):
    (installed / "lib/python3.11/site-packages/sensor-simulator.egg-link").write_text("")
    edit(package)
    found = read_package(package, root).installed
    assert found.linked
    assert found.changed == ()
    hooks = installed / "share" / PACKAGE / "package.dsv"
    for line, unfinished in (("hook/pythonpath.dsv", True), ("hook/pythonpath_develop.dsv", False)):
        hooks.write_text(f"source;{line}\n")
        assert read_package(package, root).installed.unfinished is unfinished


def test_the_workspace_that_the_terminal_knows(root, package, monkeypatch, tmp_path):
    monkeypatch.setenv("ROS2_WORKSPACE", str(root))
    assert [(one.executable, one.built) for one in stale_builds("/temperature")] == [
        (node, False) for node in NODES
    ]
    monkeypatch.setenv("ROS2_WORKSPACE", str(tmp_path / "none"))
    assert stale_builds("/temperature") == ()
    monkeypatch.delenv("ROS2_WORKSPACE")
    assert len(stale_builds("/temperature")) == 2


@pytest.mark.parametrize("text", ["def (\n", "\0", None])
def test_a_module_that_cannot_be_read_says_nothing(root, package, installed, text):
    edit(package, text or "")
    (package / PUBLISHER).unlink() if text is None else None
    assert stale_builds("/temperature", root) == ()
