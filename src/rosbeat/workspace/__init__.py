"""The learner's workspace: terminals, packages, and the files that cells become. No rclpy here."""
