"""A pytest plugin: the fixture `ros` gives a session, so tests of ROS nodes take milliseconds.

`docs/testing.md` shows how to use it. pytest loads this module wherever rosbeat is installed, so
ROS is imported only when a test asks for the fixture.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from rosbeat.testing import TestSession


@pytest.fixture
def ros(request: pytest.FixtureRequest) -> Iterator[TestSession]:
    """Give a test a session of its own in virtual time, with `publish` for what nodes are to hear.

    Its seed is 0; `@pytest.mark.parametrize("ros", [1, 2, 3], indirect=True)` runs a test with
    other seeds. The session ends with the test, and its nodes with it.
    """
    from rosbeat.testing import TestSession

    with TestSession(seed=getattr(request, "param", 0)) as session:
        yield session
