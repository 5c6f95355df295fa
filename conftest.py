"""Pages are tests: see `tests/notebooks`."""

pytest_plugins = ["notebooks.plugin", "pytester"]

# The finished package of the course: `colcon test` runs its tests, from tests/solutions.
collect_ignore = ["solutions/sensor_simulator"]
