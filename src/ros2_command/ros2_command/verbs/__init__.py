"""The verbs: one module each, listed in `ros2_command.registry`."""
