"""Start Rosie and her thermometer."""

import os

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    """Describe two nodes, with their parameters from a file."""
    settings = os.path.join(get_package_share_directory('rosie'), 'config', 'rosie.yaml')
    return LaunchDescription([
        DeclareLaunchArgument(
            'period', default_value='1.0', description='Seconds from one reading to the next'),
        Node(package='rosie', executable='rover', output='screen', parameters=[settings]),
        Node(
            package='rosie',
            executable='thermometer',
            output='screen',
            parameters=[settings, {'period': LaunchConfiguration('period')}],
        ),
    ])
