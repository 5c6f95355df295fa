"""A pytest plugin: the fixture `virtual_ros` gives a session, so tests of nodes take milliseconds.

`docs/testing.md` shows how to use it. pytest loads this module wherever rosbeat is installed, so
ROS is imported only when a test asks for the fixture.
"""

from __future__ import annotations

import sys
from collections.abc import Generator, Iterator
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from rosbeat.testing import TestSession

_MARKER = (
    "virtual_ros(seed=0, threads=4, ...): what the fixture `virtual_ros` gives its session: the "
    "arguments of `rosbeat.testing.TestSession`"
)


def pytest_configure(config: pytest.Config) -> None:
    """Make the marker known, so that `--strict-markers` accepts it."""
    config.addinivalue_line("markers", _MARKER)


@pytest.fixture
def virtual_ros(request: pytest.FixtureRequest) -> Iterator[TestSession]:
    """Give a test a session of its own, in virtual time.

    The session is a `rosbeat.testing.TestSession`, and ends with the test. Options come from
    `@pytest.mark.virtual_ros(seed=7)`, on a test, a class or a module, or from
    `@pytest.mark.parametrize("virtual_ros", [1, 2, 3], indirect=True)`, which runs a test with
    several seeds; a dict there holds several options.
    """
    from rosbeat.testing import TestSession

    session = TestSession(**_options(request))
    yield session
    # Not in a `with` block: what nodes have raised was raised in the test, or at its end.
    session.close()


def _options(request: pytest.FixtureRequest) -> dict[str, Any]:
    """Return the options of a session; those nearest to the test count."""
    options: dict[str, Any] = {}
    for marker in reversed(list(request.node.iter_markers("virtual_ros"))):
        options |= marker.kwargs
    chosen = getattr(request, "param", {})
    return options | (dict(chosen) if isinstance(chosen, dict) else {"seed": chosen})


@pytest.hookimpl(wrapper=True)
def pytest_runtest_call() -> Generator[None, Any, Any]:
    """Fail a test in whose sessions a node has raised something that the test has not got yet."""
    __tracebackhide__ = True
    result = yield
    testing = sys.modules.get("rosbeat.testing")
    if testing is not None:
        for session in testing.open_sessions():
            session.raise_faults()
    return result
