"""Each exercise has its scenario, and nothing that judges comes along with it."""

import subprocess
import sys

import pytest

from rosbeat.errors import ExerciseError
from rosbeat.exercises.registry import EXERCISES
from rosbeat.scenarios.registry import MODULES, ids, scenario

#: Rooms that know right answers or their names for mistakes. `rosbeat.diagnosis` is not among
#: them: a session explains exceptions with it, so it is wherever nodes run.
JUDGING = ("exercises", "checks", "grading", "clinic", "viz")
#: Everything that runs an answer, loaded as a process for answers loads it.
LOAD = """
import sys
from importlib import import_module
from pkgutil import walk_packages
import rosbeat.scenarios
for module in walk_packages(rosbeat.scenarios.__path__, "rosbeat.scenarios."):
    import_module(module.name)
for module in ("scenario", "test_nodes", "launch"):
    import_module(f"rosbeat.ros.{module}")
print(*sorted(sys.modules))
"""


def loaded(code):
    run = [sys.executable, "-c", code]
    return subprocess.run(run, capture_output=True, text=True, check=True).stdout.split()


def judging(modules):
    return [name for name in modules if name.startswith(tuple(f"rosbeat.{r}" for r in JUDGING))]


@pytest.mark.ros
def test_nothing_that_judges_is_loaded():
    modules = loaded(LOAD)
    assert {"rosbeat.scenarios.system", "rosbeat.scenarios.greenhouse.trials"} <= set(modules)
    assert judging(modules) == []


def test_something_that_judges_would_be_noticed():
    assert judging(loaded("import rosbeat.exercises.page_00, sys; print(*sys.modules)"))


def test_one_page_does_not_load_the_others():
    code = "from rosbeat.scenarios.registry import scenario; scenario('02a')"
    modules = loaded(f"{code}; import sys; print(*sys.modules)")
    assert [name for name in modules if name.startswith("rosbeat.scenarios.page_")] == [
        "rosbeat.scenarios.page_02"
    ]


def test_the_exercises_are_those_that_are_judged():
    assert ids() == tuple(EXERCISES)


# Where a scenario is handed more than the answer, a check wraps it.
@pytest.mark.parametrize("name", [one.id for one in EXERCISES.values() if one.given is dict])
def test_a_check_runs_the_same_scenario(name):
    assert EXERCISES[name].scenario is scenario(name)


@pytest.mark.parametrize("name", ["", "03", "03z", "99a", "page_03", "registry", "../03a", "03a "])
def test_what_is_no_exercise_has_none(name, says):
    with pytest.raises(ExerciseError) as caught:
        scenario(name)
    says(caught.value, repr(name), "03a", "system")


def test_every_module_is_there():
    assert MODULES[0] == "page_00"
    assert MODULES[-2:] == ("page_13", "system")
