"""What differs between the distributions of ROS, and what is refused because it is neither."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
import rclpy
from rclpy.action import ActionServer
from rclpy.node import Node
from test_msgs.action import Fibonacci

import rosbeat
from distributions import IS_KILTED
from nodes import SECOND
from rosbeat.errors import UnsupportedRclpyError

pytestmark = pytest.mark.ros

only_kilted = pytest.mark.skipif(not IS_KILTED, reason="only Kilted has it")

# `with rclpy.init():`


def test_init_returns_what_rclpys_own_returns(ros, capsys):
    """In Jazzy `with rclpy.init():` is a TypeError, here and on a robot."""
    if not IS_KILTED:
        assert rclpy.init() is None
        return
    with rclpy.init():
        assert rclpy.ok()
    assert rclpy.ok()  # the session goes on
    out = capsys.readouterr().out
    assert "rclpy.init() has no effect here" in out
    assert "rclpy.shutdown() does not close this session" in out


@only_kilted
def test_init_on_a_page_without_a_session(monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, "ipykernel.kernelapp", sys)
    with rclpy.init(domain_id=50):
        assert rclpy.ok()
        with rclpy.init():  # it changes nothing, and neither does its end
            pass
        assert rclpy.ok()
    assert not rclpy.ok()
    assert "ROS is already running in this kernel" in capsys.readouterr().out


@only_kilted
def test_a_program_may_leave_shutting_down_to_with(ros):
    states = []

    def main():
        with rclpy.init() as manager:
            node = Node("beat")
            node.create_timer(1.0, lambda: states.append(rclpy.ok()))
            rclpy.spin_until_future_complete(node, rclpy.Future(), timeout_sec=2.5)
        states.append(manager.context.ok())

    program = ros.spawn(main)
    ros.run(3)
    assert (program.returncode, states) == (0, [True, True, False])


# What a callback of a timer is told.


@only_kilted
def test_a_timer_tells_its_callback_when_it_was_due(ros):
    from rclpy.timer import TimerInfo

    class Told(Node):
        def __init__(self):
            super().__init__("told")
            self.told = []
            self.create_timer(1.0, self.tell)
            self.create_timer(1.0, lambda: self.told.append("nothing"))

        def tell(self, info: TimerInfo):
            now = self.get_clock().now()
            self.told.append((info.expected_call_time, info.actual_call_time) == (now, now))

    told = ros.add(Told)
    ros.run(2)
    assert told.told == [True, "nothing", True, "nothing"]


@only_kilted
def test_a_timer_that_is_late_says_by_how_much(ros):
    import time

    from rclpy.timer import TimerInfo

    late = []

    class Sleeper(Node):
        def __init__(self):
            super().__init__("sleeper")
            self.create_timer(1.0, lambda: time.sleep(0.75))
            self.create_timer(1.5, self.tell)

        def tell(self, info: TimerInfo):
            late.append((info.actual_call_time - info.expected_call_time).nanoseconds)

    ros.add(Sleeper)
    ros.run(2)
    assert late == [SECOND // 4]


@pytest.mark.parametrize("callback", [None, "tell"])
def test_a_callback_that_cannot_be_called_is_named_in_both(ros, callback):
    """In Kilted rclpy looks for its parameters first, and says less about it."""
    ros.add(lambda: Node("early")).create_timer(1.0, callback)
    ros.run(1, quiet=True)
    (fault,) = ros.observation().faults
    assert "object is not callable" in fault.text


# What rclpy itself calls although it has deprecated it.


def test_an_action_server_may_warn_although_warn_is_deprecated(ros, recwarn):
    """Where a DeprecationWarning is an error, as here, its line would end the node."""

    class Server(Node):
        def __init__(self):
            super().__init__("server")
            self.server = ActionServer(self, Fibonacci, "count", lambda goal: None)

    ros.add(Server).server._logger.warn("The client may have gone away")
    assert not recwarn.list


# Releases that the engine does not know.

ROOT = Path(rosbeat.__file__).resolve().parents[1]
#: What an rclpy must have to be used though nothing tells its release.
STUBS = {
    "executors": "def await_or_execute(): ...\nclass Executor:\n    _make_handler = 1\n"
    "    wait_for_ready_callbacks = 1\n",
    "event_handler": "class EventHandler: ...\n",
    "subscription": "class Subscription:\n    CallbackType = 1\n",
    "utilities": "g_default_context = g_context_lock = 1\n",
    "task": "class Task:\n    executing = 1\nclass Future:\n    _set_executor = 1\n",
}


@pytest.fixture
def made_up(tmp_path):
    """Write an rclpy into a prefix and return where Python finds it."""

    def write(release=None, packages="lib/python3.12/site-packages", metadata=None, stubs=False):
        folder = tmp_path / packages
        (folder / "rclpy").mkdir(parents=True)
        (folder / "rclpy" / "__init__.py").touch()
        for name, text in STUBS.items() if stubs else ():
            (folder / "rclpy" / f"{name}.py").write_text(text)
        if release is not None:
            manifest = tmp_path / "share" / "rclpy" / "package.xml"
            manifest.parent.mkdir(parents=True)
            manifest.write_text(
                f"<package><name>rclpy</name><version>{release}</version></package>"
            )
        if metadata is not None:
            (folder / f"rclpy-{metadata}-py3.12.egg-info").write_text(
                f"Metadata-Version: 2.1\nName: rclpy\nVersion: {metadata}\n"
            )
        return folder

    return write


def imported(folder):
    """Return how the import of the engine ends with this rclpy, and no other that pip knows."""
    code = (
        "import rosbeat\n"
        "try:\n    import rosbeat.ros\n"
        "except ImportError as error:\n    print(f'{type(error).__name__}: {error}')"
    )
    done = subprocess.run(
        [sys.executable, "-S", "-c", code],
        env={"PATH": os.defpath, "PYTHONPATH": os.pathsep.join([str(folder), str(ROOT)]),
             "_ROS_WHEELS_BOOTSTRAP_COMPLETE": "1"},
        capture_output=True, text=True, timeout=60, check=True,
    )  # fmt: skip
    assert done.stderr == ""
    return done.stdout


@pytest.mark.parametrize("release", ["3.3.16", "7.0.1", "8.0.0", "9.0.1", "10.0.2"])
def test_an_rclpy_of_another_distribution_is_refused_in_three_parts(made_up, release):
    folder = made_up(release)
    what, means, to_try = imported(folder).splitlines()
    assert what == (
        f"{UnsupportedRclpyError.__name__}: The rclpy in {folder / 'rclpy'} is release {release}."
    )
    assert "Jazzy's (7.1.x) and Kilted's (9.1.x)" in means
    assert all(words in to_try for words in ("Source", "rosbeat[ros]", "rosbeat[kilted]"))


@pytest.mark.parametrize("release", ["7.1.0", "7.1.9", "9.1.0", "9.1.12"])
@pytest.mark.parametrize(
    "packages",
    ["lib/python3.12/site-packages", "local/lib/python3.12/dist-packages"],
    ids=["of a robot", "built by colcon"],
)
def test_every_release_of_the_two_is_taken(made_up, packages, release):
    """The package.xml in the prefix tells, and pip need not know of it."""
    assert imported(made_up(release, packages)) == ""


def test_the_manifest_counts_more_than_what_pip_knows(made_up):
    assert imported(made_up("7.1.9", metadata="3.3.16")) == ""


@pytest.mark.parametrize(("metadata", "words"), [("7.1.9", ""), ("3.3.16", "is release 3.3.16.")])
def test_without_a_manifest_pip_is_asked(made_up, metadata, words):
    assert words in (text := imported(made_up(metadata=metadata)))
    assert bool(text) == bool(words)


def test_what_does_not_tell_its_release_is_refused_only_if_it_lacks_something(made_up):
    folder = made_up(stubs=True)
    assert imported(folder) == ""
    (folder / "rclpy" / "task.py").unlink()
    assert "has no `rclpy.task.Task.executing`, and no release is named." in imported(folder)


def test_without_any_rclpy_python_says_so_itself(tmp_path):
    """Tools that need no ROS use parts of the package."""
    assert imported(tmp_path) == ""
