"""A cluster gives what one machine gives, even if a worker of it is killed in the middle."""

import logging
import os
import signal
import subprocess
import sys
from contextlib import contextmanager, suppress
from importlib import import_module

import psutil
import pytest

from bank.pages import subject
from bank.reading import answers
from grading_class import hand_in, pages_of
from rosbeat.errors import GradingError
from rosbeat.grading import cluster as module
from rosbeat.grading.cluster import Cluster
from rosbeat.grading.ledger import FILE, Ledger
from rosbeat.grading.marks import Points
from rosbeat.grading.results import to_results
from rosbeat.grading.run import Plan, grade
from rosbeat.page_runs.jobs import PageCell, PageJob, lost
from rosbeat.page_runs.pool import Pool

dask = pytest.importorskip("distributed")

EXERCISES = ("03a", "04a")
#: Nothing listens there: only the system's own programs may use the port.
NOBODY = "tcp://127.0.0.1:1"


def local(workers):
    """A cluster on this machine, each worker a process; its dashboard takes any free port."""
    return dask.LocalCluster(
        n_workers=workers,
        threads_per_worker=1,
        dashboard_address="127.0.0.1:0",
        silence_logs=logging.CRITICAL,
    )


@pytest.fixture(scope="module")
def cluster():
    with local(2) as found:
        yield found


def answers_to(exercise):
    """A right and a wrong answer that define what the page's check hands over."""
    usual = subject(exercise)
    named = [one for one in answers() if (one.exercise, one.subject) == (exercise, usual)]
    right = [one.text for one in named if one.status == "passed"][:1]
    wrong = [one.text for one in named if one.status == "failed" and "sleep" not in one.text]
    return [*right, *wrong[:1]]


@pytest.fixture(scope="module")
def course_and_class(tmp_path_factory):
    pages = pages_of("03", "04")
    learners = [
        dict(zip(EXERCISES, texts, strict=True))
        for texts in zip(*map(answers_to, EXERCISES), strict=True)
    ]
    points = Points({f"0{page}{letter}": 0.0 for page in (3, 4) for letter in "bc"})
    return hand_in(tmp_path_factory.mktemp("class"), pages, learners), Plan(pages, "v", points)


def results(course_and_class, out, observe):
    collection, plan = course_and_class
    with Ledger(out / FILE) as ledger:
        return to_results(grade(collection, plan, ledger, observe, lambda *_: None))


def on_the_cluster(cluster, killed):
    """Observe there; once something has come back, kill a worker."""

    def observe(jobs):
        with Cluster(cluster.scheduler_address) as found:
            for result in found.observe(jobs):
                if not killed:
                    pids = found._client.run(os.getpid)
                    killed.extend(list(pids.values())[:1])
                    os.kill(killed[0], signal.SIGKILL)
                yield result

    return observe


@pytest.fixture(scope="module")
def expected(course_and_class, tmp_path_factory):
    """What one machine gives."""

    def on_this_machine(jobs):
        with Pool(2) as pool:
            yield from pool.observe(jobs)

    return results(course_and_class, tmp_path_factory.mktemp("here"), on_this_machine)


@pytest.mark.ros
def test_same_results_as_on_one_machine_with_a_worker_killed(
    cluster, course_and_class, expected, tmp_path
):
    killed = []
    found = results(course_and_class, tmp_path / "there", on_the_cluster(cluster, killed))
    assert killed
    assert found == expected
    assert found.count('"status": "passed"') == found.count('"status": "failed"') == 2


@contextmanager
def worker_of(cluster):
    """A worker that nobody starts again."""
    options = ("--no-nanny", "--no-dashboard", "--nthreads", "1")
    command = [sys.executable, "-m", "distributed.cli.dask_worker", cluster.scheduler_address]
    with subprocess.Popen([*command, *options], stderr=subprocess.DEVNULL) as process:
        yield process
        process.kill()


@pytest.mark.ros
@pytest.mark.timeout(300)
def test_all_workers_killed_and_the_next_run_goes_on_with_another(
    course_and_class, expected, tmp_path, monkeypatch, says
):
    monkeypatch.setattr(module, "_LOOK", 1.0)

    def observed(own, jobs, and_then):
        with Cluster(own.scheduler_address, patience=90) as found:
            for result in found.observe(jobs):
                and_then()
                yield result

    with local(0) as own:
        with pytest.raises(GradingError) as caught:
            Cluster(own.scheduler_address, patience=0.3)
        says(caught.value, "no worker", "dask worker tcp://")
        with worker_of(own) as worker, pytest.raises(GradingError) as caught:
            results(course_and_class, tmp_path, lambda jobs: observed(own, jobs, worker.kill))
        says(caught.value, "no worker", "stays graded")
        with Ledger(tmp_path / FILE) as ledger:
            assert len(ledger) > 0
        with worker_of(own):
            found = results(
                course_and_class, tmp_path, lambda jobs: observed(own, jobs, lambda: None)
            )
    assert found == expected


def sandboxes(worker):
    """The processes of sandboxes that a worker of the cluster has started."""
    found = []
    for child in psutil.Process(worker).children(recursive=True):
        with suppress(psutil.NoSuchProcess):  # it has just ended
            found += [child.pid] * ("rosbeat.page_runs.worker" in child.cmdline())
    return found


def test_nothing_is_left_on_the_workers(cluster, eventually):
    job = PageJob("03", (PageCell("import time\ntime.sleep(600)"),), {"03a": "Beat"})
    with Cluster(cluster.scheduler_address) as found:
        workers = list(found._client.run(os.getpid).values())
        future = found._submitted([job])
        eventually(lambda: any(map(sandboxes, workers)), 30)
        del future
    eventually(lambda: not any(map(sandboxes, workers)), 30)


def test_a_cluster_with_another_course_is_refused(cluster, monkeypatch, says):
    monkeypatch.setattr(module, "course_version", lambda: "another")
    job = PageJob("03", (PageCell("class Beat: ..."),), {"03a": "Beat"})
    with Cluster(cluster.scheduler_address) as found, pytest.raises(GradingError) as caught:
        list(found.observe([[("a", job)]]))
    says(caught.value, "another course", "another", "Install the same version")


def test_a_job_that_costs_workers_is_given_up(cluster, monkeypatch):
    monkeypatch.setattr(cluster.scheduler, "allowed_failures", 0)
    with Cluster(cluster.scheduler_address) as found:
        monkeypatch.setattr(found, "_submitted", lambda _: found._client.submit(os._exit, 1))
        jobs = [(key, PageJob("03", (), {"03a": "Beat"})) for key in "ab"]
        assert list(found.observe([jobs])) == [(key, lost(job)) for key, job in jobs]


@pytest.mark.parametrize("address", [NOBODY, "nonsense://x", "\x1b[31m:1"])
def test_where_no_scheduler_is(address, says):
    with pytest.raises(GradingError) as caught:
        Cluster(address, patience=0.5)
    says(caught.value, "No scheduler of Dask answers", "dask scheduler")
    assert "\x1b" not in str(caught.value)


def test_without_dask(monkeypatch, says):
    monkeypatch.setitem(sys.modules, "distributed", None)
    monkeypatch.delitem(sys.modules, module.__name__)
    with pytest.raises(GradingError) as caught:
        import_module(module.__name__)
    says(caught.value, "Dask is not installed", "pip install distributed")
