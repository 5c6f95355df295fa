"""Provide the `ros2` command for installations of ROS 2 without ros2cli."""
