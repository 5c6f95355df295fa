"""A JupyterHub with real users of the system.

It needs root and some minutes, so it runs only when it is named:
`./environment/course test tests/hub`.
"""

from pathlib import Path

import pytest

from hub.machine import installation, missing, running_hub, users

HERE = Path(__file__).parent
#: A class.
LEARNERS = 20


def pytest_ignore_collect(collection_path, config):
    """Leave the folder out unless somebody names it."""
    named = [Path(argument.split("::")[0]).resolve() for argument in config.args]
    is_meant = any(path == HERE or HERE in path.parents for path in named)
    return None if is_meant else True


@pytest.fixture(scope="session")
def hub(tmp_path_factory):
    """A hub from a shared installation, with a class that can log in."""
    reason = missing()
    if reason:
        pytest.skip(reason)
    log = tmp_path_factory.mktemp("hub") / "hub.log"
    with (
        installation() as course,
        users(LEARNERS, course.parent / "homes") as (group, members),
        running_hub(course, group, members, log) as made,
    ):
        yield made
