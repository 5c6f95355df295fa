"""The C part of message types, loaded ahead of the first node that needs it."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from rosbeat.runtime.feeding import message_class


def load_type_support(types: Iterable[str]) -> None:
    """Load the C part of message types, which rclpy does when the first publisher is made.

    Args:
        types: Names such as `std_msgs/msg/Float32`.
    """
    for name in types:
        meta: Any = type(message_class(name))
        meta.__import_type_support__()
