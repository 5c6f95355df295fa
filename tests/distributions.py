"""Tell tests on which distribution of ROS they run, for what rclpy itself does differently."""

import rclpy

# Not by `rosbeat`, which patches rclpy: the real side of conformance asks here, too.
IS_KILTED = hasattr(rclpy, "InitContextManager")

#: Names a file with settings of Fast DDS. Release 3 prints a warning about the old name.
PROFILE_VARIABLE = (
    "FASTDDS_DEFAULT_PROFILES_FILE" if IS_KILTED else "FASTRTPS_DEFAULT_PROFILES_FILE"
)

#: Of the error of a second shutdown.
ALREADY_SHUT_DOWN = (
    "Context already shutdown." if IS_KILTED else "rcl_shutdown already called on the given context"
)
