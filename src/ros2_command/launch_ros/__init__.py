"""Describe ROS nodes to start: the part of ROS 2's `launch_ros` that nodes in Python need."""

from launch.errors import left_out

from launch_ros import actions, descriptions, substitutions, tags, utilities

__all__ = ["actions", "descriptions", "substitutions", "tags", "utilities"]

__getattr__ = left_out(__name__, "event_handlers", "events", "ros_adapters")
