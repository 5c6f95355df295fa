import pytest

from rosbeat.workspace.stages import NODES, PACKAGE

RUN = f"ros2 run {PACKAGE} temperature_publisher"
NOT_FOUND = f"""Package '{PACKAGE}' not found
If you have built it in a workspace: run `source install/setup.bash` there, in this terminal.
"""
NO_EXECUTABLE = "No executable found\n"
ENTRY = f"{PACKAGE}.temperature_publisher:main"


def traceback(last):
    return f"""Traceback (most recent call last):
  File "/home/you/install/{PACKAGE}/lib/{PACKAGE}/temperature_publisher", line 33, in <module>
    sys.exit(load_entry_point('sensor-simulator==0.0.0', 'console_scripts', 'x')())
{last}
[ros2run]: Process exited with failure 1
"""


@pytest.fixture
def edit(package):
    def edit(name, old, new):
        path = package / name
        assert old in path.read_text()
        path.write_text(path.read_text().replace(old, new))

    return edit


def test_a_good_run(meaning, installed):
    assert meaning(RUN, "[INFO] [temperature_sensor]: Publishing: 22.00C\n", 0) is None


def test_not_built(meaning, package):
    assert "has not been built yet" in meaning(RUN, NOT_FOUND)


def test_not_sourced(meaning, installed):
    said = meaning(RUN, NOT_FOUND)
    assert "source install/setup.bash" in said
    assert "Every new terminal" in said


def test_a_misspelt_package(meaning, installed):
    said = meaning("ros2 run sensor_simulatr x", "Package 'sensor_simulatr' not found\n")
    assert f"Did you mean {PACKAGE}?" in said


def test_a_package_that_is_no_business_of_the_workspace(meaning, installed):
    assert meaning("ros2 run turtlesim x", "Package 'turtlesim' not found\n") is None


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("temperature_publishr", "Did you mean temperature_publisher?"),
        ("temperature_publisher.py", "Did you mean temperature_publisher?"),
        ("temperature_sensor", "temperature_"),
        ("x", "It has: temperature_publisher, temperature_subscriber."),
    ],
)
def test_a_mistyped_executable(meaning, installed, name, text):
    assert text in meaning(f"ros2 run {PACKAGE} {name}", NO_EXECUTABLE)


def test_the_entry_point_is_forgotten(meaning, installed, edit):
    edit("setup.py", f"'temperature_publisher = {ENTRY}',", "")
    said = meaning(RUN, NO_EXECUTABLE)
    assert "setup.py has no entry point for it" in said
    # Page 05 asks for it: the way, and not the answer.
    assert ENTRY not in said


def test_the_entry_point_is_newer_than_the_build(meaning, installed):
    (installed / "lib" / PACKAGE / NODES[0]).unlink()
    assert "the build in install is older" in meaning(RUN, NO_EXECUTABLE)


def test_a_comma_is_missing_and_the_build_failed_before(meaning, installed, edit):
    edit("setup.py", f"{ENTRY}',", f"{ENTRY}'")
    assert "A comma is missing" in meaning(RUN, NO_EXECUTABLE)


@pytest.mark.parametrize(
    ("old", "new", "text"),
    [(f"{ENTRY}',", f"{ENTRY}'", "A comma is missing"), (f"{ENTRY}',", f"{ENTRY},", "cannot read")],
)
def test_the_build_before_runs(meaning, installed, edit, old, new, text):
    edit("setup.py", old, new)
    said = meaning(RUN, "[INFO] [temperature_sensor]: Publishing: 22.00C\n", 0)
    assert text in said
    assert "the build before" in said


def test_setup_cfg_is_gone(meaning, installed, package):
    (package / "setup.cfg").unlink()
    assert "setup.cfg" in meaning(RUN, NO_EXECUTABLE)


@pytest.mark.parametrize(
    ("new", "last", "text"),
    [
        (ENTRY.replace("publisher:", "publishr:"),
         f"ModuleNotFoundError: No module named '{PACKAGE}.temperature_publishr'",
         f"Did you mean {PACKAGE}.temperature_publisher?"),
        (ENTRY.replace(":", ".py:"),
         f"ModuleNotFoundError: No module named '{PACKAGE}.temperature_publisher.py'; "
         f"'{PACKAGE}.temperature_publisher' is not a package", "no `.py`"),
        (ENTRY + "e", f"AttributeError: module '{PACKAGE}.temperature_publisher' has no attribute "
         "'maine'. Did you mean: 'main'?", "Did you mean main?"),
        (ENTRY.removesuffix(":main"), "TypeError: 'module' object is not callable", ":main"),
        ("temperature_publisher:main", "ModuleNotFoundError: No module named "
         "'temperature_publisher'", f"Did you mean {PACKAGE}.temperature_publisher?"),
    ],
)  # fmt: skip
def test_an_entry_point_that_leads_nowhere(meaning, installed, edit, new, last, text):
    edit("setup.py", ENTRY, new)
    assert text in meaning(RUN, traceback(last))


def test_init_is_gone(meaning, installed, package):
    (package / PACKAGE / "__init__.py").unlink()
    output = traceback(f"ModuleNotFoundError: No module named '{PACKAGE}'")
    assert "__init__.py" in meaning(RUN, output)


def test_a_syntax_error(meaning, installed, package):
    (package / PACKAGE / f"{NODES[0]}.py").write_text("x = 1\ndef f(:\n")
    said = meaning(RUN, traceback("SyntaxError: invalid syntax"))
    assert "line 2" in said


def test_mended_and_not_rebuilt(meaning, installed, edit):
    edit(f"{PACKAGE}/{NODES[0]}.py", "22.0", "21.0")
    said = meaning(RUN, traceback("SyntaxError: invalid syntax"))
    assert "edited since the last build" in said


def test_edited_and_not_rebuilt(meaning, installed, edit):
    edit(f"{PACKAGE}/{NODES[0]}.py", "22.0", "21.0")
    output = "[INFO] [temperature_sensor]: Publishing: 22.00C\n"
    assert "the copy in install" in meaning(RUN, output, 0)
    assert meaning(f"colcon build && {RUN}", output, 0) is None
    assert meaning(f"ros2 run {PACKAGE} temperature_subscriber", "[INFO] ...", 0) is None
    (installed / "lib/python3.11/site-packages/sensor-simulator.egg-link").touch()
    assert meaning(RUN, output, 0) is None


def test_a_package_that_became_a_link_after_this_terminal_was_told(meaning, installed):
    last = "importlib.metadata.PackageNotFoundError: No package metadata was found for "
    output = traceback(f"{last}sensor-simulator")
    assert meaning(RUN, output) is None
    (installed / "lib/python3.11/site-packages/sensor-simulator.egg-link").touch()
    assert "a link now" in meaning(RUN, output)
    assert meaning(RUN, traceback(f"{last}another")) is None


def test_what_ros2_asks_itself_is_not_asked_again(meaning, installed):
    output = f"{NO_EXECUTABLE}Did you mean 'temperature_publisher'?\n"
    assert meaning(f"ros2 run {PACKAGE} temperature_publishr", output) is None
    output = f"{NO_EXECUTABLE}Package '{PACKAGE}' has: temperature_publisher\n"
    assert meaning(f"ros2 run {PACKAGE} x", output) is None
    output = f"Package 'sensor_simulatr' not found\nDid you mean '{PACKAGE}'?\n"
    assert meaning("ros2 run sensor_simulatr x", output) is None


def test_an_output_that_is_only_read(meaning, installed):
    assert meaning("cat log.txt", NOT_FOUND, 0) is None


def test_entry_points_that_cannot_be_seen(meaning, installed, package, edit):
    edit("setup.py", "'console_scripts': [", "'console_scripts': [*more(),")
    assert meaning(f"ros2 run {PACKAGE} x", NO_EXECUTABLE) is None
