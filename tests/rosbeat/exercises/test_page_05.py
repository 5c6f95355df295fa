"""Page 05: entry points in a setup.py that nobody runs, and functions that write them."""

import re
from pathlib import Path

import pytest

from rosbeat.diagnosis.mistakes import MISTAKES
from rosbeat.exercises import entries as entries_module
from rosbeat.exercises.exercise import FAILED, NOT_ATTEMPTED, PASSED
from rosbeat.exercises.page_05 import EXERCISES
from rosbeat.workspace import targets
from rosbeat.workspace.meanings.flaws import MISTAKE_OF

setup_05a, function_05b = EXERCISES
PUBLISHER = "'temperature_publisher = sensor_simulator.temperature_publisher:main',"
SUBSCRIBER = "'temperature_subscriber = sensor_simulator.temperature_subscriber:main',"
SETUP = """from setuptools import setup
package_name = 'sensor_simulator'
setup(name=package_name, packages=[package_name], entry_points={{'console_scripts': [
{}
]}})
"""


@pytest.fixture
def judge(tmp_path):
    package = tmp_path / "src" / "sensor_simulator"
    (package / "sensor_simulator").mkdir(parents=True)
    (package / "package.xml").write_text("<package><name>sensor_simulator</name></package>")
    for name in ("__init__", "temperature_publisher", "temperature_subscriber"):
        (package / "sensor_simulator" / f"{name}.py").write_text("def main():\n    pass\n")

    (package / "setup.cfg").write_text("[install]\ninstall_scripts=$base/lib/sensor_simulator\n")

    def run(*entries):
        (package / "setup.py").write_text(SETUP.format("\n".join(entries)))
        return setup_05a.judged(setup_05a.scenario(tmp_path))

    return run


@pytest.mark.parametrize(
    "entries",
    [
        (PUBLISHER, SUBSCRIBER),
        (SUBSCRIBER, PUBLISHER[:-1]),
        (PUBLISHER, SUBSCRIBER, "'more = sensor_simulator.temperature_publisher:main',"),
        (PUBLISHER.replace(" = ", "="), SUBSCRIBER.replace("'", '"')),
        ("package_name.join(['', '']) or", PUBLISHER, SUBSCRIBER)[1:],
        ("f'temperature_publisher = {package_name}.temperature_publisher:main',", SUBSCRIBER),
    ],
)
def test_both_programs_are_there(judge, entries):
    assert judge(*entries).status == PASSED


def test_an_empty_list_is_nothing_tried(judge):
    assert judge().status == NOT_ATTEMPTED
    assert judge("'____',", "'____',").status == NOT_ATTEMPTED


@pytest.mark.parametrize(
    ("entries", "evidence"),
    [
        ((PUBLISHER,), "no temperature_subscriber"),
        ((PUBLISHER[:-1], SUBSCRIBER), "two entries have become one"),
        ((PUBLISHER.replace("publisher:main", "publisher.py:main"), SUBSCRIBER), "with .py"),
        ((PUBLISHER.replace("simulator.", "simulator/"), SUBSCRIBER), "slash"),
        ((PUBLISHER.replace(":main", ":man"), SUBSCRIBER), "function"),
        ((PUBLISHER.replace(":main", ""), SUBSCRIBER), "names no function"),
        ((PUBLISHER.replace("publisher:", "publsher:"), SUBSCRIBER), "module"),
        ((PUBLISHER, SUBSCRIBER.replace("subscriber:", "publisher:")), "would call"),
        (("'____',", SUBSCRIBER), "equals sign"),
        ((PUBLISHER.replace("=", "=="), SUBSCRIBER), "two equals signs"),
        (("*more(),", PUBLISHER), "no temperature_subscriber that can be read"),
        (("'{} = {}'.format('a', b()),",), "that can be read"),
        ((PUBLISHER.replace("temperature_publisher =", "publisher ="), SUBSCRIBER), "publisher"),
        ((PUBLISHER.replace("'temp", "temp"), SUBSCRIBER), "cannot be read"),
    ],
)
def test_a_wrong_list_says_what_is_wrong(judge, entries, evidence):
    outcome = judge(*entries)
    assert outcome.status == FAILED
    assert evidence in outcome.evidence
    assert outcome.hint


def test_every_flaw_of_an_entry_point_has_words():
    source = Path(targets.__file__).read_text()
    kinds = set(re.findall(r'Flaw\(\s*"([a-z-]+)"', source))
    assert len(kinds) >= 10
    assert kinds == set(entries_module.FLAWS) == set(MISTAKE_OF)
    assert set(MISTAKE_OF.values()) <= set(MISTAKES)


def by_format(executable, package, module, function="main"):
    return f"{executable} = {package}.{module}:{function}"


def by_adding(executable, package, module, function="main"):
    return executable + "=" + package + "." + module + ":" + function


class AsAMethod:
    def entry_point(self, executable, package, module, function="main"):
        return f"{executable}  =  {package}.{module}:{function}"


RIGHT = [
    lambda e, p, m, f="main": f"{e} = {p}.{m}:{f}",
    by_format,
    by_adding,
    AsAMethod().entry_point,
    lambda e, *parts: f"{e} = {'.'.join(parts[:2])}:{(*parts, 'main')[2]}",
]
WRONG = {
    "always main": lambda e, p, m, f="main": f"{e} = {p}.{m}:main",
    "a fixed text": lambda e, p, m, f="main": "talk = rosie.voice:main",
    "printed": lambda e, p, m, f="main": print(f"{e} = {p}.{m}:{f}"),
    "a slash": lambda e, p, m, f="main": f"{e} = {p}/{m}:{f}",
    "a dot": lambda e, p, m, f="main": f"{e} = {p}.{m}.{f}",
    "the wrong way round": lambda e, p, m, f="main": f"{p}.{m}:{f} = {e}",
    "brackets": lambda e, p, m, f="main": f"{e} = {p}.{m}:{f}()",
    "too few arguments": lambda e: e,
    "two equals signs": lambda e, p, m, f="main": f"{e} == {p}.{m}:{f}",
    "no f": lambda e, p, m, f="main": "{e} = {p}.{m}:{f}",
    "quoted": lambda e, p, m, f="main": f"'{e} = {p}.{m}:{f}'",
    "a tuple": lambda e, p, m, f="main": (e, p, m, f),
    "a comma": lambda e, p, m, f="main": f"{e} = {p}.{m}:{f},",
    "raises": lambda e, p, m, f="main": 1 / 0,
    "no function": "talk = rosie.voice:main",
}


@pytest.mark.parametrize("answer", RIGHT)
def test_a_function_that_writes_entry_points(answer):
    assert function_05b.judged(function_05b.scenario(answer)).status == PASSED


@pytest.mark.parametrize("answer", WRONG.values(), ids=WRONG)
def test_a_wrong_function_says_what_is_wrong(answer):
    outcome = function_05b.judged(function_05b.scenario(answer))
    assert outcome.status == FAILED
    assert outcome.hint


def test_a_blank_is_nothing_tried():
    def entry_point(executable, package, module, function="main"):
        return ____  # noqa: F821

    assert function_05b.judged(function_05b.scenario(entry_point)).status == NOT_ATTEMPTED
