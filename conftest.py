"""Pages are tests: see `tests/notebooks`."""

import gc
import signal
from collections.abc import Iterator

import pytest
from hypothesis import settings

# How long an example takes says more about what else the machine does.
settings.register_profile("rosbeat", deadline=None)
settings.load_profile("rosbeat")

pytest_plugins = ["notebooks.plugin", "pytester"]

# A shell lets what it starts with `&` ignore Interrupt, and so would every kernel and program that
# a test interrupts. Pytest's workers import this, too.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)

#: Where the files are that take longest, the longest first: with several workers these begin, and
#: nobody waits for one of them at the end. (With `--no-loadscope-reorder`; else xdist begins with
#: the files that have most tests.)
_LONGEST = (
    "tests/conformance/",
    *(f"{tree}/{page}" for page in ("07", "06", "09") for tree in ("solutions", "notebooks")),
    "tests/ros2_command/verbs/test_topic.py",
    "tests/torture/",
    "tests/bank/",
    *("tests/hostile/", "tests/solutions/", "tests/rosbeat/page_runs/"),
    *("tests/rosbeat/grading/", "tests/rosbeat/authoring/"),
    *("tests/with_nbgrader/", "tests/rosbeat/test_check_command.py"),
    *("tests/rosbeat/exercises/test_system.py", "tests/notebooks/test_closed_holes.py"),
    *("tests/ros/test_qos_events.py", "tests/ros/test_scenario.py"),
    "solutions/",
    "notebooks/",
    "tests/ros2_command/",
    "tests/rosbeat/workspace/",
)
#: Where tests wait for other programs most of the time.
_WAITING = (
    *("solutions/", "notebooks/", "tests/torture/", "tests/ros2_command/", "tests/environment/"),
    *("tests/rosbeat/workspace/", "tests/conformance/", "tests/rosbeat/test_check_command.py"),
    *("tests/rosbeat/exercises/test_system.py", "tests/ros/test_qos_events.py"),
)


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the option that runs the tests marked as thorough, too."""
    parser.addoption("--thorough", action="store_true", help="run what takes minutes, too")


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Begin with what takes longest; the tests of a file stay together and in their order.

    Tests marked as thorough are left out, unless they are asked for.
    """
    if not config.getoption("--thorough"):
        left_out = [one for one in items if one.get_closest_marker("thorough")]
        config.hook.pytest_deselected(items=left_out)
        items[:] = [one for one in items if not one.get_closest_marker("thorough")]
    files: dict[str, list[pytest.Item]] = {}
    for item in items:
        files.setdefault(item.nodeid.partition("::")[0], []).append(item)
    items[:] = (item for name in _mixed(sorted(files, key=_place)) for item in files[name])


def _mixed(files: list[str]) -> Iterator[str]:
    """Two files that wait, which are short, and one that computes: the cores are seldom idle."""
    waiting = [name for name in files if name.startswith(_WAITING)]
    computing = [name for name in files if not name.startswith(_WAITING)]
    while waiting or computing:
        yield from (*waiting[:2], *computing[:1])
        del waiting[:2], computing[:1]


def pytest_collection_finish() -> None:
    """Let Python look for garbage rarely, and not among thousands of tests, which stay to the end.

    It was a seventh of the time of tests that make many objects, as `gc.callbacks` told.
    """
    gc.collect()
    gc.freeze()
    gc.set_threshold(20_000, 20, 20)


def _place(nodeid: str) -> int:
    found = (n for n, start in enumerate(_LONGEST) if nodeid.startswith(start))
    return next(found, len(_LONGEST))


@pytest.fixture(autouse=True, scope="session")
def _somebody_elses_progress(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """Whoever proves the course on their machine keeps the progress they have made in it."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ROSBEAT_PROGRESS_IN", str(tmp_path_factory.mktemp("progress")))
        yield


# The finished package of the course: `colcon test` runs its tests, from tests/solutions.
collect_ignore = ["solutions/sensor_simulator"]
