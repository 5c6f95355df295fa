"""Offer what describes parameters in the other place where the original has it."""

from launch_ros.descriptions import Parameter, ParameterFile, ParameterValue

__all__ = ["Parameter", "ParameterFile", "ParameterValue"]
