"""Twenty learners work at once, each as if alone."""

import csv
import stat
import subprocess
from concurrent.futures import ThreadPoolExecutor

import nbformat
import pytest

from hub.learner import as_compared
from hub.machine import ROOT, environ

PAGE = "00_hear_the_heartbeat.ipynb"
pytestmark = pytest.mark.timeout(1800)


@pytest.fixture(scope="module")
def learners(hub):
    """All of them, with their servers running."""

    def begin(user):
        learner = hub.log_in(user)
        learner.start_server()
        return learner

    with ThreadPoolExecutor(len(hub.users)) as pool:
        made = list(pool.map(begin, hub.users))
        yield made
        list(pool.map(lambda one: one.stop_server(), made))


def test_all_run_the_first_page_and_see_what_it_stores(hub, learners):
    """Fill the page in as the solution does, save it, run all of its cells, and compare."""
    solution = nbformat.read(ROOT / "solutions" / PAGE, as_version=4)

    def work(learner):
        page = learner.page(PAGE)
        page.cells = solution.cells
        learner.save(PAGE, page)
        differing = []
        with learner.kernel(PAGE) as kernel:
            for cell in solution.cells:
                if cell.cell_type == "code":
                    outputs, status = kernel.run(cell.source)
                    expected = as_compared(cell.outputs)
                    if status != "ok" or as_compared(outputs) != expected:
                        differing.append((learner.name, cell.id, status, outputs, expected))
        return differing

    with ThreadPoolExecutor(len(learners)) as pool:
        assert [one for found in pool.map(work, learners) for one in found] == []
    done = [one.home / "my_course" / ".rosbeat" / "progress.json" for one in hub.users]
    assert all('"00a"' in path.read_text() for path in done)


def test_the_homes_are_graded_as_they_are(hub, learners, tmp_path):
    homes = hub.users[0].home.parent
    command = f"rosbeat grade {homes} --lessons 00 --out {tmp_path}"
    course = [hub.course / "environment" / "course", "shell", "-c", command]
    subprocess.run(course, env=environ(), check=True, timeout=900)
    with (tmp_path / "grades.csv").open(encoding="utf-8-sig") as table:
        rows = list(csv.DictReader(table))
    assert {row["learner"] for row in rows} == {user.name for user in hub.users}
    assert {row["status"] for row in rows} == {"passed"}


def test_each_has_ros2_in_a_terminal(hub, learners):
    for user, learner in list(zip(hub.users, learners, strict=True))[:3]:
        with learner.terminal() as terminal:
            assert "/rosout" in terminal.run("ros2 topic list")
            workspace = str(user.home / "my_course" / "ROS2_and_RL_Tutorials")
            assert workspace in terminal.run("echo $ROS2_WORKSPACE")


def test_homes_are_closed_and_hold_no_installation(hub, learners):
    for user in hub.users:
        assert stat.S_IMODE(user.home.stat().st_mode) == 0o700
        size = subprocess.run(["du", "-sm", user.home], capture_output=True, text=True, check=True)
        assert int(size.stdout.split()[0]) < 20


def test_what_a_learner_wrote_outlives_the_next_start(learners):
    learner, name = learners[0], "03_write_a_publisher.ipynb"
    page = learner.page(name)
    page.cells[0].source = "Mine."
    learner.save(name, page)
    learner.stop_server()
    learner.start_server()
    assert learner.page(name).cells[0].source == "Mine."


def test_update_and_reset_work_in_a_terminal(learners):
    learner, name = learners[1], "04_write_a_subscriber.ipynb"
    with learner.terminal() as terminal:
        assert "Your pages are those of the course." in terminal.run('"$ROSBEAT_COURSE" update')
        page = learner.page(name)
        page.cells[0].source = "Mine."
        learner.save(name, page)
        said = terminal.run('"$ROSBEAT_COURSE" reset 04')
    assert "is as shipped; yours is kept as my_course/04_write_a_subscriber-kept-1.ipynb" in said
    assert learner.page(name).cells[0].source != "Mine."


def test_a_learner_who_takes_too_much_memory_stops_nobody_else(hub, learners):
    greedy, other = learners[2], learners[3]
    with other.kernel(PAGE) as calm:
        with greedy.kernel(PAGE) as kernel:
            with_limit = "memory = [bytearray(10**8) for _ in range(40)]"
            assert kernel.died(with_limit)
        assert calm.says("print(6 * 7)") == "42\n"


def test_a_learner_who_starts_too_many_processes_stops_nobody_else(learners):
    greedy, other = learners[4], learners[5]
    with other.kernel(PAGE) as calm, greedy.kernel(PAGE) as kernel:
        started = kernel.says(
            "import subprocess\nstarted = []\ntry:\n"
            "    while len(started) < 1000: started.append(subprocess.Popen(['sleep', '600']))\n"
            "except OSError as error: print(type(error).__name__)\n"
            "for one in started: one.kill(); one.wait()\n"
        )
        assert started == "BlockingIOError\n"
        assert calm.says("print(6 * 7)") == "42\n"
