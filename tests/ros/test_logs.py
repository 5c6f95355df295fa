"""Log lines: from every logger, as rclpy writes them, and heard by their own session only."""

import gc
import threading
import time
import weakref
from functools import partial

import pytest
import rclpy
import rclpy.logging
from rcl_interfaces.msg import Log
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.logging import LoggingSeverity
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data

from nodes import Doer, Listener, Speaker, Talker
from rosbeat import Session

pytestmark = pytest.mark.ros


def said(ros, node=None):
    return [(line.level, line.text) for line in ros.logs(node)]


def named(ros):
    return [(line.name, line.text) for line in ros.logs()]


def test_one_place_with_two_levels(ros):
    logger = ros.add(lambda: Node("two")).get_logger()
    for name in ("info", "error", "info"):
        if name == "info":
            logger.info("x")
        else:
            logger.error("x")
    assert [level for level, _ in said(ros)] == ["INFO", "ERROR", "INFO"]


# Filters.


def test_filters(ros):
    def do(node):
        node.get_logger().info("once", once=True)
        node.get_logger().info("skip", skip_first=True)
        node.get_logger().info("throttled", throttle_duration_sec=2.5)

    ros.add(partial(Doer, do))
    ros.run(6, quiet=True)
    texts = [text for _, text in said(ros)]
    assert texts.count("once") == 1
    assert texts.count("skip") == 5
    # The first one comes at once: on a robot, the clock is never near zero.
    assert [line.time for line in ros.logs() if line.text == "throttled"] == [1, 4]


def test_several_filters(ros):
    def do(node):
        node.get_logger().info("both", throttle_duration_sec=2.5, once=True)
        node.get_logger().info("third", throttle_duration_sec=2.5, skip_first=True)

    ros.add(partial(Doer, do))
    ros.run(9, quiet=True)
    assert [(line.time, line.text) for line in ros.logs()] == [
        (1, "both"), (4, "third"), (7, "third"),
    ]  # fmt: skip


MODULE = rclpy.logging.get_logger("module")


def once_and_throttled(_):
    MODULE.info("once", once=True)
    MODULE.info("throttled", throttle_duration_sec=2.5)


def test_a_logger_of_a_module_begins_anew_in_each_process_and_session():
    for _ in range(2):
        with Session() as ros:
            ros.add(partial(Doer, once_and_throttled, "one"))
            ros.add(partial(Doer, once_and_throttled, "two"))
            ros.run(3, quiet=True)
            assert [(line.time, line.text) for line in ros.logs()] == [
                (1, "once"), (1, "throttled"), (1, "once"), (1, "throttled"),
            ]  # fmt: skip


# Which loggers: a module's, a helper's, a child, and rclpy's own.


def helper():
    return rclpy.logging.get_logger("helper").get_child("part")


def test_lines_of_every_logger_are_recorded_and_printed(ros, capsys):
    def do(node):
        node.get_logger().get_child("child").warning("of a child")
        MODULE.info("of a module")
        helper().error("of a helper")

    ros.add(partial(Doer, do))
    ros.run(1)
    MODULE.info("of a cell")
    assert named(ros) == [
        ("doer.child", "of a child"),
        ("module", "of a module"),
        ("helper.part", "of a helper"),
        ("module", "of a cell"),
    ]
    assert capsys.readouterr().out.splitlines() == [
        "[WARN] [1.000] [doer.child]: of a child",
        "[INFO] [1.000] [module]: of a module",
        "[ERROR] [1.000] [helper.part]: of a helper",
        "[INFO] [1.000] [module]: of a cell",
    ]
    line = ros.logs()[1]
    assert line.function == "do"


def test_both_sides_warn_of_incompatible_qos_as_in_rclpy(ros, capsys):
    ros.add(partial(Talker, qos=qos_profile_sensor_data))
    ros.run(1)
    assert ros.logs() == ()
    ros.add(Listener)
    ros.run(3)
    assert [(line.time, line.level, line.name, line.text) for line in ros.logs()] == [
        (
            1,
            "WARN",
            "talker",
            "New subscription discovered on topic 'count', requesting incompatible QoS. No "
            "messages will be sent to it. Last incompatible policy: RELIABILITY",
        ),
        (
            1,
            "WARN",
            "listener",
            "New publisher discovered on topic 'count', offering incompatible QoS. No messages "
            "will be received from it. Last incompatible policy: RELIABILITY",
        ),
    ]
    assert capsys.readouterr().out.count("[WARN] [1.000] ") == 2


def test_the_main_of_a_program(ros, capsys):
    def main():
        MODULE.info("before init")
        rclpy.init()
        rclpy.logging.get_logger("main").info("ready")
        rclpy.shutdown()

    ros.spawn(main)
    assert named(ros) == [("module", "before init"), ("main", "ready")]
    assert "[INFO] [0.000] [main]: ready" in capsys.readouterr().out


# Levels: each simulated process has its own.


def test_levels_belong_to_a_process(ros):
    def speak(_, level=None):
        if level:
            rclpy.logging.set_logger_level("module", level)
        MODULE.debug("detail")
        MODULE.info("news")

    ros.add(partial(Doer, partial(speak, level=LoggingSeverity.DEBUG), "chatty"))
    ros.add(partial(Doer, partial(speak, level=LoggingSeverity.WARN), "quiet"))
    ros.add(partial(Doer, speak, "plain"))
    ros.run(1, quiet=True)
    assert said(ros) == [("DEBUG", "detail"), ("INFO", "news"), ("INFO", "news")]
    with Session() as other:
        MODULE.debug("detail")
        assert other.logs() == ()
    assert rclpy.logging.get_logger_level("module") == LoggingSeverity.UNSET


def test_a_cell_sets_the_level_of_all_processes_that_have_set_none(ros):
    node = ros.add(partial(Doer, lambda node: node.get_logger().debug("detail"), "chatty"))
    ros.run(1, quiet=True)
    node.get_logger().set_level(LoggingSeverity.DEBUG)
    ros.run(1, quiet=True)
    assert [line.time for line in ros.logs()] == [2]
    rclpy.logging.set_logger_level("chatty", LoggingSeverity.UNSET)
    ros.run(1, quiet=True)
    assert [line.time for line in ros.logs()] == [2]


def test_a_logger_without_a_level_has_that_of_its_parent(ros):
    levels = []

    def do(node):
        logger = node.get_logger().get_child("part").get_child("piece")
        for name, level in (("doer", 40), ("doer.part", 10), ("doer.part", 0), ("", 50)):
            rclpy.logging.set_logger_level(name, level)
            levels.append(int(logger.get_effective_level()))
        rclpy.logging.set_logger_level("doer", 0)
        levels.append(int(logger.get_effective_level()))
        levels.append(int(rclpy.logging.get_logger_level("doer")))
        levels.append(logger.is_enabled_for(LoggingSeverity.ERROR))

    ros.add(partial(Doer, do))
    ros.run(1, quiet=True)
    assert levels == [40, 10, 40, 40, 50, 0, False]


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        ([], ["news"]),
        (["--log-level", "debug"], ["detail", "news", "noise"]),
        (["--log-level", "module:=DEBUG"], ["detail", "news"]),
        (["--log-level", "warn", "--log-level", "other:=debug"], ["noise"]),
    ],
)
@pytest.mark.parametrize("how", ["argv", "args"])
def test_log_level_of_a_program(ros, how, arguments, expected):
    words = ["--ros-args", *arguments] if arguments else []

    def main():
        rclpy.init(args=words if how == "args" else None)
        MODULE.debug("detail")
        MODULE.info("news")
        rclpy.logging.get_logger("other").debug("noise")

    ros.spawn(main, *(words if how == "argv" else []))
    assert [text for _, text in said(ros)] == expected


def test_a_logger_of_a_module_keeps_no_session_alive():
    with Session() as ros:
        ros.add(partial(Doer, once_and_throttled))
        ros.run(3, quiet=True)
        core = weakref.ref(ros._core)
    del ros
    gc.collect()
    assert core() is None


# `/rosout`.


def test_a_node_can_listen_to_rosout_in_virtual_time(ros):
    heard = []
    ear = ros.add(lambda: Node("ear"))
    ear.create_subscription(Log, "/rosout", lambda line: heard.append((ros.time, line.msg)), 10)
    ros.add(Speaker)
    ros.run(2, quiet=True)
    assert heard == [(1, "here is speaker"), (2, "here is speaker")]


def test_details_get_to_rosout_if_their_process_wants_them(ros):
    heard = []
    ear = ros.add(lambda: Node("ear"))
    ear.create_subscription(Log, "/rosout", lambda line: heard.append(line.msg), 10)

    def do(node):
        node.get_logger().set_level(LoggingSeverity.DEBUG)
        for number in range(2):
            node.get_logger().debug(f"detail {number}")

    ros.add(partial(Doer, do))
    ros.run(1, quiet=True)
    assert heard == ["detail 0", "detail 1"]


def test_a_program_without_rosout(ros):
    def main():
        rclpy.init(args=["--ros-args", "--disable-rosout-logs"])
        rclpy.spin(Speaker())

    program = ros.spawn(main)
    ros.run(1, quiet=True)
    assert named(ros) == [("speaker", "here is speaker")]
    names = [publisher.topic_name for publisher in program.nodes[0].publishers]
    assert names == ["/parameter_events"]
    assert program.nodes[0].count_publishers("/rosout") == 0


def test_logs_of_a_removed_node_can_be_read(ros):
    speaker = ros.add(Speaker)
    ros.run(1, quiet=True)
    ros.remove(speaker)
    assert len(ros.logs(speaker)) == 1


# Whose lines: two sessions in two threads, and rclpy outside of all sessions.


def test_a_live_session_hears_its_own_module_logger(eventually):
    with Session() as live:
        live.add(partial(Doer, lambda _: MODULE.info("live"), period=0.01))
        live.start()
        with Session() as ros:
            ros.add(partial(Doer, lambda _: MODULE.info("virtual")))
            eventually(lambda: live.logs(), 30)
            ros.run(3, quiet=True)
            assert [text for _, text in said(ros)] == ["virtual"] * 3
        live.stop()
        assert {text for _, text in said(live)} == {"live"}


def test_plain_rclpy_in_another_thread_is_left_alone(ros, eventually):
    logged = []

    def do(_):
        logged.append(MODULE.info("outside"))

    context = Context()
    context.init([], domain_id=ros._core.context.get_domain_id())
    node = Node("outside", context=context)
    node.create_timer(0.01, partial(do, node))
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    thread = threading.Thread(target=executor.spin, daemon=True)
    thread.start()
    eventually(lambda: logged, 30)
    ros.add(partial(Doer, lambda _: time.sleep(0.1)))
    ros.run(1)
    executor.shutdown()
    thread.join(30)
    node.destroy_node()
    context.try_shutdown()
    assert all(logged)
    assert ros.logs() == ()
