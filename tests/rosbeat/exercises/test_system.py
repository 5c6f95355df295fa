"""The whole system: the tutorial's own listings for real, then what may be wrong, as plain data."""

import shutil
from dataclasses import replace
from pathlib import Path

import listings  # the folder is put on the path by conftest.py
import pytest

from rosbeat.diagnosis.mistakes import MISTAKES
from rosbeat.exercises.check import EXERCISES
from rosbeat.exercises.evidence import from_json, to_json
from rosbeat.exercises.outcome_display import Shown
from rosbeat.exercises.scenarios import CommandMeaning
from rosbeat.exercises.system import MONITOR, SENSOR, run_system

pytestmark = pytest.mark.ros

FINISHED = Path(__file__).parents[3] / "solutions" / "sensor_simulator"
SYSTEM = EXERCISES["system"]
CODE = f"src/sensor_simulator/sensor_simulator/{SENSOR}.py"


def workspace(place):
    shutil.copytree(FINISHED, place / "src" / "sensor_simulator")
    return place


@pytest.fixture(scope="module")
def seen(tmp_path_factory):
    """What becomes of the tutorial's package."""
    root = workspace(tmp_path_factory.mktemp("workspace"))
    package = root / "src" / "sensor_simulator"
    (package / "sensor_simulator" / f"{SENSOR}.py").write_text(listings.PUBLISHER)
    (package / "sensor_simulator" / f"{MONITOR}.py").write_text(listings.SUBSCRIBER)
    (package / "setup.py").write_text(listings.SETUP)
    before = sorted(root.rglob("*"))
    made = run_system(root)
    assert sorted(root.rglob("*")) == before
    return made


def test_the_listings_of_the_tutorial_pass_and_their_end_is_remarked_upon(seen):
    outcome = SYSTEM.judged(seen)
    assert outcome.status == "passed", (outcome, seen)
    assert "try_shutdown" in " ".join(outcome.remarks)
    # The same run, with clean ends.
    clean = {
        name: replace(getattr(seen, name), output="", exit_code=0) for name in ("sensor", "monitor")
    }
    outcome = SYSTEM.judged(replace(seen, **clean))
    assert (outcome.status, outcome.remarks) == ("passed", ())


def test_praise_names_what_was_built_and_counts_what_crossed(seen):
    arrived = len([one for one in seen.taken if "Status" in one.text])
    assert arrived >= len(seen.heard) - 1
    assert str(Shown(SYSTEM.judged(seen))).startswith(
        "\N{CHECK MARK} Exercise system: passed, 5 of 5 points. You have built a robot system, and "
        "it works: your node temperature_sensor published on /temperature, and your node "
        f"temperature_monitor, in another process, received {arrived} readings and judged each of "
        "them."
    )


def test_nodes_that_log_nothing_are_praised_by_the_names_of_their_programs(seen):
    praise = SYSTEM.judged(replace(seen, sent=(), taken=())).evidence
    assert f"your node {SENSOR} published" in praise
    assert f"your node {MONITOR}, in another process, received" in praise
    assert f"received {seen.repeated.count('Status')} readings" in praise


def test_the_evidence_survives_as_text(seen):
    again = from_json(to_json(seen))
    assert again == seen
    assert SYSTEM.judged(again) == SYSTEM.judged(seen)


def test_a_picture_shows_what_crossed_between_the_two_programs(seen):
    words = SYSTEM.picture(seen).description
    assert words.startswith("temperature_sensor sent ")
    assert "arrived at temperature_monitor" in words
    assert SYSTEM.picture(replace(seen, sent=())) is None


def told(seen, value, text):
    return tuple((one, text if one == value else said) for one, said in seen.answers)


def beats(seen, seconds):
    return tuple((n * seconds, value) for n, (_, value) in enumerate(seen.heard))


def numbers(*values):
    return tuple((float(n), value) for n, value in enumerate(values))


def on(seen, **changes):
    return tuple(replace(one, **changes) for one in seen.publishers)


def ended(run, **changes):
    return replace(run, ended_early=True, exit_code=1, **changes)


LINE = "[INFO] [monitor]: Temperature: {} - Status:{}\n"
TRACEBACK = f"""Traceback (most recent call last):
  File "/home/you/install/{CODE.removeprefix("src/")}", line 9, in main
    node = TemperatureSensor(nme)
NameError: name 'nme' is not defined
"""
WRONG = {
    "a limit above": (
        "boundary",
        lambda s: {"answers": told(s, 26.0, LINE.format("26.00C", "High"))},
    ),
    "a limit below": ("boundary", lambda s: {"answers": told(s, 20.0, LINE.format("20.0", "Low"))}),
    "upside down": ("wrong-state", lambda s: {"answers": told(s, 35.25, LINE.format(1, "Low"))}),
    "two states": ("wrong-state", lambda s: {"answers": told(s, 22.75, "High, low or Normal\n")}),
    "nothing logged": ("nothing-logged", lambda s: {"answers": told(s, 26.0, "")}),
    "no subscription": ("no-subscription", lambda s: {"met": False, "answers": ()}),
    "twice a second": ("wrong-rate", lambda s: {"heard": beats(s, 0.5)}),
    "every two seconds": ("wrong-rate", lambda s: {"heard": beats(s, 2.0)}),
    "jumping": ("step-too-wide", lambda _: {"heard": numbers(22.0, 24.0, 22.0)}),
    "starting elsewhere": ("step-too-wide", lambda _: {"heard": numbers(25.0, 25.1, 25.2)}),
    "hot": ("no-clamp", lambda _: {"heard": numbers(28.0, 28.3, 28.4)}),
    "constant": ("never-changes", lambda _: {"heard": numbers(22.0, 22.0, 22.0)}),
    "another topic": (
        "topic-misspelled",
        lambda s: {"heard": (), "publishers": on(s, name="/temprature")},
    ),
    "another type": (
        "type-mismatch",
        lambda s: {"heard": (), "publishers": on(s, type_name="std_msgs/msg/Float64")},
    ),
    "silent": ("never-published", lambda _: {"heard": ()}),
    "no publisher": ("no-publisher", lambda _: {"heard": (), "publishers": ()}),
    "another number": (
        "wrong-values",
        lambda s: {"repeated": s.repeated + LINE.format("3.14C", "Low")},
    ),
    "killed": ("ctrl-c-traceback", lambda s: {"monitor": replace(s.monitor, exit_code=None)}),
    "another traceback": (
        "ctrl-c-traceback",
        lambda s: {"sensor": replace(s.sensor, exit_code=1, output="KeyboardInterrupt")},
    ),
    "ended at once": ("new-to-me", lambda s: {"sensor": ended(s.sensor, output="bye")}),
    "ended at once, known": (
        "name-error",
        lambda s: {
            "sensor": ended(s.sensor),
            "meaning": CommandMeaning("name-error", "evidence", "hint"),
        },
    ),
    "ended at once, as only its output shows": (
        "name-error",
        lambda s: {"sensor": ended(s.sensor, output=TRACEBACK)},
    ),
    "ended at once, forged": (
        "new-to-me",
        lambda s: {
            "sensor": ended(s.sensor),
            "meaning": CommandMeaning("passed", "evidence", "hint"),
        },
    ),
    "not built": ("new-to-me", lambda _: {"build_code": 1, "build_output": "one\n\ntwo\n"}),
    "never built to the end": ("new-to-me", lambda _: {"build_code": None}),
    "in another folder": ("wrong-folder", lambda _: {"place": "the workspace itself"}),
    "for C++": (
        "build-type",
        lambda s: {
            "package": replace(
                s.package, manifest=replace(s.package.manifest, build_type="ament_cmake")
            )
        },
    ),
    "without __init__": (
        "marker-missing",
        lambda s: {"package": replace(s.package, has_init=False)},
    ),
    "without marker": (
        "marker-missing",
        lambda s: {"package": replace(s.package, has_marker=False)},
    ),
}


@pytest.mark.parametrize("case", WRONG)
def test_what_is_wrong_is_named(seen, case):
    mistake, changes = WRONG[case]
    outcome = SYSTEM.judged(replace(seen, **changes(seen)))
    assert (outcome.status, outcome.mistake) == ("failed", mistake), outcome
    assert mistake in MISTAKES or mistake == "new-to-me"
    assert outcome.evidence
    assert outcome.hint


@pytest.mark.parametrize("text", ["{} is {}", "Reading {:.1f} degrees ({})", "{1}: {0:.3f}"])
def test_other_words_for_the_same_are_fine(seen, text):
    answers = tuple((value, text.format(value, state(value))) for value, _ in seen.answers)
    repeated = "\n".join(text.format(value, state(value)) for _, value in seen.heard)
    assert SYSTEM.judged(replace(seen, answers=answers, repeated=repeated)).status == "passed"


def state(value):
    return "HIGH" if value > 26 else "low" if value < 20 else "Normal"


BROKEN = {
    "a comma is missing": ("setup.py", ":main',", ":main'", "comma-missing"),
    "a slash": ("setup.py", f"sensor_simulator.{SENSOR}:", f"sensor_simulator/{SENSOR}:",
                "slash-in-module"),
    "no such function": ("setup.py", f"{SENSOR}:main", f"{SENSOR}:mian", "entry-point-target"),
    "a syntax error": (f"sensor_simulator/{SENSOR}.py", "def main", "fed main", "syntax-error"),
    "one program": ("setup.py", f"'{SENSOR} =", "'sensor =", None),
}  # fmt: skip


@pytest.mark.parametrize("case", BROKEN)
def test_what_cannot_be_built_is_not_built(case, tmp_path):
    file, old, new, mistake = BROKEN[case]
    path = workspace(tmp_path) / "src" / "sensor_simulator" / file
    text = path.read_text().replace('"', "'") if file == "setup.py" else path.read_text()
    assert old in text
    path.write_text(text.replace(old, new, 1))
    found = run_system(tmp_path)
    outcome = SYSTEM.judged(found)
    assert found.build_code is None
    assert outcome.status == "failed"
    assert outcome.mistake == (mistake or outcome.mistake) != "new-to-me", outcome
