"""Read launch files in YAML; `launch.frontend` does it."""

from launch.launch_description_sources import (
    FrontendLaunchDescriptionSource as YAMLLaunchDescriptionSource,
)

__all__ = ["YAMLLaunchDescriptionSource"]
