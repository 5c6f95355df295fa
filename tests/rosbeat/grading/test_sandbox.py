"""A sandbox holds whatever strangers' code tries, and each try ends by itself or is ended."""

import errno
import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from rosbeat.grading.sandbox import Limits, cannot_be_made

PROGRAM = Path(__file__).parents[2] / "sandbox_attacks.py"


@pytest.fixture(scope="module")
def deeds():
    done = subprocess.run(
        [sys.executable, str(PROGRAM)], capture_output=True, text=True, timeout=110, check=False
    )
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
    assert told["shm"] == []
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
        ("keeps_memory_in_sockets", {"memory"}),
        ("fills_both_scratch_folders", {"memory"}),
        ("keeps_a_few_sockets_in_many_processes", {"memory"}),
        ("fills_tables_of_pages", {"memory"}),
        ("maps_in_many_pieces", {"memory"}),
        ("stops_itself", {"deadline"}),
        ("waits_for_a_child_that_borrows_its_memory", {"deadline"}),
        ("adopts_daemons", {"ended"}),
        ("hides_and_eats", {"memory"}),
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
    assert seen["prints"]["read"] == 64_000
    assert seen["answers_too_much"]["told"] == Limits().result


def test_the_first_process_cannot_be_looked_into_or_ended(seen):
    told = seen["looks_around"]["told"]
    assert told["root"] == told["environment"] == told["memory"] == "PermissionError"
    assert told["alive"] == told["signal"] == "done"  # it hears no signal from in there
    assert told["session"]
    assert told["python"] in ("OSError", "PermissionError")  # it stays as it is
    assert set(told["descriptors"]) <= {0, 1, 2, 3, 4}  # one is the listing
    mounts = set(told["mounts"])
    assert mounts.isdisjoint({"/old", "/fresh", "/home", "/root", "/sys", "/dev", "/boot", "/var"})
    assert {"/", "/tmp", "/dev/shm", "/usr"} <= mounts


def test_what_may_be_read_may_lie_where_everything_else_is_thrown_away(seen):
    told = seen["reads_what_lies_below_tmp"]["told"]
    assert (told["folder"], told["file"]) == ("one", "two")
    assert told["there"] == [["one", "two"], ["two"]]
    assert told["write"] == told["replace"] == "OSError"


def test_what_no_namespace_keeps_apart_is_refused(seen):
    told = dict(seen["calls_what_is_not_there"]["told"])
    assert told.pop("others") > 1
    assert set(told) >= {"memfd_create", "shmget", "userfaultfd", "keyctl", "ptrace", "bpf"}
    assert all(one == [-1, errno.EPERM] for one in told.values()), told


def test_sockets_reach_this_machine_only(seen):
    told = seen["opens_sockets"]["told"]
    allowed = {name for name, said in told.items() if said == "done"}
    assert allowed == {"unix", "inet", "inet6", "netlink", "pair"}
    assert {"vsock", "packet", "alg", "netlink of another kind"} <= set(told)


def test_nothing_is_left_for_the_next_answer_or_behind(deeds, seen):
    assert seen["leaves_files"]["how"] == seen["leaves_queues"]["how"] == "ended"
    assert "left" not in seen["finds_files"]["told"]["found"]
    assert set(seen["finds_queues"]["told"].values()) == {-1}
    assert deeds["left"] == []


def test_little_waits_in_sockets_and_nothing_in_pipes_but_what_was_written(seen):
    told = seen["keeps_memory_in_tcp"]["told"]
    assert told["pairs"] == 20
    assert told["kept"] < 20 * 2 * 4 * 65_536
    assert seen["asks_for_larger_buffers"]["told"] == {"same": [True, True], "other": 1}
    assert seen["keeps_pages_in_pipes"]["told"]["vmsplice"] == -1


def test_no_namespace_and_no_mount_is_made_in_any_way(seen):
    assert set(seen["makes_namespaces"]["told"].values()) == {-1}
    assert set(seen["mounts_in_new_ways"]["told"].values()) == {-1, "PermissionError"}


def test_the_first_process_cannot_be_starved_or_slowed(seen):
    told = seen["reaches_init"]["told"]
    assert told.pop("my own") == ["done", "done"]
    assert told.pop("signal") == 0  # it does not hear it
    assert told.pop("time") == ["done", os.SCHED_OTHER]  # it has no effect
    assert told.pop("processor") == ["done", len(os.sched_getaffinity(0))]
    assert set(told.values()) == {-1, "PermissionError"}


def test_files_are_opened_by_their_names_and_held_from_nobody(seen):
    assert seen["opens_by_handle"]["told"]["opened"] == -1
    assert seen["holds_a_lease"]["told"] == {"lease": "PermissionError", "lock": "done"}


def test_why_none_can_be_made_is_said_in_three_parts(says):
    says(cannot_be_made("unshare: Operation not permitted"), "Operation not permitted", "user name")


# Without namespaces.

#: A process of its own, because the work is forked, and a test process has threads.
BARE = """
import json, os, sys, time
from pathlib import Path
from rosbeat.grading.sandbox import Limits, Sandbox, View

def looks(result):
    os.write(result, json.dumps([os.getcwd(), dict(os.environ)]).encode())

def loops(_):
    while True: pass

def leaves(_):
    os._exit(113)

def stays_behind(result):
    told, tells = os.pipe()
    if os.fork() == 0:
        os.setsid()
        os.write(result, str(os.getpid()).encode())
        os.write(tells, b".")
        time.sleep(600)
    os.read(told, 1)

def eats(_):
    many = []
    while True: many.append(bytearray(10_000_000))

told = {}
for work in (looks, loops, leaves, stays_behind, eats):
    with Sandbox(View(environment={"A": "b"}), isolated=False) as sandbox:
        seen = sandbox.run(work, Limits(wall=2.0, memory=200_000_000))
    told[work.__name__] = [seen.how, seen.number, seen.result.decode()]
told["left"] = Path("/proc", told["stays_behind"][2]).exists()
told["here"] = os.getcwd()
told["folder"] = Path(json.loads(told["looks"][2])[0]).exists()
print(json.dumps(told))
"""


@pytest.fixture(scope="module")
def bare():
    done = subprocess.run([sys.executable, "-c", BARE], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_it_has_a_folder_and_an_environment_of_its_own(bare):
    folder, environment = json.loads(bare["looks"][2])
    assert environment == {"A": "b", "HOME": folder, "TMPDIR": folder}
    assert folder != bare["here"]
    assert not bare["folder"]  # it is gone afterwards
    assert bare["loops"][0] == "deadline"
    assert bare["eats"][0] in ("memory", "exit")
    assert bare["leaves"][:2] == ["exit", 113]  # an exit code is no refusal
    assert bare["stays_behind"][0] == "ended"
    assert bare["left"] is False


# System calls and limits.
