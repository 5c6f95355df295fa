"""Whether anything was tried: judges say so of what was typed, and of nothing the page types."""

from unittest.mock import patch

import pytest

from bank.pages import lesson
from bank.workspaces import BUILT, Desk, Terminal, typed
from rosbeat.exercises import page_01, page_02, page_06, scenarios
from rosbeat.exercises.registry import EXERCISES

FOLDER = "ROS2_and_RL_Tutorials"
FIRST_BUILD = "colcon build --packages-select sensor_simulator"


def lines_of(page):
    """Return what the page's own cells type, besides those of exercises."""
    cells = [one for one in lesson(page).cells if not one.exercise]
    return [
        line
        for cell in cells
        if cell.magic.startswith("%%terminal")
        for line in cell.source.split("\n")
    ]


@pytest.mark.parametrize(
    ("page", "is_try", "tries"),
    [
        ("01", page_01._is_try, []),
        ("02", page_02._is_try, []),
        ("06", page_06._changes, []),
        ("06", page_06._builds, [FIRST_BUILD]),
    ],
)
def test_what_a_page_types_is_no_try(page, is_try, tries):
    lines = lines_of(page)
    assert len(lines) > 10
    assert [line for line in lines if is_try(line)] == tries


def judged(exercise, root, *lines):
    """Return the outcome after lines were shown in a terminal; none of them is run."""
    shown = "".join(f"~/{FOLDER}$ {line}\n" for line in lines)
    with patch.object(scenarios, "page_terminals", lambda: [Terminal(root, shown)]):
        return EXERCISES[exercise].judged(EXERCISES[exercise].observed(root))


@pytest.fixture
def root(tmp_path, monkeypatch):
    """Return a workspace with the package of page 05, built as page 06 does."""
    monkeypatch.setenv("ROSBEAT_STEADY_HOME", str(tmp_path))
    Desk(tmp_path / FOLDER).furnish(with_package=True)
    typed(BUILT, tmp_path / FOLDER)
    return tmp_path / FOLDER


@pytest.mark.parametrize(
    ("exercise", "line", "mistake", "words"),
    [
        ("01a", "mkdir -p resources/bells", "new-to-me", "You typed `mkdir -p resources/bells`"),
        ("01a", "mkdir src docs scripts", "", "no folder"),
        ("01a", "mkdir -p /resources/sounds/alarm", "tilde-missing", "isn't in your workspace"),
        ("01a", "mkdir -p ../sounds/alarm", "wrong-folder", "The workspace has no resources/s"),
        ("02b", "ros2 pkg create --build-type ament_python display", "new-to-me", "You typed"),
        ("02b", "ros2 pkg create --build-type ament_python sensor_simulator", "", "no package"),
        (
            "06a",
            "sed 's/Node Started/Version 2/' temperature_subscriber.py",
            "only-printed",
            "says",
        ),
        ("06a", "sed -i 's/Node Started/Version 2/' a.py", "other-file", "You typed"),
        (
            "06a",
            "sed -i 's/Nod/Version 2/' temperature_subscriber.py",
            "nothing-replaced",
            "You ty",
        ),
        ("06a", "nano temperature_subscriber.py", "new-to-me", "You typed `nano"),
        ("06a", "diff temperature_subscriber.py a.py", "", "still says"),
        ("06b", "colcon build", "not-linked", "You typed `colcon build`. sensor_simulator is"),
        ("06b", FIRST_BUILD, "not-linked", "as a copy so far"),
        ("06b", "colcon build --help | grep symlink", "", "as a copy so far"),
    ],
)
def test_nothing_was_tried_only_where_nothing_was(root, exercise, line, mistake, words):
    page = {"06b": [FIRST_BUILD], "06a": [FIRST_BUILD, "ros2 node list"]}.get(exercise, ["ls"])
    assert judged(exercise, root, *page).status == "not attempted"
    outcome = judged(exercise, root, *page, line)
    assert (outcome.status, outcome.mistake) == ("failed" if mistake else "not attempted", mistake)
    assert words in outcome.evidence


def test_a_build_that_left_nothing_was_tried(root):
    typed("rm -r install", root)
    assert judged("06b", root, FIRST_BUILD).status == "not attempted"
    outcome = judged("06b", root, FIRST_BUILD, "colcon build --packages-select sensor_simulater")
    assert outcome.status == "failed"
    assert "is not built yet" in outcome.evidence


def test_a_package_that_lies_elsewhere_was_created(root):
    typed("mv src/sensor_simulator docs/", root)
    outcome = EXERCISES["02a"].judged(EXERCISES["02a"].observed(root))
    assert outcome.mistake == "wrong-folder"
    assert "sensor_simulator lies in docs" in outcome.evidence


@pytest.mark.parametrize("exercise", ["02a", "05a", "06b"])
def test_a_package_xml_in_src_is_named_and_how_to_remove_it(root, exercise):
    typed("cp src/sensor_simulator/package.xml src/package.xml", root)
    if exercise == "02a":  # the blanks were filled in there, and not in the package
        typed("sed -i 's/<license>.*</<license>TODO</' src/sensor_simulator/package.xml", root)
    lines = [FIRST_BUILD, "colcon build --symlink-install"] if exercise == "06b" else ["ls"]
    outcome = judged(exercise, root, *lines)
    said = " ".join([outcome.evidence, outcome.hint, *outcome.remarks])
    assert "There is a package.xml in src, so colcon takes src for one package" in said
    assert '`rm "$ROS2_WORKSPACE"/src/package.xml`' in said
    assert outcome.status == ("passed" if exercise == "05a" else "failed")


@pytest.mark.parametrize(
    ("address", "words"),
    [
        ("jörg@example.com", "'jörg@example.com': it may not contain ö"),
        ("me", "colcon doesn't accept the maintainer's address, 'me'."),
        ("", "The maintainer in the manifest has no address."),
    ],
)
def test_an_address_that_is_refused_is_named(root, address, words):
    file = root / "src/sensor_simulator/package.xml"
    file.write_text(file.read_text("utf-8").replace("you@example.com", address), "utf-8")
    assert words in EXERCISES["02a"].judged(EXERCISES["02a"].observed(root)).evidence
