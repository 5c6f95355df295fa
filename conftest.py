"""Pages are tests: see `tests/notebooks`."""

pytest_plugins = ["notebooks.plugin", "pytester"]
