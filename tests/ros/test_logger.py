"""A node's log lines: as rclpy writes them, and heard by their own session only."""

from functools import partial

import pytest
from rcl_interfaces.msg import Log
from rclpy.node import Node

from nodes import Doer, Speaker


def said(ros, node=None):
    return [(line.level, line.text) for line in ros.logs(node)]


def test_levels(ros):
    logger = ros.add(lambda: Node("n")).get_logger()
    logger.debug("not by default")
    logger.info("i")
    logger.warning("w")
    logger.error("e")
    logger.fatal("f")
    assert said(ros) == [("INFO", "i"), ("WARN", "w"), ("ERROR", "e"), ("FATAL", "f")]


def test_a_level_that_is_set_later(ros):
    from rclpy.logging import LoggingSeverity

    logger = ros.add(lambda: Node("levelled")).get_logger()
    for level in (LoggingSeverity.DEBUG, LoggingSeverity.ERROR, LoggingSeverity.INFO):
        logger.set_level(level)
        logger.debug("d")
        logger.info("i")
    assert [text for _, text in said(ros)] == ["d", "i", "i"]


def test_a_line_says_where_it_was_written(ros):
    ros.add(Speaker)
    ros.run(2, quiet=True)
    first, second = ros.logs()
    assert (first.function, first.line) == (second.function, second.line)
    assert first.function == "speak"
    assert first.line > 0


def test_one_place_with_two_levels(ros):
    logger = ros.add(lambda: Node("two")).get_logger()
    for name in ("info", "error", "info"):
        if name == "info":
            logger.info("x")
        else:
            logger.error("x")
    assert [level for level, _ in said(ros)] == ["INFO", "ERROR", "INFO"]


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
    # rclpy counts the first span from time zero, as it does with any simulated clock.
    assert [line.time for line in ros.logs() if line.text == "throttled"] == [3, 6]


def test_a_child(ros):
    child = ros.add(lambda: Node("parent")).get_logger().get_child("child")
    child.info("hello")
    assert ros.logs("parent.child")[0].text == "hello"
    assert ros.logs("parent") == ()


def test_namespaces(ros):
    node = ros.add(lambda: Node("sensor", namespace="room"))
    node.get_logger().info("hello")
    assert [line.name for line in ros.logs(node)] == ["room.sensor"]
    assert ros.logs("/room/sensor") == ros.logs(node)


def test_what_is_not_a_text_is_rclpys_error(ros):
    node = ros.add(lambda: Node("n"))
    for _ in range(2):
        with pytest.raises(TypeError):
            node.get_logger().info(25)
    assert ros.logs() == ()


def test_a_node_can_listen_to_rosout_in_virtual_time(ros):
    heard = []
    ear = ros.add(lambda: Node("ear"))
    ear.create_subscription(Log, "/rosout", lambda line: heard.append((ros.time, line.msg)), 10)
    ros.add(Speaker)
    ros.run(2, quiet=True)
    assert heard == [(1, "here is speaker"), (2, "here is speaker")]


def test_logs_of_a_removed_node_can_be_read(ros):
    speaker = ros.add(Speaker)
    ros.run(1, quiet=True)
    ros.remove(speaker)
    assert len(ros.logs(speaker)) == 1
