"""Refuse what handles the states of lifecycle nodes."""

from launch.errors import left_out

__getattr__ = left_out(__name__, "OnStateTransition")
