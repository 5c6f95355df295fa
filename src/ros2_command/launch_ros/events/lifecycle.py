"""Refuse the events of lifecycle nodes."""

from launch.errors import left_out

__getattr__ = left_out(__name__, "ChangeState", "StateTransition")
