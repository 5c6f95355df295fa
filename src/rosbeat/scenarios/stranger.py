"""Keep the import of page 07 in release 0.1.0, with a warning that names the new one."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING

from rosbeat.ros.test_nodes import add_greenhouse

if TYPE_CHECKING:
    from rosbeat.ros.session import Session

__all__ = ["greenhouse"]


def greenhouse(session: Session) -> None:
    """Put the nodes of the greenhouse into a session, by the old name.

    Args:
        session: The session.
    """
    words = "greenhouse is now called add_greenhouse, in rosbeat.ros.test_nodes."
    warnings.warn(words, DeprecationWarning, stacklevel=2)
    add_greenhouse(session)
