"""Fixtures of tests with sessions: each test owns its own."""

import time
from collections.abc import Callable, Iterator

import pytest

from rosbeat import Session
from rosbeat.domains import lease_domain
from rosbeat.errors import RosbeatError


@pytest.fixture
def ros() -> Iterator[Session]:
    with Session(seed=1) as session:
        yield session


@pytest.fixture
def empty_domain() -> Iterator[int]:
    """Return the id of a domain that nobody has joined."""
    lease = lease_domain()
    yield lease.domain_id
    lease.release()


@pytest.fixture
def slept(monkeypatch: pytest.MonkeyPatch) -> list[float]:
    """Note for how long somebody really sleeps; a session that is made later is noticed, too."""
    spans: list[float] = []
    really = time.sleep

    def sleep(seconds: float) -> None:
        spans.append(seconds)
        really(seconds)

    monkeypatch.setattr(time, "sleep", sleep)
    return spans


@pytest.fixture
def eventually() -> Callable[[Callable[[], object], float], None]:
    """Wait until a predicate is true; fail when the deadline comes first."""

    def wait(predicate: Callable[[], object], seconds: float = 10.0) -> None:
        deadline = time.monotonic() + seconds
        while not predicate():
            assert time.monotonic() < deadline, "the deadline came first"
            time.sleep(0.005)

    return wait


@pytest.fixture
def says() -> Callable[[RosbeatError, str], None]:
    """Check that an error has its three parts, and a text in one of them."""

    def check(error: RosbeatError, *texts: str) -> None:
        assert error.what
        assert error.means
        assert error.to_try
        for text in texts:
            assert text in str(error)

    return check
