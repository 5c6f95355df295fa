"""The `ros2` command for installations of ROS 2 that have no ros2cli."""
