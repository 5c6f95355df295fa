"""Offer launch files in YAML in the place where the original has them."""

from launch_yaml import launch_description_sources

__all__ = ["launch_description_sources"]
