from glob import glob

from setuptools import find_packages, setup

package_name = 'rosie'

setup(
    name=package_name,
    version='0.1.1',
    packages=find_packages(exclude=['test']),
    data_files=[
        ('share/ament_index/resource_index/packages',
            ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml']),
        ('share/' + package_name + '/launch', glob('launch/*')),
        ('share/' + package_name + '/config', glob('config/*')),
    ],
    install_requires=['setuptools'],
    zip_safe=True,
    maintainer='rosbeat',
    maintainer_email='rosbeat@example.com',
    description='Rosie, a robot in a greenhouse: drive her, ask her, watch her thermometer.',
    license='Apache-2.0',
    extras_require={'test': ['pytest']},
    entry_points={
        'console_scripts': [
            'computer_thermometer = rosie.computer_thermometer:main',
            'rover = rosie.rover:main',
            'teleop = rosie.teleop:main',
            'thermometer = rosie.thermometer:main',
        ],
    },
)
