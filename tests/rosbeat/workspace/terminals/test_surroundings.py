import os
import sys

import pytest

from rosbeat.workspace.terminals.surroundings import surroundings


def test_the_programs_of_the_course_come_first(monkeypatch):
    own = os.path.join(sys.prefix, "bin")
    monkeypatch.setenv("PATH", f"/bin:{own}:/usr/bin")
    assert surroundings("t.")["PATH"] == f"{own}:/bin:/usr/bin"
    monkeypatch.delenv("PATH")
    assert surroundings("t.")["PATH"].startswith(own)


def test_what_a_kernel_sets_for_itself_stays_behind(monkeypatch):
    for name in ("MPLBACKEND", "FORCE_COLOR", "PYTEST_CURRENT_TEST", "PS1"):
        monkeypatch.setenv(name, "x")
    assert not {"MPLBACKEND", "FORCE_COLOR", "PYTEST_CURRENT_TEST", "PS1"} & set(surroundings("t."))


@pytest.mark.parametrize(("given", "made"), [("C", "C.UTF-8"), ("de_DE.utf8", "de_DE.utf8")])
def test_letters_of_all_languages_can_be_typed(monkeypatch, given, made):
    monkeypatch.delenv("ROSBEAT_STEADY_HOME", raising=False)
    monkeypatch.setenv("LC_ALL", given)
    assert surroundings("t.")["LC_ALL"] == made


def test_a_learner_keeps_home_and_name(monkeypatch):
    monkeypatch.delenv("ROSBEAT_STEADY_HOME", raising=False)
    monkeypatch.setenv("HOME", "/home/ada")
    monkeypatch.setenv("USER", "ada")
    made = surroundings("t.")
    assert (made["HOME"], made["USER"]) == ("/home/ada", "ada")
    assert "GIT_CONFIG_GLOBAL" not in made


def test_a_steady_run_knows_nobody(home, monkeypatch):
    monkeypatch.setenv("XDG_CONFIG_HOME", "/home/ada/.config")
    made = surroundings("t.")
    assert (made["HOME"], made["USER"], made["LOGNAME"]) == (str(home), "you", "you")
    assert "XDG_CONFIG_HOME" not in made
    assert made["RCUTILS_CONSOLE_OUTPUT_FORMAT"] == "[{severity}] [{name}]: {message}"
