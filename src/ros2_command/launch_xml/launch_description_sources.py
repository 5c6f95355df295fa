"""Read launch files in XML; `launch.frontend` does it."""

from launch.launch_description_sources import (
    FrontendLaunchDescriptionSource as XMLLaunchDescriptionSource,
)

__all__ = ["XMLLaunchDescriptionSource"]
