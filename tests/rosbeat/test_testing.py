"""The fixture of pytest: the examples of docs/testing.md run as they stand; what can go wrong."""

import logging
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
import rclpy
from nav_msgs.msg import Path as NavigationPath
from rclpy.action import ActionServer
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from rclpy.wait_for_message import wait_for_message
from std_msgs.msg import Float32, Int32
from std_srvs.srv import SetBool, Trigger
from test_msgs.action import Fibonacci

from nodes import Doer, Listener, Server, Talker
from rosbeat.errors import (
    CallError,
    DeadlockError,
    DurationError,
    ExitCodeError,
    NoFaultError,
    ParameterError,
    SessionError,
    TimeUpError,
    UnknownServerError,
    UnknownTopicError,
)
from rosbeat.testing import TestSession

pytestmark = pytest.mark.ros

ROOT = Path(__file__).resolve().parents[2]
#: What each example waits for, an empty text if it runs now, and its code.
EXAMPLES = re.findall(
    r"(?ms)^(?:<!-- waits for: ([^\n]*) -->\n)?```python\n(.*?)^```",
    (ROOT / "docs" / "testing.md").read_text("utf-8"),
)
OPTIONS = ("-q", "-p", "no:cacheprovider", "-W", "error", "-W", "ignore::DeprecationWarning")


def run_pytest(folder, *arguments):
    """Run pytest as a developer does who has nothing of this project: no conftest, no settings."""
    environment = {k: v for k, v in os.environ.items() if not k.startswith("PYTEST")}
    return subprocess.run(
        [sys.executable, "-m", "pytest", *OPTIONS, *arguments, folder],
        capture_output=True, text=True, env=environment, cwd=folder, timeout=100,
    )  # fmt: skip


def write(folder, examples):
    for number, example in enumerate(examples):
        (folder / f"test_example_{number}.py").write_text(example, "utf-8")


# The examples of the page.


def test_the_examples_pass_in_a_folder_that_has_nothing_else(tmp_path):
    """The plugin is found by its entry point, not by a conftest of ours."""
    examples = [code for waits_for, code in EXAMPLES if not waits_for]
    write(tmp_path, examples)
    done = run_pytest(tmp_path, "--strict-markers")
    assert done.returncode == 0, done.stdout + done.stderr
    assert int(re.search(r"(\d+) passed", done.stdout)[1]) >= len(examples)


WAITING = [(waits_for, code) for waits_for, code in EXAMPLES if waits_for]


@pytest.mark.parametrize(
    "code",
    [
        pytest.param(code, id=waits_for, marks=pytest.mark.xfail(reason=waits_for, strict=True))
        for waits_for, code in WAITING
    ],
)
def test_an_example_waits_for_the_engine(tmp_path, code):
    """Once an example passes, this fails: then take `waits for` out of the page."""
    write(tmp_path, [code])
    assert run_pytest(tmp_path).returncode == 0


# A test that must fail does so, and shows where.

FAILING = """
import sys
import pytest
import rclpy
from rclpy.node import Node
from rclpy.task import Future
from rosbeat.testing import TestSession
from std_srvs.srv import Trigger


class Bomb(Node):
    def __init__(self, after=2):
        super().__init__("bomb")
        self.left = after
        self.create_timer(1.0, self.tick)
        self.create_service(Trigger, "explode", self.explode)

    def tick(self):
        self.left -= 1
        assert self.left > 0, "boom"

    def explode(self, request, response):
        raise KeyError("exploded")


class Unfinished(Node):
    def __init__(self):
        super().__init__("unfinished")
        raise ValueError("not ready")


def program():
    raise RuntimeError("no network")


def test_in_a_callback(virtual_ros):
    virtual_ros.add(Bomb)
    virtual_ros.run(60)


def test_in_a_constructor(virtual_ros):
    virtual_ros.add(Unfinished)


def test_in_a_program(virtual_ros):
    virtual_ros.spawn(program)


def test_exit_code(virtual_ros):
    virtual_ros.spawn(lambda: sys.exit(3))


def test_in_a_service(virtual_ros):
    virtual_ros.add(Bomb)
    virtual_ros.call("explode")


def test_that_runs_the_nodes_by_itself(virtual_ros):
    node = virtual_ros.add(Bomb)
    rclpy.spin_until_future_complete(node, Future(), timeout_sec=60)


def test_in_a_session_of_its_own():
    with TestSession() as session:
        node = session.add(Bomb)
        rclpy.spin_until_future_complete(node, Future(), timeout_sec=60)


@pytest.fixture(scope="module")
def shared():
    with TestSession() as session:
        yield session


def test_in_a_shared_session(shared):
    shared.add(Bomb)
    shared.run(60)


def test_the_shared_session_goes_on(shared):
    shared.run(60)
    assert shared.time == 62


def test_expected(virtual_ros):
    virtual_ros.add(Bomb)
    with pytest.raises(AssertionError, match="boom"):
        virtual_ros.run(60)
    virtual_ros.run(60)


@pytest.mark.xfail(raises=AssertionError, strict=True)
def test_marked(virtual_ros):
    virtual_ros.add(Bomb)
    virtual_ros.run(60)
"""


def test_a_test_fails_with_the_exception_of_a_node_and_its_line(tmp_path):
    (tmp_path / "test_failing.py").write_text(FAILING, "utf-8")
    done = run_pytest(tmp_path)
    assert "8 failed, 2 passed, 1 xfailed" in done.stdout, done.stdout
    for told in (
        "E       AssertionError: boom",
        ">       assert self.left > 0",
        'raise ValueError("not ready")',
        'raise RuntimeError("no network")',
        "ended with exit code 3",
        'raise KeyError("exploded")',
        "/bomb stopped at 2.000 s, in tick",
    ):
        assert told in done.stdout
    # Neither our own frames, nor words of pages.
    assert "rosbeat/testing.py" not in done.stdout
    assert "virtual_time.py" not in done.stdout
    assert not re.search(r"\bcell\b|\bpage\b", done.stdout)


# What a test expects.


class Bomb(Node):
    """Raises at the second tick."""

    def __init__(self):
        super().__init__("bomb")
        self.left = 2
        self.create_timer(1.0, self.tick)

    def tick(self):
        self.left -= 1
        if not self.left:
            raise ValueError("boom at two")


def test_a_run_ends_when_a_callback_raises_and_the_next_one_goes_on(virtual_ros):
    virtual_ros.add(Bomb)
    talker = virtual_ros.add(Talker)
    with pytest.raises(ValueError, match="boom"):
        virtual_ros.run(60)
    assert virtual_ros.time == 2.0
    virtual_ros.run(3)
    assert virtual_ros.time == 5.0
    assert virtual_ros.messages("count")[-1].time == 5.0
    assert talker in virtual_ros.nodes


def test_an_expected_fault_lets_the_session_go_on(virtual_ros):
    virtual_ros.add(Bomb)
    with virtual_ros.expect_fault((KeyError, ValueError), match="boom") as fault:
        virtual_ros.run(60)
    assert virtual_ros.time == 60.0
    assert (fault.node, fault.callback, fault.time) == ("/bomb", "tick", 2.0)
    assert str(fault.value) == "boom at two"
    assert len(fault.raised) == 1


def test_another_fault_is_not_expected(virtual_ros):
    virtual_ros.add(Bomb)
    with (
        pytest.raises(ValueError, match="boom"),
        virtual_ros.expect_fault(ValueError, match="gloom"),
    ):
        virtual_ros.run(60)


def test_a_fault_that_does_not_come_is_told(virtual_ros, says):
    with (
        pytest.raises(NoFaultError) as raised,
        virtual_ros.expect_fault((KeyError, ValueError), match="boom") as fault,
    ):
        virtual_ros.run(1)
    says(raised.value, "No callback raised KeyError or ValueError that matches 'boom'")
    with pytest.raises(NoFaultError):
        assert fault.value


def test_a_goal_whose_work_raises_fails_the_test(virtual_ros):
    class Worker(Node):
        def __init__(self):
            super().__init__("worker")
            self.server = ActionServer(self, Fibonacci, "fibonacci", self.work)

        def work(self, goal):
            raise ValueError("no numbers")

    virtual_ros.add(Worker)
    with pytest.raises(ValueError, match="no numbers"):
        virtual_ros.send_goal("fibonacci", {"order": 3})
    with virtual_ros.expect_fault(ValueError):
        assert virtual_ros.send_goal("fibonacci", {"order": 3}).status == "ABORTED"


def test_a_callback_that_waits_for_its_own_executor_fails_the_test(virtual_ros):
    virtual_ros.add(Server)

    class Asker(Node):
        def __init__(self):
            super().__init__("asker")
            self.client = self.create_client(Trigger, "ask")
            self.create_timer(1.0, lambda: self.client.call(Trigger.Request()))

    virtual_ros.add(Asker)
    with pytest.raises(DeadlockError, match="/asker waits"):
        virtual_ros.run(5)


def test_a_callback_may_wait_for_what_the_test_does_next(virtual_ros):
    class Starter(Node):
        def __init__(self):
            super().__init__("starter")
            self.timer = self.create_timer(1.0, self.start)

        def start(self):
            self.timer.cancel()
            _, message = wait_for_message(Float32, self, "go")
            self.get_logger().info(f"go at {message.data}")

    virtual_ros.add(Starter)
    virtual_ros.run(5)
    virtual_ros.publish("go", Float32(data=3.0))
    virtual_ros.run(1)
    assert [(line.time, line.text) for line in virtual_ros.logs()] == [(5.0, "go at 3.0")]


@pytest.mark.parametrize("code", [0, None])
def test_a_node_that_exits_well_fails_nothing(virtual_ros, code):
    node = virtual_ros.add(lambda: Node("leaver"))
    node.create_timer(1.0, lambda: sys.exit(code))
    virtual_ros.run(5)


@pytest.mark.parametrize("code", [3, "out of tea"])
def test_a_node_that_exits_with_a_code_fails_the_test(virtual_ros, says, code):
    node = virtual_ros.add(lambda: Node("leaver"))
    node.create_timer(1.0, lambda: sys.exit(code))
    with pytest.raises(ExitCodeError) as raised:
        virtual_ros.run(5)
    says(raised.value, f"/leaver ended with exit code {code if code == 3 else 1}.")


def spin():
    rclpy.init()
    rclpy.spin(Node("spinner"))


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGKILL])
def test_a_program_that_a_signal_has_ended_fails_nothing(virtual_ros, number):
    program = virtual_ros.spawn(spin)
    virtual_ros.run(1)
    program.send_signal(number)
    assert program.returncode == -number
    virtual_ros.run(1)


def test_a_program_that_answers_a_signal_with_an_exception_fails_the_test(virtual_ros):
    """As on a robot: `spin` raises, and the exit code is 1."""
    program = virtual_ros.spawn(spin)
    virtual_ros.run(1)
    program.terminate()
    assert program.returncode == 1
    with pytest.raises(ExternalShutdownException):
        virtual_ros.run(1)


def test_the_test_may_look_at_the_exit_code_itself(virtual_ros):
    def late():
        time.sleep(2.0)
        sys.exit(7)

    at_once = virtual_ros.spawn(lambda: sys.exit(2), check=False)
    later = virtual_ros.spawn(late, check=False)
    virtual_ros.run(5)
    assert (at_once.returncode, later.returncode) == (2, 7)
    virtual_ros.spawn(late)
    with pytest.raises(ExitCodeError, match="late ended with exit code 7"):
        virtual_ros.run(5)


def test_an_exception_of_a_program_can_be_expected(virtual_ros):
    def crash():
        time.sleep(1.0)
        raise RuntimeError("no network")

    virtual_ros.spawn(crash)
    with virtual_ros.expect_fault(RuntimeError) as fault:
        virtual_ros.run(5)
    assert (fault.node, fault.callback, fault.time) == ("crash", "main", 1.0)


# Messages.


def test_a_message_comes_at_its_time(virtual_ros):
    listener = virtual_ros.add(Listener)
    virtual_ros.publish("count", 30, at=1.5)
    virtual_ros.publish("/count", Int32(data=20), at=0.5)
    virtual_ros.run(1)
    assert listener.heard == [20]
    virtual_ros.run(1)
    assert listener.heard == [20, 30]
    assert [sample.time for sample in virtual_ros.messages("count")] == [0.5, 1.5]
    first, second = listener.times
    assert second - first == 1_000_000_000


def test_a_message_of_any_type_needs_no_subscription(virtual_ros):
    virtual_ros.publish("warmth", Float32(data=3.0))
    virtual_ros.run(0)
    assert [sample.value for sample in virtual_ros.messages("warmth")] == [3.0]


@pytest.mark.parametrize(
    ("arguments", "options", "error", "words"),
    [
        (("nowhere", 1), {}, SessionError, "No node subscribes to /nowhere"),
        (("count", "warm"), {}, SessionError, "does not fit into std_msgs/msg/Int32"),
        (("count", {"value": 1}), {}, SessionError, "does not fit"),
        (("count", 1), {"at": 0.5}, SessionError, "has passed: it is 1 s"),
        (("count", 1), {"at": -1}, DurationError, "negative"),
        ((7, 1.0), {}, SessionError, "a name is a string"),
    ],
)
def test_what_cannot_be_published_is_explained(virtual_ros, says, arguments, options, error, words):
    virtual_ros.add(Listener)
    virtual_ros.run(1)
    with pytest.raises(error) as raised:
        virtual_ros.publish(*arguments, **options)
    says(raised.value, words)


def test_dicts_fill_fields_of_messages_in_messages(virtual_ros):
    heard = []
    node = virtual_ros.add(lambda: Node("navigator"))
    node.create_subscription(NavigationPath, "path", heard.append, 10)
    pose = {"pose": {"position": {"x": 1.5}}}
    virtual_ros.publish("path", {"header": {"frame_id": "map"}, "poses": [pose, pose]})
    virtual_ros.run(0)
    (path,) = heard
    assert (path.header.frame_id, len(path.poses)) == ("map", 2)
    assert path.poses[1].pose.position.x == 1.5
    with pytest.raises(SessionError, match="Pose has no field `place`"):
        virtual_ros.publish("path", {"poses": [{"pose": {"place": 1}}]})


def test_a_silent_topic_has_no_messages_and_an_unknown_one_is_an_error(virtual_ros, says):
    virtual_ros.add(Listener)
    assert virtual_ros.messages("count") == ()
    with pytest.raises(UnknownTopicError) as raised:
        virtual_ros.messages("cuont")
    says(raised.value, "No messages were published on /cuont")
    with pytest.raises(UnknownTopicError):
        virtual_ros.messages("rosout")


# Waiting.


def test_run_until_returns_what_has_come_true_at_its_moment(virtual_ros):
    listener = virtual_ros.add(Listener)
    virtual_ros.publish("count", 4, at=2.5)
    assert virtual_ros.run_until(lambda: listener.heard) == [4]
    assert virtual_ros.time == 2.5
    assert virtual_ros.run_until(lambda: "already") == "already"
    assert virtual_ros.time == 2.5


def test_run_until_gives_up_and_quotes_the_condition(virtual_ros, says):
    listener = virtual_ros.add(Listener)
    virtual_ros.run(1)
    with pytest.raises(TimeUpError) as raised:
        virtual_ros.run_until(lambda: listener.heard, within=4)
    says(raised.value, "`virtual_ros.run_until(lambda: listener.heard, within=4)`", "[] after 4 s")
    assert virtual_ros.time == 5.0

    def never():
        return None

    with pytest.raises(TimeUpError, match="`never` is still None"):
        virtual_ros.run_until(never)
    with pytest.raises(DurationError, match="run_until"):
        virtual_ros.run_until(never, within=-1)


def test_run_until_raises_what_a_node_raises(virtual_ros):
    virtual_ros.add(Bomb)
    with pytest.raises(ValueError, match="boom"):
        virtual_ros.run_until(lambda: False)


def test_an_exception_of_the_condition_is_the_tests(virtual_ros):
    virtual_ros.add(Talker)
    with pytest.raises(IndexError):
        virtual_ros.run_until(lambda: virtual_ros.logs()[0])
    virtual_ros.run(3)
    assert len(virtual_ros.messages("count")) == 3


def test_an_exception_ends_a_wait_in_live_mode(virtual_ros):
    node = virtual_ros.add(lambda: Node("live"))
    node.create_timer(0.01, lambda: 1 / 0)
    virtual_ros.start()
    with pytest.raises(ZeroDivisionError):
        virtual_ros.wait(30)
    assert virtual_ros.time < 30


def test_a_live_session_waits_for_a_condition(virtual_ros):
    ticks = []
    node = virtual_ros.add(lambda: Node("live"))
    node.create_timer(0.01, lambda: ticks.append(1))
    virtual_ros.start()
    assert virtual_ros.wait(30, until=lambda: len(ticks) > 2)


# Services, actions and parameters.


class Switch(Node):
    def __init__(self):
        super().__init__("switch")
        self.declare_parameter("name", "lamp")
        self.create_service(SetBool, "switch", self.switch)

    def switch(self, request, response):
        response.success, response.message = request.data, self.get_parameter("name").value
        return response


def test_a_service_answers(virtual_ros):
    virtual_ros.add(Switch)
    response = virtual_ros.call("switch", {"data": True})
    assert (response.success, response.message) == (True, "lamp")
    assert not virtual_ros.call("/switch", SetBool.Request(data=False)).success
    assert not virtual_ros.call("switch").success
    assert virtual_ros.time == 0.0


def test_a_service_may_come_later_and_take_time(virtual_ros):
    class Slow(Switch):
        def switch(self, request, response):
            time.sleep(3.0)
            return super().switch(request, response)

    def program():
        time.sleep(2.0)
        rclpy.init()
        rclpy.spin(Slow())

    virtual_ros.spawn(program)
    assert virtual_ros.call("switch", {"data": True}).success
    assert virtual_ros.time == 5.0
    with pytest.raises(TimeUpError, match="/switch has not answered within 2 s"):
        virtual_ros.call("switch", {"data": True}, within=2)


def test_what_cannot_be_called_is_explained(virtual_ros, says):
    virtual_ros.add(Switch)
    with pytest.raises(UnknownServerError) as raised:
        virtual_ros.call("swich", within=1)
    says(raised.value, "No node offers the service /swich", "Did you mean /switch?")
    assert virtual_ros.time == 1.0
    for fields in ({"date": True}, {"data": "on"}):
        with pytest.raises(SessionError) as raised:
            virtual_ros.call("switch", fields)
        says(raised.value, "does not fit into std_srvs/srv/SetBool")
    with pytest.raises(UnknownServerError, match="No node offers the action /fibonacci"):
        virtual_ros.send_goal("fibonacci", within=1)
    with pytest.raises(CallError):
        virtual_ros.call()


def test_parameters_are_set_as_a_command_sets_them(virtual_ros, says):
    node = virtual_ros.add(Switch)
    virtual_ros.set_parameters("switch", {"name": "heater"})
    assert virtual_ros.call("switch").message == "heater"
    virtual_ros.set_parameters(node, {"name": "fan"})
    assert virtual_ros.call("switch").message == "fan"
    with pytest.raises(ParameterError) as raised:
        virtual_ros.set_parameters("switch", {"nam": "lamp"})
    says(raised.value, "/switch refused nam: ")
    with pytest.raises(UnknownServerError):
        virtual_ros.set_parameters("swatch", {"name": "lamp"}, within=1)


def test_a_goal_that_takes_too_long_is_told(virtual_ros, says):
    class Sleeper(Node):
        def __init__(self):
            super().__init__("sleeper")
            self.server = ActionServer(self, Fibonacci, "fibonacci", self.work)

        def work(self, goal):
            goal.publish_feedback(Fibonacci.Feedback(sequence=[1]))
            time.sleep(100.0)
            goal.succeed()
            return Fibonacci.Result()

    virtual_ros.add(Sleeper)
    with pytest.raises(TimeUpError) as raised:
        virtual_ros.send_goal("fibonacci", {"order": 1}, within=10)
    says(raised.value, "was accepted, but has not ended within 10 s", "1 feedback message")


# Log lines.


class Chatterbox(Node):
    """Logs in all levels once a second."""

    def __init__(self):
        super().__init__("chatterbox", namespace="/house")
        self.create_timer(1.0, self.chat)

    def chat(self):
        log = self.get_logger()
        log.debug("nobody asked")
        log.info("in 100 %")
        log.warning("careful")
        log.error("wrong")
        log.fatal("over")


def test_log_lines_come_to_caplog_with_levels_places_and_times(virtual_ros, caplog):
    virtual_ros.add(Chatterbox)
    virtual_ros.run(1)
    assert caplog.record_tuples == [
        ("ros.house.chatterbox", logging.INFO, "in 100 %"),
        ("ros.house.chatterbox", logging.WARNING, "careful"),
        ("ros.house.chatterbox", logging.ERROR, "wrong"),
        ("ros.house.chatterbox", logging.CRITICAL, "over"),
    ]
    record = caplog.records[0]
    assert (record.filename, record.funcName, record.ros_time) == ("test_testing.py", "chat", 1.0)
    assert 'log.info("in 100 %")' in Path(__file__).read_text().splitlines()[record.lineno - 1]


def test_a_quiet_run_logs_nothing_and_the_next_one_does(virtual_ros, caplog, capsys):
    virtual_ros.add(Chatterbox)
    virtual_ros.run(200, quiet=True)
    assert caplog.records == []
    assert len(virtual_ros.logs()) == 800
    virtual_ros.run(200)
    assert len(caplog.records) == 800
    assert capsys.readouterr().out == ""


def test_levels_of_caplog_count(virtual_ros, caplog):
    virtual_ros.add(Chatterbox)
    with caplog.at_level(logging.ERROR, logger="ros.house.chatterbox"):
        virtual_ros.run(1)
    assert [record.levelname for record in caplog.records] == ["ERROR", "CRITICAL"]


# Options.


@pytest.mark.virtual_ros(seed=3, threads=2)
class TestOptions:
    def test_a_marker_gives_options(self, virtual_ros):
        assert virtual_ros.observation().seed == 3

    @pytest.mark.virtual_ros(seed=4)
    def test_the_nearest_marker_counts(self, virtual_ros):
        assert virtual_ros.observation().seed == 4

    @pytest.mark.parametrize("virtual_ros", [5, {"seed": 5}], indirect=True)
    def test_a_parameter_counts_most(self, virtual_ros):
        assert virtual_ros.observation().seed == 5


@pytest.mark.parametrize(
    ("virtual_ros", "threads"), [({}, 4), ({"threads": 2}, 2)], indirect=["virtual_ros"]
)
def test_an_executor_without_a_number_has_the_threads_of_the_session(virtual_ros, threads):
    """On every machine the same, whatever its number of processors."""
    begun = []

    def program():
        rclpy.init()
        node = Node("busy")
        for _ in range(10):
            node.create_timer(1.0, work, callback_group=ReentrantCallbackGroup())
        executor = MultiThreadedExecutor()
        executor.add_node(node)
        executor.spin()

    def work():
        begun.append(1)
        time.sleep(100.0)

    virtual_ros.spawn(program)
    virtual_ros.run(10)
    assert len(begun) == threads


@pytest.mark.parametrize(
    ("options", "error"),
    [({"threads": 1}, SessionError), ({"seed": -1}, SessionError), ({"sead": 1}, CallError)],
)
def test_an_option_that_cannot_be_is_refused(options, error):
    with pytest.raises(error):
        TestSession(**options)


def test_another_middleware_is_refused(monkeypatch, says):
    monkeypatch.setattr(rclpy, "get_rmw_implementation_identifier", lambda: "rmw_cyclonedds_cpp")
    with pytest.raises(SessionError) as raised:
        TestSession()
    says(raised.value, "this process uses rmw_cyclonedds_cpp", "RMW_IMPLEMENTATION=rmw_fastrtps")


# Nothing of the course.


def test_errors_of_a_test_speak_of_no_page(virtual_ros, capsys):
    def act(node):
        raise ZeroDivisionError

    virtual_ros.add(lambda: Doer(act))
    with virtual_ros.expect_fault(ZeroDivisionError):
        virtual_ros.run(1)
    told = capsys.readouterr().err
    assert "then run the test again." in told
    assert not re.search(r"\bcell\b|\bpage\b", told)
