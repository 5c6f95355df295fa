"""Tell tests on which distribution of ROS they run, for what rclpy itself does differently."""

from rosbeat import environment

IS_KILTED = environment.distribution() == "kilted"

#: Of the error of a second shutdown.
ALREADY_SHUT_DOWN = (
    "Context already shutdown." if IS_KILTED else "rcl_shutdown already called on the given context"
)
