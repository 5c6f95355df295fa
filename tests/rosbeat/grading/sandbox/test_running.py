"""A sandbox holds whatever strangers' code tries, and each try ends by itself or is ended."""

import errno
import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from rosbeat.grading.sandbox.limits import Limits

PROGRAM = Path(__file__).parents[3] / "sandbox_deeds.py"


@pytest.fixture(scope="module")
def deeds():
    done = subprocess.run(
        [sys.executable, str(PROGRAM)], capture_output=True, text=True, timeout=110, check=False,
        env={**os.environ, "SECRET": "canary-7731"},
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    told = json.loads(done.stdout)
    if "refused" in told["seen"]:
        pytest.skip(told["seen"]["refused"])
    return told


@pytest.fixture(scope="module")
def seen(deeds):
    return deeds["seen"]


def test_it_sees_nothing_that_it_need_not_see(seen):
    told = seen["looks"]["told"]
    assert told["user"] == 1000
    assert told["environment"] == {"PATH": "/usr/bin", "HOME": "/tmp"}
    assert {"home", "var", "mnt", "srv", "old"} & set(told["folders"]) == set()
    assert told["host"] == "sandbox"
    assert told["capabilities"]
    assert told["shm"] == told["tmp"] == told["home"] == [] or told["home"] == "done"
    assert told["secret"] == "FileNotFoundError"
    assert len(told["processes"]) <= 2
    assert told["here"] == "/tmp"


def test_it_can_write_only_where_everything_is_thrown_away(seen):
    told = seen["writes"]["told"]
    assert told.pop("/tmp/x") == "done"
    assert set(told.values()) <= {"OSError", "PermissionError", "FileNotFoundError"}


def test_it_gains_no_rights(seen):
    told = seen["gains_rights"]["told"]
    assert told["user namespace"] == told["mount"] == told["trace the first process"] == -1
    assert "done" not in (told["user"], told["nice"])


def test_it_reaches_itself_and_nobody_else(seen):
    told = seen["calls_out"]["told"]
    assert told["itself"] == "done"
    assert told["interfaces"] == ["lo"]
    assert told["others"] != "done"
    assert told["names"] == "gaierror"


@pytest.mark.parametrize(
    ("deed", "endings"),
    [
        ("loops", {"deadline"}),
        ("sleeps", {"deadline"}),
        ("ignores_signals", {"deadline"}),
        ("forks", {"deadline", "memory"}),
        ("eats", {"memory"}),
        ("prints", {"deadline"}),
        ("answers_too_much", {"result"}),
        ("fills_a_file", {"exit"}),
        ("fills_memory_that_is_shared", {"exit"}),
        ("kills_itself", {"signal"}),
        ("crashes", {"signal"}),
        ("kills_all", {"ended", "signal"}),
        ("leaves", {"ended"}),
        ("leaves_with_a_code", {"exit"}),
        ("raises", {"exit"}),
        ("stays_behind", {"ended"}),
        ("shares_memory", {"memory"}),
        ("hides_a_pipe", {"ended"}),
        ("has_a_sibling", {"ended"}),
        ("has_a_sibling_that_eats", {"memory"}),
        ("closes_everything", {"ended", "exit"}),
        ("closes_everything_and_sleeps", {"deadline"}),
        ("leaves_with_a_high_code", {"exit"}),
    ],
)
def test_each_deed_ends_in_its_own_way(deed, endings, seen):
    assert seen[deed]["how"] in endings, seen[deed]
    assert seen[deed]["seconds"] < 20


def test_the_ending_says_more(seen):
    assert seen["kills_itself"]["number"] == 9
    assert seen["crashes"]["number"] == 11
    assert seen["leaves_with_a_code"]["number"] == 7
    assert "ValueError: no" in seen["raises"]["output"]


def test_the_first_process_cannot_be_looked_into_or_ended(seen):
    told = seen["looks_around"]["told"]
    assert told["root"] == told["environment"] == told["memory"] == "PermissionError"
    assert told["alive"] == told["signal"] == "done"  # it hears no signal from in there
    assert told["session"]


def test_what_may_be_read_may_lie_where_everything_else_is_thrown_away(seen):
    told = seen["reads_what_lies_below_tmp"]["told"]
    assert (told["folder"], told["file"]) == ("one", "two")
    assert told["there"] == [["one", "two"], ["two"]]
    assert told["write"] == told["replace"] == "OSError"


def test_what_no_namespace_keeps_apart_is_refused(seen):
    told = seen["calls_what_is_not_there"]["told"]
    assert told["refused"] == [[-1, errno.EPERM]] * 4
    assert told["others"] > 1


def test_the_environment_of_whoever_was_forked_is_nowhere_in_its_memory(seen):
    assert seen["searches_itself"]["told"] == {"found": 0}


def test_python_itself_stays_as_it_is(seen):
    assert seen["looks_around"]["told"]["python"] in ("OSError", "PermissionError")


def test_nothing_of_whoever_started_it_is_open(seen):
    assert set(seen["looks_around"]["told"]["descriptors"]) <= {0, 1, 2, 3, 4}  # one is the listing


def test_nothing_of_the_machine_is_mounted_where_it_could_be_seen(seen):
    mounts = set(seen["looks_around"]["told"]["mounts"])
    assert mounts.isdisjoint({"/old", "/fresh", "/home", "/root", "/sys", "/dev", "/boot", "/var"})
    assert {"/", "/tmp", "/dev/shm", "/usr"} <= mounts


def test_no_more_is_read_than_was_allowed(seen):
    assert seen["prints"]["read"] == 64_000
    assert seen["answers_too_much"]["told"] == Limits().result


def test_nothing_is_left_behind(deeds):
    assert deeds["left"] == []
