"""Errors of Python in a node, by the texts that rclpy gives them (mistakes 1 to 12, and 17)."""

from __future__ import annotations

import re

from rosbeat.workspace.meanings.running import last_error
from rosbeat.workspace.meanings.situation import Situation

#: Only of a node: in another program these texts mean something else.
_TEXTS = (
    (
        r"AssertionError: The '(\w+)' field must be of type '(\w+)'",
        "The field {0} of the message wants a {1}, and another type was put in. Write a {1}: "
        "25.0 is a float, 25 is an int.",
    ),
    (
        r"AssertionError: Invalid arguments passed to constructor",
        "The message has no field of that name. `ros2 interface show` lists the fields of a type; "
        "Float32 has one, `data`.",
    ),
    (
        r"TypeError: Expected .*, got <class '(?:float|int|str|NoneType)'>",
        "`publish` wants a message, and a bare value was given. Put the value into a message "
        "first: msg = Float32(), then msg.data = the value.",
    ),
    (
        r"TypeError: Expected .*Metaclass_(\w+)'>",
        "`publish` was given the class {0} itself and not a message of it. "
        "Brackets make a message: {0}()",
    ),
    (
        r"missing 1 required positional argument: 'qos_profile'",
        "An argument is missing: the queue depth is the last one, a number such as 10. A "
        "subscription needs its callback before it.",
    ),
    (
        r"rclpy_resolve_name\(\): incompatible function arguments",
        "The arguments are in another order than rclpy wants: first the message type, then the "
        "topic's name as text, then the rest.",
    ),
    (
        r"has no attribute '_TYPE_SUPPORT'",
        "What stands in the place of the message type is none. Import the class, as in "
        "`from std_msgs.msg import Float32`, and give Float32.",
    ),
    (
        r"callback should be either be callable|'NoneType' object is not callable",
        "A callback is handed over, not called: write self.temperature_callback without brackets. "
        "It takes self and the message.",
    ),
    (
        r"has no attribute '_default_callback_group'",
        "The node was used before it was made: `super().__init__('name')` has to be the first line "
        "of `__init__`.",
    ),
    (
        r"Node\.__init__\(\) missing 1 required positional argument: 'node_name'",
        "The node has no name. Give it one: super().__init__('temperature_sensor')",
    ),
    (
        r"InvalidNodeNameException|InvalidTopicNameException",
        "Names of nodes and topics hold letters, digits and `_` only, and begin with a letter.",
    ),
    (
        r"NotInitializedException",
        "`rclpy.init()` has to come before the first node. Call it as the first line of `main`.",
    ),
    (
        r"Context\.init\(\) must only be called once",
        "`rclpy.init()` was called twice. Once is enough, as the first line of `main`.",
    ),
    (
        r"does not support the context manager protocol",
        "In this version of ROS, `rclpy.init()` does not work with `with`. Call it, and at the end "
        "`rclpy.try_shutdown()`.",
    ),
)
_PLAIN = (
    (
        r"AttributeError: '(\w+)' object has no attribute '(\w+)'",
        "A {0} has nothing of the name {1}. Compare the spelling with the line where it is made.",
    ),
    (
        r"NameError: name '(\w+)' is not defined",
        "Nothing is called {0} at that line. Compare the spelling, letter by letter, with the line "
        "that defines or imports it.",
    ),
)


def no_rclpy(seen: Situation) -> str | None:
    """A Python without ROS."""
    if not seen.code or "No module named 'rclpy'" not in last_error(seen.traceback):
        return None
    return (
        "The Python that ran is not the one of the course, and it has no ROS. "
        "`which python3` shows which one a terminal uses; open a terminal from the course, or "
        "run `./environment/course shell` first."
    )


def in_a_node(seen: Situation) -> str | None:
    """An error that rclpy raises for a mistake in a node, or Python for a misspelt name."""
    last = last_error(seen.traceback)
    texts: tuple[tuple[str, str], ...] = (*_TEXTS, *_PLAIN) if seen.about_ros else _PLAIN
    for pattern, words in texts:
        found = re.search(pattern, last)
        if found:
            return words.format(*found.groups())
    return None
