"""Name the type of objects that carry no type information."""

from __future__ import annotations

from typing import Any, TypeAlias

#: An object of rclpy or of a message package, or a value from YAML: no tool can check these.
Untyped: TypeAlias = Any
