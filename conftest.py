"""Pages are tests: see `tests/notebooks`."""

from hypothesis import settings

# How long an example takes says more about what else the machine does.
settings.register_profile("rosbeat", deadline=None)
settings.load_profile("rosbeat")

pytest_plugins = ["notebooks.plugin", "pytester"]

# The finished package of the course: `colcon test` runs its tests, from tests/solutions.
collect_ignore = ["solutions/sensor_simulator"]
