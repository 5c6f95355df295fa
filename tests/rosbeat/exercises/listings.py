"""The complete listings of the tutorial as they stand."""

from pathlib import Path

_TUTORIAL = Path(__file__).resolve().parents[2] / "conformance" / "tutorial"

PUBLISHER, SUBSCRIBER = (
    (_TUTORIAL / f"temperature_{name}.py").read_text("utf-8")
    for name in ("publisher", "subscriber")
)

SETUP = """\
from setuptools import find_packages, setup

package_name = 'sensor_simulator'

setup(
    name=package_name,
    version='0.0.0',
    packages=find_packages(exclude=['test']),    data_files=[
        ('share/ament_index/resource_index/packages',
            ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml']),
    ],
    install_requires=['setuptools'],
    zip_safe=True,
    maintainer='janak',
    maintainer_email='janak.klal@gmail.com',
    description='TODO: Package description',
    license='TODO: License declaration',
    extras_require={
        'test': [
            'pytest',
        ],
    },
    entry_points={
    'console_scripts': [
        'temperature_publisher = sensor_simulator.temperature_publisher:main',
        'temperature_subscriber = sensor_simulator.temperature_subscriber:main',
    ],
},
)
"""
