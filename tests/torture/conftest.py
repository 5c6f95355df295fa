"""The kernel that the interrupts of a file share."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from torture.kernel import FULL, Kernel


@pytest.fixture(scope="function" if FULL else "module")
def kernel(request: pytest.FixtureRequest) -> Iterator[Kernel]:
    """A kernel that lives through one kind of interrupt, or through all, and ends in peace."""
    with Kernel() as found:
        assert found.run(request.module.PRELUDE).error == ""
        found.run("1 / 0")  # IPython's first traceback takes 0.3 s, whatever it is about
        yield found
        assert found.exit() == 0, found.log()
