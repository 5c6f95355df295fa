"""Offer launch files in XML in the place where the original has them."""

from launch_xml import launch_description_sources

__all__ = ["launch_description_sources"]
