"""Pages are tests: see `tests/notebooks`."""

from collections.abc import Iterator

import pytest
from hypothesis import settings

# How long an example takes says more about what else the machine does.
settings.register_profile("rosbeat", deadline=None)
settings.load_profile("rosbeat")

pytest_plugins = ["notebooks.plugin", "pytester"]


@pytest.fixture(autouse=True, scope="session")
def _somebody_elses_progress(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """Whoever proves the course on their machine keeps the progress they have made in it."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ROSBEAT_PROGRESS_IN", str(tmp_path_factory.mktemp("progress")))
        yield


# The finished package of the course: `colcon test` runs its tests, from tests/solutions.
collect_ignore = ["solutions/sensor_simulator"]
