"""What the names of a page stand for where a stranger's code runs."""

import pytest

from rosbeat import Session
from rosbeat.grading.inside.standins import StandIn, run_imports


def imported(cell):
    space = {}
    run_imports(cell, space)
    return {name: value for name, value in space.items() if name != "__builtins__"}


def test_what_judges_draws_or_keeps_progress_does_nothing():
    found = imported("from rosbeat import Session, check, hint as help_me, progress")
    assert found["Session"] is Session
    for name in ("check", "help_me", "progress"):
        one = found[name]
        assert isinstance(one, StandIn)
        assert one("03a", object()).show().x(1, a=2) is not None


def test_what_is_not_ours_is_imported_as_it_is():
    found = imported("import math\nfrom json import dumps\nfrom rosbeat import check")
    assert (found["math"].pi, found["dumps"](1)) == (pytest.approx(3.14159, 1e-5), "1")


def test_a_module_of_the_course_that_is_not_there_is_no_trouble():
    found = imported("from rosbeat.viz.nothing import draw\nfrom rosbeat.clinic import Ward")
    assert set(found) == {"draw", "Ward"}
    assert all(isinstance(one, StandIn) for one in found.values())


def test_a_stand_in_has_nothing_of_pythons_own():
    for name in ("__iter__", "__len__", "__enter__", "__wrapped__"):
        with pytest.raises(AttributeError):
            getattr(StandIn(), name)
    assert "left out" in repr(StandIn())
    with pytest.raises(TypeError):
        list(StandIn())


def test_a_page_without_imports_brings_nothing():
    assert imported("") == {}
